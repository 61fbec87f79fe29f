//! Polygons into triangles: a fan where the polygon is convex, ear clipping where it is not
//! (Meisters 1975, "Polygons have ears").
//!
//! The polygon is judged in the plane of its Newell normal, with the axis dropped in which that
//! normal is longest; corners need not lie in one plane. Coordinates are `f32`, the orientation of
//! three corners is computed in `f64`. A polygon that crosses itself has no ears at some point; the
//! rest becomes a fan and the result says so.

/// Corners that a polygon may have when it is not convex: ear clipping takes quadratic time.
pub const MAX_CONCAVE_CORNERS: usize = 2048;

/// A polygon as triangles.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Triangulation {
    /// Corner numbers, in the winding of the polygon; two fewer than corners.
    pub triangles: Vec<[usize; 3]>,
    /// The polygon does not cross itself; otherwise the triangles may overlap.
    pub simple: bool,
}

/// Cuts a polygon into triangles that do not overlap.
///
/// Fewer than three corners give no triangles.
///
/// # Errors
/// The number of corners, when the polygon is not convex and has more than
/// [`MAX_CONCAVE_CORNERS`].
pub fn triangulate(corners: &[[f32; 3]]) -> Result<Triangulation, usize> {
    let n = corners.len();
    if n <= 3 {
        return Ok(Triangulation {
            triangles: (n == 3).then_some([0, 1, 2]).into_iter().collect(),
            simple: true,
        });
    }
    let flat = flatten(corners);
    if is_convex(&flat) {
        return Ok(Triangulation {
            triangles: (1..n - 1).map(|i| [0, i, i + 1]).collect(),
            simple: true,
        });
    }
    if n > MAX_CONCAVE_CORNERS {
        return Err(n);
    }
    Ok(clip_ears(&flat))
}

/// The corners in 2D, counter-clockwise.
fn flatten(corners: &[[f32; 3]]) -> Vec<[f64; 2]> {
    let normal = newell_normal(corners);
    let axis = (0..3)
        .max_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()))
        .expect("three axes");
    let (u, v) = match (axis, normal[axis] < 0.0) {
        (0, false) => (1, 2),
        (0, true) => (2, 1),
        (1, false) => (2, 0),
        (1, true) => (0, 2),
        (_, false) => (0, 1),
        (_, true) => (1, 0),
    };
    corners
        .iter()
        .map(|c| [f64::from(c[u]), f64::from(c[v])])
        .collect()
}

/// Twice the signed areas projected along each axis (Newell's method; Sutherland, Sproull, Schumacker 1974).
fn newell_normal(corners: &[[f32; 3]]) -> [f64; 3] {
    let mut normal = [0.0; 3];
    // Relative to the first corner, so that a polygon far from the origin keeps its digits.
    let origin = corners[0].map(f64::from);
    let at = |i: usize| {
        let c = corners[i % corners.len()].map(f64::from);
        [c[0] - origin[0], c[1] - origin[1], c[2] - origin[2]]
    };
    for i in 0..corners.len() {
        let (a, b) = (at(i), at(i + 1));
        for (k, n) in normal.iter_mut().enumerate() {
            let (p, q) = ((k + 1) % 3, (k + 2) % 3);
            *n += (a[p] - b[p]) * (a[q] + b[q]);
        }
    }
    normal
}

/// Twice the signed area of a triangle; above 0 when it is counter-clockwise.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// No corner turns right and no triangle of the fan is turned over: the second excludes polygons
/// that wind around more than once.
fn is_convex(p: &[[f64; 2]]) -> bool {
    let n = p.len();
    (0..n).all(|i| turn(p[i], p[(i + 1) % n], p[(i + 2) % n]) >= 0.0)
        && (1..n - 1).all(|i| turn(p[0], p[i], p[i + 1]) >= 0.0)
}

fn clip_ears(p: &[[f64; 2]]) -> Triangulation {
    let mut ring = Ring::new(p);
    let mut triangles = Vec::with_capacity(p.len() - 2);
    let mut at = 0;
    while ring.left > 3 {
        let Some(i) = ring.ear_from(at) else {
            break;
        };
        let (before, after) = (ring.previous[i], ring.next[i]);
        triangles.push([before, i, after]);
        ring.clip(i);
        // Going on behind the ear spreads the triangles instead of making a fan of slivers.
        at = ring.next[after];
    }
    let rest: Vec<usize> = ring.from(at).collect();
    let simple = match rest[..] {
        [a, b, c] => turn(p[a], p[b], p[c]) >= 0.0,
        // Corners in a row have no area, and their order does not matter.
        _ => ring.is_line(at),
    };
    triangles.extend(rest.windows(2).skip(1).map(|w| [rest[0], w[0], w[1]]));
    Triangulation { triangles, simple }
}

/// Corners that are not clipped yet.
struct Ring<'p> {
    p: &'p [[f64; 2]],
    previous: Vec<usize>,
    next: Vec<usize>,
    left: usize,
    /// Clipping changes this for the two neighbours only (O'Rourke 1998, "Computational Geometry
    /// in C", §1.6.6), as long as no corner lies on a diagonal.
    is_ear: Vec<bool>,
    /// Looks at all ears again that are left, for when one did.
    rescans: usize,
}

/// More than a polygon with holes joined to its outline needs, few enough to keep time quadratic.
const MAX_RESCANS: usize = 16;

impl<'p> Ring<'p> {
    fn new(p: &'p [[f64; 2]]) -> Self {
        let n = p.len();
        let mut ring = Self {
            p,
            previous: (0..n).map(|i| (i + n - 1) % n).collect(),
            next: (0..n).map(|i| (i + 1) % n).collect(),
            left: n,
            is_ear: vec![false; n],
            rescans: MAX_RESCANS,
        };
        ring.scan(0);
        ring
    }

    /// All corners, once around.
    fn from(&self, start: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(start), |&i| Some(self.next[i])).take(self.left)
    }

    fn scan(&mut self, start: usize) {
        let all: Vec<usize> = self.from(start).collect();
        for i in all {
            self.is_ear[i] = self.looks_like_ear(i);
        }
    }

    fn ear_from(&mut self, start: usize) -> Option<usize> {
        let first = |ring: &Self| ring.from(start).find(|&i| ring.is_ear[i]);
        if let Some(i) = first(self) {
            return Some(i);
        }
        self.rescans = self.rescans.checked_sub(1)?;
        self.scan(start);
        first(self)
    }

    fn clip(&mut self, i: usize) {
        let (before, after) = (self.previous[i], self.next[i]);
        self.next[before] = after;
        self.previous[after] = before;
        self.left -= 1;
        self.is_ear[before] = self.looks_like_ear(before);
        self.is_ear[after] = self.looks_like_ear(after);
    }

    /// The corner sticks out and no other corner lies in or on its triangle.
    fn looks_like_ear(&self, i: usize) -> bool {
        let [a, b, c] = [self.previous[i], i, self.next[i]].map(|k| self.p[k]);
        if turn(a, b, c) <= 0.0 {
            return false;
        }
        self.from(i).map(|k| self.p[k]).all(|q| {
            // A corner at the same place is a seam, as where a hole is joined to the outline.
            let is_corner = q == a || q == b || q == c;
            is_corner || turn(a, b, q) < 0.0 || turn(b, c, q) < 0.0 || turn(c, a, q) < 0.0
        })
    }

    fn is_line(&self, start: usize) -> bool {
        self.from(start).all(|i| {
            let [a, b, c] = [self.previous[i], i, self.next[i]].map(|k| self.p[k]);
            turn(a, b, c) == 0.0
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(p: [[f32; 3]; 3]) -> [f64; 3] {
        newell_normal(&p).map(|x| x * 0.5)
    }

    /// Triangles that keep the polygon's winding and add up to its area cannot overlap.
    fn check(corners: &[[f32; 3]]) -> Triangulation {
        let t = triangulate(corners).unwrap();
        assert_eq!(t.triangles.len(), corners.len() - 2);
        let whole = newell_normal(corners).map(|x| x * 0.5);
        let size = whole.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mut sum = 0.0;
        for tri in &t.triangles {
            let a = area(tri.map(|i| corners[i]));
            let along: f64 = (0..3).map(|k| a[k] * whole[k] / size).sum();
            // Corners on one line make triangles whose area is rounding only.
            assert!(along >= -1e-12 * size, "{tri:?} is turned over: {along}");
            sum += along;
        }
        assert!(
            (sum - size).abs() <= 1e-12 * size,
            "{sum} instead of {size}"
        );
        assert!(t.simple);
        t
    }

    #[test]
    fn convex_polygons_become_fans() {
        let t = check(&[
            [0.0, 0.0, 1.0],
            [1.0, 0.0, 1.0],
            [1.0, 1.0, 1.0],
            [0.0, 1.0, 1.0],
        ]);
        assert_eq!(t.triangles, [[0, 1, 2], [0, 2, 3]]);
    }

    #[test]
    fn a_concave_quad_is_cut_at_its_reflex_corner_wherever_it_is() {
        let arrow = [
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [0.5, 0.5, 0.0],
            [0.0, 2.0, 0.0f32],
        ];
        for first in 0..4 {
            let mut corners = arrow;
            corners.rotate_left(first);
            check(&corners);
            corners.reverse();
            check(&corners);
        }
    }

    #[test]
    fn random_star_shaped_polygons_are_covered_once_in_any_plane() {
        let mut state = 1u64;
        let mut random = move || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 40) as f32 / (1u64 << 24) as f32
        };
        for round in 0..500 {
            let n = 4 + round % 60;
            let corners: Vec<[f32; 3]> = (0..n)
                .map(|i| {
                    let phi = (i as f32 + 0.8 * random()) / n as f32 * std::f32::consts::TAU;
                    let r = 0.2 + random();
                    let (x, y) = (r * phi.cos(), r * phi.sin());
                    match round % 3 {
                        0 => [x, y, 5.0],
                        1 => [5.0, x, y],
                        _ => [y, 5.0, x],
                    }
                })
                .collect();
            check(&corners);
        }
    }

    #[test]
    fn corners_on_an_edge_stay_corners() {
        // An L with a corner in the middle of its longest edges.
        let l = [
            [0.0, 0.0],
            [1.0, 0.0],
            [2.0, 0.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [1.0, 2.0],
            [0.0, 2.0],
            [0.0, 1.0f32],
        ];
        let t = check(&l.map(|[x, y]| [x, y, 0.0]));
        for i in 0..l.len() {
            assert!(
                t.triangles.iter().flatten().any(|&c| c == i),
                "corner {i} is lost"
            );
        }
    }

    #[test]
    fn a_spiral_of_many_turns_is_covered_once() {
        let n = 200;
        let side = |i: usize, width: f32| {
            let phi = i as f32 * 0.3;
            let r = 1.0 + phi + width;
            [r * phi.cos(), r * phi.sin(), 0.0]
        };
        let outer = (0..n).map(|i| side(i, 1.0));
        let inner = (0..n).rev().map(|i| side(i, 0.0));
        check(&outer.chain(inner).collect::<Vec<_>>());
    }

    #[test]
    fn a_hole_joined_to_the_outline_by_a_seam_stays_open() {
        #[rustfmt::skip]
        let p = [
            [0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [0.0, 0.0f32],
            [1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0], [1.0, 1.0],
        ];
        check(&p.map(|[x, y]| [x, y, 0.0]));
    }

    #[test]
    fn a_comb_is_covered_once() {
        // Many corners on common lines.
        let mut comb = vec![];
        for i in 0..100 {
            let x = 2.0 * i as f32;
            comb.extend([
                [x, 1.0, 0.0],
                [x, 9.0, 0.0],
                [x + 1.0, 9.0, 0.0],
                [x + 1.0, 1.0, 0.0],
            ]);
        }
        comb.extend([[199.0, 0.0, 0.0], [0.0, 0.0, 0.0]]);
        check(&comb);
    }

    #[test]
    fn crossing_and_flat_polygons_end_and_are_told_apart() {
        let bow = [
            [0.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0f32],
        ];
        let bow = triangulate(&bow).unwrap();
        assert_eq!(bow.triangles.len(), 2);
        assert!(!bow.simple);
        let line: Vec<_> = (0..5).map(|i| [i as f32, 0.0, 0.0]).collect();
        assert_eq!(triangulate(&line).unwrap().triangles.len(), 3);
        let star: Vec<_> = [0, 2, 4, 1, 3]
            .map(|i| (i as f32 * 0.4 * std::f32::consts::PI).sin_cos())
            .iter()
            .map(|&(s, c)| [c, s, 0.0])
            .collect();
        assert!(!triangulate(&star).unwrap().simple);
    }

    #[test]
    fn too_many_corners_are_refused_only_when_concave() {
        let circle = |n: usize| -> Vec<[f32; 3]> {
            (0..n)
                .map(|i| (i as f64 / n as f64 * std::f64::consts::TAU).sin_cos())
                .map(|(s, c)| [1000.0 * c as f32, 1000.0 * s as f32, 0.0])
                .collect()
        };
        assert_eq!(triangulate(&circle(300)).unwrap().triangles.len(), 298);
        let mut dented = circle(MAX_CONCAVE_CORNERS + 1);
        dented[7] = [0.0; 3];
        assert_eq!(triangulate(&dented), Err(MAX_CONCAVE_CORNERS + 1));
    }
}
