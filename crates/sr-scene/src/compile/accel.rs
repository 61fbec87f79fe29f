//! The acceleration structure.

use super::geometry::GeometryTables;
use crate::settings::{AccelQuality, CompileSettings};
use bevy_ecs::prelude::*;
use sr_render::accel::{Accel, BuildSettings, Quality};

/// The built structure, which now owns the geometry.
#[derive(Resource)]
pub(super) struct AccelTable(pub Accel);

/// Builds over all primitives.
pub(super) fn build_accel(
    mut tables: ResMut<'_, GeometryTables>,
    settings: Res<'_, CompileSettings>,
    mut commands: Commands<'_, '_>,
) {
    let quality = match settings.accel {
        AccelQuality::Fast => Quality::Fast,
        AccelQuality::Balanced => Quality::Balanced,
        AccelQuality::High => Quality::High,
    };
    let geometry = std::mem::take(&mut tables.geometry);
    let accel = Accel::build(geometry, &BuildSettings { quality });
    commands.insert_resource(AccelTable(accel));
}
