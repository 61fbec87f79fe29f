//! A thin lens in front of the film: light that leaves one point of the plane of focus meets one
//! point of the film, through whichever point of the aperture it goes (Cook, Porter, Carpenter
//! 1984, "Distributed Ray Tracing").
//!
//! Points of the aperture are measured in its radius, along the camera's `right` and `up`. Of the
//! focus only `slope`, radius over distance, is kept: it goes to 0 for a focus at infinity, and
//! nothing overflows where radius and distance are both extreme.

use glam::Vec2;
use sr_math::warp;

/// The shape of the hole that light passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aperture {
    /// A disk.
    Round,
    /// A regular polygon with its corners on the disk's edge.
    Polygon {
        /// How many corners, at least 3.
        corners: u32,
        /// Cosine and sine of the angle from `right` to a corner.
        corner: Vec2,
    },
}

impl Aperture {
    /// A polygon with a corner at the top, turned counter-clockwise as the picture shows it.
    pub fn polygon(corners: u32, rotation_deg: f64) -> Self {
        let (sin, cos) = (90.0 + rotation_deg % 360.0).to_radians().sin_cos();
        Self::Polygon {
            corners,
            corner: Vec2::new(cos as f32, sin as f32),
        }
    }

    /// A uniform point, in radii.
    #[inline]
    fn sample(&self, u: Vec2) -> Vec2 {
        match *self {
            Self::Round => Vec2::from_array(warp::concentric_disk(u.to_array())),
            Self::Polygon { corners, corner } => corner.rotate(Vec2::from_array(
                warp::regular_polygon(u.to_array(), corners),
            )),
        }
    }
}

/// A thin lens of finite aperture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    aperture: Aperture,
    radius: f32,
    slope: f32,
    focus_distance: f64,
}

impl Lens {
    /// A lens of some radius, focused on the plane at a distance along the view axis, both in
    /// metres. The distance may be infinite.
    ///
    /// `None` when single precision cannot hold it: the radius must not vanish or overflow, and
    /// the outermost ray must not lie in the plane of the lens, so the slope is at most 1/ε, ε the
    /// spacing of numbers at 1: beyond, the part along the axis is lost in rounding.
    pub fn new(radius: f64, focus_distance: f64, aperture: Aperture) -> Option<Self> {
        let slope = radius / focus_distance;
        let fits = focus_distance > 0.0 && slope <= 1.0 / f64::from(f32::EPSILON);
        let rounded = radius as f32;
        (fits && rounded > 0.0 && rounded.is_finite()).then_some(Self {
            aperture,
            radius: rounded,
            slope: slope as f32,
            focus_distance,
        })
    }

    /// The shape of the aperture.
    pub fn aperture(&self) -> Aperture {
        self.aperture
    }

    /// Radius of the aperture's disk in metres.
    pub fn radius(&self) -> f32 {
        self.radius
    }

    /// Distance of the plane of focus along the view axis, in metres; may be infinite.
    pub fn focus_distance(&self) -> f64 {
        self.focus_distance
    }

    /// Radius over distance of focus: the tangent of the outermost ray to a point in focus on the
    /// axis.
    #[inline]
    pub fn slope(&self) -> f32 {
        self.slope
    }

    /// A uniform point of the aperture, in radii.
    #[inline]
    pub fn sample(&self, u: Vec2) -> Vec2 {
        self.aperture.sample(u)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polygon_stands_on_its_rotation() {
        for (rotation, corner) in [(0.0, Vec2::Y), (90.0, -Vec2::X), (-450.0, Vec2::X)] {
            let aperture = Aperture::polygon(5, rotation);
            let top = aperture.sample(Vec2::new(1.0, 0.5));
            assert!(
                (top - corner).abs().max_element() < 1e-6,
                "{rotation}: {top}"
            );
        }
    }

    #[test]
    fn what_f32_cannot_hold_is_refused() {
        let lens = |radius, focus| Lens::new(radius, focus, Aperture::Round);
        assert!(lens(0.1, 3.0).is_some() && lens(1e-30, 1e30).is_some());
        assert_eq!(lens(0.1, f64::INFINITY).map(|l| l.slope()), Some(0.0));
        for (radius, focus) in [
            (1e-60, 1.0),
            (1e60, 1e60),
            (1.0, 1e-9),
            (1.0, 0.0),
            (1.0, -1.0),
            (f64::NAN, 1.0),
            (1.0, f64::NAN),
            (f64::INFINITY, f64::INFINITY),
        ] {
            assert_eq!(lens(radius, focus), None, "{radius} {focus}");
        }
    }
}
