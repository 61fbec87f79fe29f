//! The choice of one light among many.

use crate::Light;
use glam::Vec3;
use sr_math::color::luminance;
use sr_math::distribution::Distribution1D;

/// How lights are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LightSelection {
    /// Each as often as any other.
    Uniform,
    /// In proportion to the luminance of their power.
    #[default]
    Power,
}

/// A table of lights to choose from. Lights without power are never chosen.
#[derive(Clone, Debug)]
pub struct LightSampler {
    /// `None` when all lights are black.
    table: Option<Distribution1D>,
}

impl LightSampler {
    /// Lights keep their places in the slice as indices. Centre and radius are those of the scene's
    /// bounding sphere, which the power of infinite lights depends on. A power beyond `f32` counts as its
    /// largest number.
    pub fn new(
        lights: &[Light],
        selection: LightSelection,
        scene_center: Vec3,
        scene_radius: f32,
    ) -> Self {
        let weight = |light: &Light| {
            let power = luminance(light.power(scene_center, scene_radius));
            // A power that is no number says that the light is broken, not that it is bright.
            let power = if power.is_nan() {
                0.0
            } else {
                f64::from(power.min(f32::MAX))
            };
            match selection {
                LightSelection::Power => power.max(0.0),
                LightSelection::Uniform if power > 0.0 => 1.0,
                LightSelection::Uniform => 0.0,
            }
        };
        Self {
            table: Distribution1D::new(lights.iter().map(weight)),
        }
    }

    /// The index of the light that `u` in `[0, 1)` falls on, its probability, and what is left of
    /// `u`, again uniform in `[0, 1)`. `None` when there is no light to choose.
    #[inline]
    pub fn select(&self, u: f32) -> Option<(u32, f32, f32)> {
        let (index, pmf, rest) = self.table.as_ref()?.sample(u);
        Some((index as u32, pmf, rest))
    }

    /// Probability of a light; 0 for an index out of range.
    #[inline]
    pub fn pmf(&self, index: u32) -> f32 {
        let table = self.table.as_ref();
        table.map_or(0.0, |t| t.pmf(index as usize) as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ConstantEnvironment, PointLight};

    fn point(intensity: f32) -> Light {
        Light::Point(PointLight {
            p: Vec3::ZERO,
            intensity: Vec3::splat(intensity),
        })
    }

    #[test]
    fn lights_are_chosen_as_their_probabilities_say_and_black_ones_never() {
        let lights = [point(0.0), point(3.0), point(0.0), point(1.0), point(0.0)];
        for (selection, first) in [
            (LightSelection::Power, 0.75),
            (LightSelection::Uniform, 0.5),
        ] {
            let table = LightSampler::new(&lights, selection, Vec3::ZERO, 1.0);
            let mut counts = [0; 5];
            for k in 0..1 << 12 {
                let (index, pmf, rest) = table.select(k as f32 / 4096.0).expect("lights");
                assert_eq!(pmf, table.pmf(index));
                assert!((0.0..1.0).contains(&rest));
                counts[index as usize] += 1;
            }
            let expected = (first * 4096.0) as i32;
            assert!((counts[1] - expected).abs() <= 1, "{counts:?}");
            assert_eq!(counts[1] + counts[3], 4096);
            assert!((table.pmf(1) - first).abs() < 1e-6);
            assert_eq!([0, 2, 4, 5, u32::MAX].map(|i| table.pmf(i)), [0.0; 5]);
        }
    }

    #[test]
    fn a_table_without_light_selects_nothing() {
        let black = Light::Environment(ConstantEnvironment {
            radiance: Vec3::ZERO,
        });
        for lights in [vec![], vec![black.clone()], vec![point(0.0), black]] {
            let table = LightSampler::new(&lights, LightSelection::Power, Vec3::ZERO, 1.0);
            assert!(table.select(0.5).is_none());
            assert_eq!(table.pmf(0), 0.0);
        }
    }

    #[test]
    fn a_power_beyond_f32_does_not_empty_the_table() {
        let table = LightSampler::new(
            &[point(f32::MAX), point(1.0)],
            LightSelection::Power,
            Vec3::ZERO,
            1.0,
        );
        assert_eq!(table.select(0.5).map(|s| s.0), Some(0));
    }
}
