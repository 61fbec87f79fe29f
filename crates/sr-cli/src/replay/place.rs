//! Shapes, materials and lights by name, and where their files define them.

use serde::Serialize;
use sr_pipeline::bevy_ecs::prelude::{Entity, Name, World};
use sr_pipeline::{LightId, MaterialId, SealedScene, ShapeId};
use sr_scene::compile::SceneSources;
use sr_scene::components::SourceSpan;
use std::fmt;

/// Something with a name, and its place where that is known.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Place {
    pub name: String,
    /// File, line and column.
    pub at: Option<String>,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}`", self.name)?;
        match &self.at {
            Some(at) => write!(f, " ({at})"),
            None => Ok(()),
        }
    }
}

/// Looks names and places up in a compiled world.
pub struct Places<'a> {
    world: &'a World,
}

impl<'a> Places<'a> {
    pub fn new(world: &'a World) -> Self {
        Self { world }
    }

    pub fn shape(&self, id: ShapeId) -> Place {
        let name = self.scene().shape_name(id);
        self.place(self.sources().shape(id), name)
    }

    pub fn material(&self, id: MaterialId) -> Place {
        let name = &self.scene().material(id).name;
        self.place(self.sources().material(id), name)
    }

    /// Of a glowing mesh each primitive is a light; all have the mesh's name.
    pub fn light(&self, id: LightId) -> Place {
        self.place(self.sources().light(id), "white environment")
    }

    fn scene(&self) -> &SealedScene {
        self.world.resource::<SealedScene>()
    }

    fn sources(&self) -> &SceneSources {
        self.world.resource::<SceneSources>()
    }

    fn place(&self, entity: Option<Entity>, otherwise: &str) -> Place {
        let entity = entity.and_then(|e| self.world.get_entity(e).ok());
        let name = entity.and_then(|e| e.get::<Name>()).map(|n| n.as_str());
        let span = entity.and_then(|e| e.get::<SourceSpan>());
        Place {
            name: name.unwrap_or(otherwise).to_owned(),
            at: span.map(ToString::to_string),
        }
    }
}
