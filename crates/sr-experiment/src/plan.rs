//! Everything that is to be done, looked at before anything is: every point is loaded and compiled
//! once, and all that is wrong with any of them is told in one go.

use crate::document::{Experiment, ReferenceSpec};
use crate::expand::{Point, Run, points, runs};
use crate::host::Host;
use crate::session;
use sr_film::{Image, read_image};
use sr_io::document::OverrideEntry;
use sr_io::{config_hash, resolved_config};
use sr_pipeline::catalog::SelectedIntegrator;
use sr_pipeline::diagnostics::{Diagnostic, Diagnostics, Severity};
use sr_pipeline::settings::{Budget, PostSettings};
use sr_pipeline::{Pipeline, PipelineError, PlanItem, film_spec};
use std::collections::HashSet;
use std::path::Path;

/// An experiment that is known to be right, as far as that can be known.
#[derive(Debug)]
pub struct Plan {
    /// The file.
    pub experiment: Experiment,
    /// Values of the axes with methods.
    pub points: Vec<Point>,
    /// What is known of each point.
    pub facts: Vec<Facts>,
    /// Pictures, in the order in which they are made.
    pub runs: Vec<Run>,
    /// References to be rendered, each for one or more points.
    pub references: Vec<RenderedReference>,
    /// The reference that is a file.
    pub reference_file: Option<Image>,
}

/// What loading and compiling a point has told.
#[derive(Clone, Debug)]
pub struct Facts {
    /// The scene's file as the configuration names it.
    pub scene: String,
    /// Name of the integrator.
    pub integrator: String,
    /// Width and height of what is rendered.
    pub size: [u32; 2],
    /// Values a pixel in the EXR file.
    pub channels: u64,
    /// Samples a pixel at which a run ends at the latest, when that is known.
    pub samples: Option<u64>,
    /// Seconds after which it ends, if any.
    pub seconds: Option<f64>,
    /// Development of the picture.
    pub post: PostSettings,
    /// What a run does not do, and why.
    pub left_out: Vec<PlanItem>,
    /// The resolved configuration, with the base's seed.
    pub config: String,
    /// Its short name.
    pub config_hash: String,
    /// The same without what decides only how long it takes in all.
    pub work: String,
}

/// A reference that is rendered.
#[derive(Clone, Debug)]
pub struct RenderedReference {
    /// The first of its points, whose axes it has.
    pub point: usize,
    /// What is known of it.
    pub facts: Facts,
    /// Which points are measured against it.
    pub points: Vec<usize>,
}

/// Why there is no plan. What is wrong has been told to the host.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PlanError {
    /// The input has errors.
    Input {
        /// How many.
        errors: usize,
    },
    /// The machine refused, or there is a bug.
    Pipeline(PipelineError),
}

/// Looks at every point and reference of an experiment.
///
/// # Errors
/// Anything that is wrong with any of them; all of it is told to the host first, each thing once.
pub fn plan(experiment: Experiment, host: &dyn Host) -> Result<Plan, PlanError> {
    let points = points(&experiment);
    let runs = runs(&experiment, &points);
    let mut look = Look::new(&experiment, host);
    let mut facts = Vec::new();
    let mut references: Vec<RenderedReference> = Vec::new();
    for (number, point) in points.iter().enumerate() {
        let seed = experiment.seeds.first().copied();
        facts.extend(look.at(point.changes(&experiment, seed))?);
        let Some(changes) = point.reference_changes(&experiment) else {
            continue;
        };
        let Some(found) = look.at(changes)? else {
            continue;
        };
        let same = |r: &&mut RenderedReference| r.facts.config == found.config;
        match references.iter_mut().find(same) {
            Some(reference) => reference.points.push(number),
            None => references.push(RenderedReference {
                point: number,
                facts: found,
                points: vec![number],
            }),
        }
    }
    let reference_file = look.reference_file(&facts);
    look.attachments();
    look.sizes(&facts, &references, &points);
    match look.errors {
        0 => Ok(Plan {
            experiment,
            points,
            facts,
            runs,
            references,
            reference_file,
        }),
        errors => Err(PlanError::Input { errors }),
    }
}

/// What is common to looking at all points.
struct Look<'a> {
    experiment: &'a Experiment,
    host: &'a dyn Host,
    told: HashSet<String>,
    errors: usize,
}

impl<'a> Look<'a> {
    fn new(experiment: &'a Experiment, host: &'a dyn Host) -> Self {
        Self {
            experiment,
            host,
            told: HashSet::new(),
            errors: 0,
        }
    }

    fn tell(&mut self, diagnostic: &Diagnostic) {
        if self.told.insert(diagnostic.to_string()) {
            self.errors += usize::from(diagnostic.severity == Severity::Error);
            self.host.diagnose(diagnostic);
        }
    }

    /// Loads and compiles; `None` when the input is wrong, which has been told.
    fn at(&mut self, changes: Vec<sr_io::Change>) -> Result<Option<Facts>, PlanError> {
        let opened = session::compile(self.experiment, changes, self.host);
        let (pipeline, result) = opened.map_err(PlanError::Pipeline)?;
        for diagnostic in &pipeline.world.resource::<Diagnostics>().0 {
            self.tell(diagnostic);
        }
        match result {
            Ok(()) => match Facts::of(&pipeline) {
                Ok(facts) => Ok(Some(facts)),
                Err(message) => {
                    self.tell(&Diagnostic::error(message));
                    Ok(None)
                }
            },
            Err(PipelineError::Input { .. }) => Ok(None),
            Err(error) => Err(PlanError::Pipeline(error)),
        }
    }

    /// Reads the reference's file, which must have the size of every picture.
    fn reference_file(&mut self, facts: &[Facts]) -> Option<Image> {
        let Some(ReferenceSpec::File { path, change }) = &self.experiment.reference else {
            return None;
        };
        let image = self.picture(path, change)?;
        let size = [image.width, image.height];
        if let Some(other) = facts.iter().find(|f| f.size != size) {
            let message = format!(
                "the reference has {} × {} pixels, the pictures have {} × {}",
                size[0], size[1], other.size[0], other.size[1]
            );
            self.error(change, message);
            return None;
        }
        Some(image)
    }

    /// Attached pictures are read at the end, when it would be late to find that they cannot be.
    fn attachments(&mut self) {
        for attachment in &self.experiment.attach {
            self.picture(&attachment.path, &attachment.change);
        }
    }

    fn picture(&mut self, path: &Path, named: &OverrideEntry) -> Option<Image> {
        match read_image(path) {
            Ok(image) => Some(image),
            Err(cause) => {
                self.error(named, cause.to_string());
                None
            }
        }
    }

    /// An error about what stands at a place of the experiment file.
    fn error(&mut self, at: &OverrideEntry, message: String) {
        let span = self.experiment.origin.span(at.pos);
        self.tell(&Diagnostic::error(message).at(span).field(&at.path));
    }

    /// Rendered references must have the size of their pictures, and what is shown must be there.
    fn sizes(&mut self, facts: &[Facts], references: &[RenderedReference], points: &[Point]) {
        // With errors before, points and facts are not the same ones.
        if self.errors > 0 {
            return;
        }
        for reference in references {
            let size = reference.facts.size;
            let other = reference.points.iter().find(|p| facts[**p].size != size);
            if let Some(point) = other {
                let [w, h] = facts[*point].size;
                let message = format!(
                    "the reference has {} × {} pixels, the pictures of `{}` have {w} × {h}",
                    size[0], size[1], points[*point].id
                );
                let hint = "leave the size to `set`, which both have";
                self.tell(&Diagnostic::error(message).field("reference").hint(hint));
            }
        }
        let show = &self.experiment.show;
        let crop = show.crop.iter().zip(&show.crop_at);
        for ([_, _, x1, y1], at) in crop.chain(show.insets.iter().zip(&show.insets_at)) {
            if let Some(facts) = facts.iter().find(|f| *x1 > f.size[0] || *y1 > f.size[1]) {
                let message = format!(
                    "it is not inside the pictures of {} × {}",
                    facts.size[0], facts.size[1]
                );
                self.error(at, message);
            }
        }
    }
}

impl Facts {
    fn of(pipeline: &Pipeline) -> Result<Self, String> {
        let world = &pipeline.world;
        let spec = film_spec(world)?;
        let config = resolved_config(world);
        let layers = spec.layers.iter().map(|l| l.channel_names().len() as u64);
        let scene = world.get_resource::<sr_io::ResolvedConfig>();
        Ok(Self {
            scene: scene.map_or_else(String::new, |c| c.scene.clone()),
            integrator: world.resource::<SelectedIntegrator>().name.clone(),
            size: [spec.crop.width(), spec.crop.height()],
            // Colour, its variance, the count of samples.
            channels: 7 + layers.sum::<u64>(),
            samples: session::most_samples(pipeline),
            seconds: world.resource::<Budget>().seconds,
            post: world.resource::<PostSettings>().clone(),
            left_out: sr_pipeline::plan(world)
                .into_iter()
                .filter(|item| !item.runs)
                .collect(),
            config_hash: config_hash(&config),
            work: work(&config),
            config,
        })
    }

    /// Pixels of the picture.
    pub fn pixels(&self) -> u64 {
        u64::from(self.size[0]) * u64::from(self.size[1])
    }
}

/// The lines of a configuration that say how much work a sample is.
fn work(config: &str) -> String {
    let kept = config.lines().filter(|line| {
        let line = line.trim_start();
        !["budget:", "sampler:", "post:", "adaptive:"]
            .iter()
            .any(|s| line.starts_with(s))
    });
    kept.collect::<Vec<_>>().join("\n")
}
