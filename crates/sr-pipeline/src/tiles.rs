//! Work over tiles, shared by every integrator that starts at the camera.

use crate::clock::ThreadClock;
use crate::pass::PassSpec;
use crate::report::{RejectKey, TileReport};
use glam::Vec3;
use rayon::prelude::*;
use sr_render::accel::Ray;
use sr_render::film::{Film, FilmTile, Layer};
use sr_render::sampling::{
    Dim, Filter, FilterSampler, IndependentSampler, Sampler, SamplerKind, SamplerSpec, SobolSampler,
};
use sr_render::{Camera, MaterialId};
use sr_scene::settings::{FilmSettings, PixelFilter, SamplerName, SamplerSettings};

/// Gives the random numbers of each sample; static dispatch over the kind of sequence.
pub trait SampleSource: Copy + Send + Sync {
    /// The numbers of one sample.
    type Sampler: Sampler;

    /// The numbers of sample `sample` of the pixel at `pixel`.
    fn at(&self, pixel: [u32; 2], sample: u64) -> Self::Sampler;
}

/// Owen-scrambled Sobol points.
#[derive(Clone, Copy, Debug)]
pub struct SobolSamples(pub SamplerSpec);

impl SampleSource for SobolSamples {
    type Sampler = SobolSampler;
    #[inline]
    fn at(&self, pixel: [u32; 2], sample: u64) -> SobolSampler {
        self.0.sobol(pixel, sample)
    }
}

/// Independent numbers.
#[derive(Clone, Copy, Debug)]
pub struct IndependentSamples(pub SamplerSpec);

impl SampleSource for IndependentSamples {
    type Sampler = IndependentSampler;
    #[inline]
    fn at(&self, pixel: [u32; 2], sample: u64) -> IndependentSampler {
        self.0.independent(pixel, sample)
    }
}

/// The configured kind of sequence; match on it once a pass.
#[derive(Clone, Copy, Debug)]
pub enum Samples {
    /// Sobol.
    Sobol(SobolSamples),
    /// Independent.
    Independent(IndependentSamples),
}

impl Samples {
    /// From the settings.
    pub fn new(settings: &SamplerSettings) -> Self {
        let kind = match settings.kind {
            SamplerName::Sobol => SamplerKind::Sobol,
            SamplerName::Independent => SamplerKind::Independent,
        };
        let spec = SamplerSpec {
            kind,
            seed: settings.seed,
            replicas: settings.replicas,
        };
        match kind {
            SamplerKind::Sobol => Self::Sobol(SobolSamples(spec)),
            SamplerKind::Independent => Self::Independent(IndependentSamples(spec)),
        }
    }
}

/// The pixel filter of the settings, ready to be sampled.
pub fn filter_sampler(settings: &FilmSettings) -> Result<FilterSampler, String> {
    let filter = match settings.filter {
        PixelFilter::Box { radius } => Filter::Box { radius },
        PixelFilter::Tent { radius } => Filter::Tent { radius },
        PixelFilter::Gaussian { radius, sigma } => Filter::Gaussian { radius, sigma },
        PixelFilter::BlackmanHarris { radius } => Filter::BlackmanHarris { radius },
    };
    FilterSampler::new(filter)
        .ok_or_else(|| format!("film.filter: lengths must be above 0 and finite, not {filter:?}"))
}

/// The camera ray of a sample: a place around the pixel's centre, chosen in proportion to the
/// filter, so that the sample belongs to this pixel alone with weight 1, and a point of the lens
/// when there is one.
#[inline]
pub fn camera_ray<S: Sampler>(
    camera: &Camera,
    filter: &FilterSampler,
    (x, y): (u32, u32),
    sampler: &S,
) -> Ray {
    let offset = filter.sample(sampler.d2(Dim::FILTER));
    let center = glam::Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
    let point = camera.lens_point(|| sampler.d2(Dim::LENS));
    camera.ray_through(center + offset, point)
}

/// Runs `work` on every tile in parallel and merges what they count in the order of the tiles. When
/// the film has [`Layer::Seconds`], the processor time of each tile goes there; otherwise no clock is
/// read.
pub fn render_tiles(
    film: &mut Film,
    work: impl Fn(&mut FilmTile) -> TileReport + Sync + Send,
) -> TileReport {
    let timed = film.spec().layers.contains(&Layer::Seconds);
    let work = |tile: &mut FilmTile| {
        if !timed {
            return work(tile);
        }
        let start = ThreadClock::now();
        let report = work(tile);
        tile.add_seconds(start.elapsed());
        report
    };
    let reports: Vec<TileReport> = film.tiles_mut().par_iter_mut().map(work).collect();
    let mut total = TileReport::default();
    for report in reports {
        total.merge(report);
    }
    total
}

/// Adds a sample to the film, or counts why it was rejected.
#[inline]
pub fn deposit(
    tile: &mut FilmTile,
    pixel: usize,
    sample: u64,
    radiance: Vec3,
    bounce: u32,
    material: Option<MaterialId>,
    report: &mut TileReport,
) {
    if let Err(cause) = tile.add(pixel, sample, radiance) {
        let (x, y) = tile.pixel(pixel);
        let key = RejectKey {
            cause,
            bounce,
            material,
        };
        report.rejects.add(key, [x, y], sample);
    }
}

impl PassSpec {
    /// The indices of the pass's samples.
    pub fn indices(&self) -> std::ops::Range<u64> {
        self.first_sample..self.first_sample + u64::from(self.samples)
    }
}
