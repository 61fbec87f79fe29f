//! Integrators that answer one camera ray at a time.

use crate::film::FilmResource;
use crate::integrator::Integrator;
use crate::pass::PassSpec;
use crate::report::{RayCounts, RenderReport, TileReport};
use crate::tiles::{SampleSource, Samples, camera_ray, deposit, filter_sampler, render_tiles};
use bevy_ecs::prelude::*;
use glam::Vec3;
use sr_render::accel::{Hit, Ray};
use sr_render::film::Layer;
use sr_render::sampling::{FilterSampler, Sampler};
use sr_render::{MaterialId, RenderScene, SurfacePoint};
use sr_scene::bevy_ecs;
use sr_scene::compile::SealedScene;
use sr_scene::integrator::SelectedIntegrator;
use sr_scene::settings::{FilmSettings, SamplerSettings};

/// What [`RayIntegrator::li`] works with: the scene, the numbers of its sample, and ray queries
/// that are counted.
///
/// A trait, so that further kernels can be given to integrators that exist: the pipeline chooses
/// the implementation, the integrator is compiled for each.
pub trait RayContext {
    /// The sequence.
    type Sampler: Sampler;

    /// The sealed scene.
    fn scene(&self) -> &RenderScene;

    /// The random numbers of this sample.
    fn sampler(&self) -> &Self::Sampler;

    /// The first surface along a ray of unit direction.
    fn closest(&mut self, ray: &Ray) -> Option<SurfacePoint>;

    /// Whether anything stands in the way of a ray.
    fn occluded(&mut self, ray: &Ray) -> bool;

    /// Says where the path is and how many bounces it took, for the layer of bounces and so that
    /// a rejected sample can be blamed.
    fn at(&mut self, bounce: u32, point: &SurfacePoint);
}

/// An integrator that estimates the radiance of one camera ray.
pub trait RayIntegrator: Integrator + Sized {
    /// Called once a pass, before its first ray.
    fn prepare(settings: &Self::Settings, scene: &RenderScene) -> Result<Self, String>;

    /// One estimate of the radiance that arrives along a camera ray.
    fn li<C: RayContext>(&self, ray: &Ray, context: &mut C) -> Vec3;
}

struct Context<'a, S> {
    scene: &'a RenderScene,
    sampler: S,
    rays: RayCounts,
    from_camera: bool,
    bounce: u32,
    material: Option<MaterialId>,
}

impl<S: Sampler> RayContext for Context<'_, S> {
    type Sampler = S;

    #[inline]
    fn scene(&self) -> &RenderScene {
        self.scene
    }

    #[inline]
    fn sampler(&self) -> &S {
        &self.sampler
    }

    #[inline]
    fn closest(&mut self, ray: &Ray) -> Option<SurfacePoint> {
        if self.from_camera {
            self.from_camera = false;
            self.rays.camera += 1;
        } else {
            self.rays.bounce += 1;
        }
        let hit: Hit = self.scene.accel().closest_one(ray);
        hit.is_hit().then(|| self.scene.surface(ray, &hit))
    }

    #[inline]
    fn occluded(&mut self, ray: &Ray) -> bool {
        self.rays.shadow += 1;
        self.scene.accel().occluded_one(ray)
    }

    #[inline]
    fn at(&mut self, bounce: u32, point: &SurfacePoint) {
        self.bounce = bounce;
        self.material = Some(point.material);
    }
}

/// The pass system of `I`, compiled for it alone.
pub(crate) fn render_pass<I: RayIntegrator>(
    scene: Res<'_, SealedScene>,
    pass: Res<'_, PassSpec>,
    choice: Res<'_, SelectedIntegrator>,
    film_settings: Res<'_, FilmSettings>,
    sampler: Res<'_, SamplerSettings>,
    mut film: ResMut<'_, FilmResource>,
    mut report: ResMut<'_, RenderReport>,
) -> Result {
    let settings = choice
        .settings::<I::Settings>()
        .ok_or("the settings are another integrator's")?;
    let integrator = I::prepare(settings, &scene)?;
    let filter = filter_sampler(&film_settings)?;
    let job = Job {
        integrator: &integrator,
        scene: &scene,
        filter,
        pass: *pass,
    };
    let film = &mut film.film;
    report.tiles.merge(match Samples::new(&sampler) {
        Samples::Sobol(s) => job.run(film, s),
        Samples::Independent(s) => job.run(film, s),
    });
    Ok(())
}

struct Job<'a, I> {
    integrator: &'a I,
    scene: &'a RenderScene,
    filter: FilterSampler,
    pass: PassSpec,
}

impl<I: RayIntegrator> Job<'_, I> {
    fn run(&self, film: &mut sr_render::film::Film, samples: impl SampleSource) -> TileReport {
        render_tiles(film, |tile| {
            let mut report = TileReport::default();
            for pixel in tile.active_pixels() {
                let (x, y) = tile.pixel(pixel);
                for sample in self.pass.indices() {
                    let mut context = Context {
                        scene: self.scene,
                        sampler: samples.at([x, y], sample),
                        rays: report.rays,
                        from_camera: true,
                        bounce: 0,
                        material: None,
                    };
                    let ray =
                        camera_ray(self.scene.camera(), &self.filter, (x, y), &context.sampler);
                    let radiance = self.integrator.li(&ray, &mut context);
                    report.rays = context.rays;
                    let (bounce, material) = (context.bounce, context.material);
                    // A count is finite, so nothing is refused.
                    let count = Vec3::splat(bounce as f32);
                    let _ = tile.add_layer(pixel, Layer::Bounces, sample, count);
                    deposit(tile, pixel, sample, radiance, bounce, material, &mut report);
                }
            }
            report
        })
    }
}
