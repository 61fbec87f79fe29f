//! Cutting polygons into triangles.
//!
//! Ear clipping on the plane that fits best (Newell's normal), after O'Rourke 1998,
//! "Computational Geometry in C", §1.4 to 1.6. Every corner stays a corner, those on a straight
//! edge too: the neighbouring polygon may use them, and a mesh must not get cracks. Quadratic in
//! the number of corners, hence [`MAX_CORNERS`].

use glam::{DVec2, DVec3};

/// More corners than this and a polygon is not cut by its shape any more.
pub(crate) const MAX_CORNERS: usize = 2048;

/// How well a polygon could be cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cut {
    /// The triangles cover the polygon once.
    Exact,
    /// The polygon has no area or crosses itself; the triangles use all its corners.
    Approximate,
}

/// Triangles as indices into `points`, turning as the polygon does.
pub(crate) fn triangulate(points: &[DVec3], out: &mut Vec<[usize; 3]>) -> Cut {
    let n = points.len();
    match n {
        0..3 => return Cut::Exact,
        3 => {
            out.push([0, 1, 2]);
            return Cut::Exact;
        }
        _ => {}
    }
    let normal = newell(points);
    if n > MAX_CORNERS || normal == DVec3::ZERO || !normal.is_finite() {
        out.extend((2..n).map(|i| [0, i - 1, i]));
        return Cut::Approximate;
    }
    let (s, t) = normal.normalize().any_orthonormal_pair();
    let origin = points[0];
    let flat: Vec<DVec2> = points
        .iter()
        .map(|&p| DVec2::new((p - origin).dot(s), (p - origin).dot(t)))
        .collect();
    Clipper::new(flat).run(out)
}

/// Twice the area vector of a polygon (Newell; Sutherland, Sproull, Schumacker 1974).
fn newell(points: &[DVec3]) -> DVec3 {
    // Relative to a corner, so that a polygon far from the origin keeps its digits.
    let origin = points[0];
    let mut sum = DVec3::ZERO;
    for i in 0..points.len() {
        let next = points[(i + 1) % points.len()];
        sum += (points[i] - origin).cross(next - origin);
    }
    sum
}

/// Twice the signed area of a triangle.
fn area(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

struct Clipper {
    points: Vec<DVec2>,
    prev: Vec<usize>,
    next: Vec<usize>,
    is_ear: Vec<bool>,
    left: usize,
}

impl Clipper {
    fn new(points: Vec<DVec2>) -> Self {
        let n = points.len();
        let mut clipper = Self {
            points,
            prev: (0..n).map(|i| (i + n - 1) % n).collect(),
            next: (0..n).map(|i| (i + 1) % n).collect(),
            is_ear: vec![false; n],
            left: n,
        };
        for i in 0..n {
            clipper.is_ear[i] = clipper.test_ear(i);
        }
        clipper
    }

    fn run(mut self, out: &mut Vec<[usize; 3]>) -> Cut {
        let mut cut = Cut::Exact;
        // A convex quadrilateral is cut from its first corner, as nearly every program does it.
        let mut at = 1;
        while self.left > 3 {
            let ear = self.find_ear(at).unwrap_or_else(|| {
                cut = Cut::Approximate;
                at
            });
            let (prev, next) = (self.prev[ear], self.next[ear]);
            out.push([prev, ear, next]);
            self.next[prev] = next;
            self.prev[next] = prev;
            self.left -= 1;
            // Clipping an ear changes no other corner of a simple polygon (O'Rourke, lemma 1.2.7).
            self.is_ear[prev] = self.test_ear(prev);
            self.is_ear[next] = self.test_ear(next);
            // Go on behind the neighbour: alternate corners make fewer slivers than a fan.
            at = self.next[next];
        }
        out.push([self.prev[at], at, self.next[at]]);
        cut
    }

    fn find_ear(&self, from: usize) -> Option<usize> {
        let mut i = from;
        for _ in 0..self.left {
            if self.is_ear[i] {
                return Some(i);
            }
            i = self.next[i];
        }
        None
    }

    /// Is the corner convex, with no other corner in or on its triangle?
    fn test_ear(&self, i: usize) -> bool {
        let (ia, ic) = (self.prev[i], self.next[i]);
        let (a, b, c) = (self.points[ia], self.points[i], self.points[ic]);
        if area(a, b, c) <= 0.0 {
            return false;
        }
        let mut j = self.next[ic];
        while j != ia {
            let p = self.points[j];
            let inside = area(a, b, p) >= 0.0 && area(b, c, p) >= 0.0 && area(c, a, p) >= 0.0;
            // A corner in the same place as one of the ear's (a bridge to a hole) blocks nothing.
            if inside && p != a && p != b && p != c {
                return false;
            }
            j = self.next[j];
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cut a polygon of the plane z = x + 2 y and check that the areas add up and that nothing
    /// turns the wrong way.
    fn check(corners: &[[f64; 2]]) {
        let lift = |[x, y]: [f64; 2]| DVec3::new(x, y, x + 2.0 * y);
        let points: Vec<DVec3> = corners.iter().map(|&c| lift(c)).collect();
        let mut triangles = Vec::new();
        assert_eq!(triangulate(&points, &mut triangles), Cut::Exact);
        assert_eq!(triangles.len(), points.len() - 2);
        let whole = newell(&points);
        // Corners in a row may make triangles without area, which rounding gives a sign.
        let rounding = 1e-12 * whole.length();
        let mut sum = 0.0;
        for [a, b, c] in triangles {
            let n = (points[b] - points[a]).cross(points[c] - points[a]);
            let along = n.dot(whole.normalize());
            assert!(
                along >= -rounding,
                "{a} {b} {c} turns the wrong way: {along}"
            );
            sum += along;
        }
        let error = (sum - whole.length()).abs();
        assert!(error <= rounding, "{error}");
    }

    #[test]
    fn convex_and_concave_polygons_are_covered_once() {
        check(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]);
        // An arrow head: the diagonal from corner 0 lies outside.
        check(&[[0.0, 0.0], [2.0, -1.0], [0.5, 0.0], [2.0, 1.0]]);
        check(&[[2.0, -1.0], [0.5, 0.0], [2.0, 1.0], [0.0, 0.0]]);
        let l_shape = [
            [0.0, 0.0],
            [3.0, 0.0],
            [3.0, 1.0],
            [1.0, 1.0],
            [1.0, 3.0],
            [0.0, 3.0],
        ];
        check(&l_shape);
        let comb: Vec<[f64; 2]> = (0..40)
            .flat_map(|i| [[i as f64, 0.9], [i as f64 + 0.5, 0.05]])
            .chain([[40.0, 1.0], [40.0, 0.0], [0.0, 0.0]])
            .rev()
            .collect();
        check(&comb);
    }

    #[test]
    fn corners_on_a_straight_edge_stay_corners() {
        let square = [
            [0.0, 0.0],
            [1.0, 0.0],
            [2.0, 0.0],
            [2.0, 1.0],
            [2.0, 2.0],
            [0.0, 2.0],
        ];
        check(&square);
    }

    #[test]
    fn a_polygon_without_area_keeps_its_corners_and_says_so() {
        let points: Vec<DVec3> = (0..5).map(|i| DVec3::X * i as f64).collect();
        let mut triangles = Vec::new();
        assert_eq!(triangulate(&points, &mut triangles), Cut::Approximate);
        assert_eq!(triangles.len(), 3);
    }

    #[test]
    fn a_polygon_that_crosses_itself_still_ends() {
        let star: Vec<DVec3> = (0..5)
            .map(|i| {
                let (s, c) = (i as f64 * 2.0 * std::f64::consts::TAU / 5.0).sin_cos();
                DVec3::new(c, s, 0.0)
            })
            .collect();
        let mut triangles = Vec::new();
        triangulate(&star, &mut triangles);
        assert_eq!(triangles.len(), 3);
    }
}
