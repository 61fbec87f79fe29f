//! Lights without a surface.

use super::super::session::Session;
use super::{check_power, complaint};
use sr_scene::components::{DirectionalLight, Environment, PointLight, Rgb, SpotLight};

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
            let scale = light.scale;
            if !(0.0..=f32::MAX).contains(&scale) {
                let message = format!("{scale} must be finite and at least 0");
                complaints.push(("scale", complaint(message)));
            } else if !Rgb(light.radiance.0.map(|c| c * scale)).within(0.0, f32::MAX)
                && light.radiance.within(0.0, f32::MAX)
            {
                let message = "`radiance` times `scale` is too large";
                complaints.push(("scale", complaint(message)));
            }
            if !light.rotation_deg.is_finite() {
                let message = "the angle must be finite";
                complaints.push(("rotation_deg", complaint(message)));
            }
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
