//! Whole runs of `Load` over files in a folder of their own.

mod errors;
mod files;
mod maps;
mod materials;
mod models;
mod overrides;
mod resolved;
mod scenes;

use crate::load::{LoadRequest, Override};
use bevy_ecs::prelude::*;
use bevy_ecs::reflect::AppTypeRegistry;
use bevy_reflect::Reflect;
use bevy_reflect::std_traits::ReflectDefault;
use sr_scene::diagnostics::Diagnostics;
use sr_scene::integrator::{IntegratorCatalog, IntegratorInfo, SelectedIntegrator};
use sr_scene::schedule::Load;
use std::any::TypeId;
use tempfile::TempDir;

#[derive(Reflect, Clone, Debug, Default, PartialEq)]
#[reflect(Default)]
struct PathSettings {
    max_depth: Option<u32>,
}

#[derive(Reflect, Clone, Debug, Default, PartialEq)]
#[reflect(Default)]
enum Strategy {
    #[default]
    Mis,
    Light,
}

#[derive(Reflect, Clone, Debug, Default, PartialEq)]
#[reflect(Default)]
struct DirectSettings {
    strategy: Strategy,
    lights: u32,
}

fn new_world() -> World {
    let mut world = World::new();
    sr_scene::install(&mut world);
    crate::install(&mut world);
    {
        let types = world.resource::<AppTypeRegistry>().clone();
        let mut types = types.write();
        types.register::<PathSettings>();
        types.register::<DirectSettings>();
    }
    let catalog = &mut world.resource_mut::<IntegratorCatalog>().0;
    for (name, settings) in [
        ("Path", TypeId::of::<PathSettings>()),
        ("Direct", TypeId::of::<DirectSettings>()),
    ] {
        let summary = "for tests";
        catalog.insert(name, IntegratorInfo { settings, summary });
    }
    world
}

/// A world after `Load`, with all that was said.
struct Loaded {
    world: World,
    ok: bool,
    said: Vec<String>,
    _folder: TempDir,
}

/// Writes files, loads the first, with `path=value` given as `--set`.
fn load(files: &[(&str, &str)], sets: &[&str]) -> Loaded {
    load_bytes(
        &files
            .iter()
            .map(|(n, t)| (*n, t.as_bytes()))
            .collect::<Vec<_>>(),
        sets,
    )
}

fn load_bytes(files: &[(&str, &[u8])], sets: &[&str]) -> Loaded {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, bytes) in files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().expect("inside the folder")).expect("a folder");
        std::fs::write(path, bytes).expect("written");
    }
    let mut world = new_world();
    world.insert_resource(LoadRequest {
        path: folder.path().join(files[0].0),
        overrides: sets.iter().map(|s| set(s)).collect(),
        ..Default::default()
    });
    let ok = sr_scene::stage::run(&mut world, Load).is_ok();
    let prefix = format!("{}{}", folder.path().display(), std::path::MAIN_SEPARATOR);
    let said = world.resource::<Diagnostics>().0.iter();
    let said = said.map(|d| d.to_string().replace(&prefix, "")).collect();
    Loaded {
        world,
        ok,
        said,
        _folder: folder,
    }
}

fn set(text: &str) -> Override {
    let (path, value) = text.split_once('=').expect("path=value");
    Override {
        path: path.into(),
        value: value.into(),
        origin: "--set".into(),
    }
}

impl Loaded {
    /// Expects that nothing was said.
    fn clean(self) -> Self {
        assert!(self.ok && self.said.is_empty(), "{:#?}", self.said);
        self
    }

    fn entity(&mut self, name: &str) -> Entity {
        let mut names = self.world.query::<(Entity, &Name)>();
        let mut found = names
            .iter(&self.world)
            .filter(|(_, n)| n.as_str() == name)
            .map(|(e, _)| e);
        let entity = found.next().unwrap_or_else(|| panic!("no `{name}`"));
        assert!(found.next().is_none(), "two `{name}`");
        entity
    }

    fn get<C: Component + Clone>(&mut self, name: &str) -> C {
        let entity = self.entity(name);
        let component = self.world.get::<C>(entity);
        component
            .unwrap_or_else(|| panic!("`{name}` lacks it"))
            .clone()
    }

    fn has<C: Component>(&mut self, name: &str) -> bool {
        let entity = self.entity(name);
        self.world.get::<C>(entity).is_some()
    }

    fn resource<R: Resource + Clone>(&self) -> R {
        self.world.resource::<R>().clone()
    }

    fn settings<S: Reflect + Clone>(&self) -> S {
        let selected = self.world.resource::<SelectedIntegrator>();
        selected.settings::<S>().expect("these settings").clone()
    }
}
