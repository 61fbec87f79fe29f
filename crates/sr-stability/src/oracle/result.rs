//! What a comparison of paths in both precisions came to.

use super::steps::Cause;
use serde::Serialize;
use sr_experiment::units::counted;
use sr_pipeline::glam::DVec3;
use sr_pipeline::math::color::luminance_of;
use sr_pipeline::replay::SampleId;
use std::collections::BTreeMap;

/// One sample in both precisions.
pub(super) struct Compared {
    pub id: SampleId,
    /// After how many bounces they part, and how.
    pub parting: Option<(u32, Cause)>,
    /// By the film, of what the renderer traced.
    pub is_refused: bool,
    /// In `f32` and in `f64`.
    pub radiance: [DVec3; 2],
    /// The largest distance of a hit from its surface, in units of the claimed one, and its bounce.
    pub off_surface: (f64, u32),
    /// The largest distance of two hits that belong together, likewise.
    pub apart: (f64, u32),
}

/// Paths of the renderer against the same paths in `f64`. What is infinite is `null` in JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Oracle {
    /// Paths that were traced in both precisions.
    pub paths: u64,
    /// Those that part somewhere.
    pub parted: u64,
    /// `parted` by bounce and by cause, in this order.
    pub partings: Vec<Parting>,
    /// Between the radiances of paths that do not part.
    pub radiance: Difference,
    /// The largest distance of a hit in `f32` from its surface, in units of the distance that rays which leave it are
    /// moved by: above 1 a ray may meet the surface that it leaves.
    pub off_surface: Option<Largest>,
    /// The largest distance between two hits of paths that have not parted yet, in units of the length of the error that
    /// the hit in `f32` claims. It counts what the path has gathered on its way too, so it may be large.
    pub apart: Option<Largest>,
    /// Of all paths but those that the film refuses.
    pub mean: Mean,
    /// Samples in `f32` that the film refuses, and the first of them.
    pub refused: u64,
    /// `x,y,sample` of the first of these, for `steradian render --replay`.
    pub refused_replay: Option<String>,
}

/// Paths that part in one way.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Parting {
    /// Bounces before it: 0 on the way to the first surface or there.
    pub bounce: u32,
    /// What is not the same any more.
    pub cause: Cause,
    /// How many.
    pub paths: u64,
    /// `x,y,sample` of the first of them.
    pub replay: String,
}

/// Differences of radiance, relative to the larger of the two, in the channel where it is largest.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// Paths that did not part and bring any light.
    pub paths: u64,
    /// Half of them differ by less.
    pub median: f64,
    /// All but one in a hundred differ by less.
    pub p99: f64,
    /// The one that differs most.
    pub largest: Option<Largest>,
}

/// The largest of something, and where it was.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Largest {
    /// Its value.
    pub value: f64,
    /// Bounces before it; of a whole path 0.
    pub bounce: u32,
    /// `x,y,sample`, for `steradian render --replay`.
    pub replay: String,
}

/// Mean luminance in both precisions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Mean {
    /// Of the renderer.
    pub narrow: f64,
    /// In `f64`.
    pub wide: f64,
    /// Standard error of their difference, from the differences of all paths.
    pub standard_error: f64,
}

/// What rounding may add up to along a path: some hundred operations at each of some ten bounces, 10³ · 2⁻²⁴, all to one
/// side. It is far less than a picture shows.
const ROUNDING: f64 = 1e-4;

impl Oracle {
    pub(super) fn of(compared: &[Compared]) -> Self {
        let refused = || compared.iter().filter(|c| c.is_refused);
        let whole: Vec<&Compared> = compared.iter().filter(|c| !c.is_refused).collect();
        Self {
            paths: compared.len() as u64,
            parted: compared.iter().filter(|c| c.parting.is_some()).count() as u64,
            partings: partings(compared),
            radiance: Difference::of(&whole),
            off_surface: largest(compared.iter().map(|c| (c.off_surface, c.id))),
            apart: largest(compared.iter().map(|c| (c.apart, c.id))),
            mean: Mean::of(&whole),
            refused: refused().count() as u64,
            refused_replay: refused().next().map(|c| c.id.to_string()),
        }
    }

    /// Share of the paths that part.
    pub fn parted_share(&self) -> f64 {
        self.parted as f64 / self.paths.max(1) as f64
    }

    /// What should not be, a sentence each: none when rounding does no harm to this scene.
    pub fn defects(&self) -> Vec<String> {
        let mut defects = Vec::new();
        if let Some(worst) = self.off_surface.as_ref().filter(|w| w.value > 1.0) {
            defects.push(format!(
                "a hit lies {} times as far off its surface as it claims: {worst}",
                figure(worst.value)
            ));
        }
        if self.radiance.median > 10.0 * ROUNDING {
            defects.push(format!(
                "half of the paths that do not part differ in radiance by more than {}",
                figure(self.radiance.median)
            ));
        }
        let Mean {
            narrow,
            wide,
            standard_error,
        } = self.mean;
        // Written so that it holds for what is no number.
        let is_near = (narrow - wide).abs() <= 4.0 * standard_error + ROUNDING * wide.abs();
        if self.refused < self.paths && !is_near {
            defects.push(format!(
                "the mean is {} in f32 and {} in f64, which are further apart than chance (4 standard errors of {}) and \
                 rounding explain",
                figure(narrow),
                figure(wide),
                figure(standard_error)
            ));
        }
        if let Some(replay) = &self.refused_replay {
            let refused = self.refused;
            defects.push(format!(
                "the film refuses {refused} of the samples: --replay {replay}"
            ));
        }
        defects
    }

    /// By cause: how many paths, and the earliest of them.
    pub fn causes(&self) -> Vec<(Cause, u64, &Parting)> {
        let mut causes: BTreeMap<Cause, (u64, &Parting)> = BTreeMap::new();
        // In the order of bounces.
        for parting in &self.partings {
            causes.entry(parting.cause).or_insert((0, parting)).0 += parting.paths;
        }
        let causes = causes.into_iter();
        causes
            .map(|(cause, (n, first))| (cause, n, first))
            .collect()
    }

    /// What it came to, for people, a sentence each.
    pub fn words(&self) -> Vec<String> {
        let mut words = vec![format!(
            "{} paths were traced again in f64 with the same random numbers; {} of them ({:.2} %) part",
            self.paths,
            self.parted,
            100.0 * self.parted_share()
        )];
        words.extend(self.causes().into_iter().map(|(cause, paths, first)| {
            format!(
                "{paths} by {cause}, the earliest after {}: --replay {}",
                counted(first.bounce.into(), "bounce"),
                first.replay
            )
        }));
        let radiance = &self.radiance;
        if let Some(worst) = &radiance.largest {
            words.push(format!(
                "the others have the same radiance but for {} (median), {} (99 %), {} (largest): {worst}",
                figure(radiance.median),
                figure(radiance.p99),
                figure(worst.value)
            ));
        }
        if let Some(worst) = &self.off_surface {
            words.push(format!(
                "hits lie off their surface by at most {} of what they claim: {worst}",
                figure(worst.value)
            ));
        }
        if let Some(worst) = &self.apart {
            words.push(format!(
                "points of the two paths are at most {} of these errors apart: {worst}",
                figure(worst.value)
            ));
        }
        words.push(format!(
            "the mean is {:.6} in f32 and {:.6} in f64, which differ by {} ± {} (standard error)",
            self.mean.narrow,
            self.mean.wide,
            figure(self.mean.narrow - self.mean.wide),
            figure(self.mean.standard_error)
        ));
        words
    }
}

/// Two digits.
fn figure(x: f64) -> String {
    if x == 0.0 || (0.01..1000.0).contains(&x.abs()) {
        format!("{x:.3}")
    } else {
        format!("{x:.1e}")
    }
}

impl std::fmt::Display for Largest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "--replay {}", self.replay)?;
        match self.bounce {
            0 => Ok(()),
            bounce => write!(f, ", bounce {bounce}"),
        }
    }
}

fn partings(compared: &[Compared]) -> Vec<Parting> {
    let mut all: BTreeMap<(u32, Cause), (u64, SampleId)> = BTreeMap::new();
    for c in compared {
        if let Some(parting) = c.parting {
            all.entry(parting).or_insert((0, c.id)).0 += 1;
        }
    }
    let one = |((bounce, cause), (paths, id)): (_, (u64, SampleId))| Parting {
        bounce,
        cause,
        paths,
        replay: id.to_string(),
    };
    all.into_iter().map(one).collect()
}

/// The first of the largest; `None` where nothing was measured.
fn largest(all: impl Iterator<Item = ((f64, u32), SampleId)>) -> Option<Largest> {
    let worst = all.reduce(|a, b| if b.0.0 > a.0.0 { b } else { a })?;
    let ((value, bounce), id) = worst;
    Some(Largest {
        value,
        bounce,
        replay: id.to_string(),
    })
}

impl Difference {
    fn of(whole: &[&Compared]) -> Self {
        let together = whole.iter().filter(|c| c.parting.is_none());
        let lit = together.filter(|c| c.radiance.iter().any(|l| *l != DVec3::ZERO));
        let relative = |[a, b]: [DVec3; 2]| {
            let scale = a.abs().max_element().max(b.abs().max_element());
            let relative = (a - b).abs().max_element() / scale;
            if relative.is_nan() {
                f64::INFINITY
            } else {
                relative
            }
        };
        let all: Vec<(f64, SampleId)> = lit.map(|c| (relative(c.radiance), c.id)).collect();
        let mut sorted: Vec<f64> = all.iter().map(|(x, _)| *x).collect();
        sorted.sort_by(f64::total_cmp);
        let quantile = |q: f64| {
            let at = (q * sorted.len() as f64) as usize;
            sorted.get(at).or(sorted.last()).copied().unwrap_or(0.0)
        };
        Self {
            paths: all.len() as u64,
            median: quantile(0.5),
            p99: quantile(0.99),
            largest: largest(all.iter().map(|(x, id)| ((*x, 0), *id))),
        }
    }
}

impl Mean {
    fn of(whole: &[&Compared]) -> Self {
        let n = whole.len().max(1) as f64;
        let luminance = |l: DVec3| luminance_of(l.to_array());
        let mean = |of: &dyn Fn(&Compared) -> f64| whole.iter().map(|c| of(c)).sum::<f64>() / n;
        let difference = |c: &Compared| luminance(c.radiance[0]) - luminance(c.radiance[1]);
        let bias = mean(&difference);
        let variance = mean(&|c| (difference(c) - bias).powi(2));
        Self {
            narrow: mean(&|c| luminance(c.radiance[0])),
            wide: mean(&|c| luminance(c.radiance[1])),
            standard_error: (variance / (n - 1.0).max(1.0)).sqrt(),
        }
    }
}
