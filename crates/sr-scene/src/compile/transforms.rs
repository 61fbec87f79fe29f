//! World transforms, in f64: the hierarchy may sit far from the origin.

use crate::components::{LocalTransform, LookAt, SourceSpan, WorldTransform};
use crate::diagnostics::{Diagnostic, Diagnostics};
use bevy_ecs::prelude::*;
use glam::DMat4;

type Placement<'a> = (
    Option<&'a LocalTransform>,
    Option<&'a LookAt>,
    Option<&'a ChildOf>,
    Option<&'a Children>,
    Option<&'a SourceSpan>,
);

/// Multiplies transforms from the roots down.
pub(super) fn propagate_transforms(
    nodes: Query<(Entity, Placement<'_>)>,
    mut commands: Commands<'_, '_>,
    mut diagnostics: ResMut<'_, Diagnostics>,
) -> Result {
    // An explicit stack: model files decide how deep the hierarchy is.
    let mut stack: Vec<(Entity, DMat4)> = nodes
        .iter()
        .filter(|(_, (_, _, parent, _, _))| parent.is_none())
        .map(|(entity, _)| (entity, DMat4::IDENTITY))
        .collect();
    while let Some((entity, parent)) = stack.pop() {
        let Ok((_, placement)) = nodes.get(entity) else {
            continue;
        };
        let (_, _, _, children, span) = placement;
        let world = match local_matrix(&placement) {
            Some(local) => parent * local,
            None => {
                let message = "`from`, `to` and `up` do not span a frame";
                diagnostics.push(
                    Diagnostic::error(message)
                        .at(span.cloned())
                        .field("LookAt")
                        .hint("`to` must differ from `from`, and `up` from the view direction"),
                );
                parent
            }
        };
        if !world.is_finite() {
            diagnostics.push(
                Diagnostic::error("the world transform is not finite")
                    .at(span.cloned())
                    .field("LocalTransform"),
            );
        }
        commands.entity(entity).insert(WorldTransform(world));
        for child in children.into_iter().flatten() {
            stack.push((*child, world));
        }
    }
    Ok(diagnostics.check()?)
}

fn local_matrix((local, look_at, ..): &Placement<'_>) -> Option<DMat4> {
    match (look_at, local) {
        (Some(look_at), _) => look_at.to_matrix(),
        (None, Some(local)) => Some(local.to_matrix()),
        (None, None) => Some(DMat4::IDENTITY),
    }
}
