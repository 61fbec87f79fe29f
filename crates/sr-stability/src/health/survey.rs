//! Samples of a picture, one by one, and what is kept of them.

use super::grid::Grid;
use super::moments::Moments;
use super::tally::Tally;
use super::top::{Bright, Top};
use sr_film::{check_colour, luminance};
use sr_pipeline::glam::Vec3;
use sr_pipeline::rayon::prelude::*;
use sr_pipeline::replay::{Record, SampleId, SampleTracer};
use sr_pipeline::{Pipeline, RejectKey, Rejects};
use std::ops::Range;
use std::time::Instant;

/// Pixels that one thread takes at a time. A constant: sums are made in this order whatever the threads.
const CHUNK: usize = 256;
/// Most samples a pixel between two looks at the clock.
const LONGEST_BLOCK: u64 = 16;

/// What is kept of all samples.
pub(super) struct Survey {
    /// Which pixels.
    pub grid: Grid,
    /// Samples a pixel.
    pub samples: u64,
    /// Before the first of them.
    pub begun: Instant,
    /// Of each pixel.
    pub pixels: Vec<Moments>,
    pub top: Top,
    pub rejects: Rejects,
    pub tally: Tally,
}

/// What one thread adds.
#[derive(Default)]
struct Part {
    bright: Vec<Bright>,
    rejects: Rejects,
    tally: Tally,
}

/// Blocks of sample indices that grow: the first ones tell which samples are bright at all.
pub(super) fn blocks(samples: u64) -> impl Iterator<Item = Range<u64>> {
    let mut next = 0;
    std::iter::from_fn(move || {
        let first = next;
        next = samples.min(first + first.clamp(1, LONGEST_BLOCK));
        (first < samples).then_some(first..next)
    })
}

impl Survey {
    /// Before the first sample.
    pub fn new(grid: Grid, samples: u64) -> Self {
        Self {
            grid,
            samples,
            begun: Instant::now(),
            pixels: vec![Moments::default(); grid.len()],
            top: Top::of(grid.len() as u64 * samples),
            rejects: Rejects::default(),
            tally: Tally::default(),
        }
    }

    /// A block of samples of each pixel, by the integrator's tracer.
    pub fn trace(&mut self, pipeline: &Pipeline, tracer: &dyn SampleTracer, block: &Range<u64>) {
        let (grid, threshold) = (self.grid, self.top.threshold());
        let pixels = &mut self.pixels;
        let trace = |(chunk, pixels): (usize, &mut [Moments])| {
            let record = Record::new();
            let mut part = Part::default();
            for (i, moments) in pixels.iter_mut().enumerate() {
                let i = chunk * CHUNK + i;
                for sample in block.clone() {
                    let pixel = grid.pixel(i);
                    let traced = tracer.trace(SampleId { pixel, sample }, &record);
                    if let Err(cause) = check_colour(traced.radiance) {
                        let key = RejectKey {
                            cause,
                            bounce: traced.bounces,
                            material: traced.material,
                        };
                        part.rejects.add(key, pixel, sample);
                        record.drain(|_| ());
                        continue;
                    }
                    record.drain(|events| part.tally.add(events));
                    let found = take(moments, traced.radiance, i, sample);
                    part.bright
                        .extend(Some(found).filter(|b| b.luminance > threshold));
                }
            }
            part
        };
        let parts: Vec<Part> = pipeline.install(|| {
            let chunks = pixels.par_chunks_mut(CHUNK).enumerate();
            chunks.map(trace).collect()
        });
        let mut bright = Vec::new();
        for part in parts {
            bright.extend(part.bright);
            self.tally.merge(&part.tally);
            add_rejects(&mut self.rejects, part.rejects);
        }
        self.top.offer(bright);
    }

    /// One sample of each pixel that has one, from a picture.
    pub fn add_picture(&mut self, sample: u64, values: impl Iterator<Item = Option<Vec3>>) {
        let threshold = self.top.threshold();
        let mut bright = Vec::new();
        for (i, (moments, value)) in self.pixels.iter_mut().zip(values).enumerate() {
            if let Some(value) = value {
                let found = take(moments, value, i, sample);
                bright.extend(Some(found).filter(|b| b.luminance > threshold));
            }
        }
        self.top.offer(bright);
    }

    /// All light.
    pub fn light(&self) -> f64 {
        self.pixels.iter().map(Moments::sum).sum()
    }
}

fn take(moments: &mut Moments, radiance: Vec3, pixel: usize, sample: u64) -> Bright {
    let luminance = luminance(radiance.as_dvec3());
    moments.add(luminance);
    Bright {
        luminance,
        pixel,
        sample,
    }
}

/// Of each kind the first one stays the example.
fn add_rejects(all: &mut Rejects, more: Rejects) {
    for (key, (n, pixel, sample)) in more.0 {
        all.0.entry(key).or_insert((0, pixel, sample)).0 += n;
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn blocks_are_every_sample_once() {
        let all: Vec<u64> = super::blocks(100).flatten().collect();
        assert_eq!(all, (0..100).collect::<Vec<u64>>());
        let first: Vec<_> = super::blocks(20).take(4).collect();
        assert_eq!(first, [0..1, 1..2, 2..4, 4..8]);
    }
}
