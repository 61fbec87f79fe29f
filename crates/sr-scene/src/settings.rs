//! What a configuration sets beside the scene and the integrator. Each is a resource; the path of
//! a field is the section's name and the field's, such as `film.width`.

use bevy_ecs::prelude::*;
use bevy_ecs::reflect::AppTypeRegistry;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;
use sr_render::film::{AdaptiveSpec, StoppingRule};

/// The picture: `film`.
#[derive(Resource, Clone, Debug, Default, PartialEq, Reflect)]
#[reflect(Default)]
pub struct FilmSettings {
    /// Width in pixels; unset means the scene's, or 480.
    pub width: Option<u32>,
    /// Height in pixels; unset means the scene's, or 360.
    pub height: Option<u32>,
    /// How samples are weighted around a pixel's centre.
    pub filter: PixelFilter,
    /// Only this part is rendered: x0, y0, x1, y1 in pixels from the top left, half-open.
    pub crop: Option<[u32; 4]>,
    /// Further layers of the EXR file.
    pub layers: Vec<LayerName>,
    /// Number format of colour in the EXR file.
    pub precision: Precision,
    /// Samples with a larger component are scaled down to it. Less noise, but biased: what is cut off
    /// is missing in the picture. Unset leaves them as they are.
    pub clamp: Option<f32>,
}

/// Pixel filters; each is sampled in proportion to its value. Lengths are in pixels.
#[derive(Clone, Debug, PartialEq, Reflect)]
#[reflect(Default)]
pub enum PixelFilter {
    /// Constant inside `radius`; 0.5 is the pixel itself.
    Box {
        /// Half width.
        radius: f32,
    },
    /// Falls linearly to 0 at `radius`.
    Tent {
        /// Half width.
        radius: f32,
    },
    /// A Gaussian, cut off at `radius`.
    Gaussian {
        /// Half width.
        radius: f32,
        /// Standard deviation.
        sigma: f32,
    },
    /// The four-term Blackman–Harris window.
    BlackmanHarris {
        /// Half width.
        radius: f32,
    },
}

impl Default for PixelFilter {
    fn default() -> Self {
        Self::Box { radius: 0.5 }
    }
}

/// Layers that a film can hold beside colour, variance and sample count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub enum LayerName {
    /// Shading normal at the first hit, world frame.
    #[default]
    Normal,
    /// Distance to the first hit along the view axis, metres.
    Depth,
    /// Albedo of the first hit.
    Albedo,
    /// Shape and material index at the first hit.
    Ids,
    /// Mean number of bounces of the paths.
    Bounces,
    /// CPU seconds by pixel, measured by tile.
    Seconds,
}

/// Number format of colour layers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub enum Precision {
    /// 32 bits.
    #[default]
    Float,
    /// 16 bits.
    Half,
}

/// Where random numbers come from: `sampler`.
#[derive(Resource, Clone, Debug, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub struct SamplerSettings {
    /// The sequence.
    pub kind: SamplerName,
    /// Another seed is another, independent picture.
    pub seed: u64,
    /// Independently scrambled sequences that a pixel's samples are dealt to in turn, a power of
    /// two. Their spread is the error estimate, so 2 is the least that gives an honest one under
    /// `Sobol`; 1 converges a little faster and leaves the (pessimistic) sample variance.
    pub replicas: u32,
}

impl Default for SamplerSettings {
    fn default() -> Self {
        Self {
            kind: SamplerName::Sobol,
            seed: 0,
            replicas: 2,
        }
    }
}

/// Sequences.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub enum SamplerName {
    /// Independent uniform numbers.
    Independent,
    /// Owen-scrambled Sobol points, padded by pairs of dimensions.
    #[default]
    Sobol,
}

/// When to stop: `budget`. Whatever is reached first; all unset means 64 samples.
#[derive(Resource, Clone, Debug, Default, PartialEq, Reflect)]
#[reflect(Default)]
pub struct Budget {
    /// Samples a pixel.
    pub samples: Option<u64>,
    /// Seconds of integration. The first pass is always taken, however long it is.
    pub seconds: Option<f64>,
    /// Estimated relative mean squared error of the picture.
    pub target_error: Option<f64>,
    /// Samples a pixel in one pass, at most 64; fewer when time or error decides. Unset lets the
    /// renderer choose. The picture does not depend on it.
    pub pass_samples: Option<u32>,
}

/// Where samples go: `adaptive`. Off, every pixel gets the budget's samples; else these are the
/// most that a pixel gets.
#[derive(Resource, Clone, Debug, PartialEq, Reflect)]
#[reflect(Default)]
pub struct AdaptiveSettings {
    /// Which samples decide whether a pixel has enough.
    pub rule: AdaptiveRule,
    /// A pixel has enough when the half width of the confidence interval of its luminance is at most
    /// this share of its mean.
    pub tolerance: f64,
    /// Confidence of that interval.
    pub confidence: f64,
    /// Decisions are made at multiples of this many samples a pixel.
    pub batch: u32,
    /// Samples that every pixel gets. `Course` has no such thing.
    pub min_samples: u32,
    /// Side in pixels of the blocks that are decided as a whole, by their mean square error: 1, 2,
    /// 4, 8 or 16. `Course` decides by pixels.
    pub block: u32,
    /// Luminance below which a pixel counts as this bright: the tolerance is relative to
    /// √(mean² + floor²). `Course` has no such thing.
    pub floor: f64,
}

impl Default for AdaptiveSettings {
    fn default() -> Self {
        Self {
            rule: AdaptiveRule::Off,
            tolerance: 0.05,
            confidence: 0.95,
            batch: 32,
            min_samples: 64,
            block: 4,
            floor: 0.0,
        }
    }
}

impl AdaptiveSettings {
    /// Whether pixels may get different numbers of samples.
    pub fn is_on(&self) -> bool {
        self.rule != AdaptiveRule::Off
    }

    /// What the film needs to know; `None` while it is off.
    pub fn spec(&self) -> Option<AdaptiveSpec> {
        let (rule, block) = match self.rule {
            AdaptiveRule::Off => return None,
            AdaptiveRule::Folds => (StoppingRule::Folds, self.block),
            AdaptiveRule::Course => (StoppingRule::Course, 1),
        };
        Some(AdaptiveSpec { rule, block })
    }
}

/// Which samples decide whether a pixel has enough.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub enum AdaptiveRule {
    /// None: every pixel gets the same number of samples.
    #[default]
    Off,
    /// A pixel's replicas (`sampler.replicas`) decide for one another, none for itself: unbiased.
    Folds,
    /// The very samples that are averaged, as classic assignments do it: biased, and of less
    /// confidence than it says.
    Course,
}

/// How the picture is developed for the screen: `post`.
#[derive(Resource, Clone, Debug, Default, PartialEq, Reflect)]
#[reflect(Default)]
pub struct PostSettings {
    /// Exposure in stops: the picture is multiplied by 2ˣ.
    pub exposure: f32,
    /// From linear light to the screen.
    pub tone_map: ToneMapName,
}

/// Tone maps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub enum ToneMapName {
    /// Clip at 1, sRGB curve.
    #[default]
    Srgb,
    /// AgX, base look.
    AgX,
    /// Khronos PBR Neutral.
    PbrNeutral,
}

/// How lights are chosen and rays are answered: `compile`.
#[derive(Resource, Clone, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub struct CompileSettings {
    /// Effort that goes into the acceleration structure. The picture does not depend on it.
    pub accel: AccelQuality,
    /// How a light is chosen among many.
    pub light_selection: LightSelectionName,
}

/// Effort of the BVH build.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub enum AccelQuality {
    /// For previews of large scenes.
    Fast,
    /// The best for most pictures.
    #[default]
    Balanced,
    /// For long renders.
    High,
}

/// How a light is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub enum LightSelectionName {
    /// Each light with the same probability.
    Uniform,
    /// In proportion to emitted power.
    Power,
    /// By what each light may bring to the point: power, distance and orientation, from a tree over
    /// all lights.
    #[default]
    Spatial,
    /// Every light at every surface.
    All,
}

/// The picture size that the scene file asks for, when it does.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default)]
pub struct SceneFilm {
    /// Width in pixels.
    pub width: Option<u32>,
    /// Height in pixels.
    pub height: Option<u32>,
}

impl FilmSettings {
    /// Width and height in pixels.
    pub fn size(&self, scene: SceneFilm) -> [u32; 2] {
        [
            self.width.or(scene.width).unwrap_or(480),
            self.height.or(scene.height).unwrap_or(360),
        ]
    }
}

pub(crate) fn register(world: &mut World) {
    world.init_resource::<FilmSettings>();
    world.init_resource::<SamplerSettings>();
    world.init_resource::<Budget>();
    world.init_resource::<AdaptiveSettings>();
    world.init_resource::<PostSettings>();
    world.init_resource::<CompileSettings>();
    world.init_resource::<SceneFilm>();
    let registry = world.resource::<AppTypeRegistry>().clone();
    let mut registry = registry.write();
    registry.register::<FilmSettings>();
    registry.register::<SamplerSettings>();
    registry.register::<Budget>();
    registry.register::<AdaptiveSettings>();
    registry.register::<PostSettings>();
    registry.register::<CompileSettings>();
    registry.register::<SceneFilm>();
}
