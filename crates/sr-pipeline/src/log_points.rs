//! When a render is looked at.

use bevy_ecs::prelude::*;
use sr_scene::bevy_ecs;

/// The log points of a render: [`Measure`](crate::Measure) runs there, and at the end.
///
/// The picture does not depend on them, and neither does the error at any number of samples.
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct LogPoints {
    /// At each doubling of the samples: 2, 4, 8 … a pixel, whatever the clock says.
    pub doublings: bool,
    /// After the first pass that ends at or beyond each of these seconds of integration. Passes are
    /// cut so that, by the speed of the last ones, they end there. Marks that are not above 0 are
    /// passed over; the order does not matter.
    pub seconds: Vec<f64>,
}

impl Default for LogPoints {
    fn default() -> Self {
        Self {
            doublings: true,
            seconds: Vec::new(),
        }
    }
}

impl LogPoints {
    /// None but the end.
    pub fn none() -> Self {
        Self {
            doublings: false,
            seconds: Vec::new(),
        }
    }
}

/// Whether [`Measure`](crate::Measure) runs at a log point or at the end. It runs at other times, too,
/// when the error decides how long a render goes on.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AtLogPoint(pub bool);

/// Run condition for systems that keep a log.
pub fn at_log_point(at: Res<'_, AtLogPoint>) -> bool {
    at.0
}

/// The time marks that lie ahead.
#[derive(Clone, Debug)]
pub(crate) struct Marks {
    /// Falling, so that the next one is the last.
    ahead: Vec<f64>,
}

impl Marks {
    pub fn new(points: &LogPoints) -> Self {
        let mut ahead: Vec<f64> = points.seconds.clone();
        ahead.retain(|mark| *mark > 0.0);
        ahead.sort_by(|a, b| b.total_cmp(a));
        Self { ahead }
    }

    /// The next one.
    pub fn next(&self) -> Option<f64> {
        self.ahead.last().copied()
    }

    /// Drops those that `seconds` has reached, and says whether there were any.
    pub fn pass(&mut self, seconds: f64) -> bool {
        let count = self.ahead.len();
        self.ahead.retain(|mark| *mark > seconds);
        self.ahead.len() < count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_come_in_their_order_and_once() {
        let mut marks = Marks::new(&LogPoints {
            seconds: vec![2.0, f64::NAN, 1.0, -3.0, 2.0, 0.0, 8.0],
            ..Default::default()
        });
        assert_eq!(marks.next(), Some(1.0));
        assert!(!marks.pass(0.5));
        assert!(marks.pass(1.0) && !marks.pass(1.5));
        assert_eq!(marks.next(), Some(2.0));
        assert!(marks.pass(3.0));
        assert_eq!(marks.next(), Some(8.0));
        assert!(marks.pass(9.0) && !marks.pass(100.0));
        assert_eq!(marks.next(), None);
    }
}
