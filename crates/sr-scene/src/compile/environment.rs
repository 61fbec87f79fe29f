//! An environment as a light.

use crate::components::{Environment, EnvironmentImage, EnvironmentSampling, SourceSpan};
use crate::diagnostics::{Diagnostic, Diagnostics};
use bevy_ecs::prelude::*;
use glam::{DMat3, DMat4, DVec3, Mat3, Vec3};
use sr_render::light::{self, Light};

type Unread<'a> = (Option<&'a Name>, Option<&'a SourceSpan>, &'a Environment);

/// Refuses environments whose map nobody has read: those that a program made without `Load`.
pub(super) fn check_maps(
    unread: Query<Unread<'_>, Without<EnvironmentImage>>,
    mut diagnostics: ResMut<'_, Diagnostics>,
) -> Result {
    for (name, span, environment) in &unread {
        diagnostics.0.extend(without_map(name, span, environment));
    }
    Ok(diagnostics.check()?)
}

fn without_map(
    name: Option<&Name>,
    span: Option<&SourceSpan>,
    environment: &Environment,
) -> Option<Diagnostic> {
    let map = environment.map.as_ref()?;
    let message = format!("the map `{}` has not been read", map.display());
    let name = name.map_or("unnamed", |n| n.as_str());
    Some(
        Diagnostic::error(message)
            .at(span.cloned())
            .field(format!("entities.{name}.Environment.map"))
            .hint("`Load` reads it; a program can give the entity an `EnvironmentImage`"),
    )
}

/// The light of an environment whose entity is placed by `world`.
pub(super) fn environment_light(
    environment: &Environment,
    image: Option<&EnvironmentImage>,
    world: &DMat4,
) -> Light {
    let radiance = environment.radiance.to_vec() * environment.scale;
    match image {
        None => Light::Environment(light::ConstantEnvironment { radiance }),
        Some(image) => Light::ImageEnvironment(light::ImageEnvironment {
            map: image.0.clone(),
            to_map: to_map(environment, world),
            scale: radiance,
            sampling: match environment.sampling {
                EnvironmentSampling::Importance => light::EnvironmentSampling::Importance,
                EnvironmentSampling::Uniform => light::EnvironmentSampling::Uniform,
            },
        }),
    }
}

/// A white light from everywhere.
pub(super) fn white() -> Light {
    Light::Environment(light::ConstantEnvironment {
        radiance: Vec3::ONE,
    })
}

/// Directions of the world to those of the map: back through the transform, back through the
/// rotation, mirrored where the map is.
fn to_map(environment: &Environment, world: &DMat4) -> Mat3 {
    let back = DMat3::from_rotation_y(-environment.rotation_deg.to_radians());
    // u grows with x: a mirrored x is a mirrored u.
    let mirror = if environment.flip_u { -1.0 } else { 1.0 };
    let flip = DMat3::from_diagonal(DVec3::new(mirror, 1.0, 1.0));
    (flip * back * axes(world).transpose()).as_mat3()
}

/// The axes of a transform without scale and shear: +Y keeps its direction, then +Z as far as it can; +X
/// keeps its side. A transform that has no such axes turns nothing.
fn axes(world: &DMat4) -> DMat3 {
    let [x, y, z] = [world.x_axis, world.y_axis, world.z_axis].map(|a| a.truncate());
    let frame = || {
        let y = y.try_normalize()?;
        let z = z.reject_from_normalized(y).try_normalize()?;
        let right = y.cross(z);
        Some(DMat3::from_cols(right * right.dot(x).signum(), y, z))
    };
    frame().unwrap_or(DMat3::IDENTITY)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::components::LocalTransform;

    fn look(environment: &Environment, transform: &LocalTransform, d: [f64; 3]) -> [f64; 3] {
        let m = to_map(environment, &transform.to_matrix());
        let local = m.as_dmat3() * DVec3::from(d);
        // Whole numbers, but for the sine of whole turns.
        local.to_array().map(|x| (x * 1e6).round() / 1e6 + 0.0)
    }

    #[test]
    fn rotations_turn_the_map_and_a_flip_mirrors_it() {
        let plain = Environment::default();
        let still = LocalTransform::default();
        let d = [0.36, 0.48, -0.8];
        assert_eq!(look(&plain, &still, d), d);
        let flipped = Environment {
            flip_u: true,
            ..plain.clone()
        };
        assert_eq!(look(&flipped, &still, d), [-0.36, 0.48, -0.8]);
        // What was at −Z is found at −X: where the scene looks to −X, the map is asked for −Z.
        let turned = Environment {
            rotation_deg: 90.0,
            ..plain.clone()
        };
        assert_eq!(look(&turned, &still, [-1.0, 0.0, 0.0]), [0.0, 0.0, -1.0]);
        // The same by the transform, whatever its scale and place.
        let placed = LocalTransform {
            rotate_deg: [0.0, 90.0, 0.0],
            scale: [2.0, 3.0, 0.5],
            translate: [1.0, 2.0, 3.0],
            ..still.clone()
        };
        assert_eq!(look(&plain, &placed, d), look(&turned, &still, d));
        // Both: the map turns by 180 degrees.
        assert_eq!(look(&turned, &placed, d), [-0.36, 0.48, 0.8]);
        // A flip is of the map, before it is turned.
        let both = Environment {
            flip_u: true,
            ..turned
        };
        assert_eq!(look(&both, &still, [0.0, 0.0, -1.0]), [-1.0, 0.0, 0.0]);
    }

    #[test]
    fn transforms_that_tilt_mirror_or_collapse() {
        let plain = Environment::default();
        let tilted = LocalTransform {
            rotate_deg: [90.0, 0.0, 0.0],
            ..Default::default()
        };
        // The zenith has gone to +Z.
        assert_eq!(look(&plain, &tilted, [0.0, 0.0, 1.0]), [0.0, 1.0, 0.0]);
        let mirrored = LocalTransform {
            scale: [-1.0, 1.0, 1.0],
            ..Default::default()
        };
        assert_eq!(look(&plain, &mirrored, [1.0, 0.0, 0.0]), [-1.0, 0.0, 0.0]);
        let collapsed = LocalTransform {
            scale: [0.0; 3],
            ..Default::default()
        };
        let d = [0.36, 0.48, -0.8];
        assert_eq!(look(&plain, &collapsed, d), d);
    }
}
