//! What pictures are measured against, and the error that it has itself.
//!
//! A reference that is rendered is kept in the experiment's folder, under a name made of its
//! configuration and of its first sample a pixel: a scene, an image map or a renderer that has
//! changed gives other bits there, so that an old picture is not taken for the new one.

use crate::document::ReferenceSpec;
use crate::folder::Folder;
use crate::host::Host;
use crate::plan::{Plan, RenderedReference};
use crate::session;
use glam::Vec3;
use serde::Serialize;
use sr_film::{Image, RELMSE_OFFSET, read_channels, read_image};
use sr_pipeline::{Developed, OutputRequest, RenderReport, StageSeconds, StopReason};
use std::path::Path;
use std::sync::Arc;

/// A picture to measure against.
#[derive(Clone, Debug)]
pub struct Reference {
    /// Radiance.
    pub image: Image,
    /// Variance of `image`, when it is known.
    pub variance: Option<Image>,
    /// What is told of it.
    pub facts: ReferenceFacts,
}

/// What rows and pages tell of a reference.
#[derive(Clone, Debug, Serialize)]
pub struct ReferenceFacts {
    /// Its file; for one that was rendered relative to the experiment's folder.
    pub file: String,
    /// Samples a pixel, of one that was rendered.
    pub samples: Option<u64>,
    /// Seconds that it took, whenever it was rendered.
    pub seconds: Option<f64>,
    /// An earlier experiment in the same folder had rendered it.
    pub from_cache: bool,
    /// Its own MSE, from the variance of its pixels.
    pub mse: Option<f64>,
    /// Its own relMSE, likewise.
    pub relmse: Option<f64>,
}

/// Names of the variance's channels.
const VARIANCE: [&str; 3] = ["Variance.R", "Variance.G", "Variance.B"];

/// The variance that a picture's file has.
pub(crate) fn variance_of(path: &Path) -> Option<Image> {
    read_channels(path, &VARIANCE).ok().map(image_of)
}

/// A reference, or why it failed.
pub type Attempt = Result<Arc<Reference>, String>;

/// The reference of each point, by number, or why there is none; `None` when the host wants an end.
pub(crate) fn references(
    plan: &Plan,
    folder: &Folder,
    host: &dyn Host,
) -> Option<Vec<Option<Attempt>>> {
    let mut of_point = vec![None; plan.points.len()];
    if let (Some(image), Some(ReferenceSpec::File { path, .. })) =
        (&plan.reference_file, &plan.experiment.reference)
    {
        let reference = Arc::new(Reference::from_file(image.clone(), path));
        of_point.fill(Some(Ok(reference)));
    }
    for (number, wanted) in plan.references.iter().enumerate() {
        let name = format!("reference {} of {}", number + 1, plan.references.len());
        let reference = match rendered(plan, wanted, &name, folder, host) {
            Ok(reference) => Ok(Arc::new(reference?)),
            Err(cause) => {
                host.warn(&format!("{name}: {cause}"));
                Err(cause)
            }
        };
        for point in &wanted.points {
            of_point[*point] = Some(reference.clone());
        }
    }
    Some(of_point)
}

impl Reference {
    fn new(image: Image, variance: Option<Image>, file: String) -> Self {
        let mut reference = Self {
            image,
            variance,
            facts: ReferenceFacts {
                file,
                samples: None,
                seconds: None,
                from_cache: false,
                mse: None,
                relmse: None,
            },
        };
        if let Some([mse, relmse]) = reference.noise() {
            reference.facts.mse = Some(mse);
            reference.facts.relmse = Some(relmse);
        }
        reference
    }

    /// With its variance when the file has that.
    fn from_file(image: Image, path: &Path) -> Self {
        let variance = variance_of(path);
        let same = |v: &Image| (v.width, v.height) == (image.width, image.height);
        let variance = variance.filter(same);
        Self::new(image, variance, path.display().to_string())
    }

    /// Its own MSE and relMSE, over the pixels whose variance is known. What it takes from a
    /// picture's error: the expectation of (x − r)² is the picture's own error and the variance of r.
    fn noise(&self) -> Option<[f64; 2]> {
        let variance = self.variance.as_ref()?;
        let both = self.image.pixels.iter().zip(&variance.pixels);
        let known = both.filter(|(r, v)| r.is_finite() && v.is_finite());
        let (mut sums, mut count) = ([0.0; 2], 0.0);
        for (r, v) in known {
            let (r, v) = (r.as_dvec3(), v.as_dvec3());
            sums[0] += v.element_sum() / 3.0;
            sums[1] += (v / (r * r + RELMSE_OFFSET)).element_sum() / 3.0;
            count += 1.0;
        }
        (count > 0.0).then(|| sums.map(|s| s / count))
    }
}

fn image_of(channels: sr_film::Channels) -> Image {
    let [r, g, b] = [0, 1, 2].map(|i| &channels.planes[i]);
    let pixels = r.iter().zip(g).zip(b);
    Image {
        width: channels.width,
        height: channels.height,
        pixels: pixels.map(|((r, g), b)| Vec3::new(*r, *g, *b)).collect(),
    }
}

/// From the folder, or rendered into it; `None` when it was interrupted.
fn rendered(
    plan: &Plan,
    wanted: &RenderedReference,
    name: &str,
    folder: &Folder,
    host: &dyn Host,
) -> Result<Option<Reference>, String> {
    if host.stopped() {
        return Ok(None);
    }
    let point = &plan.points[wanted.point];
    let changes = point.reference_changes(&plan.experiment);
    let changes = changes.unwrap_or_default();
    let mut pipeline = session::open(&plan.experiment, changes, host)?;
    let explained = |e| host.explain(e);
    let probe = session::probe(&mut pipeline).map_err(explained)?;
    let key = format!("{}-{:016x}", wanted.facts.config_hash, probe.hash);
    let path = folder.reference(&key);
    if let Some(reference) = cached(&path, folder) {
        host.say(&format!("{name}: taken from {}", reference.facts.file));
        return Ok(Some(reference));
    }
    pipeline.world.insert_resource(OutputRequest {
        exr: Some(path.clone()),
        ..Default::default()
    });
    let stop = session::render(&mut pipeline, name, host);
    if stop.map_err(explained)? == StopReason::Asked {
        return Ok(None);
    }
    folder.make_references()?;
    pipeline.post().map_err(explained)?;
    let world = &pipeline.world;
    let developed = world.resource::<Developed>();
    let image = developed.image.rgb.clone();
    let variance = developed.image.variance_of_mean.clone();
    let mut reference = Reference::new(image, Some(variance), folder.relative(&path));
    let seconds = world.resource::<StageSeconds>().integrate;
    reference.facts.samples = Some(world.resource::<RenderReport>().samples_per_pixel);
    reference.facts.seconds = Some(seconds);
    host.say(&format!("{name}: rendered in {seconds:.2} s"));
    Ok(Some(reference))
}

/// One that an earlier experiment has left. A file that cannot be read is rendered again.
fn cached(path: &Path, folder: &Folder) -> Option<Reference> {
    if !path.is_file() {
        return None;
    }
    let image = read_image(path).ok()?;
    let variance = variance_of(path);
    let mut reference = Reference::new(image, variance, folder.relative(path));
    let attributes = sr_film::read_attributes(path).unwrap_or_default();
    let number = |name: &str| {
        let full = format!("{}{name}", sr_film::ATTRIBUTE_PREFIX);
        let found = attributes.iter().find(|(n, _)| *n == full);
        found.and_then(|(_, value)| value.parse::<f64>().ok())
    };
    reference.facts.samples = number("samples").map(|n| n as u64);
    reference.facts.seconds = number("seconds");
    reference.facts.from_cache = true;
    Some(reference)
}
