//! Cameras in render space. The origin of render space is the camera, so that coordinates are
//! small where precision is seen.

use crate::Lens;
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
    /// The lens around the origin of each ray; without one the camera is a pinhole.
    pub lens: Option<Lens>,
}

/// A straight way from a point to the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraConnection {
    /// Where it meets the film, in pixels from the top left.
    pub film: Vec2,
    /// Unit direction from the point to the camera.
    pub wi: Vec3,
    /// Distance to the point of the lens; for parallel rays without one, to the camera's plane.
    pub dist: f32,
    /// Importance with all geometry terms on the camera's side: a light path of throughput
    /// `beta` that ends at a surface point adds `beta · f · |cosθ| · importance` to its pixel,
    /// when one light path is traced for each pixel of the film and each sample.
    pub importance: f32,
}

impl Camera {
    /// The ray through a place on the film, in pixels from the top left, and the middle of the
    /// lens; its direction has unit length.
    #[inline]
    pub fn ray(&self, film: Vec2) -> Ray {
        let plane = self.plane(film);
        match self.projection {
            Projection::Perspective { .. } => {
                let d = self.right * plane.x + self.up * plane.y - self.back;
                endless(Vec3::ZERO, d.normalize())
            }
            Projection::Orthographic { .. } => endless(self.across(plane), -self.back),
        }
    }

    /// A uniform point of the aperture, for [`ray_through`](Self::ray_through) and
    /// [`connect`](Self::connect), from two random numbers; a pinhole does not ask for them.
    #[inline]
    pub fn lens_point(&self, u: impl FnOnce() -> Vec2) -> Vec2 {
        self.lens.map_or(Vec2::ZERO, |lens| lens.sample(u()))
    }

    /// The ray through a place on the film and a point of the aperture. A pinhole has one point
    /// only, so that it is [`ray`](Self::ray).
    ///
    /// Both rays meet the plane of focus in one point. At distance 1, in front of a lens point `l`
    /// in radii, that is the tilt `−l · slope`; a perspective ray adds the pinhole's direction, a
    /// parallel one starts at its own place on the camera's plane.
    #[inline]
    pub fn ray_through(&self, film: Vec2, point: Vec2) -> Ray {
        let Some(lens) = &self.lens else {
            return self.ray(film);
        };
        let (start, tilt) = (point * lens.radius(), point * -lens.slope());
        let plane = self.plane(film);
        let (o, d) = match self.projection {
            Projection::Perspective { .. } => (start, plane + tilt),
            Projection::Orthographic { .. } => (plane + start, tilt),
        };
        endless(self.across(o), (self.across(d) - self.back).normalize())
    }

    /// Distance of a point along the view axis; negative behind the camera.
    #[inline]
    pub fn depth(&self, p: Vec3) -> f32 {
        -p.dot(self.back)
    }

    /// The way from `p` to a point of the aperture, or `None` when the film does not see `p`,
    /// whatever stands between.
    ///
    /// With pixel filter of one pixel, a pixel is `∫∫ L dx dl` over its area `dx` on the film and
    /// the aperture, `dl` with total 1. For one `l`, `dx = W·H dω / (A cos³θ)` of a perspective
    /// camera, `A` the film's area at distance 1 and `dω = dA cos/d²`; for parallel rays
    /// `dx = W·H dA cos / (A cosθ)`. `W·H` cancels against the number of light paths, and a
    /// uniform `l` has density 1. θ is the angle to the view axis, 0 for parallel rays of a
    /// pinhole.
    #[inline]
    pub fn connect(&self, p: Vec3, point: Vec2) -> Option<CameraConnection> {
        let depth = self.depth(p);
        if depth <= 0.0 {
            return None;
        }
        let mut plane = Vec2::new(p.dot(self.right), p.dot(self.up));
        let (mut start, mut tilt) = (Vec3::ZERO, Vec2::ZERO);
        if let Some(lens) = &self.lens {
            // The pinhole's ray through the same place on the film, at the same depth.
            (start, tilt) = (self.across(point * lens.radius()), point * lens.slope());
            plane += tilt * depth - point * lens.radius();
        }
        let (ndc, wi, dist, importance) = match self.projection {
            Projection::Perspective { tan_half } => {
                let way = start - p;
                let dist = way.length();
                let cos = depth / dist;
                let area = 4.0 * tan_half.x * tan_half.y;
                let importance = 1.0 / (area * cos * cos * cos * dist * dist);
                (plane / (depth * tan_half), way / dist, dist, importance)
            }
            Projection::Orthographic { half } => {
                let way = self.back + self.across(tilt);
                let stretch = if self.lens.is_some() {
                    way.length()
                } else {
                    1.0
                };
                let area = 4.0 * half.x * half.y;
                (plane / half, way / stretch, depth * stretch, stretch / area)
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

    /// A place on the film as one on the plane at distance 1, of parallel rays on any plane.
    #[inline(always)]
    fn plane(&self, film: Vec2) -> Vec2 {
        // Exact differences around the middle, where narrow pictures of many pixels look.
        let ndc = (2.0 * film - self.size) / self.size * Vec2::new(1.0, -1.0);
        match self.projection {
            Projection::Perspective { tan_half } => ndc * tan_half,
            Projection::Orthographic { half } => ndc * half,
        }
    }

    /// A vector across the view axis.
    #[inline(always)]
    fn across(&self, v: Vec2) -> Vec3 {
        self.right * v.x + self.up * v.y
    }
}

/// A ray without end.
#[inline(always)]
fn endless(o: Vec3, d: Vec3) -> Ray {
    Ray {
        o,
        t_max: f32::INFINITY,
        d,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Aperture;

    /// Perspective and parallel, each as a pinhole and with two lenses.
    fn cameras() -> Vec<Camera> {
        let base = Camera {
            projection: Projection::Perspective {
                tan_half: Vec2::new(0.4, 0.3),
            },
            right: Vec3::X,
            up: Vec3::Y,
            back: Vec3::Z,
            size: Vec2::new(64.0, 48.0),
            lens: None,
        };
        let parallel = Camera {
            projection: Projection::Orthographic {
                half: Vec2::new(2.0, 1.5),
            },
            ..base
        };
        let lenses = [
            None,
            Lens::new(0.2, 3.0, Aperture::Round),
            Lens::new(0.1, 0.7, Aperture::polygon(5, 20.0)),
        ];
        let with = |lens| [base, parallel].map(|camera| Camera { lens, ..camera });
        lenses.into_iter().flat_map(with).collect()
    }

    /// A hashed number for a case.
    fn u(i: u32, k: u32) -> f32 {
        sr_math::hash::unit_f32(sr_math::hash::mix(i, k))
    }

    #[test]
    fn connecting_a_point_on_a_ray_finds_the_rays_pixel() {
        for camera in cameras() {
            for i in 0..1000u32 {
                let film = Vec2::new(u(i, 0), u(i, 1)) * camera.size;
                let point = camera.lens_point(|| Vec2::new(u(i, 2), u(i, 3)));
                let ray = camera.ray_through(film, point);
                let t = 0.5 + 10.0 * u(i, 4);
                let c = camera.connect(ray.o + ray.d * t, point);
                // A dozen roundings of numbers up to 64: 64 · 12 · 2⁻²⁴ < 5e-5. Those of a place
                // off the axis of a near point count 1/depth/tan more: at most 4 · 2/0.5 · 64.
                let back = c.map(|c| c.film).unwrap_or(Vec2::INFINITY);
                assert!((back - film).abs().max_element() < 2e-4, "{film} {back}");
                let c = c.expect("seen");
                assert!((c.dist - t).abs() < 1e-5 * t && (c.wi + ray.d).length() < 1e-6);
            }
        }
    }

    /// Whatever the point of the lens, rays of one place on the film meet where it is in focus.
    #[test]
    fn rays_meet_in_the_plane_of_focus() {
        for camera in cameras() {
            let Some(lens) = camera.lens else { continue };
            let focus = lens.focus_distance() as f32;
            for i in 0..1000u32 {
                let film = Vec2::new(u(i, 0), u(i, 1)) * camera.size;
                let at = |ray: Ray| ray.o + ray.d * ((focus + ray.o.z) / -ray.d.z);
                let point = camera.lens_point(|| Vec2::new(u(i, 2), u(i, 3)));
                let through = at(camera.ray_through(film, point));
                let middle = at(camera.ray(film));
                // A dozen roundings of lengths up to 3.5.
                assert!((through - middle).length() < 3e-6, "{through} {middle}");
                assert_eq!(camera.ray_through(film, Vec2::ZERO).d, camera.ray(film).d);
            }
        }
    }

    /// A plane at distance 2, larger than what is seen: the importance of its points, integrated
    /// over its area with the cosine, is the number of pixels over W·H, that is 1.
    #[test]
    fn importance_integrates_to_one_picture() {
        for camera in cameras() {
            // The lens shifts what is seen by up to its blur: 0.2 · |1 − 2/0.7| < 0.4.
            let blur = if camera.lens.is_some() { 0.4 } else { 0.0 };
            let extent = match camera.projection {
                Projection::Perspective { tan_half } => tan_half * 2.0,
                Projection::Orthographic { half } => half,
            } + blur;
            for i in 0..if camera.lens.is_some() { 8 } else { 1 } {
                let point = camera.lens_point(|| Vec2::new(u(i, 0), u(i, 1)));
                let n = 200;
                let (mut sum, mut cells) = (0.0f64, 0);
                for i in 0..n {
                    for j in 0..n {
                        let q = (Vec2::new(i as f32, j as f32) + 0.5) / n as f32 * 2.0 - 1.0;
                        let p = (q * extent).extend(-2.0);
                        if let Some(c) = camera.connect(p, point) {
                            sum += f64::from(c.importance * c.wi.z);
                            cells += 1;
                        }
                    }
                }
                let area = 4.0 * f64::from(extent.x * extent.y);
                let total = sum * area / f64::from(n * n);
                // The integrand is constant in exact arithmetic where the picture lies, which a
                // whole number of cells cannot cover: at most a row at each end of both axes.
                let edge = if camera.lens.is_some() {
                    4.0 / 200.0
                } else {
                    1e-5
                };
                assert!((total - 1.0).abs() < edge * 1.5, "{total} {cells}");
                let seen = sum / f64::from(cells);
                let whole = match camera.projection {
                    Projection::Perspective { tan_half } => {
                        4.0 * tan_half * Vec2::new(tan_half.y, tan_half.x) * 4.0
                    }
                    Projection::Orthographic { half } => 4.0 * half * Vec2::new(half.y, half.x),
                };
                assert!((seen * f64::from(whole.x) - 1.0).abs() < 1e-5, "{seen}");
            }
        }
    }

    #[test]
    fn nothing_behind_the_camera_is_seen() {
        for camera in cameras() {
            assert_eq!(camera.connect(Vec3::new(0.0, 0.0, 1.0), Vec2::ZERO), None);
        }
    }
}
