//! The camera and the origin of render space.

use super::geometry::world_bounds;
use crate::components::{
    ActiveCamera, Orthographic, PerspectiveCamera, Quad, Sphere, TriangleMesh, WorldTransform,
};
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::settings::{FilmSettings, SceneFilm};
use bevy_ecs::prelude::*;
use glam::{DMat4, DVec2, DVec3, Vec2};
use sr_render::{Camera, Projection};

/// Where render space is, and the camera in it.
#[derive(Resource, Clone, Copy)]
pub(super) struct RenderSpace {
    /// World position of the origin.
    pub origin: DVec3,
    /// The camera at the origin.
    pub camera: Camera,
    /// Whose camera it is; unset when the scene has none.
    pub entity: Option<Entity>,
}

impl RenderSpace {
    fn of(self, entity: Entity) -> Self {
        Self {
            entity: Some(entity),
            ..self
        }
    }
}

type View<'a> = (
    Entity,
    &'a WorldTransform,
    Option<&'a PerspectiveCamera>,
    Option<&'a Orthographic>,
);

type Shapes<'a> = (
    &'a WorldTransform,
    Option<&'a TriangleMesh>,
    Option<&'a Sphere>,
    Option<&'a Quad>,
);

/// Places render space at the active camera, or frames the scene when there is none.
pub(super) fn place_camera(
    cameras: Query<View<'_>, With<ActiveCamera>>,
    shapes: Query<Shapes<'_>>,
    film: Res<'_, FilmSettings>,
    scene_film: Res<'_, SceneFilm>,
    mut diagnostics: ResMut<'_, Diagnostics>,
    mut commands: Commands<'_, '_>,
) {
    let size = film.size(*scene_film).map(f64::from);
    let size = DVec2::from_array(size);
    let space = match cameras.iter().next() {
        Some((entity, world, _, Some(view))) => {
            render_space(world.0, orthographic(view, size), size).of(entity)
        }
        Some((entity, world, view, None)) => {
            let view = view.cloned().unwrap_or_default();
            render_space(world.0, perspective(&view, size), size).of(entity)
        }
        None => {
            diagnostics.push(
                Diagnostic::notice("the scene has no camera, so it is framed from the front")
                    .hint("add an entity with `PerspectiveCamera` and `LookAt`"),
            );
            frame_scene(&shapes, size)
        }
    };
    commands.insert_resource(space);
}

/// Half the angle that a camera gets when nothing says otherwise: 40° across the picture.
const DEFAULT_HFOV_DEG: f64 = 40.0;

fn perspective(view: &PerspectiveCamera, size: DVec2) -> Projection {
    let tan = |deg: f64| (0.5 * deg).to_radians().tan();
    let tan_half = match (view.hfov_deg, view.vfov_deg) {
        (None, Some(v)) => DVec2::new(tan(v) * size.x / size.y, tan(v)),
        (h, _) => {
            let x = tan(h.unwrap_or(DEFAULT_HFOV_DEG));
            DVec2::new(x, x * size.y / size.x)
        }
    };
    Projection::Perspective {
        tan_half: tan_half.as_vec2(),
    }
}

fn orthographic(view: &Orthographic, size: DVec2) -> Projection {
    let half = match (view.width, view.height) {
        (None, Some(h)) => DVec2::new(h * size.x / size.y, h),
        (w, _) => {
            let w = w.unwrap_or(2.0);
            DVec2::new(w, w * size.y / size.x)
        }
    };
    Projection::Orthographic {
        half: (0.5 * half).as_vec2(),
    }
}

fn render_space(camera: DMat4, projection: Projection, size: DVec2) -> RenderSpace {
    // A scaled or sheared node still has a view direction and an upwards.
    let back = camera.z_axis.truncate().normalize_or(DVec3::Z);
    let right = camera.y_axis.truncate().cross(back).normalize_or(DVec3::X);
    RenderSpace {
        origin: camera.w_axis.truncate(),
        camera: Camera {
            projection,
            right: right.as_vec3(),
            up: back.cross(right).as_vec3(),
            back: back.as_vec3(),
            size: Vec2::new(size.x as f32, size.y as f32),
            lens: None,
        },
        entity: None,
    }
}

/// Looks along −Z at everything, with the bounding sphere inside the picture.
fn frame_scene(shapes: &Query<Shapes<'_>>, size: DVec2) -> RenderSpace {
    let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for (world, mesh, sphere, quad) in shapes {
        if let Some((lo, hi)) = world_bounds(&world.0, mesh, sphere, quad) {
            (min, max) = (min.min(lo), max.max(hi));
        }
    }
    let (center, radius) = if min.x <= max.x {
        (
            0.5 * (min + max),
            (0.5 * (max - min).length()).max(f64::MIN_POSITIVE),
        )
    } else {
        (DVec3::ZERO, 1.0)
    };
    let projection = perspective(&PerspectiveCamera::default(), size);
    let half_angle_sin = match projection {
        Projection::Perspective { tan_half } => f64::from(tan_half.min_element()).atan().sin(),
        Projection::Orthographic { .. } => 1.0,
    };
    let eye = center + DVec3::Z * (radius / half_angle_sin);
    render_space(DMat4::from_translation(eye), projection, size)
}
