//! What became of paths, counted.

use super::found::{BounceLight, Ended, Paths};
use sr_film::luminance;
use sr_pipeline::glam::Vec3;
use sr_pipeline::replay::{Event, PathEnd};

/// Ends of paths and light by bounce. Throughput and light are luminances; a path sets out with 1.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    paths: u64,
    /// Count, throughput and bounces by [`PathEnd::ALL`].
    ends: [(u64, f64, u64); PathEnd::ALL.len()],
    /// By bounces between camera and light.
    light: Vec<f64>,
    /// Most bounces that the settings allow, if a path has met that limit.
    limit: Option<u32>,
}

impl Tally {
    /// A sample that the film takes.
    pub fn add(&mut self, events: &[Event]) {
        self.paths += 1;
        // A shadow ray belongs to the surface of the last connection.
        let mut connected = 0;
        for event in events {
            match event {
                Event::Emission(e) => self.add_light(e.depth, e.contribution),
                Event::Connection(c) => connected = c.depth,
                Event::Shadow {
                    occluded: false,
                    contribution: Some(light),
                    ..
                } => self.add_light(connected + 1, *light),
                Event::End { why, depth, beta } => self.add_end(*why, *depth, *beta),
                _ => {}
            }
        }
    }

    fn add_light(&mut self, bounces: u32, light: Vec3) {
        let bounces = bounces as usize;
        if self.light.len() <= bounces {
            self.light.resize(bounces + 1, 0.0);
        }
        self.light[bounces] += luminance(light.as_dvec3());
    }

    fn add_end(&mut self, why: PathEnd, depth: u32, beta: Vec3) {
        let Some(i) = PathEnd::ALL.iter().position(|p| *p == why) else {
            return;
        };
        let (count, throughput, bounces) = &mut self.ends[i];
        *count += 1;
        *bounces += u64::from(depth);
        // Radiance may be finite where what would have gone on is not.
        if beta.is_finite() {
            *throughput += luminance(beta.as_dvec3());
        }
        let limit = match why {
            PathEnd::Depth => Some(depth),
            PathEnd::LastRay => Some(depth + 1),
            PathEnd::Left | PathEnd::Absorbed | PathEnd::Roulette => None,
        };
        self.limit = self.limit.max(limit);
    }

    /// Adds what another has counted.
    pub fn merge(&mut self, other: &Self) {
        self.paths += other.paths;
        for (a, b) in self.ends.iter_mut().zip(&other.ends) {
            *a = (a.0 + b.0, a.1 + b.1, a.2 + b.2);
        }
        let longest = self.light.len().max(other.light.len());
        self.light.resize(longest, 0.0);
        for (a, b) in self.light.iter_mut().zip(&other.light) {
            *a += b;
        }
        self.limit = self.limit.max(other.limit);
    }

    /// What it came to; `None` where no end was told.
    pub fn paths(&self, depth_is_a_setting: bool) -> Option<Paths> {
        let count: u64 = self.ends.iter().map(|(n, _, _)| n).sum();
        if count == 0 {
            return None;
        }
        let all_light: f64 = self.light.iter().sum();
        let light = self.light.iter().enumerate().map(|(bounces, light)| {
            let share = if all_light > 0.0 {
                light / all_light
            } else {
                0.0
            };
            BounceLight { bounces, share }
        });
        let ends = PathEnd::ALL.iter().zip(self.ends);
        let ended = ends.map(|(why, (n, throughput, bounces))| Ended {
            why: name(*why),
            text: why.describe(),
            count: n,
            share: n as f64 / count as f64,
            throughput: throughput / self.paths as f64,
            mean_bounces: bounces as f64 / n.max(1) as f64,
        });
        let limit = self.limit.filter(|_| depth_is_a_setting);
        Some(Paths {
            count: self.paths,
            ends: ended.collect(),
            max_depth: limit,
            missing: limit.and_then(|limit| self.missing(limit, all_light)),
            light: light.collect(),
        })
    }

    /// Light beyond the last bounce, as part of all: the light of the last bounces goes on as a geometric
    /// series. `None` where they are too few or too dark to know one, or do not fall.
    fn missing(&self, limit: u32, all: f64) -> Option<f64> {
        let last = limit as usize;
        let of = |bounces: usize| self.light.get(bounces).copied().unwrap_or(0.0);
        if last < 2 {
            return None;
        }
        let (before, at) = (of(last - 1), of(last));
        let ratio = at / before;
        (0.0 < ratio && ratio < 1.0).then(|| {
            let rest = at * ratio / (1.0 - ratio);
            rest / (all + rest)
        })
    }
}

/// As JSON has it.
fn name(why: PathEnd) -> &'static str {
    match why {
        PathEnd::Left => "left",
        PathEnd::Absorbed => "absorbed",
        PathEnd::Depth => "depth",
        PathEnd::LastRay => "last_ray",
        PathEnd::Roulette => "roulette",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_beyond_the_last_bounce_is_the_rest_of_a_geometric_series() {
        let mut tally = Tally {
            paths: 1,
            light: (0..=8).map(|b| 0.5f64.powi(b)).collect(),
            ..Default::default()
        };
        tally.add_end(PathEnd::Depth, 8, Vec3::splat(0.25));
        let paths = tally.paths(true).unwrap();
        assert_eq!(paths.max_depth, Some(8));
        let wanted = 0.5f64.powi(8) / 2.0;
        assert!((paths.missing.unwrap() - wanted).abs() < 1e-12);
        let depth = paths.ends.iter().find(|e| e.why == "depth").unwrap();
        assert!((depth.throughput - 0.25).abs() < 1e-6 && depth.count == 1);
        assert_eq!(tally.paths(false).unwrap().missing, None);
    }
}
