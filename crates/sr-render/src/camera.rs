//! Cameras in render space. The origin of render space is the camera, so that coordinates are
//! small where precision is seen.

use glam::{Vec2, Vec3};
use sr_accel::Ray;

/// How directions become places on the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Through a point.
    Perspective {
        /// Tangents of the half angles of view, horizontal and vertical.
        tan_half: Vec2,
    },
    /// Along parallel rays.
    Orthographic {
        /// Half extents of what is seen, in metres.
        half: Vec2,
    },
}

/// A camera at the origin of render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The kind of projection and its measures.
    pub projection: Projection,
    /// Unit vector to the right of the picture.
    pub right: Vec3,
    /// Unit vector to the top of the picture.
    pub up: Vec3,
    /// Unit vector against the view direction.
    pub back: Vec3,
    /// Width and height of the film in pixels.
    pub size: Vec2,
}

/// A straight way from a point to the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraConnection {
    /// Where it meets the film, in pixels from the top left.
    pub film: Vec2,
    /// Unit direction from the point to the camera.
    pub wi: Vec3,
    /// Distance to the camera; for parallel rays, to its plane.
    pub dist: f32,
    /// Importance with all geometry terms on the camera's side: a light path of throughput
    /// `beta` that ends at a surface point adds `beta · f · |cosθ| · importance` to its pixel,
    /// when one light path is traced for each pixel of the film and each sample.
    pub importance: f32,
}

impl Camera {
    /// The ray through a place on the film, in pixels from the top left; its direction has unit
    /// length.
    #[inline]
    pub fn ray(&self, film: Vec2) -> Ray {
        let ndc = Vec2::new(
            2.0 * film.x / self.size.x - 1.0,
            1.0 - 2.0 * film.y / self.size.y,
        );
        let (o, d) = match self.projection {
            Projection::Perspective { tan_half } => {
                let q = ndc * tan_half;
                let d = self.right * q.x + self.up * q.y - self.back;
                (Vec3::ZERO, d.normalize())
            }
            Projection::Orthographic { half } => {
                let q = ndc * half;
                (self.right * q.x + self.up * q.y, -self.back)
            }
        };
        Ray {
            o,
            t_max: f32::INFINITY,
            d,
        }
    }

    /// Distance of a point along the view axis; negative behind the camera.
    #[inline]
    pub fn depth(&self, p: Vec3) -> f32 {
        -p.dot(self.back)
    }

    /// The way from `p` to the camera, or `None` when the film does not see `p`, whatever stands
    /// between.
    ///
    /// With pixel filter of one pixel, a pixel is `∫ L dx` over its area `dx` on the film. For a
    /// pinhole `dx = W·H dω / (A cos³θ)`, `A` the film's area at distance 1 and `dω = dA cos/d²`;
    /// for parallel rays `dx = W·H dA cos / A`. `W·H` cancels against the number of light paths.
    #[inline]
    pub fn connect(&self, p: Vec3) -> Option<CameraConnection> {
        let depth = self.depth(p);
        if depth <= 0.0 {
            return None;
        }
        let plane = Vec2::new(p.dot(self.right), p.dot(self.up));
        let (ndc, wi, dist, importance) = match self.projection {
            Projection::Perspective { tan_half } => {
                let dist = p.length();
                let cos = depth / dist;
                let area = 4.0 * tan_half.x * tan_half.y;
                let importance = 1.0 / (area * cos * cos * cos * dist * dist);
                (plane / (depth * tan_half), -p / dist, dist, importance)
            }
            Projection::Orthographic { half } => {
                let area = 4.0 * half.x * half.y;
                (plane / half, self.back, depth, 1.0 / area)
            }
        };
        let film = Vec2::new((ndc.x + 1.0) * 0.5, (1.0 - ndc.y) * 0.5) * self.size;
        let inside = film.cmpge(Vec2::ZERO).all() && film.cmplt(self.size).all();
        inside.then_some(CameraConnection {
            film,
            wi,
            dist,
            importance,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cameras() -> [Camera; 2] {
        let base = Camera {
            projection: Projection::Perspective {
                tan_half: Vec2::new(0.4, 0.3),
            },
            right: Vec3::X,
            up: Vec3::Y,
            back: Vec3::Z,
            size: Vec2::new(64.0, 48.0),
        };
        let parallel = Camera {
            projection: Projection::Orthographic {
                half: Vec2::new(2.0, 1.5),
            },
            ..base
        };
        [base, parallel]
    }

    #[test]
    fn connecting_a_point_on_a_ray_finds_the_rays_pixel() {
        for camera in cameras() {
            for i in 0..1000u32 {
                let u = |k| sr_math::hash::unit_f32(sr_math::hash::mix(i, k));
                let film = Vec2::new(u(0), u(1)) * camera.size;
                let ray = camera.ray(film);
                let c = camera.connect(ray.o + ray.d * (0.1 + 10.0 * u(2)));
                // A dozen roundings of numbers up to 64: 64 · 12 · 2⁻²⁴ < 5e-5.
                let back = c.map(|c| c.film).unwrap_or(Vec2::INFINITY);
                assert!((back - film).abs().max_element() < 5e-5, "{film} {back}");
            }
        }
    }

    /// A plane at distance 2 seen whole: the importance of its points, integrated over its area
    /// with the cosine, is the number of pixels over W·H, that is 1.
    #[test]
    fn importance_integrates_to_one_picture() {
        for camera in cameras() {
            let extent = match camera.projection {
                Projection::Perspective { tan_half } => tan_half * 2.0,
                Projection::Orthographic { half } => half,
            };
            let n = 200;
            let mut sum = 0.0f64;
            for i in 0..n {
                for j in 0..n {
                    let q = (Vec2::new(i as f32, j as f32) + 0.5) / n as f32 * 2.0 - 1.0;
                    let p = (q * extent).extend(-2.0);
                    if let Some(c) = camera.connect(p) {
                        sum += f64::from(c.importance * c.wi.z);
                    }
                }
            }
            let area = 4.0 * f64::from(extent.x * extent.y);
            let total = sum * area / f64::from(n * n);
            // The integrand is constant in exact arithmetic; what is left is rounding.
            assert!((total - 1.0).abs() < 1e-5, "{total}");
        }
    }

    #[test]
    fn nothing_behind_the_camera_is_seen() {
        for camera in cameras() {
            assert_eq!(camera.connect(Vec3::new(0.0, 0.0, 1.0)), None);
        }
    }
}
