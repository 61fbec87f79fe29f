//! One path from a light.

use sr_pipeline::accel::Ray;
use sr_pipeline::bsdf::TransportMode;
use sr_pipeline::film_kernel::Film;
use sr_pipeline::math::offset_ray_origin;
use sr_pipeline::prelude::*;
use sr_pipeline::{CameraConnection, RejectKey, TileReport};

/// What all paths of a pass share.
pub struct LightTracing<'a> {
    /// The scene.
    pub scene: &'a RenderScene,
    /// Where paths add.
    pub film: &'a Film,
    /// Most bounces.
    pub max_depth: u32,
}

/// Where a path adds to, and which sample it is.
#[derive(Clone, Copy)]
struct PathId {
    pixel: [u32; 2],
    sample: u64,
}

impl LightTracing<'_> {
    /// Traces the light path of a pixel's sample; the pixel only names it.
    pub fn trace<S: Sampler>(
        &self,
        pixel: [u32; 2],
        sample: u64,
        sampler: &S,
        report: &mut TileReport,
    ) {
        let id = PathId { pixel, sample };
        let scene = self.scene;
        let u_select = sampler.d1(Dim::bounce(0, BounceDim::LightSelect));
        let Some((index, pmf, _)) = scene.light_sampler().select_emitter(u_select) else {
            return;
        };
        let light = &scene.lights()[index as usize];
        let u_pos = sampler.d2(Dim::bounce(0, BounceDim::Light));
        let u_dir = sampler.d2(Dim::LENS);
        let Some(e) = light.sample_le(u_pos, u_dir, scene.center(), scene.radius()) else {
            return;
        };
        if !(light.is_delta() || light.is_infinite()) {
            let u_lens = || sampler.d2(Dim::bounce(0, BounceDim::User(0)));
            let lens = scene.camera().lens_point(u_lens);
            self.see_light(index, &e, pmf, lens, id, report);
        }
        // Where there is no surface, `ng` is the direction itself.
        let cos = e.ng.dot(e.d).abs();
        let beta = e.radiance * (cos / (pmf * e.pdf_pos * e.pdf_dir));
        let ray = Ray {
            o: offset_ray_origin(e.o, e.o_err, e.ng, e.d),
            t_max: f32::INFINITY,
            d: e.d,
        };
        self.walk(ray, beta, sampler, id, report);
    }

    /// Follows the lobes, and connects each surface to the camera.
    fn walk<S: Sampler>(
        &self,
        mut ray: Ray,
        mut beta: Vec3,
        sampler: &S,
        id: PathId,
        report: &mut TileReport,
    ) {
        for depth in 0..self.max_depth {
            report.rays.bounce += 1;
            let hit = self.scene.accel().closest_one(&ray);
            if !hit.is_hit() {
                return;
            }
            let point = self.scene.surface(&ray, &hit);
            let u_lens = || sampler.d2(Dim::bounce(depth + 1, BounceDim::User(0)));
            let lens = self.scene.camera().lens_point(u_lens);
            self.connect(&point, beta, depth, lens, id, report);
            let uc = sampler.d1(Dim::bounce(depth + 1, BounceDim::Lobe));
            let u = sampler.d2(Dim::bounce(depth + 1, BounceDim::Bsdf));
            let wo = point.to_local(point.wo);
            let bsdf = self.scene.bsdf(&point);
            let Some(s) = bsdf.sample(wo, uc, u, TransportMode::Importance) else {
                return;
            };
            let wi = point.to_world(s.wi);
            if !self.scene.scatters_along(&point, wi) {
                return;
            }
            beta *= s.weight * shading_correction(&point, point.wo, wi);
            ray = point.spawn_ray(wi);
        }
    }

    /// The light itself, seen by the camera through a point of its lens.
    fn see_light(
        &self,
        light: u32,
        e: &sr_pipeline::light::EmissionSample,
        pmf: f32,
        lens: Vec2,
        id: PathId,
        report: &mut TileReport,
    ) {
        let Some(c) = self.scene.camera().connect(e.o, lens) else {
            return;
        };
        let le = self.scene.lights()[light as usize].le(c.wi, e.ng);
        let weight = e.ng.dot(c.wi).abs() * c.importance / (pmf * e.pdf_pos);
        let origin = offset_ray_origin(e.o, e.o_err, e.ng, c.wi);
        self.splat(origin, &c, le * weight, 0, None, id, report);
    }

    /// A surface point, seen by the camera through a point of its lens.
    fn connect(
        &self,
        point: &SurfacePoint,
        beta: Vec3,
        depth: u32,
        lens: Vec2,
        id: PathId,
        report: &mut TileReport,
    ) {
        let Some(c) = self.scene.camera().connect(point.p, lens) else {
            return;
        };
        let wo = point.to_local(point.wo);
        let wi = point.to_local(c.wi);
        if !self.scene.scatters_along(point, c.wi) {
            return;
        }
        let f = self
            .scene
            .bsdf(point)
            .eval(wo, wi, TransportMode::Importance);
        let cos = wi.z.abs() * shading_correction(point, point.wo, c.wi);
        let value = beta * f * (cos * c.importance);
        let origin = offset_ray_origin(point.p, point.p_err, point.ng, c.wi);
        self.splat(origin, &c, value, depth + 1, Some(point), id, report);
    }

    #[expect(
        clippy::too_many_arguments,
        reason = "a splat and whom to blame for it"
    )]
    fn splat(
        &self,
        origin: Vec3,
        connection: &CameraConnection,
        value: Vec3,
        bounce: u32,
        point: Option<&SurfacePoint>,
        id: PathId,
        report: &mut TileReport,
    ) {
        if value == Vec3::ZERO {
            return;
        }
        let shadow_ray = Ray {
            o: origin,
            t_max: connection.dist,
            d: connection.wi,
        };
        report.rays.shadow += 1;
        if self.scene.accel().occluded_one(&shadow_ray) {
            return;
        }
        let [x, y] = connection.film.to_array().map(|c| c as u32);
        if let Err(cause) = self.film.splat(x, y, id.sample, value) {
            let key = RejectKey {
                cause,
                bounce,
                material: point.map(|p| p.material),
            };
            report.rejects.add(key, id.pixel, id.sample);
        }
    }
}

/// What interpolated normals owe to light that travels from the lights (Veach 1997, §5.3.2):
/// `|wo·ns| |wi·ng| / (|wo·ng| |wi·ns|)`, `wo` towards the light; 1 for true normals.
fn shading_correction(point: &SurfacePoint, wo: Vec3, wi: Vec3) -> f32 {
    let (ns, ng) = (point.frame.n, point.ng);
    if ns == ng {
        return 1.0;
    }
    let below = (wo.dot(ng) * wi.dot(ns)).abs();
    if below == 0.0 {
        return 0.0;
    }
    (wo.dot(ns) * wi.dot(ng)).abs() / below
}
