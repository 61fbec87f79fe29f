//! Points on surfaces, rays that leave them and ways to lights.

use crate::{LightId, MaterialId, RenderScene, ShapeId};
use glam::{Vec2, Vec3};
use sr_accel::{Hit, Prim, Ray};
use sr_bsdf::{Bsdf, LobeFlags};
use sr_light::{LightSample, Receiver};
use sr_math::{Frame, gamma, offset_ray_origin};

/// A point on a surface, as seen from one direction.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// Position in render space.
    pub p: Vec3,
    /// Bound of the position's rounding error, by axis.
    pub p_err: Vec3,
    /// Unit geometric normal; towards the outside of a closed shape, not towards `wo`.
    pub ng: Vec3,
    /// Shading frame; its `n` is the interpolated normal.
    pub frame: Frame,
    /// Unit direction to where the ray came from.
    pub wo: Vec3,
    /// The primitive.
    pub prim: u32,
    /// The shape.
    pub shape: ShapeId,
    /// The material.
    pub material: MaterialId,
}

/// A light, a point on it, and the ray that finds out whether it is seen.
#[derive(Clone, Copy, Debug)]
pub struct LightConnection {
    /// Which light.
    pub light: LightId,
    /// What arrives, from where; `pdf` includes the choice of the light where there was one.
    pub sample: LightSample,
    /// From the surface to just before the light.
    pub shadow_ray: Ray,
}

impl SurfacePoint {
    /// A ray that leaves the surface along the unit vector `w`, to infinity.
    #[inline]
    pub fn spawn_ray(&self, w: Vec3) -> Ray {
        Ray {
            o: offset_ray_origin(self.p, self.p_err, self.ng, w),
            t_max: f32::INFINITY,
            d: w,
        }
    }

    /// A ray that leaves the surface towards another surface's point `q ± q_err` with unit
    /// geometric normal `nq`, and ends just before it.
    ///
    /// `w` is the unit direction towards `q` that the caller has already. The ray's length is
    /// exact to a few roundings; γ₈ covers two differences, three squares, two sums and the root,
    /// so that the far surface itself is not met.
    #[inline]
    pub fn spawn_ray_to(&self, w: Vec3, q: Vec3, q_err: Vec3, nq: Vec3) -> Ray {
        let o = offset_ray_origin(self.p, self.p_err, self.ng, w);
        let end = offset_ray_origin(q, q_err, nq, -w);
        let way = end - o;
        Ray {
            o,
            t_max: 1.0 - 2.0 * gamma(8),
            d: way,
        }
    }

    /// World to the local shading frame.
    #[inline]
    pub fn to_local(&self, w: Vec3) -> Vec3 {
        self.frame.to_local(w)
    }

    /// The local shading frame to world, with unit length restored.
    #[inline]
    pub fn to_world(&self, w: Vec3) -> Vec3 {
        self.frame.to_world(w).normalize()
    }
}

impl RenderScene {
    /// The surface that a ray with unit direction has hit.
    #[inline]
    pub fn surface(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let point = self.accel().hit_point(ray, hit);
        let shape_id = self.shape_of(hit.prim);
        let shape = self.shape(shape_id);
        let mut ng = point.ng;
        let mut ns = ng;
        if let (Some(normals), Prim::Triangle(t)) =
            (shape.normals, self.accel().geometry().kind(hit.prim))
        {
            let triangle = self.accel().geometry().triangles[t as usize];
            let [n0, n1, n2] = normals.of(self.normals(), triangle);
            // The author's normals say where the outside is.
            if ng.dot(n0 + n1 + n2) < 0.0 {
                ng = -ng;
            }
            let n = n0 * (1.0 - hit.u - hit.v) + n1 * hit.u + n2 * hit.v;
            ns = n.try_normalize().unwrap_or(ng);
        }
        SurfacePoint {
            p: point.p,
            p_err: point.p_err,
            ng,
            frame: match &shape.brush {
                None => Frame::from_normal(ns),
                Some(brush) => brush.frame(ns),
            },
            wo: -ray.d,
            prim: hit.prim,
            shape: shape_id,
            material: shape.material,
        }
    }

    /// Whether light can be scattered along a unit direction: between the sides of an opaque surface, as its geometric
    /// normal has them, it cannot, whatever an interpolated normal says.
    ///
    /// Where both normals are one the lobe itself knows the sides, and no rounding decides.
    #[inline]
    pub fn scatters_along(&self, point: &SurfacePoint, w: Vec3) -> bool {
        point.frame.n == point.ng
            || (w.dot(point.ng) > 0.0) == (point.wo.dot(point.ng) > 0.0)
            || self.bsdf(point).flags().contains(LobeFlags::TRANSMISSION)
    }

    /// The lobe at a surface point.
    #[inline]
    pub fn bsdf(&self, point: &SurfacePoint) -> &Bsdf {
        &self.material(point.material).bsdf
    }

    /// What the choice of a light may know of a surface point: light must come from the side that it is
    /// seen from, unless the lobe lets light through.
    #[inline]
    pub fn receiver(&self, point: &SurfacePoint) -> Receiver {
        let through = self.bsdf(point).flags().contains(LobeFlags::TRANSMISSION);
        let n = if through {
            Vec3::ZERO
        } else if point.frame.n.dot(point.wo) < 0.0 {
            -point.frame.n
        } else {
            point.frame.n
        };
        Receiver { p: point.p, n }
    }

    /// Chooses a light by `u_select` and a point on it by `u`, as seen from `point`.
    ///
    /// `None` when nothing can arrive: no lights, or the point lies behind the chosen one.
    #[inline]
    pub fn sample_light(
        &self,
        point: &SurfacePoint,
        u_select: f32,
        u: Vec2,
    ) -> Option<LightConnection> {
        let sampler = self.light_sampler();
        let receiver = if sampler.depends_on_receiver() {
            self.receiver(point)
        } else {
            Receiver::anywhere(point.p)
        };
        let (index, pmf, _) = sampler.select(&receiver, u_select)?;
        let mut connection = self.connect_light(LightId(index), point, u)?;
        connection.sample.pdf *= pmf;
        Some(connection)
    }

    /// A point on a given light, by `u`, as seen from `point`: for those who sample every light. The
    /// density is that of [`Light::pdf_li`](sr_light::Light::pdf_li), without a choice.
    ///
    /// `None` when nothing can arrive.
    #[inline]
    pub fn connect_light(
        &self,
        light: LightId,
        point: &SurfacePoint,
        u: Vec2,
    ) -> Option<LightConnection> {
        let sample = self.light(light).sample_li(point.p, u)?;
        let shadow_ray = if self.light(light).is_infinite() {
            point.spawn_ray(sample.wi)
        } else {
            point.spawn_ray_to(sample.wi, sample.p, sample.p_err, sample.ng)
        };
        Some(LightConnection {
            light,
            sample,
            shadow_ray,
        })
    }

    /// The density with which [`RenderScene::sample_light`] would have chosen the direction
    /// `wi` at a receiver, given that it meets the light at distance `dist` with normal `ng`.
    #[inline]
    pub fn light_pdf(
        &self,
        light: LightId,
        receiver: &Receiver,
        wi: Vec3,
        dist: f32,
        ng: Vec3,
    ) -> f32 {
        let pmf = self.light_sampler().pmf(receiver, light.0);
        pmf * self.light(light).pdf_li(receiver.p, wi, dist, ng)
    }
}
