//! Points on surfaces in `f64`, and the ways that leave them.

use super::tree::Way;
use sr_pipeline::accel::oracle::{Line, OracleHit};
use sr_pipeline::accel::{Geometry, PRIM_NONE, Prim};
use sr_pipeline::bsdf::LobeFlags;
use sr_pipeline::glam::{DVec3, Vec3};
use sr_pipeline::math::{Frame, gamma_of, orthonormal_basis};
use sr_pipeline::{MaterialId, RenderScene, SurfacePoint};

/// What [`SurfacePoint`] is in `f32`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex {
    pub p: DVec3,
    /// Bound of the distance from the surface.
    err: f64,
    pub ng: DVec3,
    /// Tangent, bitangent and shading normal.
    frame: [DVec3; 3],
    pub wo: DVec3,
    pub t: f64,
    pub prim: u32,
    pub material: MaterialId,
}

/// Of a primitive at two coordinates: the point, the geometric normal, and the sum of the lengths that went into the
/// point.
fn place(geometry: &Geometry, line: &Line, hit: &OracleHit) -> (DVec3, DVec3, f64) {
    let flat = |corner: Vec3, a: DVec3, b: DVec3| {
        let corner = corner.as_dvec3();
        let p = corner + (hit.u * a + hit.v * b);
        let lengths = corner.length() + a.length() + b.length();
        (p, a.cross(b).normalize(), lengths)
    };
    match geometry.kind(hit.prim) {
        Prim::Triangle(i) => {
            let [p0, p1, p2] = geometry.triangle_vertices(i);
            let corner = p0.as_dvec3();
            flat(p0, p1.as_dvec3() - corner, p2.as_dvec3() - corner)
        }
        Prim::Quad(i) => {
            let q = &geometry.quads[i as usize];
            flat(q.corner, q.edge_u.as_dvec3(), q.edge_v.as_dvec3())
        }
        Prim::Sphere(i) => {
            let s = &geometry.spheres[i as usize];
            let (center, radius) = (s.center.as_dvec3(), f64::from(s.radius));
            let ng = (line.o - center + hit.t * line.d).normalize();
            (center + radius * ng, ng, center.length() + radius)
        }
    }
}

/// How far a point lies off the surface of a primitive, or off the plane of a flat one.
pub(super) fn distance_off(geometry: &Geometry, prim: u32, p: DVec3) -> f64 {
    let flat = |corner: DVec3, a: DVec3, b: DVec3| a.cross(b).normalize().dot(p - corner).abs();
    match geometry.kind(prim) {
        Prim::Triangle(i) => {
            let [p0, p1, p2] = geometry.triangle_vertices(i).map(|p| p.as_dvec3());
            flat(p0, p1 - p0, p2 - p0)
        }
        Prim::Quad(i) => {
            let q = &geometry.quads[i as usize];
            flat(
                q.corner.as_dvec3(),
                q.edge_u.as_dvec3(),
                q.edge_v.as_dvec3(),
            )
        }
        Prim::Sphere(i) => {
            let s = &geometry.spheres[i as usize];
            (p.distance(s.center.as_dvec3()) - f64::from(s.radius)).abs()
        }
    }
}

impl Vertex {
    /// As [`RenderScene::surface`] has it.
    pub fn new(scene: &RenderScene, line: &Line, hit: &OracleHit) -> Self {
        let geometry = scene.accel().geometry();
        let (p, mut ng, lengths) = place(geometry, line, hit);
        let shape = scene.shape(scene.shape_of(hit.prim));
        let mut n = ng;
        if let (Some(normals), Prim::Triangle(t)) = (shape.normals, geometry.kind(hit.prim)) {
            let triangle = geometry.triangles[t as usize];
            let [n0, n1, n2] = normals.of(scene.normals(), triangle).map(|n| n.as_dvec3());
            if ng.dot(n0 + n1 + n2) < 0.0 {
                ng = -ng;
            }
            let between = n0 * (1.0 - hit.u - hit.v) + n1 * hit.u + n2 * hit.v;
            n = between.try_normalize().unwrap_or(ng);
        }
        let frame = match &shape.brush {
            Some(brush) => brush.wide_frame(n),
            None => {
                let (s, t) = orthonormal_basis(n.to_array());
                [s.into(), t.into(), n]
            }
        };
        Self {
            p,
            // A product of three differences, a quotient, and a sum of three products, with a margin of two: the
            // distance is nothing to `f32`, and is there to leave faces behind that lie upon one another.
            err: gamma_of::<f64>(32) * (lengths + line.o.length()),
            ng,
            frame,
            wo: -line.d,
            t: hit.t,
            prim: hit.prim,
            material: shape.material,
        }
    }

    /// As [`RenderScene::scatters_along`].
    pub fn scatters_along(&self, scene: &RenderScene, w: DVec3) -> bool {
        let flags = scene.material(self.material).bsdf.flags();
        self.frame[2] == self.ng
            || (w.dot(self.ng) > 0.0) == (self.wo.dot(self.ng) > 0.0)
            || flags.contains(LobeFlags::TRANSMISSION)
    }

    pub fn local(&self, w: DVec3) -> [f64; 3] {
        self.frame.map(|axis| axis.dot(w))
    }

    pub fn world(&self, [x, y, z]: [f64; 3]) -> DVec3 {
        let [s, t, n] = self.frame;
        (s * x + t * y + n * z).normalize()
    }

    fn leave_towards(&self, w: DVec3) -> DVec3 {
        self.p + self.ng * self.err.copysign(w.dot(self.ng))
    }

    /// The way into a direction.
    pub fn spawn(&self, w: DVec3) -> Way {
        let line = Line {
            o: self.leave_towards(w),
            d: w,
            t_max: f64::INFINITY,
        };
        Way {
            line,
            leaves: self.prim,
            reaches: PRIM_NONE,
        }
    }

    /// The way to a point `q ± q_err` of a light's surface with normal `nq`, or of a light without one.
    pub fn spawn_to(&self, w: DVec3, q: DVec3, q_err: f64, nq: DVec3, reaches: u32) -> Way {
        let o = self.leave_towards(w);
        let end = q + nq * q_err.copysign(-w.dot(nq));
        let line = Line {
            o,
            d: end - o,
            t_max: 1.0 - 2.0 * gamma_of::<f64>(8),
        };
        Way {
            line,
            leaves: self.prim,
            reaches,
        }
    }

    /// The same in `f32`, for the questions that are answered by tables in `f32`.
    pub fn narrow(&self, scene: &RenderScene) -> SurfacePoint {
        let [s, t, n] = self.frame.map(|v| v.as_vec3());
        SurfacePoint {
            p: self.p.as_vec3(),
            p_err: Vec3::ZERO,
            ng: self.ng.as_vec3(),
            frame: Frame { s, t, n },
            wo: self.wo.as_vec3(),
            prim: self.prim,
            shape: scene.shape_of(self.prim),
            material: self.material,
        }
    }
}
