//! `<camera>`, and the two ways to point it at the scene.

use super::transform::frame_along;
use super::xml::{Reader, Xml, child, label, path, start};
use glam::{DMat4, DVec3};

/// A camera of the file, placed.
#[derive(Clone, Debug)]
pub(crate) struct Camera {
    pub name: String,
    pub optics: Optics,
    /// Camera to world.
    pub world: DMat4,
    /// Metres per unit of the file.
    pub metres: f64,
    /// Where the node is in the file.
    pub at: usize,
}

/// What a camera's lens says. Angles are full and in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Optics {
    Perspective {
        xfov: Option<f64>,
        yfov: Option<f64>,
        aspect: Option<f64>,
    },
    /// Half extents in units of the file.
    Orthographic {
        xmag: Option<f64>,
        ymag: Option<f64>,
        aspect: Option<f64>,
    },
}

/// What the picture's edges see: the one number that a scene file gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View {
    /// Full horizontal field of view, degrees.
    Hfov(f64),
    /// Full vertical field of view, degrees.
    Vfov(f64),
    /// Width seen by parallel rays, metres.
    Width(f64),
    /// Height seen by parallel rays, metres.
    Height(f64),
}

/// A camera as a scene file gives it, in world coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Framing {
    /// Position.
    pub from: DVec3,
    /// A point on the optical axis.
    pub to: DVec3,
    /// Up in the picture.
    pub up: DVec3,
    /// What it sees.
    pub view: View,
    /// Width and height in pixels of the picture that it was framed for.
    pub film: (u32, u32),
}

/// The window for which the course's viewer fits the field of view, before it crops.
const COURSE_WINDOW: (f64, f64) = (800.0, 600.0);

/// Width of the picture for cameras that follow the file.
const FILM_WIDTH: u32 = 480;

impl<'a> Reader<'a> {
    /// Read a `<camera>`.
    pub fn camera_optics(&mut self, camera: Xml<'a>) -> Option<Optics> {
        let common = path(camera, &["optics", "technique_common"]);
        let kind = |name| common.and_then(|c| child(c, name));
        let optics = if let Some(p) = kind("perspective") {
            Optics::Perspective {
                xfov: self.lens_number(p, "xfov", 180.0)?,
                yfov: self.lens_number(p, "yfov", 180.0)?,
                aspect: self.lens_number(p, "aspect_ratio", f64::INFINITY)?,
            }
        } else if let Some(o) = kind("orthographic") {
            Optics::Orthographic {
                xmag: self.lens_number(o, "xmag", f64::INFINITY)?,
                ymag: self.lens_number(o, "ymag", f64::INFINITY)?,
                aspect: self.lens_number(o, "aspect_ratio", f64::INFINITY)?,
            }
        } else {
            let message = format!("camera `{}` has no lens", label(camera));
            let hint = "<perspective> or <orthographic> is needed in <optics>";
            self.diag.error(start(camera), message, hint);
            return None;
        };
        if let Optics::Perspective {
            xfov: None,
            yfov: None,
            ..
        }
        | Optics::Orthographic {
            xmag: None,
            ymag: None,
            ..
        } = optics
        {
            let message = format!("camera `{}` does not say how much it sees", label(camera));
            let hint = "give <xfov> or <yfov>, of an orthographic camera <xmag> or <ymag>";
            self.diag.error(start(camera), message, hint);
            return None;
        }
        self.lens_shift(camera);
        Some(optics)
    }

    /// `Some(None)` when absent.
    fn lens_number(
        &mut self,
        lens: Xml<'a>,
        name: &'static str,
        below: f64,
    ) -> Option<Option<f64>> {
        let Some(node) = child(lens, name) else {
            return Some(None);
        };
        let x = self.number(node)?;
        if x > 0.0 && x < below {
            return Some(Some(x));
        }
        let message = format!("<{name}> is out of range");
        let hint = "it must be above 0, and an angle below 180";
        self.diag.error(start(node), message, hint);
        None
    }

    fn lens_shift(&mut self, camera: Xml<'a>) {
        let shifted = camera
            .descendants()
            .filter(|n| n.has_tag_name("shiftx") || n.tag_name().name() == "shifty")
            .filter_map(|n| n.text())
            .any(|t| t.trim().parse::<f64>().is_ok_and(|x| x != 0.0));
        if shifted {
            let text = format!("dropped the lens shift of camera `{}`", label(camera));
            self.diag.note(text);
        }
    }
}

fn half_tan(degrees: f64) -> f64 {
    (degrees.to_radians() / 2.0).tan()
}

impl Camera {
    /// As the file says; `None` when the matrix gives no direction.
    pub fn file_framing(&self) -> Option<Framing> {
        let toward = self.world.transform_vector3(DVec3::NEG_Z);
        let [_, up, back] = frame_along(-toward, self.world.transform_vector3(DVec3::Y))?;
        let from = self.world.transform_point3(DVec3::ZERO);
        let width = |half: f64| 2.0 * half * self.metres;
        let (view, aspect) = match self.optics {
            Optics::Perspective { xfov, yfov, aspect } => {
                let ratio = xfov.zip(yfov).map(|(x, y)| half_tan(x) / half_tan(y));
                let view = xfov.map(View::Hfov).or(yfov.map(View::Vfov))?;
                (view, aspect.or(ratio))
            }
            Optics::Orthographic { xmag, ymag, aspect } => {
                let ratio = xmag.zip(ymag).map(|(x, y)| x / y);
                let view = xmag
                    .map(|x| View::Width(width(x)))
                    .or(ymag.map(|y| View::Height(width(y))))?;
                (view, aspect.or(ratio))
            }
        };
        let height = FILM_WIDTH as f64 / aspect.unwrap_or(4.0 / 3.0);
        Some(Framing {
            from,
            to: from - back,
            up,
            view,
            // A shape beyond 1:10 is a slip of the pen rather than a picture.
            film: (FILM_WIDTH, height.round().clamp(48.0, 4800.0) as u32),
        })
    }

    /// As the course's viewer does it, which looks at the centre of the geometry from one and a
    /// half times its extent.
    ///
    /// The direction is the image of (0, 0, −1) taken as a *point*, so the camera's position leaks
    /// into it; the field of view is fitted to a window of 800 × 600 and cropped to the picture.
    pub fn course_framing(
        &self,
        bounds: (DVec3, DVec3),
        film: (u32, u32),
    ) -> Result<Framing, String> {
        let Optics::Perspective { xfov, yfov, aspect } = self.optics else {
            return Err("the course's viewer has no orthographic camera".to_owned());
        };
        let (window_width, window_height) = COURSE_WINDOW;
        let window = window_width / window_height;
        let aspect = aspect.unwrap_or(window);
        let (mut x, mut y) = (xfov.map(half_tan), yfov.map(half_tan));
        x = x.or(y.map(|y| y * aspect));
        y = y.or(x.map(|x| x / aspect));
        let (Some(x), Some(y)) = (x, y) else {
            return Err("the camera has no field of view".to_owned());
        };
        // The file's picture is fitted into the window.
        let tan_y = if x / y > window { x / window } else { y };
        let pixels = window_height / (2.0 * tan_y);
        let hfov = 2.0 * (film.0 as f64 / (2.0 * pixels)).atan();

        let direction = self.world.transform_point3(DVec3::NEG_Z).try_normalize();
        let direction = direction
            .filter(|d| d.cross(DVec3::Y) != DVec3::ZERO)
            .ok_or("the course's viewer gets no direction from this camera's matrix")?;
        let target = 0.5 * (bounds.0 + bounds.1);
        let radius = 1.5 * (bounds.1 - bounds.0).length();
        Ok(Framing {
            from: target + radius * direction,
            to: target,
            up: DVec3::Y,
            view: View::Hfov(hfov.to_degrees()),
            film,
        })
    }
}
