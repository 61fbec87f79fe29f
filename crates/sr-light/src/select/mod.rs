//! The choice of one light among many.

mod angle;
mod build;
mod cluster;
mod spatial;
mod tree;

use crate::Light;
use glam::Vec3;
use spatial::Spatial;
use sr_math::color::luminance;
use sr_math::distribution::Distribution1D;

/// How lights are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LightSelection {
    /// Each as often as any other.
    Uniform,
    /// In proportion to the luminance of their power.
    Power,
    /// By what each may bring to the point: intensity, distance and orientation.
    #[default]
    Spatial,
    /// Not at all: whoever can samples every light. Where only one can be taken, as `Spatial`.
    All,
}

/// What the choice of a light may know of the point that it is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Receiver {
    /// The point.
    pub p: Vec3,
    /// Unit normal of the side that light must come from to count; zero where it may come from
    /// anywhere, as at surfaces that let light through.
    pub n: Vec3,
}

impl Receiver {
    /// A point that light may reach from anywhere.
    pub const fn anywhere(p: Vec3) -> Self {
        Self { p, n: Vec3::ZERO }
    }
}

/// A table of lights to choose from. Lights without power are never chosen.
#[derive(Clone, Debug)]
pub struct LightSampler {
    selection: LightSelection,
    /// The choice that knows no receiver. `None` when all lights are black.
    table: Option<Distribution1D>,
    /// The choice that does, where there is one to be made.
    spatial: Option<Spatial>,
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
        let power = |light: &Light| {
            let power = luminance(light.power(scene_center, scene_radius));
            // A power that is no number says that the light is broken, not that it is bright.
            if power > 0.0 {
                f64::from(power.min(f32::MAX))
            } else {
                0.0
            }
        };
        let weight = |light: &Light| match selection {
            LightSelection::Uniform if power(light) > 0.0 => 1.0,
            _ => power(light),
        };
        let shines = |light: &Light| power(light) > 0.0;
        let by_place = matches!(selection, LightSelection::Spatial | LightSelection::All);
        // One light needs no choice.
        let several = lights.iter().filter(|l| shines(l)).nth(1).is_some();
        Self {
            selection,
            table: Distribution1D::new(lights.iter().map(weight)),
            spatial: (by_place && several).then(|| Spatial::new(lights, shines)),
        }
    }

    /// The index of the light that `u` in `[0, 1)` falls on, its probability, and what is left of
    /// `u`, again uniform in `[0, 1)`. `None` when no light can bring anything to the receiver.
    ///
    /// `u` has 24 bits: a light of a probability below that is chosen as often as it should be on
    /// average over receivers, not at each by itself.
    #[inline]
    pub fn select(&self, receiver: &Receiver, u: f32) -> Option<(u32, f32, f32)> {
        let Some(spatial) = &self.spatial else {
            return self.select_emitter(u);
        };
        // The middle of what rounding to 24 bits takes for `u`: a corner of the interval, such as 0,
        // would always fall on one and the same light, however improbable.
        const HALF_STEP: f64 = 1.0 / 33_554_432.0;
        let (index, pmf, rest) = spatial.select(receiver, f64::from(u) + HALF_STEP)?;
        Some((index, pmf, (rest as f32).min(1.0 - f32::EPSILON / 2.0)))
    }

    /// Probability with which [`LightSampler::select`] chooses a light for this receiver; 0 for an index
    /// out of range.
    #[inline]
    pub fn pmf(&self, receiver: &Receiver, index: u32) -> f32 {
        match &self.spatial {
            Some(spatial) => spatial.pmf(receiver, index),
            None => self.emitter_pmf(index),
        }
    }

    /// The same choice for a path that starts at the light and has no receiver: uniform under
    /// [`LightSelection::Uniform`], by power under all others.
    #[inline]
    pub fn select_emitter(&self, u: f32) -> Option<(u32, f32, f32)> {
        let (index, pmf, rest) = self.table.as_ref()?.sample(u);
        Some((index as u32, pmf, rest))
    }

    /// Probability with which [`LightSampler::select_emitter`] chooses a light.
    #[inline]
    pub fn emitter_pmf(&self, index: u32) -> f32 {
        let table = self.table.as_ref();
        table.map_or(0.0, |t| t.pmf(index as usize) as f32)
    }

    /// What was asked for.
    pub fn selection(&self) -> LightSelection {
        self.selection
    }

    /// Whether the choice differs from receiver to receiver.
    #[inline]
    pub fn depends_on_receiver(&self) -> bool {
        self.spatial.is_some()
    }

    /// Levels of the tree over the lights that have a place; 0 without one.
    pub fn tree_levels(&self) -> u32 {
        self.spatial.as_ref().map_or(0, Spatial::levels)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ConstantEnvironment, PointLight};

    const HERE: Receiver = Receiver::anywhere(Vec3::ZERO);

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
                let (index, pmf, rest) = table.select(&HERE, k as f32 / 4096.0).expect("lights");
                assert_eq!(pmf, table.pmf(&HERE, index));
                assert!((0.0..1.0).contains(&rest));
                counts[index as usize] += 1;
            }
            let expected = (first * 4096.0) as i32;
            assert!((counts[1] - expected).abs() <= 1, "{counts:?}");
            assert_eq!(counts[1] + counts[3], 4096);
            assert!((table.pmf(&HERE, 1) - first).abs() < 1e-6);
            assert_eq!(
                [0, 2, 4, 5, u32::MAX].map(|i| table.pmf(&HERE, i)),
                [0.0; 5]
            );
        }
    }

    #[test]
    fn a_table_without_light_selects_nothing() {
        let black = Light::Environment(ConstantEnvironment {
            radiance: Vec3::ZERO,
        });
        for lights in [vec![], vec![black.clone()], vec![point(0.0), black]] {
            let table = LightSampler::new(&lights, LightSelection::Power, Vec3::ZERO, 1.0);
            assert!(table.select(&HERE, 0.5).is_none());
            assert_eq!(table.pmf(&HERE, 0), 0.0);
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
        assert_eq!(table.select(&HERE, 0.5).map(|s| s.0), Some(0));
    }
}
