//! The acceleration structure.

use super::geometry::GeometryTables;
use crate::diagnostics::{Diagnostic, Diagnostics};
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
    mut diagnostics: ResMut<'_, Diagnostics>,
    mut commands: Commands<'_, '_>,
) {
    let quality = match settings.accel {
        AccelQuality::Fast => Quality::Fast,
        AccelQuality::Balanced => Quality::Balanced,
        AccelQuality::High => Quality::High,
    };
    let geometry = std::mem::take(&mut tables.geometry);
    let accel = Accel::build(geometry, &BuildSettings { quality });
    let lost = accel.report().left_out_degenerate + accel.report().left_out_non_finite;
    if lost > 0 {
        let message = format!("{lost} primitives have no area and are left out");
        diagnostics.push(Diagnostic::warning(message));
    }
    commands.insert_resource(AccelTable(accel));
}
