//! Primitives as they are given: plain tables, and which of them can be hit at all.

use glam::{DVec3, Vec3};
use sr_math::Bounds3;

/// A sphere, hit from outside and inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereShape {
    /// Centre.
    pub center: Vec3,
    /// Radius, above 0.
    pub radius: f32,
}

/// A parallelogram, hit from both sides; its normal is `edge_u × edge_v`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuadShape {
    /// The corner that both edges start from.
    pub corner: Vec3,
    /// The edge along which `u` grows from 0 to 1.
    pub edge_u: Vec3,
    /// The edge along which `v` grows from 0 to 1.
    pub edge_v: Vec3,
}

impl QuadShape {
    /// The corners at (u, v) = (0,0), (1,0), (1,1), (0,1). A hit is a hit of one of the triangles
    /// 0-1-2 and 0-2-3, which share the diagonal and so leave no crack between them.
    pub(crate) fn corners(&self) -> [Vec3; 4] {
        let q = self.corner + self.edge_u;
        [self.corner, q, q + self.edge_v, self.corner + self.edge_v]
    }
}

/// Everything that rays can hit.
///
/// Primitive ids count the triangles first, then the spheres, then the quads.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Geometry {
    /// Vertices of the triangles.
    pub positions: Vec<Vec3>,
    /// Three indices into `positions` a triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Spheres.
    pub spheres: Vec<SphereShape>,
    /// Quads.
    pub quads: Vec<QuadShape>,
}

/// A primitive id, resolved: the kind and the index in the kind's table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Prim {
    /// Of [`Geometry::triangles`].
    Triangle(u32),
    /// Of [`Geometry::spheres`].
    Sphere(u32),
    /// Of [`Geometry::quads`].
    Quad(u32),
}

/// Why a primitive is left out of the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Defect {
    /// A coordinate is infinite or NaN, or a vertex does not exist.
    NonFinite,
    /// No area, or a radius that is not positive.
    Degenerate,
}

impl Geometry {
    /// The number of primitives of all kinds.
    pub fn prim_count(&self) -> usize {
        self.triangles.len() + self.spheres.len() + self.quads.len()
    }

    /// What a primitive id stands for.
    ///
    /// Ids at or above [`Geometry::prim_count`] resolve to quads that do not exist.
    #[inline]
    pub fn kind(&self, prim: u32) -> Prim {
        let spheres_from = self.triangles.len() as u32;
        let quads_from = spheres_from + self.spheres.len() as u32;
        if prim < spheres_from {
            Prim::Triangle(prim)
        } else if prim < quads_from {
            Prim::Sphere(prim - spheres_from)
        } else {
            Prim::Quad(prim - quads_from)
        }
    }

    /// The three vertices of a triangle.
    ///
    /// # Panics
    /// When the triangle or one of its vertices does not exist.
    #[inline]
    pub fn triangle_vertices(&self, triangle: u32) -> [Vec3; 3] {
        self.triangles[triangle as usize].map(|i| self.positions[i as usize])
    }

    /// A box around all of a primitive, or why it cannot be hit.
    ///
    /// The box holds the exact surface; what rounding adds to it depends on the ray and is added
    /// there.
    pub(crate) fn checked_bounds(&self, prim: u32) -> Result<Bounds3, Defect> {
        match self.kind(prim) {
            Prim::Triangle(i) => {
                let corners = self.triangles[i as usize].map(|k| {
                    let p = self.positions.get(k as usize);
                    p.copied().unwrap_or(Vec3::NAN)
                });
                flat_bounds(&corners, &corners)
            }
            Prim::Quad(i) => {
                let q = &self.quads[i as usize];
                let edges = [Vec3::ZERO, q.edge_u, q.edge_v];
                flat_bounds(&q.corners(), &edges)
            }
            Prim::Sphere(i) => {
                let s = &self.spheres[i as usize];
                // Rounded to nearest, then one step outward: the exact extremes are inside.
                let b = Bounds3 {
                    min: (s.center - s.radius).map(f32::next_down),
                    max: (s.center + s.radius).map(f32::next_up),
                };
                if !(b.min.is_finite() && b.max.is_finite()) {
                    Err(Defect::NonFinite)
                } else if s.radius > 0.0 {
                    Ok(b)
                } else {
                    Err(Defect::Degenerate)
                }
            }
        }
    }
}

/// The box of a flat primitive, whose area is judged by a triangle of it.
fn flat_bounds(corners: &[Vec3], triangle: &[Vec3; 3]) -> Result<Bounds3, Defect> {
    if !corners.iter().all(|p| p.is_finite()) {
        return Err(Defect::NonFinite);
    }
    // Differences of f32 are exact in f64 unless 2²⁹ apart, so only true collinearity gives zero.
    let [a, b, c] = triangle.map(Vec3::as_dvec3);
    if (b - a).cross(c - a) == DVec3::ZERO {
        return Err(Defect::Degenerate);
    }
    Ok(Bounds3::from_points(corners.iter().copied()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_count_triangles_then_spheres_then_quads() {
        let sphere = SphereShape {
            center: Vec3::ZERO,
            radius: 1.0,
        };
        let quad = QuadShape {
            corner: Vec3::ZERO,
            edge_u: Vec3::X,
            edge_v: Vec3::Y,
        };
        let g = Geometry {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            triangles: vec![[0, 1, 2]; 2],
            spheres: vec![sphere; 3],
            quads: vec![quad; 1],
        };
        assert_eq!(g.prim_count(), 6);
        assert_eq!(g.kind(1), Prim::Triangle(1));
        assert_eq!(g.kind(2), Prim::Sphere(0));
        assert_eq!(g.kind(4), Prim::Sphere(2));
        assert_eq!(g.kind(5), Prim::Quad(0));
    }
}
