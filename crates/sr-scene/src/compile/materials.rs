//! Materials that shapes refer to become a table.

use crate::components::{Emission, IsShape, MaterialRef, SourceSpan};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::lobes::LobeCatalog;
use bevy_ecs::prelude::*;
use glam::Vec3;
use sr_render::bsdf::{Bsdf, Lambert};
use sr_render::{Material, MaterialId};
use std::collections::HashMap;

/// The table, and how entities address it.
#[derive(Resource, Default)]
pub(super) struct MaterialTable {
    pub materials: Vec<Material>,
    /// What each material gives off, and whether on both sides; unset when it is dark.
    pub emission: Vec<Option<(Vec3, bool)>>,
    /// The entity of each; unset for the default.
    pub entities: Vec<Option<Entity>>,
    ids: HashMap<Entity, MaterialId>,
}

impl MaterialTable {
    /// The id of a material entity, or of the default for shapes without one.
    pub fn id(&self, material: Option<&MaterialRef>) -> MaterialId {
        material
            .and_then(|m| self.ids.get(&m.0).copied())
            .unwrap_or(MaterialId(0))
    }
}

/// Converts each material that a shape refers to; others are left out.
pub(super) fn collect_materials(world: &mut World) -> Result {
    let mut shapes = world.query_filtered::<(Entity, Option<&MaterialRef>), IsShape>();
    let mut used: Vec<Entity> = Vec::new();
    let mut bare = 0usize;
    for (_, material) in shapes.iter(world) {
        match material {
            Some(m) => used.push(m.0),
            None => bare += 1,
        }
    }
    used.sort_unstable();
    used.dedup();
    let mut table = MaterialTable::default();
    // Index 0: what a shape without material gets.
    table.materials.push(Material {
        bsdf: Bsdf::Lambert(Lambert {
            reflectance: Vec3::splat(0.5),
        }),
        name: "default".into(),
    });
    table.emission.push(None);
    table.entities.push(None);
    let mut problems = Vec::new();
    if bare > 0 {
        problems.push(without_material(bare));
    }
    for entity in used {
        match convert(world, entity) {
            Ok((material, emission)) => {
                let id = MaterialId(table.materials.len() as u32);
                table.ids.insert(entity, id);
                table.materials.push(material);
                table.emission.push(emission);
                table.entities.push(Some(entity));
            }
            Err(problem) => problems.push(problem),
        }
    }
    let mut diagnostics = world.resource_mut::<Diagnostics>();
    problems.into_iter().for_each(|p| diagnostics.push(p));
    diagnostics.check()?;
    world.insert_resource(table);
    Ok(())
}

fn without_material(shapes: usize) -> Diagnostic {
    let (message, hint) = if shapes == 1 {
        let message = "1 shape has no material and gets a grey Lambert".to_owned();
        (message, "give it a `MaterialRef`")
    } else {
        let message = format!("{shapes} shapes have no material and get a grey Lambert");
        (message, "give them a `MaterialRef`")
    };
    Diagnostic::notice(message).hint(hint)
}

type Converted = (Material, Option<(Vec3, bool)>);

fn convert(world: &World, entity: Entity) -> Result<Converted, Diagnostic> {
    let Ok(entity) = world.get_entity(entity) else {
        return Err(Diagnostic::error(
            "a MaterialRef points to an entity that is gone",
        ));
    };
    let name = entity.get::<Name>().map_or("unnamed", |n| n.as_str());
    let fail = |field: &str, message: String| {
        Err(Diagnostic::error(message)
            .at(entity.get::<SourceSpan>().cloned())
            .field(format!("entities.{name}{field}")))
    };
    let mut lobes: Vec<_> = world.resource::<LobeCatalog>().of(entity).collect();
    let [(lobe, bsdf)] = lobes.as_mut_slice() else {
        return fail(
            "",
            format!(
                "a material has exactly one lobe, this one has {}",
                lobes.len()
            ),
        );
    };
    let bsdf = match bsdf {
        Ok(bsdf) => bsdf.clone(),
        Err(message) => return fail(&format!(".{lobe}"), message.clone()),
    };
    let emission = match entity.get::<Emission>() {
        None => None,
        Some(e) => {
            let radiance = e.radiance.to_vec() * e.strength;
            if !(radiance.is_finite() && radiance.cmpge(Vec3::ZERO).all()) {
                return fail(
                    ".Emission",
                    "radiance must be finite and not negative".into(),
                );
            }
            (radiance != Vec3::ZERO).then_some((radiance, e.two_sided))
        }
    };
    Ok((
        Material {
            bsdf,
            name: name.to_owned(),
        },
        emission,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_shape_and_several_are_told_in_their_grammar() {
        assert_eq!(
            without_material(1).to_string(),
            "notice: 1 shape has no material and gets a grey Lambert; give it a `MaterialRef`"
        );
        assert_eq!(
            without_material(2).to_string(),
            "notice: 2 shapes have no material and get a grey Lambert; give them a `MaterialRef`"
        );
    }
}
