//! The maps of environments are read.

use super::super::parse::nearest_file;
use super::super::session::Session;
use super::complaint;
use bevy_ecs::prelude::*;
use sr_render::film::{ImageError, read_image};
use sr_render::light::{BadTexels, EnvironmentMap, clamp_negative};
use sr_scene::components::{Environment, EnvironmentImage};
use sr_scene::diagnostics::Diagnostic;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A map, and what had to be changed in it; or why there is none, with advice.
type Read = Result<(Arc<EnvironmentMap>, Option<BadTexels>), (String, Option<String>)>;

impl Session<'_> {
    /// Gives each environment the map that it names. A file is read once, whoever names it.
    pub(super) fn read_maps(&mut self) {
        let mut query = self.world.query::<(Entity, &Environment)>();
        let named = query.iter(self.world).filter_map(|(entity, environment)| {
            Some((entity, environment.map.clone()?, environment.clone()))
        });
        let mut named: Vec<(Entity, PathBuf, Environment)> = named.collect();
        named.sort_unstable_by_key(|(entity, ..)| entity.index());
        let mut files: HashMap<PathBuf, Read> = HashMap::new();
        for (entity, path, environment) in named {
            let field = format!("{}.Environment.map", self.names.path(entity));
            if self.places.is_faulty(&field) {
                continue;
            }
            let file = path.canonicalize().unwrap_or_else(|_| path.clone());
            let is_new = !files.contains_key(&file);
            let report = |diagnostic: Diagnostic, session: &mut Self| {
                let place = session.place(entity, ".Environment.map");
                let diagnostic = diagnostic.at(place).field(field.clone());
                session.diagnostics.push(diagnostic);
            };
            match files.entry(file).or_insert_with(|| read_map(&path)) {
                Ok((map, clamped)) => {
                    if let (Some(bad), true) = (clamped, is_new) {
                        let message =
                            format!("`{}`: {bad} negative and taken for 0", path.display());
                        report(Diagnostic::warning(message), self);
                    }
                    let map = map.clone();
                    self.check_brightness(entity, &environment, &map);
                    self.world.entity_mut(entity).insert(EnvironmentImage(map));
                }
                Err((message, hint)) => {
                    let mut diagnostic =
                        Diagnostic::error(format!("`{}`: {message}", path.display()));
                    diagnostic.hint.clone_from(hint);
                    report(diagnostic, self);
                }
            }
        }
    }

    /// The brightest texel must be a number after all factors.
    fn check_brightness(
        &mut self,
        entity: Entity,
        environment: &Environment,
        map: &EnvironmentMap,
    ) {
        let factor = environment.radiance.to_vec().max_element() * environment.scale;
        // Factors that are themselves out of range are told where they stand.
        if factor.is_finite() && factor * map.brightest() > EnvironmentMap::BRIGHTEST {
            let message = format!(
                "{factor} times the map's brightest texel, {}, is too large",
                map.brightest()
            );
            self.invalid(entity, ".Environment.scale", complaint(message));
        }
    }
}

fn read_map(path: &Path) -> Read {
    let image = read_image(path).map_err(|error| match error {
        ImageError::Io { source, .. } if source.kind() == std::io::ErrorKind::NotFound => {
            let near = nearest_file(path);
            let hint = near.map(|near| format!("did you mean `{}`?", near.display()));
            ("there is no such file".to_owned(), hint)
        }
        ImageError::Io { source, .. } => (format!("cannot be read: {source}"), None),
        ImageError::Format { message, .. } => (message, None),
    })?;
    let (width, height) = (image.width, image.height);
    let mut rgb = image.pixels;
    let clamped = clamp_negative(width, &mut rgb);
    let map = EnvironmentMap::new(width, height, rgb).map_err(|e| (e.to_string(), None))?;
    Ok((Arc::new(map), clamped))
}
