//! What a scene is made of. One entity is one thing; what it is follows from its components.
//!
//! Components hold what the author wrote, in small types of their own; `Compile` converts.

mod camera;
mod light;
mod material;
mod placement;
mod provenance;
mod shape;

pub use camera::{ActiveCamera, Focus, Orthographic, PerspectiveCamera, ThinLens};
pub use light::{
    DirectionalLight, Environment, EnvironmentImage, EnvironmentSampling, PointLight, SpotLight,
};
pub use material::{
    Conductor, Dielectric, Emission, FacetSampling, Fresnel, Lambert, MaterialRef, MetalFresnel,
    MetallicRoughness, Mirror, Ndf, OrenNayar, Refraction, RoughDielectric, ThinDielectric,
};
pub use placement::{LocalTransform, LookAt, WorldTransform};
pub use provenance::SourceSpan;
pub use shape::{IsShape, Quad, Sphere, TriangleMesh};

use crate::lobes::register_lobe;
use bevy_ecs::prelude::*;
use bevy_ecs::reflect::AppTypeRegistry;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;

/// A linear Rec. 709 colour or RGB triple; in RON `(0.6, 0.2, 0.2)`, or `0.6` for a grey.
#[derive(Clone, Copy, Debug, Default, PartialEq, Reflect)]
#[reflect(Default)]
pub struct Rgb(pub [f32; 3]);

impl Rgb {
    /// The same number in each channel.
    pub const fn splat(x: f32) -> Self {
        Self([x; 3])
    }

    /// For kernels.
    pub const fn to_vec(self) -> glam::Vec3 {
        glam::Vec3::from_array(self.0)
    }

    /// All channels are finite and in `[lo, hi]`.
    pub fn within(self, lo: f32, hi: f32) -> bool {
        self.0.iter().all(|c| (lo..=hi).contains(c))
    }
}

pub(crate) fn register(world: &mut World) {
    {
        let registry = world.resource::<AppTypeRegistry>().clone();
        let mut registry = registry.write();
        registry.register::<Rgb>();
        registry.register::<LocalTransform>();
        registry.register::<LookAt>();
        registry.register::<ChildOf>();
        registry.register::<TriangleMesh>();
        registry.register::<Sphere>();
        registry.register::<Quad>();
        registry.register::<MaterialRef>();
        registry.register::<Emission>();
        registry.register::<PointLight>();
        registry.register::<SpotLight>();
        registry.register::<DirectionalLight>();
        registry.register::<Environment>();
        registry.register::<PerspectiveCamera>();
        registry.register::<Orthographic>();
        registry.register::<ThinLens>();
        registry.register::<Focus>();
        registry.register::<ActiveCamera>();
    }
    register_lobe::<Lambert>(world);
    register_lobe::<OrenNayar>(world);
    register_lobe::<Mirror>(world);
    register_lobe::<Refraction>(world);
    register_lobe::<Dielectric>(world);
    register_lobe::<ThinDielectric>(world);
    register_lobe::<Conductor>(world);
    register_lobe::<RoughDielectric>(world);
    register_lobe::<MetallicRoughness>(world);
}
