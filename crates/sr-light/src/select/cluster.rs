//! What is known of a group of lights: where they are, where they shine, how strongly.

use crate::Light;
use glam::{DVec3, Vec3};
use sr_math::Bounds3;
use sr_math::color::LUMINANCE_WEIGHTS;
use std::f64::consts::{FRAC_PI_2, PI};

/// The directions within `theta` of an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    /// Unit vector.
    pub axis: DVec3,
    /// Half angle in radians; π is the whole sphere.
    pub theta: f64,
}

impl Cone {
    const SPHERE: Self = Self {
        axis: DVec3::Z,
        theta: PI,
    };

    /// A cone around both, the smallest but for rounding (Conty Estevez, Kulla 2018, algorithm 1).
    fn union(self, other: Self) -> Self {
        let (wide, narrow) = if self.theta >= other.theta {
            (self, other)
        } else {
            (other, self)
        };
        let sine = wide.axis.cross(narrow.axis).length();
        let between = sine.atan2(wide.axis.dot(narrow.axis));
        if between + narrow.theta <= wide.theta {
            return wide;
        }
        let theta = 0.5 * (wide.theta + between + narrow.theta);
        if theta >= PI {
            return Self::SPHERE;
        }
        let across = |v: DVec3| (v - wide.axis * wide.axis.dot(v)).try_normalize();
        // Of axes all but opposite the first difference is rounding in any direction, the second is
        // across the axis again; opposite ones turn into any plane.
        let side = across(narrow.axis).and_then(across);
        let side = side.unwrap_or_else(|| wide.axis.any_orthonormal_vector());
        let (sin, cos) = (theta - wide.theta).sin_cos();
        Self {
            axis: (wide.axis * cos + side * sin).normalize(),
            theta,
        }
    }
}

/// Bounds of some lights, as of Conty Estevez, Kulla 2018, §4.1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cluster {
    /// Around their surfaces.
    pub bounds: Bounds3,
    /// Around their axes: the normals of surfaces, all directions for spheres and points.
    pub cone: Cone,
    /// How far from an axis light is sent, at most π/2.
    pub theta_e: f64,
    /// Sum of the luminances of radiant intensity along the axes, W/sr.
    pub intensity: f64,
    /// Some send light along the opposite axis too.
    pub two_sided: bool,
}

fn luminance(rgb: Vec3) -> f64 {
    rgb.as_dvec3().dot(LUMINANCE_WEIGHTS.as_dvec3())
}

impl Cluster {
    /// Of one light; `None` for an infinite one.
    pub fn of(light: &Light) -> Option<Self> {
        let bounds = light.bounds()?;
        let flat = |ng: Vec3, radiance, area: f32, two_sided| {
            let axis = ng.as_dvec3().normalize_or(DVec3::Z);
            let cone = Cone { axis, theta: 0.0 };
            (
                cone,
                FRAC_PI_2,
                luminance(radiance) * f64::from(area),
                two_sided,
            )
        };
        let (cone, theta_e, intensity, two_sided) = match light {
            Light::Triangle(l) => flat(l.ng(), l.radiance(), l.area(), l.is_two_sided()),
            Light::Quad(l) => flat(l.ng(), l.radiance(), l.area(), l.is_two_sided()),
            // A sphere shows a quarter of its area.
            Light::Sphere(l) => {
                let intensity = 0.25 * f64::from(l.area()) * luminance(l.radiance());
                (Cone::SPHERE, FRAC_PI_2, intensity, false)
            }
            Light::Point(l) => (Cone::SPHERE, FRAC_PI_2, luminance(l.intensity), false),
            Light::Spot(l) => {
                let axis = l.axis.as_dvec3().normalize_or(DVec3::Z);
                let theta_e = f64::from(l.cos_outer).clamp(0.0, 1.0).acos();
                let cone = Cone { axis, theta: 0.0 };
                (cone, theta_e, luminance(l.intensity), false)
            }
            Light::Directional(_) | Light::Environment(_) | Light::ImageEnvironment(_) => {
                return None;
            }
        };
        Some(Self {
            bounds,
            cone,
            theta_e,
            intensity,
            two_sided,
        })
    }

    /// Of both.
    pub fn union(&self, other: &Self) -> Self {
        let mut turned = other.cone;
        // Axes that hold both ways may point either way.
        if self.two_sided && other.two_sided && turned.axis.dot(self.cone.axis) < 0.0 {
            turned.axis = -turned.axis;
        }
        Self {
            bounds: self.bounds.union(other.bounds),
            cone: self.cone.union(turned),
            theta_e: self.theta_e.max(other.theta_e),
            intensity: self.intensity + other.intensity,
            two_sided: self.two_sided || other.two_sided,
        }
    }
}

/// `∫ cos(max(0, θ − θo)) dω` over the directions within θo + θe: the measure of the directions that a
/// cluster shines in (Conty Estevez, Kulla 2018, eq. 1).
pub(super) fn measure(theta_o: f64, theta_e: f64) -> f64 {
    let theta_w = (theta_o + theta_e).min(PI);
    let (sin_o, cos_o) = theta_o.sin_cos();
    2.0 * PI * (1.0 - cos_o)
        + FRAC_PI_2
            * (2.0 * theta_w * sin_o - (theta_o - 2.0 * theta_w).cos() - 2.0 * theta_o * sin_o
                + cos_o)
}

#[cfg(test)]
mod tests {
    use super::*;
    use sr_math::hash;

    fn direction(i: u32) -> DVec3 {
        let u = [0, 1].map(|k| f64::from(hash::unit_f32(hash::mix(i, k))));
        DVec3::from(sr_math::warp::uniform_sphere(u))
    }

    fn angle(a: DVec3, b: DVec3) -> f64 {
        a.cross(b).length().atan2(a.dot(b))
    }

    /// The union holds each cone as a whole: the directions on its rim are within.
    #[test]
    fn a_union_of_cones_contains_both_and_touches_them() {
        for i in 0..20_000u32 {
            let u = |k: u32| f64::from(hash::unit_f32(hash::mix(i, 10 + k)));
            let of = |k, theta| Cone {
                axis: direction(2 * i + k),
                theta,
            };
            let mut cones = [of(0, PI * u(0) * u(0)), of(1, PI * u(1) * u(2))];
            match i % 8 {
                0 => cones[1].axis = cones[0].axis,
                1 => cones[1].axis = -cones[0].axis,
                2 => cones.iter_mut().for_each(|c| c.theta = 0.0),
                _ => {}
            }
            let union = cones[0].union(cones[1]);
            assert!((union.axis.length() - 1.0).abs() < 1e-14);
            for c in cones {
                let reach = (angle(union.axis, c.axis) + c.theta).min(PI);
                assert!(reach <= union.theta + 1e-7, "{cones:?} {union:?}");
            }
            let widest = cones[0].theta.max(cones[1].theta);
            let sum = cones[0].theta + cones[1].theta + angle(cones[0].axis, cones[1].axis);
            assert!(union.theta <= widest.max(0.5 * sum).min(PI) + 1e-7);
        }
    }

    /// Against the sum over a fine grid of θ.
    #[test]
    fn the_measure_is_the_integral() {
        for (theta_o, theta_e) in [(0.0, FRAC_PI_2), (0.4, 1.0), (2.5, 1.5), (PI, FRAC_PI_2)] {
            let n = 20_000;
            let end = (theta_o + theta_e).min(PI);
            let sum: f64 = (0..n)
                .map(|k| (f64::from(k) + 0.5) * end / f64::from(n))
                .map(|t| (t - theta_o).max(0.0).cos() * t.sin())
                .sum();
            let want = 2.0 * PI * sum * end / f64::from(n);
            let got = measure(theta_o, theta_e);
            assert!(
                (got - want).abs() < 1e-6,
                "{theta_o} {theta_e}: {got} {want}"
            );
        }
    }
}
