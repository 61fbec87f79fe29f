//! The seam: what an integrator, a plug-in or a front end builds on.
//!
//! A [`Pipeline`] is a world and five schedules: `Load` and `Compile` make a sealed scene,
//! [`Render`] runs once a pass, [`Measure`] looks at the film off the clock, [`Post`] develops and
//! writes. An integrator comes in by [`Pipeline::add_ray_integrator`] (one trait, one camera ray at
//! a time) or by [`Pipeline::add_integrator`] with systems of its own. Everything that the built-in
//! integrators use is public here.

mod adapt;
mod clock;
mod film;
mod integrator;
mod layers;
mod log_points;
mod measure;
mod pace;
mod pass;
mod pipeline;
mod plan;
mod planner;
mod post;
mod ray_integrator;
pub mod replay;
mod report;
mod schedule;
mod tiles;

pub use clock::StageSeconds;
pub use film::{FilmResource, film_spec};
pub use integrator::{Integrator, Requirement, selected};
pub use log_points::{AtLogPoint, LogPoints, at_log_point};
pub use measure::Estimate;
pub use pass::{
    DEFAULT_ADAPTIVE_SAMPLES, DEFAULT_SAMPLES, PassSpec, Progress, StopReason, TimeToError,
    most_samples,
};
pub use pipeline::{Pipeline, PipelineError, Plugin};
pub use plan::{PlanItem, plan};
pub use post::{Developed, OutputRequest, Provenance};
pub use ray_integrator::{RayContext, RayIntegrator};
pub use report::{RayCounts, RejectKey, Rejects, RenderReport, TileReport};
pub use schedule::{IntegratorSet, Measure, MeasureSet, Post, PostSet, Render, RenderSet};
pub use tiles::{
    IndependentSamples, SampleSource, Samples, SobolSamples, camera_ray, deposit, filter_sampler,
    render_tiles,
};

pub use glam;
pub use rayon;
pub use sr_render::{
    Camera, CameraConnection, LightConnection, LightId, MaterialId, RenderScene, SceneFeatures,
    ShapeId, SurfacePoint,
};
pub use sr_render::{accel, bsdf, film as film_kernel, light, math, sampling};
pub use sr_scene::schedule::{Compile, CompileSet, Load, LoadSet};
pub use sr_scene::{bevy_ecs, bevy_reflect, compile::SealedScene, diagnostics, settings, stage};
pub use sr_scene::{integrator as catalog, sr_render};

/// What most integrators import.
pub mod prelude {
    pub use crate::{
        FilmResource, Integrator, PassSpec, Pipeline, Plugin, RayContext, RayIntegrator, Render,
        RenderScene, RenderSet, Requirement, SceneFeatures, SealedScene, SurfacePoint, selected,
    };
    pub use bevy_ecs::prelude::*;
    pub use bevy_reflect::Reflect;
    pub use bevy_reflect::std_traits::ReflectDefault;
    pub use glam::{Vec2, Vec3};
    pub use sr_render::sampling::{BounceDim, Dim, Sampler};
    pub use sr_scene::{bevy_ecs, bevy_reflect};
}
