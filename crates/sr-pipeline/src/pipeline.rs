//! A world, its schedules and the loop over passes.

use crate::adapt;
use crate::clock::{StageSeconds, timed};
use crate::film;
use crate::integrator::{
    Integrator, IntegratorEntry, IntegratorTable, check_requirements, selected,
};
use crate::layers;
use crate::log_points::{AtLogPoint, LogPoints};
use crate::measure::{self, Estimate};
use crate::pass::{PassSpec, Progress, StopReason};
use crate::planner::PassPlanner;
use crate::post::{self, OutputRequest, Provenance};
use crate::ray_integrator::{self, RayIntegrator};
use crate::replay::{self, MakeTracer};
use crate::report::RenderReport;
use crate::schedule::{self, IntegratorSet, Measure, MeasureSet, Post, PostSet, Render, RenderSet};
use bevy_ecs::prelude::*;
use bevy_ecs::reflect::AppTypeRegistry;
use bevy_ecs::schedule::ScheduleLabel;
use bevy_ecs::system::ScheduleSystem;
use sr_render::film::{ErrorEstimate, Film};
use sr_scene::bevy_ecs;
use sr_scene::diagnostics::Diagnostics;
use sr_scene::integrator::{IntegratorCatalog, IntegratorInfo};
use sr_scene::schedule::{Compile, CompileSet, Load};
use sr_scene::settings::{AdaptiveSettings, Budget, FilmSettings};
use sr_scene::stage::{self, StageError};
use std::any::TypeId;
use std::fmt;
use std::ops::ControlFlow;

/// Something that adds itself to a pipeline.
pub trait Plugin {
    /// Registers components, integrators and systems.
    fn build(&self, pipeline: &mut Pipeline);
}

impl<F: Fn(&mut Pipeline)> Plugin for F {
    fn build(&self, pipeline: &mut Pipeline) {
        self(pipeline);
    }
}

/// Why a run ended early.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PipelineError {
    /// The input has errors; [`Diagnostics`] lists them.
    Input {
        /// How many.
        errors: usize,
    },
    /// A stage failed.
    Stage(StageError),
    /// Threads could not be started.
    Threads(String),
}

impl fmt::Display for PipelineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input { errors: 1 } => write!(f, "the input has 1 error"),
            Self::Input { errors } => write!(f, "the input has {errors} errors"),
            Self::Stage(error) => write!(f, "{error}"),
            Self::Threads(cause) => write!(f, "cannot start threads: {cause}"),
        }
    }
}

impl std::error::Error for PipelineError {}

/// A world with the schedules of a render, and a pool of threads that all stages share.
pub struct Pipeline {
    /// Entities, settings and results.
    pub world: World,
    pool: rayon::ThreadPool,
}

impl Pipeline {
    /// A pipeline without readers and integrators; 0 threads means one for each core.
    pub fn new(threads: usize) -> Result<Self, PipelineError> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|e| PipelineError::Threads(e.to_string()))?;
        let mut world = World::new();
        sr_scene::install(&mut world);
        schedule::install(&mut world);
        world.init_resource::<IntegratorTable>();
        world.init_resource::<StageSeconds>();
        world.init_resource::<RenderReport>();
        world.init_resource::<Estimate>();
        world.init_resource::<LogPoints>();
        world.init_resource::<AtLogPoint>();
        world.init_resource::<OutputRequest>();
        world.init_resource::<Provenance>();
        let mut pipeline = Self { world, pool };
        pipeline
            .add_systems(Compile, check_requirements.in_set(CompileSet::Check))
            .add_systems(
                Render,
                layers::add_first_hits
                    .in_set(RenderSet::Accumulate)
                    .run_if(|s: Res<'_, FilmSettings>| layers::wants_first_hit(&s)),
            )
            .add_systems(
                Render,
                adapt::decide
                    .in_set(RenderSet::Adapt)
                    .run_if(adapt::is_adaptive),
            )
            .add_systems(Measure, measure::estimate_error.in_set(MeasureSet::Error))
            .add_systems(Post, post::develop_film.in_set(PostSet::Develop))
            .add_systems(
                Post,
                (post::write_files, post::write_rate)
                    .chain()
                    .in_set(PostSet::Write),
            );
        Ok(pipeline)
    }

    /// Adds a plug-in.
    pub fn add_plugin(&mut self, plugin: impl Plugin) -> &mut Self {
        plugin.build(self);
        self
    }

    /// Adds systems to one of the schedules; say `.in_set(…)` for their place.
    pub fn add_systems<M>(
        &mut self,
        label: impl ScheduleLabel,
        systems: impl IntoScheduleConfigs<ScheduleSystem, M>,
    ) -> &mut Self {
        stage::add_systems(&mut self.world, label, systems);
        self
    }

    /// Registers an integrator by name and settings; its systems come in by
    /// [`Pipeline::add_integrator_systems`].
    pub fn add_integrator<I: Integrator>(&mut self) -> &mut Self {
        self.world
            .resource::<AppTypeRegistry>()
            .write()
            .register::<I::Settings>();
        self.world.resource_mut::<IntegratorCatalog>().0.insert(
            I::NAME,
            IntegratorInfo {
                settings: TypeId::of::<I::Settings>(),
                summary: I::SUMMARY,
            },
        );
        let mut table = self.world.resource_mut::<IntegratorTable>();
        let others: Vec<&'static str> = table.0.keys().copied().collect();
        table.0.insert(I::NAME, IntegratorEntry::of::<I>());
        self.world.schedule_scope(Render, |_, schedule| {
            for other in others {
                let set = IntegratorSet(I::NAME).ambiguous_with(IntegratorSet(other));
                schedule.configure_sets(set);
            }
        });
        self
    }

    /// Adds systems to [`RenderSet::Integrate`] that run when the configuration names `I`.
    pub fn add_integrator_systems<I: Integrator, M>(
        &mut self,
        systems: impl IntoScheduleConfigs<ScheduleSystem, M>,
    ) -> &mut Self {
        let guarded = systems
            .into_configs()
            .distributive_run_if(selected::<I>)
            .in_set(IntegratorSet(I::NAME))
            .in_set(RenderSet::Integrate);
        self.add_systems(Render, guarded)
    }

    /// Registers an integrator that answers one camera ray at a time.
    pub fn add_ray_integrator<I: RayIntegrator>(&mut self) -> &mut Self {
        self.add_integrator::<I>();
        self.add_integrator_systems::<I, _>(ray_integrator::render_pass::<I>);
        self.add_tracer::<I>(replay::ray_tracer::<I>)
    }

    /// Lets single samples of an integrator with systems of its own be traced again, by
    /// `steradian render --replay` and by `steradian check`. Integrators that answer one camera ray at a
    /// time need no call.
    pub fn add_tracer<I: Integrator>(&mut self, make: MakeTracer) -> &mut Self {
        if !self
            .world
            .resource::<IntegratorTable>()
            .0
            .contains_key(I::NAME)
        {
            self.add_integrator::<I>();
        }
        let mut table = self.world.resource_mut::<IntegratorTable>();
        if let Some(entry) = table.0.get_mut(I::NAME) {
            entry.tracer = Some(make);
        }
        self
    }

    /// Threads that stages may use.
    pub fn threads(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// Does some work in the pool of threads.
    pub fn install<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        self.pool.install(work)
    }

    /// Runs a schedule in the pool; the first failure ends it.
    pub fn run(&mut self, label: impl ScheduleLabel + Clone) -> Result<(), PipelineError> {
        let world = &mut self.world;
        let result = self.pool.install(|| stage::run(world, label));
        result.map_err(
            |error| match self.world.resource::<Diagnostics>().error_count() {
                0 => PipelineError::Stage(error),
                errors => PipelineError::Input { errors },
            },
        )
    }

    /// Files become entities. The reader's plug-in says which files.
    pub fn load(&mut self) -> Result<(), PipelineError> {
        let mut seconds = 0.0;
        let result = timed(&mut seconds, || self.run(Load));
        self.world.resource_mut::<StageSeconds>().load += seconds;
        result
    }

    /// Entities become a sealed scene.
    pub fn compile(&mut self) -> Result<(), PipelineError> {
        let mut seconds = 0.0;
        let result = timed(&mut seconds, || self.run(Compile));
        self.world.resource_mut::<StageSeconds>().compile += seconds;
        result
    }

    /// Passes until the budget is used up or `observe` breaks. The film starts empty.
    pub fn render(
        &mut self,
        mut observe: impl FnMut(&Progress) -> ControlFlow<()>,
    ) -> Result<StopReason, PipelineError> {
        self.make_film()?;
        let mut planner = PassPlanner::new(
            self.world.resource::<Budget>(),
            self.world.resource::<AdaptiveSettings>(),
            self.world.resource::<LogPoints>(),
        );
        let reason = loop {
            let pass = match planner.next() {
                Ok(pass) => pass,
                Err(reason) => break reason,
            };
            self.render_pass(pass, &mut planner)?;
            let mut error = None;
            if planner.wants_estimate() {
                error = self.measure(planner.at_log_point())?;
            }
            if let Some(error) = &error {
                planner.estimated(error);
            }
            let known = self.world.resource::<Estimate>().0;
            let (fraction, ends_by) = planner.fraction(known.as_ref());
            let progress = Progress {
                samples: planner.samples(),
                mean_samples: planner.mean_samples(),
                active: planner.active(),
                seconds: self.world.resource::<StageSeconds>().integrate,
                fraction,
                ends_by,
                error,
                target: planner.target(),
            };
            if observe(&progress).is_break() {
                break StopReason::Asked;
            }
            if error.is_some_and(|e| planner.reached(&e)) {
                break StopReason::TargetError;
            }
            if planner.is_converged() {
                break StopReason::Converged;
            }
        };
        // The closing estimate belongs to the last pass, which may be a log point already.
        if !planner.at_log_point() {
            self.measure(true)?;
        }
        self.world.resource_mut::<RenderReport>().over_budget = planner.over_budget(reason);
        self.world.insert_resource(reason);
        Ok(reason)
    }

    /// Develops the film and writes what is asked for.
    pub fn post(&mut self) -> Result<(), PipelineError> {
        let mut seconds = 0.0;
        let result = timed(&mut seconds, || self.run(Post));
        self.world.resource_mut::<StageSeconds>().post += seconds;
        result
    }

    /// Looks at the film, off the clock.
    fn measure(&mut self, at_log_point: bool) -> Result<Option<ErrorEstimate>, PipelineError> {
        self.world.insert_resource(AtLogPoint(at_log_point));
        let mut seconds = 0.0;
        timed(&mut seconds, || self.run(Measure))?;
        self.world.resource_mut::<StageSeconds>().measure += seconds;
        Ok(self.world.resource::<Estimate>().0)
    }

    fn render_pass(
        &mut self,
        pass: PassSpec,
        planner: &mut PassPlanner,
    ) -> Result<(), PipelineError> {
        self.world.insert_resource(pass);
        let pixels = self.film().spec().sampled().pixel_count();
        let sampled = self.film().active_pixels();
        let mut seconds = 0.0;
        timed(&mut seconds, || self.run(Render))?;
        let active = self.film().active_pixels() as f64 / pixels as f64;
        planner.done(pass, seconds, active);
        self.world.resource_mut::<StageSeconds>().integrate += seconds;
        let mut report = self.world.resource_mut::<RenderReport>();
        report.passes += 1;
        report.samples_per_pixel = planner.samples();
        report.samples += u64::from(pass.samples) * sampled;
        Ok(())
    }

    fn film(&self) -> &Film {
        &self.world.resource::<film::FilmResource>().film
    }

    fn make_film(&mut self) -> Result<(), PipelineError> {
        self.world.insert_resource(RenderReport::default());
        self.world.insert_resource(Estimate::default());
        let mut seconds = self.world.resource_mut::<StageSeconds>();
        (seconds.integrate, seconds.measure) = (0.0, 0.0);
        film::make_film(&mut self.world).map_err(|cause| {
            PipelineError::Stage(StageError {
                stage: "Render".into(),
                system: "make_film".into(),
                cause,
            })
        })
    }
}
