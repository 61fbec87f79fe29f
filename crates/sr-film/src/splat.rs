//! Contributions to arbitrary pixels from any thread, summed so that order does not matter.
//!
//! Floating-point sums depend on the order of their terms, integer sums do not: a splat is turned
//! into units of [`SPLAT_RESOLUTION`] and added atomically to 64-bit integers. The fraction of a
//! unit is rounded up with a probability equal to it, by a number that is a pure function of the
//! splat, so that many splats far below the resolution still add up to their sum on average.

use crate::clamp::{ClampReport, clamped, luminance};
use crate::tile::check_colour;
use crate::{FilmSpec, Rect, Reject};
use glam::{DVec3, Vec3};
use sr_math::hash;
use std::ops::Range;
use std::sync::atomic::{AtomicI64, AtomicU64, Ordering};

/// Units of a splat sum to 1 of radiance.
const UNITS: f64 = (1u64 << 28) as f64;

/// Resolution of a splat sum: 2⁻²⁸, about 3.7·10⁻⁹.
pub const SPLAT_RESOLUTION: f64 = 1.0 / UNITS;

/// The sum of the splats of one pixel, channel and replica stays below this: 2³⁵, about 3.4·10¹⁰
/// (a pixel of radiance 10⁴ reaches it after 3 million samples). A splat that would carry a
/// sum past it is rejected; only then could the result depend on order, and the count says so.
pub const SPLAT_LIMIT: f64 = (1u64 << 35) as f64;

/// The splat sums of a film.
pub struct Splats {
    crop: Rect,
    replicas: usize,
    /// Per pixel, replica and channel; empty when the film takes no splats.
    sums: Vec<AtomicI64>,
    /// Samples per pixel traced, per replica.
    samples: Vec<u64>,
    clamp: Option<SplatClamp>,
}

/// The clamp of splats, which counts what it takes; exact integers, as the sums.
struct SplatClamp {
    limit: f32,
    clamped: AtomicU64,
    /// Luminance cut off, in units, per pixel; it stays at the largest number when it gets there.
    removed: Vec<AtomicI64>,
}

impl Splats {
    pub(crate) fn new(spec: &FilmSpec) -> Self {
        let replicas = spec.replicas as usize;
        let len = if spec.splats {
            spec.crop.pixel_count() as usize * replicas * 3
        } else {
            0
        };
        Self {
            crop: spec.crop,
            replicas,
            sums: std::iter::repeat_with(AtomicI64::default)
                .take(len)
                .collect(),
            samples: vec![0; replicas],
            clamp: spec.clamp.filter(|_| spec.splats).map(|limit| SplatClamp {
                limit,
                clamped: AtomicU64::new(0),
                removed: (0..spec.crop.pixel_count())
                    .map(|_| AtomicI64::new(0))
                    .collect(),
            }),
        }
    }

    /// Bytes per pixel of the splat sums.
    pub(crate) fn bytes_per_pixel(spec: &FilmSpec) -> usize {
        if spec.splats {
            let clamp = usize::from(spec.clamp.is_some());
            (spec.replicas as usize * 3 + clamp) * size_of::<AtomicI64>()
        } else {
            0
        }
    }

    /// Adds a contribution to pixel (x, y) of the picture; outside the crop it is nobody's, which
    /// is no error. `sample` is the index of the sample it belongs to, see [`Film::splat`].
    ///
    /// [`Film::splat`]: crate::Film::splat
    ///
    /// # Errors
    /// A splat that is not finite, negative or past [`SPLAT_LIMIT`] is not added, in no channel.
    pub fn add(&self, x: u32, y: u32, sample: u64, rgb: Vec3) -> Result<(), Reject> {
        if !self.is_on() {
            return Err(Reject::NoSplats);
        }
        check_colour(rgb)?;
        let whole = rgb;
        let rgb = self.clamp.as_ref().map_or(rgb, |c| clamped(rgb, c.limit));
        if f64::from(rgb.max_element()) >= SPLAT_LIMIT {
            return Err(Reject::OutOfRange);
        }
        if !self.crop.contains(x, y) {
            return Ok(());
        }
        let replica = sample as usize & (self.replicas - 1);
        let pixel = self.crop.index(x, y);
        let first = (pixel * self.replicas + replica) * 3;
        let sums = &self.sums[first..first + 3];
        let units = to_units(x, y, sample, rgb);
        for (channel, &amount) in units.iter().enumerate() {
            if !add_within_range(&sums[channel], amount) {
                for (sum, amount) in sums[..channel].iter().zip(units) {
                    sum.fetch_sub(amount, Ordering::Relaxed);
                }
                return Err(Reject::OutOfRange);
            }
        }
        if let Some(clamp) = &self.clamp {
            clamp.note(pixel, whole, rgb);
        }
        Ok(())
    }

    /// Notes that the samples of these indices were traced for every pixel; sums are divided by
    /// their number.
    pub(crate) fn add_samples(&mut self, indices: Range<u64>) {
        let replicas = self.replicas as u64;
        for (r, count) in self.samples.iter_mut().enumerate() {
            let below = |end: u64| (end + replicas - 1 - r as u64) / replicas;
            *count += below(indices.end.max(indices.start)) - below(indices.start);
        }
    }

    /// What the clamp has taken so far, without what it kept; nothing without one.
    pub(crate) fn clamp_report(&self) -> ClampReport {
        let Some(clamp) = &self.clamp else {
            return ClampReport::default();
        };
        let traced = self.samples.iter().sum::<u64>().max(1) as f64;
        let mut report = ClampReport {
            clamped: clamp.clamped.load(Ordering::Relaxed),
            ..ClampReport::default()
        };
        for removed in &clamp.removed {
            report.removed += removed.load(Ordering::Relaxed) as f64 / UNITS / traced;
        }
        report
    }

    /// Whether the film takes splats.
    pub fn is_on(&self) -> bool {
        !self.sums.is_empty()
    }

    /// Sum of the splats and samples traced of each replica of a pixel, `pixel` row-major in the
    /// crop. Nothing when the film takes no splats.
    pub(crate) fn replica_sums(&self, pixel: usize) -> impl Iterator<Item = (DVec3, u64)> {
        let per_pixel = if self.is_on() { self.replicas } else { 0 };
        (0..per_pixel).map(move |r| {
            let first = (pixel * self.replicas + r) * 3;
            let value = |c: usize| self.sums[first + c].load(Ordering::Relaxed) as f64 / UNITS;
            (DVec3::new(value(0), value(1), value(2)), self.samples[r])
        })
    }
}

impl SplatClamp {
    /// Notes that `added` has been added instead of `whole`.
    fn note(&self, pixel: usize, whole: Vec3, added: Vec3) {
        if whole == added {
            return;
        }
        self.clamped.fetch_add(1, Ordering::Relaxed);
        let lost = luminance(whole.as_dvec3() - added.as_dvec3());
        // Conversion ends at the largest number, as the sum does: both in any order.
        let units = (lost * UNITS).round() as i64;
        let _ = self.removed[pixel].fetch_update(Ordering::Relaxed, Ordering::Relaxed, |old| {
            Some(old.saturating_add(units))
        });
    }
}

/// A splat in units. Below 2³⁵ the product with 2²⁸ is exact and fits 63 bits.
fn to_units(x: u32, y: u32, sample: u64, rgb: Vec3) -> [i64; 3] {
    // The value is part of the key: two splats of a sample onto one pixel round independently.
    let [r, g, b] = rgb.to_array().map(f32::to_bits);
    let place = hash::mix64(u64::from(x) << 32 | u64::from(y), sample);
    let colour = hash::mix64(u64::from(r) << 32 | u64::from(g), u64::from(b));
    let key = hash::mix64(place, colour);
    let mut channel = 0;
    rgb.to_array().map(|value| {
        let dither = hash::finalize64(key.wrapping_add(channel)) >> 11;
        channel += 1;
        let units = f64::from(value) * UNITS;
        let whole = units as i64;
        let up = units - whole as f64 > dither as f64 * (1.0 / (1u64 << 53) as f64);
        whole + i64::from(up)
    })
}

/// Adds unless the sum would pass 2⁶³ units, which is [`SPLAT_LIMIT`]; whether it did.
fn add_within_range(sum: &AtomicI64, amount: i64) -> bool {
    sum.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |old| {
        old.checked_add(amount)
    })
    .is_ok()
}
