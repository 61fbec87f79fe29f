//! The lens, focused on what its author named.

use super::accel::AccelTable;
use super::camera::RenderSpace;
use super::geometry::world_bounds;
use crate::components::{Focus, Quad, SourceSpan, Sphere, ThinLens, TriangleMesh, WorldTransform};
use crate::diagnostics::{Diagnostic, Diagnostics};
use bevy_ecs::prelude::*;
use glam::{DVec3, Vec2};
use sr_render::accel::Accel;
use sr_render::{Aperture, Lens};
use std::collections::HashSet;

/// The field, what is wrong with it, and advice.
type Problem = (&'static str, String, &'static str);

type Thing<'a> = (
    &'a WorldTransform,
    Option<&'a TriangleMesh>,
    Option<&'a Sphere>,
    Option<&'a Quad>,
    Option<&'a Children>,
    Option<&'a Name>,
);

/// Gives the camera its lens. An aperture of radius 0 leaves the pinhole.
pub(super) fn focus_lens(
    lenses: Query<(&ThinLens, Option<&SourceSpan>)>,
    things: Query<Thing<'_>>,
    accel: Res<'_, AccelTable>,
    mut space: ResMut<'_, RenderSpace>,
    mut diagnostics: ResMut<'_, Diagnostics>,
) -> Result {
    let found = space.entity.and_then(|e| lenses.get(e).ok());
    let Some((lens, span)) = found.filter(|(lens, _)| lens.aperture_radius != 0.0) else {
        return Ok(());
    };
    match focus_distance(lens, &space, &accel.0, &things).and_then(|focus| build(lens, focus)) {
        Ok(lens) => space.camera.lens = Some(lens),
        Err((field, message, hint)) => diagnostics.push(
            Diagnostic::error(message)
                .at(span.cloned())
                .field(format!("camera.ThinLens.{field}"))
                .hint(hint),
        ),
    }
    Ok(diagnostics.check()?)
}

fn build(lens: &ThinLens, focus: f64) -> Result<Lens, Problem> {
    let radius = lens.aperture_radius;
    let aperture = match lens.blades {
        0 => Aperture::Round,
        1 | 2 => {
            let message = format!("{} corners make no polygon", lens.blades);
            return Err(("blades", message, "3 or more make one, 0 is round"));
        }
        corners => Aperture::polygon(corners, lens.rotation_deg),
    };
    Lens::new(radius, focus, aperture).ok_or_else(|| {
        let message = format!("f32 cannot hold a radius of {radius} m focused at {focus} m");
        let hint = "the radius must be above 0, and at most 8388608 times the distance";
        ("aperture_radius", message, hint)
    })
}

/// Distance of the plane of focus along the view axis.
fn focus_distance(
    lens: &ThinLens,
    space: &RenderSpace,
    accel: &Accel,
    things: &Query<Thing<'_>>,
) -> Result<f64, Problem> {
    match (lens.focus_distance, lens.focus) {
        (Some(distance), None) => Ok(distance),
        (None, Some(Focus::Entity(entity))) => depth_of(entity, space, things),
        (None, Some(Focus::At(pixel))) => depth_at(pixel, space, accel),
        (None, None) => {
            let message = "an aperture needs something to be in focus".to_owned();
            Err(("focus", message, "give `focus_distance`, or `focus`"))
        }
        (Some(_), Some(_)) => {
            let message = "`focus` and `focus_distance` are both given".to_owned();
            Err(("focus", message, "keep one"))
        }
    }
}

/// Depth of the middle of an entity's bounds, those of its children included.
fn depth_of(
    entity: Entity,
    space: &RenderSpace,
    things: &Query<Thing<'_>>,
) -> Result<f64, Problem> {
    let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (mut seen, mut stack) = (HashSet::from([entity]), vec![entity]);
    while let Some(next) = stack.pop() {
        let Ok((world, mesh, sphere, quad, children, _)) = things.get(next) else {
            continue;
        };
        if let Some((lo, hi)) = world_bounds(&world.0, mesh, sphere, quad) {
            (min, max) = (min.min(lo), max.max(hi));
        }
        let children = children.into_iter().flatten().copied();
        stack.extend(children.filter(|c| seen.insert(*c)));
    }
    let thing = things.get(entity);
    let middle = if min.x <= max.x {
        0.5 * (min + max)
    } else {
        thing.map_or(DVec3::NAN, |t| t.0.0.w_axis.truncate())
    };
    let depth = (space.origin - middle).dot(space.camera.back.as_dvec3());
    if depth > 0.0 {
        return Ok(depth);
    }
    let name = thing.ok().and_then(|t| t.5);
    let name = name.map_or("the entity", |n| n.as_str());
    let message = format!("the middle of `{name}` is not in front of the camera, but at {depth} m");
    Err(("focus", message, "name something that the camera looks at"))
}

/// Depth of what the pinhole sees first through the centre of a pixel.
fn depth_at([x, y]: [u32; 2], space: &RenderSpace, accel: &Accel) -> Result<f64, Problem> {
    let camera = &space.camera;
    let [width, height] = camera.size.to_array();
    let center = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
    if !center.cmplt(camera.size).all() {
        let message = format!("pixel ({x}, {y}) lies outside of the picture");
        let hint = "pixels count from (0, 0) at the top left; the picture's size may have been \
                    changed";
        return Err(("focus", format!("{message}, {width} × {height}"), hint));
    }
    let ray = camera.ray(center);
    let hit = accel.closest_one(&ray);
    if !hit.is_hit() {
        let message = format!("the ray through pixel ({x}, {y}) meets nothing");
        return Err(("focus", message, "choose a pixel that shows a surface"));
    }
    Ok(f64::from(camera.depth(ray.o + ray.d * hit.t)))
}
