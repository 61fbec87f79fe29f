//! The watertight triangle test of Woop, Benthin, Wald 2013, "Watertight Ray/Triangle
//! Intersection".
//!
//! Vertices are taken relative to the ray's origin and sheared so that the ray runs along one
//! axis; what is left is whether the origin of the plane lies inside a 2-D triangle. An edge
//! function is `c.x b.y − c.y b.x`, two products and a difference, each rounded, never fused: the
//! neighbour that runs along the same edge the other way gets exactly the negative, so a ray cannot
//! pass between both. Zero counts as inside for both.
//!
//! Two things are added to the paper's test.
//!
//! **No second pass in double precision when an edge function is zero.** With inclusive edges it
//! decides nothing but which of two neighbours is hit.
//!
//! **Where the triangle is met.** Edge functions of one sign make `t` a weighted mean of the vertices'
//! depths, so that it is surely positive when those are. Two kinds of triangles are solved again in
//! f64, where differences of f32 are exact: those that reach behind the origin, one that the ray
//! has just left above all, where rounding may turn the sign; and needles, whose weights are all
//! rounding, so that the mean may lie anywhere along them.

use crate::node::WIDTH;
use glam::{DVec3, Vec3};
use sr_math::Real;

/// How many times the doubled area the square of the longest edge may be. Edge functions err by 8 u R times that edge,
/// R the distance, so that a hit strays along its triangle by up to 8 u R times this: 3·10⁻⁵ R, seen face on.
const SLENDER: f64 = 64.0;

/// A ray's direction as a shear: `kz` is its largest component.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Shear<R> {
    pub kx: usize,
    pub ky: usize,
    pub kz: usize,
    /// `d[kx] / d[kz]`, in [−1, 1].
    pub sx: R,
    /// `d[ky] / d[kz]`, in [−1, 1].
    pub sy: R,
    /// `1 / d[kz]`.
    pub sz: R,
}

impl<R: Real> Shear<R> {
    /// `d` must not be zero.
    #[inline(always)]
    pub fn new(d: [R; 3]) -> Self {
        // Numbers in place of branches, which no processor would foresee.
        let [x, y, z] = d.map(R::abs);
        let of_xy = usize::from(x <= y);
        let larger = if x > y { x } else { y };
        let kz = of_xy + (2 - of_xy) * usize::from(larger <= z);
        const NEXT: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];
        let [kx, ky] = NEXT[kz];
        Self {
            kx,
            ky,
            kz,
            sx: d[kx] / d[kz],
            sy: d[ky] / d[kz],
            sz: R::ONE / d[kz],
        }
    }
}

/// Edge functions and depths of one triangle, as the kernel leaves them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate<R> {
    /// Edge functions: unnormalised weights of the vertices 0, 1, 2; none of them of another
    /// sign than the others.
    pub weights: [R; 3],
    /// Distances of the vertices from the ray's origin along the axis `kz`.
    pub depths: [R; 3],
}

/// Where a ray meets a plane triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FlatHit<R> {
    pub t: R,
    /// Weights of vertices 1 and 2.
    pub b: [R; 2],
}

impl<R: Real> Candidate<R> {
    /// The hit, when its `t` is positive. `vertices` gives the triangle when it is needed; `slender` says
    /// what [`is_slender`] says of it.
    #[inline]
    pub fn resolve(
        &self,
        shear: &Shear<R>,
        ray: ([R; 3], [R; 3]),
        slender: bool,
        vertices: impl FnOnce() -> [[R; 3]; 3],
    ) -> Option<FlatHit<R>> {
        let [u, v, w] = self.weights;
        let [az, bz, cz] = self.depths;
        let det = u + v + w;
        // Seen edge-on; the neighbours see the same edges and have the hit.
        if det == R::ZERO {
            return None;
        }
        let (nearest, farthest) = if shear.sz > R::ZERO {
            (az.min(bz).min(cz), az.max(bz).max(cz))
        } else {
            (az.max(bz).max(cz), az.min(bz).min(cz))
        };
        let range = [nearest * shear.sz, farthest * shear.sz];
        let at = |t| FlatHit {
            t,
            b: [v / det, w / det],
        };
        let hit = if range[1] <= R::ZERO {
            return None;
        } else if slender {
            in_f64(ray, vertices(), range)
        } else if range[0] > R::ZERO {
            at((u * az + v * bz + w * cz) / det * shear.sz)
        } else {
            // The plane may be met beyond the triangle when nearly parallel.
            at(plane_distance(ray, vertices()).min(range[1]))
        };
        // False for NaN.
        (hit.t > R::ZERO).then_some(hit)
    }
}

/// Whether a triangle is so long and thin that its weights in f32 are no good.
pub(crate) fn is_slender(corners: [Vec3; 3]) -> bool {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let longest = a
        .distance_squared(b)
        .max(b.distance_squared(c))
        .max(c.distance_squared(a));
    (b - a).cross(c - a).length() * SLENDER < longest
}

/// The `t` at which a ray meets the plane of a triangle, by way of f64; not finite when parallel.
#[cold]
fn plane_distance<R: Real>((o, d): ([R; 3], [R; 3]), vertices: [[R; 3]; 3]) -> R {
    let wide = |x: [R; 3]| DVec3::from(x.map(R::to_f64));
    let [p0, p1, p2] = vertices.map(wide);
    let n = (p1 - p0).cross(p2 - p0);
    R::lit(n.dot(p0 - wide(o)) / n.dot(wide(d)))
}

/// Where a ray that meets the triangle meets its plane, in f64: not before or beyond the triangle's depths.
#[cold]
fn in_f64<R: Real>(
    (o, d): ([R; 3], [R; 3]),
    vertices: [[R; 3]; 3],
    [nearest, farthest]: [R; 2],
) -> FlatHit<R> {
    let wide = |x: [R; 3]| DVec3::from(x.map(R::to_f64));
    let (corners, o, d) = (vertices.map(wide), wide(o), wide(d));
    let n = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    let t = n.dot(corners[0] - o) / n.dot(d);
    // NaN of a ray within the plane becomes the nearest.
    let t = between(t, nearest.to_f64(), farthest.to_f64());
    let [_, b1, b2] = nearest_weights(corners, n, o + t * d);
    FlatHit {
        t: R::lit(t),
        b: [R::lit(b1), R::lit(b2)],
    }
}

/// The weights of the triangle's point next to `p`, which is in its plane, `n` the unscaled normal. A ray that passes within
/// rounding may lie beside a needle by many times its width.
fn nearest_weights(corners: [DVec3; 3], n: DVec3, p: DVec3) -> [f64; 3] {
    let opposite = |i: usize| [corners[(i + 1) % 3], corners[(i + 2) % 3]];
    let weights = [0, 1, 2].map(|i| {
        let [a, b] = opposite(i);
        (b - a).cross(p - a).dot(n) / n.length_squared()
    });
    let Some(i) = (0..3).find(|&i| weights[i] < 0.0) else {
        return weights;
    };
    let [a, b] = opposite(i);
    let s = between((p - a).dot(b - a) / (b - a).length_squared(), 0.0, 1.0);
    let mut on_edge = [0.0; 3];
    on_edge[(i + 1) % 3] = 1.0 - s;
    on_edge[(i + 2) % 3] = s;
    on_edge
}

/// `x.clamp(low, high)`, but `low` for NaN and never a panic.
fn between(x: f64, low: f64, high: f64) -> f64 {
    if x >= low { x.min(high) } else { low }
}

/// What a kernel finds for the triangles of a leaf.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Candidates {
    /// Bit i: the ray's line runs through triangle i.
    pub mask: u32,
    pub weights: [[f32; WIDTH]; 3],
    pub depths: [[f32; WIDTH]; 3],
}

impl Candidates {
    /// One triangle's share.
    #[inline(always)]
    pub fn get(&self, i: usize) -> Candidate<f32> {
        let [[u, v, w], [x, y, z]] =
            [&self.weights, &self.depths].map(|r| [r[0][i], r[1][i], r[2][i]]);
        Candidate {
            weights: [u, v, w],
            depths: [x, y, z],
        }
    }
}

/// The test for triangles `from` to `from + N − 1` of a leaf at once; `row(vertex, axis)` gives a coordinate
/// of all.
///
/// The order of operations is part of the contract: kernels for other instruction sets give the
/// same bits.
#[inline(always)]
pub(crate) fn test_lanes<'a, const N: usize>(
    shear: &Shear<f32>,
    o: &[f32; 3],
    from: usize,
    out: &mut Candidates,
    row: impl Fn(usize, usize) -> &'a [f32; N],
) {
    let mut x = [[0.0f32; N]; 3];
    let mut y = [[0.0f32; N]; 3];
    let mut z = [[0.0f32; N]; 3];
    for vertex in 0..3 {
        let (px, py, pz) = (
            row(vertex, shear.kx),
            row(vertex, shear.ky),
            row(vertex, shear.kz),
        );
        for i in 0..N {
            let depth = pz[i] - o[shear.kz];
            z[vertex][i] = depth;
            x[vertex][i] = (px[i] - o[shear.kx]) - shear.sx * depth;
            y[vertex][i] = (py[i] - o[shear.ky]) - shear.sy * depth;
        }
        out.depths[vertex][from..from + N].copy_from_slice(&z[vertex]);
    }
    let mut weights = [[0.0f32; N]; 3];
    for i in 0..N {
        let u = x[2][i] * y[1][i] - y[2][i] * x[1][i];
        let v = x[0][i] * y[2][i] - y[0][i] * x[2][i];
        let w = x[1][i] * y[0][i] - y[1][i] * x[0][i];
        weights[0][i] = u;
        weights[1][i] = v;
        weights[2][i] = w;
        let lowest = if u < v { u } else { v };
        let lowest = if w < lowest { w } else { lowest };
        let highest = if u > v { u } else { v };
        let highest = if w > highest { w } else { highest };
        out.mask |= u32::from((lowest >= 0.0) | (highest <= 0.0)) << (from + i);
    }
    for (out, row) in out.weights.iter_mut().zip(&weights) {
        out[from..from + N].copy_from_slice(row);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sr_math::hash::{mix, unit_f32};

    fn random(i: u32, k: u32) -> f32 {
        unit_f32(mix(i, k)) * 2.0 - 1.0
    }

    fn found(shear: &Shear<f32>, o: [f32; 3], t: [[f32; 3]; 3]) -> Candidates {
        let rows = t.map(|p| p.map(|x| [x; 4]));
        let mut out = Candidates::default();
        test_lanes(shear, &o, 0, &mut out, |vertex, axis| &rows[vertex][axis]);
        assert!(out.mask == 0 || out.mask == 15);
        out
    }

    fn mask_of(o: [f32; 3], d: [f32; 3], t: [[f32; 3]; 3]) -> u32 {
        found(&Shear::new(d), o, t).mask
    }

    #[test]
    fn the_shear_takes_the_largest_axis_and_keeps_slopes_below_one() {
        for i in 0..10_000 {
            let d = [random(i, 0), random(i, 1), random(i, 2)];
            let s = Shear::new(d);
            assert_eq!(s.kx + s.ky + s.kz, 3);
            assert!(s.sx.abs() <= 1.0 && s.sy.abs() <= 1.0);
        }
    }

    /// The plane of all triangles is cut into a fan around a vertex: a ray at the fan hits at
    /// least one of it, wherever the ray starts.
    #[test]
    fn a_fan_has_no_gaps_at_its_spokes_and_hub() {
        for i in 0..50_000 {
            let o = [random(i, 0), random(i, 1), random(i, 2) + 3.0];
            let hub = [random(i, 3) * 0.1, random(i, 4) * 0.1, 0.0];
            let corners = [[-1.0, -1.0, 0.1], [1.0, -1.0, -0.2], [0.0, 1.0, 0.3]];
            let along = if i % 2 == 0 { 0.0 } else { unit_f32(mix(i, 5)) };
            let spoke = corners[i as usize % 3];
            let target: [f32; 3] = std::array::from_fn(|k| hub[k] + along * (spoke[k] - hub[k]));
            let d: [f32; 3] = std::array::from_fn(|k| target[k] - o[k]);
            let hits = (0..3)
                .filter(|&k| mask_of(o, d, [hub, corners[k], corners[(k + 1) % 3]]) != 0)
                .count();
            assert!(hits > 0, "ray {i} leaks");
        }
    }

    #[test]
    fn t_and_weights_agree_with_f64() {
        for i in 0..20_000 {
            let point = |k| [random(i, k), random(i, k + 1), random(i, k + 2) + 2.0];
            let vertices = [point(0), point(3), point(6)];
            let (b1, b2) = (0.2 + 0.3 * unit_f32(mix(i, 9)), 0.3);
            let o = [random(i, 10), random(i, 11), random(i, 12)];
            let d: [f32; 3] = std::array::from_fn(|k| {
                (1.0 - b1 - b2) * vertices[0][k] + b1 * vertices[1][k] + b2 * vertices[2][k] - o[k]
            });
            let shear = Shear::new(d);
            let found = found(&shear, o, vertices);
            let [e, f] = [1, 2].map(|k| {
                let p = |a: usize| f64::from(vertices[k][a]) - f64::from(vertices[0][a]);
                DVec3::new(p(0), p(1), p(2))
            });
            let d64 = DVec3::from(d.map(f64::from));
            let area = e.cross(f).length();
            let steepness = e.cross(f).dot(d64).abs() / (area * d64.length());
            // Edge-on and thin triangles are another matter: t has no such accuracy there.
            if steepness < 0.05 || area < 0.1 {
                continue;
            }
            assert_ne!(found.mask, 0);
            let hit = found.get(0).resolve(&shear, (o, d), false, || vertices);
            let hit = hit.expect("aimed at the inside");
            // 9 u of at most 4 in the coordinates, through an area of 0.1 and a slope of 0.05.
            let bound = 9.0 * 4.0 * f64::from(f32::EPSILON) / (0.1 * 0.05);
            assert!((f64::from(hit.t) - 1.0).abs() < bound, "{hit:?}");
            assert!((hit.b[0] - b1).abs() < bound as f32 && (hit.b[1] - b2).abs() < bound as f32);
        }
    }

    /// Face on at a distance of 1, of length 1 and ever narrower: the point found is the one that was aimed at.
    #[test]
    fn needles_are_met_where_they_are() {
        for i in 0..20_000u32 {
            let width = 10f32.powf(-6.0 * unit_f32(mix(i, 0)));
            let side = random(i, 1) * width;
            let vertices = [[0.0, 0.0, 1.0], [1.0, side, 1.5], [1.0, side + width, 1.5]];
            let (b1, b2) = (0.6 * unit_f32(mix(i, 2)), 0.3);
            let o = [random(i, 3), random(i, 4), random(i, 5) - 1.0];
            let at = |k: usize| b1 * vertices[1][k] + b2 * vertices[2][k];
            let first = [0, 1, 2].map(|k| (1.0 - b1 - b2) * vertices[0][k]);
            let d: [f32; 3] = std::array::from_fn(|k| first[k] + at(k) - o[k]);
            let shear = Shear::new(d);
            let found = found(&shear, o, vertices);
            if found.mask == 0 {
                // Its width is less than the rounding of the direction.
                assert!(width < 1e-5, "{width}");
                continue;
            }
            let slender = is_slender(vertices.map(Vec3::from));
            let hit = found.get(0).resolve(&shear, (o, d), slender, || vertices);
            let Some(hit) = hit else { continue };
            // Seen through a slope as small as the needle's own, depth and place along it go together.
            let place: [f32; 3] = std::array::from_fn(|k| {
                let [p0, p1, p2] = [0, 1, 2].map(|v| vertices[v][k]);
                p0 + hit.b[0] * (p1 - p0) + hit.b[1] * (p2 - p0)
            });
            for k in 0..2 {
                let ray = o[k] + hit.t * d[k];
                assert!(
                    (place[k] - ray).abs() < 3e-5 * 3.0,
                    "{i}: {place:?}, {hit:?}"
                );
            }
        }
    }

    #[test]
    fn edge_on_and_degenerate_triangles_are_no_hit() {
        let d = [0.0, 0.0, 1.0];
        let edge_on = [[0.0, -1.0, 1.0], [0.0, 1.0, 1.0], [0.0, 0.0, 2.0]];
        let point = [[0.0, 0.0, 1.0]; 3];
        for t in [edge_on, point] {
            let shear = Shear::new(d);
            let hit = found(&shear, [0.0; 3], t)
                .get(0)
                .resolve(&shear, ([0.0; 3], d), false, || t);
            assert_eq!(hit, None);
        }
    }
}
