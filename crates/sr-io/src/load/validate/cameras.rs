//! One active camera, and projections that make sense.

use super::super::session::Session;
use super::{Complaint, check_positive, complaint};
use bevy_ecs::prelude::*;
use sr_scene::components::{ActiveCamera, LocalTransform, LookAt, Orthographic, PerspectiveCamera};

/// Angles that [`shows_a_picture`] takes, rounded to fewer digits towards the inside.
const LEAST_FOV_DEG: f64 = 0.000014;
const MOST_FOV_DEG: f64 = 179.99998;

/// Whether single precision tells the rays of a picture apart.
///
/// A ray through the picture's edge is (t, 0, −1) normalised, with t the tangent of half the
/// angle. Below t = ε, the spacing of numbers at 1, all rays turn into the axis once the camera is
/// turned away from the world's axes; above 1/ε the part along the axis is lost in the same way,
/// and all rays lie in the plane across it.
fn shows_a_picture(deg: f64) -> bool {
    let t = (0.5 * deg).to_radians().tan();
    let spacing = f64::from(f32::EPSILON);
    deg < 180.0 && (spacing..=1.0 / spacing).contains(&t)
}

impl Session<'_> {
    pub(super) fn check_cameras(&mut self) {
        self.check_each::<PerspectiveCamera>("PerspectiveCamera", |c, complaints| {
            for (field, angle) in [("hfov_deg", c.hfov_deg), ("vfov_deg", c.vfov_deg)] {
                if let Some(deg) = angle
                    && !shows_a_picture(deg)
                {
                    let message =
                        format!("{deg} must be between {LEAST_FOV_DEG} and {MOST_FOV_DEG}");
                    complaints.push((field, complaint(message)));
                }
            }
            if c.hfov_deg.is_some() && c.vfov_deg.is_some() {
                complaints.push(("", either("hfov_deg", "vfov_deg")));
            }
        });
        self.check_each::<Orthographic>("Orthographic", |c, complaints| {
            for (field, extent) in [("width", c.width), ("height", c.height)] {
                if let Some(extent) = extent {
                    check_positive(field, extent, complaints);
                }
            }
            if c.width.is_some() && c.height.is_some() {
                complaints.push(("", either("width", "height")));
            }
        });
        self.check_each::<LookAt>("LookAt", |look_at, complaints| {
            if look_at.to_matrix().is_none_or(|m| !m.is_finite()) {
                let message = "`from`, `to` and `up` do not span a frame".to_owned();
                let hint = "`to` must differ from `from`, and `up` from the view direction";
                complaints.push(("", (message, Some(hint))));
            }
        });
        self.check_placements();
        self.check_projections();
        self.check_lenses();
        self.check_one_is_active();
    }

    fn check_placements(&mut self) {
        let mut both = self
            .world
            .query_filtered::<Entity, (With<LookAt>, With<LocalTransform>)>();
        let both: Vec<Entity> = both.iter(self.world).collect();
        for entity in both {
            let message = "`LookAt` and `LocalTransform` both place the entity".to_owned();
            let hint = "keep one; to move the camera besides, put it under a parent entity with the \
                        `LocalTransform`";
            self.invalid(entity, ".LocalTransform", (message, Some(hint)));
        }
    }

    fn check_projections(&mut self) {
        let mut cameras = self.world.query::<(
            Entity,
            Has<PerspectiveCamera>,
            Has<Orthographic>,
            Has<ActiveCamera>,
        )>();
        let cameras: Vec<_> = cameras.iter(self.world).collect();
        for (entity, perspective, orthographic, active) in cameras {
            if perspective && orthographic {
                let message = "a camera has one projection: `PerspectiveCamera` or `Orthographic`";
                self.invalid(entity, ".Orthographic", complaint(message));
            }
            // The camera of a configuration has been told about already.
            let told = self.names.path(entity) == "camera";
            if active && !perspective && !orthographic && !told {
                let message = "what is marked as the active camera is no camera".to_owned();
                let hint = "give it a `PerspectiveCamera` or an `Orthographic`";
                self.invalid(entity, ".ActiveCamera", (message, Some(hint)));
            }
        }
    }

    fn check_one_is_active(&mut self) {
        let mut active = self
            .world
            .query_filtered::<(Entity, &Name), With<ActiveCamera>>();
        let mut active: Vec<(Entity, String)> = active
            .iter(self.world)
            .map(|(entity, name)| (entity, name.to_string()))
            .collect();
        if active.len() < 2 {
            return;
        }
        active.sort_by_key(|(entity, _)| {
            let place = self.place(*entity, ".ActiveCamera");
            place.map(|p| (p.line, p.column))
        });
        let first = active[0].1.clone();
        for (entity, _) in &active[1..] {
            let message = format!("`{first}` is the active camera already");
            self.invalid(*entity, ".ActiveCamera", (message, Some("a scene has one")));
        }
    }
}

fn either(a: &str, b: &str) -> Complaint {
    let message = format!("both `{a}` and `{b}` are given");
    (
        message,
        Some("give one, the other follows from the picture"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_range_that_is_told_is_within_the_one_that_is_taken() {
        assert!(shows_a_picture(LEAST_FOV_DEG) && shows_a_picture(MOST_FOV_DEG));
        assert!(shows_a_picture(40.0) && shows_a_picture(179.0));
        // Within a tenth of the true ends.
        assert!(!shows_a_picture(0.9 * LEAST_FOV_DEG));
        assert!(!shows_a_picture(180.0 - 0.5 * (180.0 - MOST_FOV_DEG)));
        for deg in [
            1e-320,
            0.0,
            -40.0,
            179.9999999999999,
            180.0,
            400.0,
            f64::NAN,
        ] {
            assert!(!shows_a_picture(deg), "{deg}");
        }
    }
}
