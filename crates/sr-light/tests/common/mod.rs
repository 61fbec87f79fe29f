//! Shapes met by rays in `f64`, and numbers.
#![allow(dead_code, reason = "each test binary uses its own part")]

use glam::{DVec3, Vec3};
use sr_math::hash;

/// The hashed number `k` of sample `i`, in `[0, 1)`.
pub fn numbers(i: u32, k: u32) -> f32 {
    hash::unit_f32(hash::mix(i, k))
}

/// The integral of a density over a cell of the unit square divided into `cells` a side: nine Gauss
/// points in each of 64 parts.
pub fn integrate_cell(cell: [usize; 2], cells: usize, density: impl Fn(f64, f64) -> f64) -> f64 {
    const PARTS: usize = 8;
    let node = 0.6f64.sqrt();
    let rule = [(-node, 5.0 / 18.0), (0.0, 8.0 / 18.0), (node, 5.0 / 18.0)];
    let width = 1.0 / (cells * PARTS) as f64;
    let points = |c: usize| {
        (0..PARTS).flat_map(move |k| {
            rule.map(|(x, w)| (((c * PARTS + k) as f64 + 0.5 + 0.5 * x) * width, w * width))
        })
    };
    points(cell[0])
        .map(|(a, wa)| {
            points(cell[1])
                .map(|(b, wb)| wa * wb * density(a, b))
                .sum::<f64>()
        })
        .sum()
}

/// The oracle's own idea of a light's surface.
pub enum Shape {
    /// Corner and two edges; a triangle takes the half next to the corner.
    Flat {
        corner: DVec3,
        edges: [DVec3; 2],
        triangle: bool,
    },
    Sphere {
        center: DVec3,
        radius: f64,
    },
}

impl Shape {
    pub fn triangle([a, b, c]: [Vec3; 3]) -> Self {
        let (a, b, c) = (a.as_dvec3(), b.as_dvec3(), c.as_dvec3());
        Self::Flat {
            corner: a,
            edges: [b - a, c - a],
            triangle: true,
        }
    }

    pub fn quad(corner: Vec3, u: Vec3, v: Vec3) -> Self {
        Self::Flat {
            corner: corner.as_dvec3(),
            edges: [u.as_dvec3(), v.as_dvec3()],
            triangle: false,
        }
    }

    pub fn sphere(center: Vec3, radius: f32) -> Self {
        Self::Sphere {
            center: center.as_dvec3(),
            radius: radius.into(),
        }
    }

    fn flat(&self) -> (DVec3, [DVec3; 2], bool) {
        match self {
            Self::Flat {
                corner,
                edges,
                triangle,
            } => (*corner, *edges, *triangle),
            Self::Sphere { .. } => panic!("a sphere is not flat"),
        }
    }

    /// A point near the middle; of a flat shape, on it.
    pub fn center(&self) -> Vec3 {
        match self {
            Self::Flat { corner, edges, .. } => (*corner + 0.4 * (edges[0] + edges[1])).as_vec3(),
            Self::Sphere { center, .. } => center.as_vec3(),
        }
    }

    /// About half of its extent.
    pub fn size(&self) -> f32 {
        match self {
            Self::Flat { edges, .. } => (0.5 * edges[0].length()) as f32,
            Self::Sphere { radius, .. } => *radius as f32,
        }
    }

    /// Where the line from `o` along `d` meets a flat shape, in coordinates of the unit square. Those
    /// of a triangle shrink towards its third corner.
    pub fn coordinates_along(&self, o: DVec3, d: DVec3) -> [f64; 2] {
        let (corner, [e, f], triangle) = self.flat();
        let n = e.cross(f);
        let q = o + n.dot(corner - o) / n.dot(d) * d - corner;
        let (s, t) = (q.cross(f).dot(n), e.cross(q).dot(n));
        let (s, t) = (s / n.length_squared(), t / n.length_squared());
        let s = if triangle { s / (1.0 - t) } else { s };
        [s.clamp(0.0, 1.0), t.clamp(0.0, 1.0)]
    }

    /// The point of a flat shape at coordinates of the unit square, its unit normal, and the area
    /// there per unit of the square.
    pub fn surface(&self, [a, b]: [f64; 2]) -> (DVec3, DVec3, f64) {
        let (corner, [e, f], triangle) = self.flat();
        let shrink = if triangle { 1.0 - b } else { 1.0 };
        let n = e.cross(f);
        let q = corner + a * shrink * e + b * f;
        (q, n.normalize(), n.length() * shrink)
    }

    /// Distance and unit normal where the ray first meets the shape.
    pub fn hit(&self, o: DVec3, d: DVec3) -> Option<(f64, DVec3)> {
        match self {
            Self::Flat { .. } => panic!("grazing rays to flat shapes want `coordinates_along`"),
            Self::Sphere { center, radius } => {
                let c = *center - o;
                let along = c.dot(d);
                let root = radius * radius - (c - along * d).length_squared();
                if root < 0.0 {
                    return None;
                }
                let (near, far) = (along - root.sqrt(), along + root.sqrt());
                let t = if near > 0.0 { near } else { far };
                (t > 0.0).then(|| (t, (t * d - c) / *radius))
            }
        }
    }
}
