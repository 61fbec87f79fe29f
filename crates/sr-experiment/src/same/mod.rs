//! "Are these two the same?": whether two methods have the same expected picture.
//!
//! After Jung, Hanika and Dachsbacher 2020, "Detecting Bias in Monte Carlo Renderers using Welch's
//! t-test" (JCGT 9(2)): pictures are cut into tiles, the means of tiles and channels are near to
//! normal, and Welch's test asks whether two of them differ by more than their variances explain.
//! Three questions together give the [`Verdict`]:
//!
//! 1. **tiles**: is the smallest p-value of all tiles and channels too small for so many tests
//!    (Šidák 1967)? Finds what is wrong somewhere.
//! 2. **distribution**: are there more small p-values than uniform ones would be (one-sided
//!    Kolmogorov–Smirnov, by channel)? Finds what is a little wrong in many places.
//! 3. **mean**: does the mean of the picture differ? Finds a little too much or too little light
//!    everywhere.
//!
//! The false-alarm rate is shared by all three. [`Evidence`] is several pictures of a method, which
//! differ in their seeds, or one with its own variance. The tests
//! and figures of `p` are approximate where tails are heavy: rare bright paths that one method has
//! met and the other has not yet. Such tiles are counted ([`Verdict::heavy_tiles`]), and where
//! there are many a difference is called [`Answer::Unclear`]; more samples cure it.

mod judge;
mod sides;
#[cfg(test)]
mod tests;
mod verdict;

pub use sides::{SameError, Side};
pub use verdict::{Answer, MeanDifference, Question, TileDifference, Verdict};

use sr_film::Image;

/// How to ask.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Side of the tiles in pixels, at least 1.
    pub tile: u32,
    /// Probability that two methods of the same expectation are called different.
    pub false_alarm: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            tile: 8,
            false_alarm: 0.01,
        }
    }
}

/// What is known of one method.
#[derive(Clone, Copy, Debug)]
pub enum Evidence<'a> {
    /// Two or more pictures that differ in their seeds only. Pixels of a tile may be correlated;
    /// tiles are taken for independent where the distribution is asked for.
    Seeds(&'a [Image]),
    /// One picture with the variance of its mean. Pixels must be independent of one another, which they
    /// are where each sample counts for one pixel; for integrators that splat it takes several seeds.
    ///
    /// A tile that rare bright paths have missed knows nothing of them, and a mean that is too low comes
    /// with a variance that is too low. So a tile's variance is taken to be that of the 3 × 3 tiles
    /// around it if theirs is larger: a little too careful where noise changes.
    Variance(Side<'a>),
}

impl<'a> From<&'a [Image]> for Evidence<'a> {
    fn from(images: &'a [Image]) -> Self {
        Self::Seeds(images)
    }
}

impl<'a> From<Side<'a>> for Evidence<'a> {
    fn from(side: Side<'a>) -> Self {
        Self::Variance(side)
    }
}

/// Whether two methods have the same expectation. The noise of `a` should be independent of that of `b`;
/// where both share their seeds, differences are smaller than the test expects, and it is too
/// careful.
///
/// # Errors
/// Fewer than two pictures of a side of several, different sizes, pixels that are not finite,
/// variances that are not known.
pub fn same<'a>(
    a: impl Into<Evidence<'a>>,
    b: impl Into<Evidence<'a>>,
    settings: &Settings,
) -> Result<Verdict, SameError> {
    let known = |evidence: Evidence<'_>| match evidence {
        Evidence::Seeds(images) => sides::from_seeds(images, settings),
        Evidence::Variance(side) => sides::from_variance(&side, settings),
    };
    judge::judge(&known(a.into())?, &known(b.into())?, settings)
}
