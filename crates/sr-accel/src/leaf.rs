//! What leaves hold: primitives copied in the order of the tree, one array a kind.
//!
//! Slots are numbered through: triangles first, then spheres, then quads, so that the kind of a
//! leaf shows in its first slot and costs no bits of its word. Triangles of a leaf of n lie as nine
//! rows of n floats (vertex 0 x, y, z, vertex 1 x, …), quads as twelve: full rows without padding,
//! read in sets of lanes whose surplus is masked off.

use crate::geometry::{Geometry, Prim, SphereShape};
use crate::lanes::Lanes;
use crate::node::WIDTH;
use crate::ray::{Hit, Ray};
use crate::sphere;
use crate::triangle::{FlatHit, Shear, is_slender};
use glam::Vec3;

/// A ray prepared for leaves.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LeafRay {
    pub o: [f32; 3],
    pub d: [f32; 3],
    pub shear: Shear<f32>,
}

impl LeafRay {
    /// `ray` must be finite and its direction not zero.
    #[inline]
    pub fn new(ray: &Ray) -> Self {
        let (o, d) = (ray.o.to_array(), ray.d.to_array());
        Self {
            o,
            d,
            shear: Shear::new(d),
        }
    }
}

/// The primitives of all leaves.
#[derive(Clone, Debug, Default)]
pub(crate) struct Leaves {
    triangles: Vec<f32>,
    spheres: Vec<SphereShape>,
    quads: Vec<f32>,
    /// The primitive id of each slot, and [`SLENDER`].
    ids: Vec<u32>,
    /// The first slot that is not a triangle's.
    spheres_from: usize,
    /// The first slot that is not a triangle's or a sphere's.
    quads_from: usize,
}

/// The bit of an id that says [`is_slender`], of a quad of either half.
const SLENDER: u32 = 1 << 31;

fn slender_bit(geometry: &Geometry, prim: u32) -> u32 {
    let slender = match geometry.kind(prim) {
        Prim::Triangle(i) => is_slender(geometry.triangle_vertices(i)),
        Prim::Quad(i) => {
            let [a, b, c, d] = geometry.quads[i as usize].corners();
            is_slender([a, b, c]) || is_slender([a, c, d])
        }
        Prim::Sphere(_) => false,
    };
    if slender { SLENDER } else { 0 }
}

/// Rows of a triangle and of a quad.
const TRIANGLE_ROWS: usize = 9;
const QUAD_ROWS: usize = 12;

impl Leaves {
    /// For so many primitives; the quads follow.
    pub fn with_capacity(triangles: usize, spheres: usize, total: usize) -> Self {
        Self {
            triangles: Vec::with_capacity(triangles * TRIANGLE_ROWS + WIDTH),
            spheres: Vec::with_capacity(spheres),
            quads: Vec::new(),
            ids: vec![0; total],
            spheres_from: triangles,
            quads_from: triangles + spheres,
        }
    }

    /// Appends a leaf of one kind and tells its first slot.
    pub fn push(&mut self, geometry: &Geometry, prims: &[u32]) -> u32 {
        let first = match geometry.kind(prims[0]) {
            Prim::Triangle(_) => {
                let first = self.triangles.len() / TRIANGLE_ROWS;
                let corners: Vec<_> = prims
                    .iter()
                    .map(|&p| geometry.triangle_vertices(p))
                    .collect();
                push_rows(&mut self.triangles, &corners);
                first
            }
            Prim::Sphere(_) => {
                let first = self.spheres_from + self.spheres.len();
                let of = |&p: &u32| match geometry.kind(p) {
                    Prim::Sphere(i) => geometry.spheres[i as usize],
                    _ => unreachable!("a leaf holds one kind"),
                };
                self.spheres.extend(prims.iter().map(of));
                first
            }
            Prim::Quad(_) => {
                let first = self.quads_from + self.quads.len() / QUAD_ROWS;
                let of = |&p: &u32| match geometry.kind(p) {
                    Prim::Quad(i) => geometry.quads[i as usize].corners(),
                    _ => unreachable!("a leaf holds one kind"),
                };
                let corners: Vec<_> = prims.iter().map(of).collect();
                push_rows(&mut self.quads, &corners);
                first
            }
        };
        for (id, &prim) in self.ids[first..].iter_mut().zip(prims) {
            *id = prim | slender_bit(geometry, prim);
        }
        first as u32
    }

    /// Pads the arrays so that the last row can be read as a full set of eight lanes.
    pub fn finish(&mut self) {
        for rows in [&mut self.triangles, &mut self.quads] {
            if !rows.is_empty() {
                rows.extend([0.0; WIDTH]);
            }
        }
    }

    /// Bytes of the arrays.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.triangles[..])
            + size_of_val(&self.spheres[..])
            + size_of_val(&self.quads[..])
            + size_of_val(&self.ids[..])
    }

    /// Tests the leaf of `count` slots from `first` and keeps the better of its hits and `best`,
    /// whose `t` is the largest that counts. With `ANY`, the first hit found will do. True when
    /// there was one.
    #[inline(always)]
    pub fn intersect<const ANY: bool, L: Lanes>(
        &self,
        lanes: L,
        (first, count): (usize, usize),
        ray: &LeafRay,
        best: &mut Hit,
    ) -> bool {
        let ids = &self.ids[first..first + count];
        if first < self.spheres_from {
            let rows = &self.triangles[first * TRIANGLE_ROWS..];
            flat::<ANY, L>(lanes, rows, [0, 1, 2], ids, ray, best, |h| h.b)
        } else if first < self.quads_from {
            let first = first - self.spheres_from;
            spheres::<ANY>(&self.spheres[first..first + count], ids, ray, best)
        } else {
            // Both triangles of quads, with their weights turned into fractions of the edges.
            let rows = &self.quads[(first - self.quads_from) * QUAD_ROWS..];
            let lower = |h: FlatHit<f32>| [(h.b[0] + h.b[1]).min(1.0), h.b[1]];
            let upper = |h: FlatHit<f32>| [h.b[0], (h.b[0] + h.b[1]).min(1.0)];
            let found = flat::<ANY, L>(lanes, rows, [0, 1, 2], ids, ray, best, lower);
            if ANY && found {
                return true;
            }
            flat::<ANY, L>(lanes, rows, [0, 2, 3], ids, ray, best, upper) || found
        }
    }

    /// Where the triangles lie, [`LEAF_STRIDE`] numbers a slot; leaves of other kinds are few.
    #[inline(always)]
    pub fn head(&self) -> *const f32 {
        self.triangles.as_ptr()
    }
}

/// Numbers of a slot with a triangle.
pub(crate) const LEAF_STRIDE: usize = TRIANGLE_ROWS;

/// Appends the corners of n primitives as rows of n coordinates.
fn push_rows<const N: usize>(rows: &mut Vec<f32>, corners: &[[Vec3; N]]) {
    for vertex in 0..N {
        for axis in 0..3 {
            rows.extend(corners.iter().map(|c| c[vertex][axis]));
        }
    }
}

/// Whether a hit at `t` of primitive `id` replaces the best one so far.
#[inline(always)]
fn is_better(t: f32, id: u32, best: &Hit) -> bool {
    t < best.t || (t == best.t && id < best.prim)
}

/// Triangles of a leaf; `pick` says which vertices of a primitive make the triangle.
#[inline(always)]
fn flat<const ANY: bool, L: Lanes>(
    lanes: L,
    rows: &[f32],
    pick: [usize; 3],
    ids: &[u32],
    ray: &LeafRay,
    best: &mut Hit,
    uv: impl Fn(FlatHit<f32>) -> [f32; 2],
) -> bool {
    let n = ids.len();
    let found = lanes.triangles(rows, n, pick, ray);
    let (mut mask, mut any) = (found.mask, false);
    while mask != 0 {
        let i = mask.trailing_zeros() as usize & (WIDTH - 1);
        mask &= mask - 1;
        let corners = || pick.map(|v| std::array::from_fn(|axis| rows[(v * 3 + axis) * n + i]));
        let (slender, prim) = (ids[i] & SLENDER != 0, ids[i] & !SLENDER);
        let candidate = found.get(i);
        let hit = candidate.resolve(&ray.shear, (ray.o, ray.d), slender, corners);
        let Some(hit) = hit else { continue };
        if is_better(hit.t, prim, best) {
            any = true;
            let [u, v] = uv(hit);
            let t = hit.t;
            *best = Hit { t, u, v, prim };
            if ANY {
                return true;
            }
        }
    }
    any
}

/// Spheres of a leaf.
#[inline(never)]
fn spheres<const ANY: bool>(
    spheres: &[SphereShape],
    ids: &[u32],
    ray: &LeafRay,
    best: &mut Hit,
) -> bool {
    let mut any = false;
    for (s, &prim) in spheres.iter().zip(ids) {
        let Some(t) = sphere::intersect(ray.o, ray.d, s.center.to_array(), s.radius) else {
            continue;
        };
        if is_better(t, prim, best) {
            any = true;
            *best = Hit {
                t,
                u: 0.0,
                v: 0.0,
                prim,
            };
            if ANY {
                return true;
            }
        }
    }
    any
}
