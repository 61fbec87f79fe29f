//! How long the next samples will take, from the last passes.

use std::collections::VecDeque;

/// Passes that are looked at: enough that one that was held up has no say, few enough that a machine
/// that slows down is noticed.
const PASSES: usize = 5;

/// The speed of the last passes.
///
/// Work is counted in samples of every pixel: a pass that samples half of the pixels does half of it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pace {
    /// Work and seconds, the last one at the end.
    passes: VecDeque<(f64, f64)>,
}

impl Pace {
    /// A pass is done.
    pub fn add(&mut self, work: f64, seconds: f64) {
        if work > 0.0 {
            if self.passes.len() == PASSES {
                self.passes.pop_front();
            }
            self.passes.push_back((work, seconds));
        }
    }

    /// Seconds that one sample of every pixel takes: the median over the last passes, weighted by
    /// their work. `None` before the first.
    pub fn seconds_a_sample(&self) -> Option<f64> {
        let mut paces: Vec<(f64, f64)> = self.passes.iter().map(|(w, s)| (s / w, *w)).collect();
        paces.sort_by(|a, b| a.0.total_cmp(&b.0));
        let half = 0.5 * paces.iter().map(|p| p.1).sum::<f64>();
        let mut below = 0.0;
        for (i, (pace, work)) in paces.iter().enumerate() {
            below += work;
            if below > half {
                return Some(*pace);
            }
            // Half of the work was faster, half slower: between the two.
            if below == half {
                let next = paces.get(i + 1).map_or(*pace, |p| p.0);
                return Some(0.5 * (pace + next));
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pace(passes: &[(f64, f64)]) -> Option<f64> {
        let mut pace = Pace::default();
        for (work, seconds) in passes {
            pace.add(*work, *seconds);
        }
        pace.seconds_a_sample()
    }

    #[test]
    fn it_is_the_weighted_median_of_the_last_passes() {
        assert_eq!(pace(&[]), None);
        assert_eq!(pace(&[(0.0, 1.0)]), None);
        assert_eq!(pace(&[(4.0, 2.0)]), Some(0.5));
        // Equal weights on either side: between the two.
        assert_eq!(pace(&[(2.0, 2.0), (2.0, 6.0)]), Some(2.0));
        // The larger pass has its way.
        assert_eq!(pace(&[(2.0, 2.0), (8.0, 24.0)]), Some(3.0));
        // Five passes at most: the first one is forgotten.
        let passes = [
            (100.0, 900.0),
            (1.0, 1.0),
            (1.0, 2.0),
            (1.0, 3.0),
            (1.0, 4.0),
            (1.0, 5.0),
        ];
        assert_eq!(pace(&passes), Some(3.0));
    }

    #[test]
    fn a_pass_that_was_held_up_has_no_say() {
        let mut passes = vec![(64.0, 6.4); 4];
        passes.push((64.0, 640.0));
        assert!((pace(&passes).expect("there are passes") - 0.1).abs() < 1e-12);
    }
}
