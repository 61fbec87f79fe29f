//! Lights without a surface.

use super::super::session::Session;
use super::{check_power, complaint};
use sr_scene::components::{DirectionalLight, Environment, PointLight, SpotLight};

impl Session<'_> {
    pub(super) fn check_lights(&mut self) {
        self.check_each::<PointLight>("PointLight", |light, complaints| {
            check_power("intensity", light.intensity, complaints);
        });
        self.check_each::<DirectionalLight>("DirectionalLight", |light, complaints| {
            check_power("irradiance", light.irradiance, complaints);
        });
        self.check_each::<Environment>("Environment", |light, complaints| {
            check_power("radiance", light.radiance, complaints);
        });
        self.check_each::<SpotLight>("SpotLight", |light, complaints| {
            check_power("intensity", light.intensity, complaints);
            let (inner, outer) = (light.inner_deg, light.outer_deg);
            if !(outer > 0.0 && outer <= 90.0) {
                let message = format!("{outer} must be above 0 and at most 90");
                complaints.push(("outer_deg", complaint(message)));
            } else if !(inner >= 0.0 && inner <= outer) {
                let message = format!("{inner} must be between 0 and `outer_deg`, {outer}");
                complaints.push(("inner_deg", complaint(message)));
            }
        });
    }
}
