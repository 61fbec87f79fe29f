//! Names for the decisions that consume random numbers.

use std::fmt;

/// One decision of a path: it has its own one or two random numbers, independent of all others.
///
/// Dimensions 0 to 15 belong to the camera, the next 16 to bounce 0, and so on: a fixed stride, so
/// that kernels which take fewer decisions at a bounce agree on the rest of the path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Dim(u32);

/// A decision at one vertex of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BounceDim {
    /// Which lobe of the material scatters (1-D).
    Lobe,
    /// The direction it scatters to (2-D).
    Bsdf,
    /// Which light is sampled (1-D).
    LightSelect,
    /// The point on that light (2-D).
    Light,
    /// Whether the path goes on (1-D).
    Roulette,
    /// The integrator's own, from 0 to [`BounceDim::USERS`] − 1.
    User(u32),
}

impl BounceDim {
    /// How many [`BounceDim::User`] decisions a bounce has.
    pub const USERS: u32 = Dim::STRIDE - 5;

    const fn slot(self) -> u32 {
        match self {
            Self::Lobe => 0,
            Self::Bsdf => 1,
            Self::LightSelect => 2,
            Self::Light => 3,
            Self::Roulette => 4,
            Self::User(k) => {
                assert!(k < Self::USERS, "a bounce has 11 dimensions for users");
                5 + k
            }
        }
    }
}

impl Dim {
    const STRIDE: u32 = 16;

    /// The place within the pixel filter (2-D).
    pub const FILTER: Self = Self(0);
    /// The point on the lens (2-D).
    pub const LENS: Self = Self(1);
    /// The moment within the exposure (1-D).
    pub const TIME: Self = Self(2);
    /// How many decisions [`Dim::user`] has.
    pub const USERS: u32 = Self::STRIDE - 3;

    /// A decision of the integrator's own before the first bounce, from 0 to [`Dim::USERS`] − 1.
    ///
    /// # Panics
    /// When `k` is larger.
    #[inline]
    pub const fn user(k: u32) -> Self {
        assert!(k < Self::USERS, "the camera has 13 dimensions for users");
        Self(3 + k)
    }

    /// A decision at the vertex number `depth`, counted from 0 at the first hit. Any depth will do.
    ///
    /// # Panics
    /// When a [`BounceDim::User`] is out of its range.
    #[inline]
    pub const fn bounce(depth: u32, what: BounceDim) -> Self {
        // Wraps after 2²⁸ bounces.
        Self((depth + 1).wrapping_mul(Self::STRIDE) + what.slot())
    }

    /// The number that is hashed.
    #[inline]
    pub const fn index(self) -> u32 {
        self.0
    }
}

impl fmt::Display for Dim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (vertex, slot) = (self.0 / Self::STRIDE, self.0 % Self::STRIDE);
        match (vertex.checked_sub(1), slot) {
            (None, 0) => f.write_str("filter"),
            (None, 1) => f.write_str("lens"),
            (None, 2) => f.write_str("time"),
            (None, k) => write!(f, "user {}", k - 3),
            (Some(depth), 0) => write!(f, "lobe at depth {depth}"),
            (Some(depth), 1) => write!(f, "direction at depth {depth}"),
            (Some(depth), 2) => write!(f, "choice of a light at depth {depth}"),
            (Some(depth), 3) => write!(f, "point on a light at depth {depth}"),
            (Some(depth), 4) => write!(f, "roulette at depth {depth}"),
            (Some(depth), k) => write!(f, "user {} at depth {depth}", k - 5),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn no_two_decisions_share_a_dimension() {
        let mut seen = HashSet::new();
        let camera = [Dim::FILTER, Dim::LENS, Dim::TIME];
        let users = (0..Dim::USERS).map(Dim::user);
        let bounces = (0..1000).flat_map(|depth| {
            use BounceDim::{Bsdf, Light, LightSelect, Lobe, Roulette, User};
            [Lobe, Bsdf, LightSelect, Light, Roulette]
                .into_iter()
                .chain((0..BounceDim::USERS).map(User))
                .map(move |what| Dim::bounce(depth, what))
        });
        for dim in camera.into_iter().chain(users).chain(bounces) {
            assert!(seen.insert(dim), "{dim:?}");
        }
        assert_eq!(seen.len(), 16 * 1001);
    }

    #[test]
    fn decisions_have_names() {
        let name = |dim: Dim| dim.to_string();
        assert_eq!(name(Dim::FILTER), "filter");
        assert_eq!(name(Dim::user(2)), "user 2");
        assert_eq!(
            name(Dim::bounce(0, BounceDim::Light)),
            "point on a light at depth 0"
        );
        assert_eq!(
            name(Dim::bounce(7, BounceDim::User(3))),
            "user 3 at depth 7"
        );
    }
}
