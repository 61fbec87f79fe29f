//! A record of everything that happens to one sample, and random numbers that enter themselves.

use super::event::{Draw, Event, Number, Witness};
use glam::Vec2;
use sr_render::sampling::{Dim, Sampler};
use std::sync::{Mutex, PoisonError};

/// The events of a sample in their order. Behind a lock, since samplers are copied freely and each copy
/// enters its numbers; one thread at a time traces a sample, so nobody waits.
#[derive(Debug, Default)]
pub struct Record(Mutex<Vec<Event>>);

impl Record {
    /// An empty one.
    pub fn new() -> Self {
        Self::default()
    }

    /// Enters something.
    pub fn push(&self, event: Event) {
        self.lock().push(event);
    }

    /// Hands over what has been entered, and is empty again.
    pub fn take(&self) -> Vec<Event> {
        std::mem::take(&mut *self.lock())
    }

    /// Looks at what has been entered, and is empty again, with the memory that it has.
    pub fn drain(&self, mut look: impl FnMut(&[Event])) {
        let mut events = self.lock();
        look(&events);
        events.clear();
    }

    /// A sampler whose numbers are entered here.
    pub fn sampler<S: Sampler>(&self, sampler: S) -> RecordingSampler<'_, S> {
        RecordingSampler {
            sampler,
            record: self,
            fork: 0,
            split: [0, 1],
        }
    }

    /// A push leaves nothing half done, so a panic elsewhere spoils nothing.
    fn lock(&self) -> std::sync::MutexGuard<'_, Vec<Event>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Witness for &Record {
    fn see(&mut self, _: u32, event: Event) {
        self.push(event);
    }
}

/// Gives the numbers of another sampler, and enters them; see [`Record::sampler`].
#[derive(Clone, Copy, Debug)]
pub struct RecordingSampler<'a, S> {
    sampler: S,
    record: &'a Record,
    fork: u32,
    split: [u32; 2],
}

impl<S> RecordingSampler<'_, S> {
    fn note(&self, dim: Dim, u: Draw) {
        self.record.push(Event::Number(Number {
            dim,
            u,
            fork: self.fork,
            split: self.split,
        }));
    }
}

impl<S: Sampler> Sampler for RecordingSampler<'_, S> {
    fn d1(&self, dim: Dim) -> f32 {
        let u = self.sampler.d1(dim);
        self.note(dim, Draw::D1(u));
        u
    }

    fn d2(&self, dim: Dim) -> Vec2 {
        let u = self.sampler.d2(dim);
        self.note(dim, Draw::D2(u));
        u
    }

    fn split(&self, j: u32, n: u32) -> Self {
        let sampler = self.sampler.split(j, n);
        let split = if n == 1 { self.split } else { [j, n] };
        Self {
            sampler,
            split,
            ..*self
        }
    }

    fn fork(&self, k: u32) -> Self {
        let sampler = self.sampler.fork(k);
        let fork = if k == 0 { self.fork } else { k };
        Self {
            sampler,
            fork,
            ..*self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sr_render::sampling::{BounceDim, SamplerSpec};

    #[test]
    fn numbers_are_the_samplers_own_and_are_entered_in_order() {
        let plain = SamplerSpec::default().sobol([3, 4], 77);
        let record = Record::new();
        let sampler = record.sampler(plain);
        let light = Dim::bounce(2, BounceDim::Light);
        assert_eq!(sampler.d2(Dim::FILTER), plain.d2(Dim::FILTER));
        let part = sampler.fork(5).split(1, 3);
        assert_eq!(part.d1(light), plain.fork(5).split(1, 3).d1(light));
        let events = record.take();
        let [Event::Number(a), Event::Number(b)] = events[..] else {
            panic!("{events:?}");
        };
        assert_eq!((a.dim, a.fork, a.split), (Dim::FILTER, 0, [0, 1]));
        assert_eq!((b.dim, b.fork, b.split), (light, 5, [1, 3]));
        assert_eq!(a.u, Draw::D2(plain.d2(Dim::FILTER)));
        assert!(record.take().is_empty());
    }
}
