//! Closed rooms around the camera, as scenes.

use crate::Bench;
use sr_pipeline::bevy_ecs::prelude::World;
use sr_pipeline::glam::{DMat3, DVec3, Vec3};
use sr_pipeline::{Pipeline, SealedScene};
use std::fmt::Write;

/// What a room is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Walls {
    /// A box of triangles, a few on each wall.
    Mesh,
    /// The same twice, face on face.
    Doubled,
    /// A box of six quads.
    Quads,
    /// A sphere.
    Sphere,
}

/// A room from −1 to 1 on each local axis, in its place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    pub walls: Walls,
    /// Along the local axes; may be negative.
    pub scale: DVec3,
    /// World position of its middle.
    pub place: DVec3,
}

/// Where the camera is, in coordinates of the room.
const EYE: DVec3 = DVec3::new(0.1, 0.2, 0.3);
/// How the room lies in the world, in degrees about x, then y, then z: no wall lies in an axis plane.
const TURN: DVec3 = DVec3::new(20.0, 30.0, 10.0);
/// Cells along a wall of [`Walls::Mesh`].
const CELLS: u32 = 3;

impl Room {
    pub fn new(walls: Walls) -> Self {
        Self {
            walls,
            scale: DVec3::ONE,
            place: DVec3::ZERO,
        }
    }

    /// The compiled scene, in the pipeline that owns it.
    pub fn compiled(&self) -> Result<Pipeline, String> {
        Bench::new(1).scene(&self.text("\"Lambert\": (reflectance: 0.5)"), &[])
    }

    /// Place, room and camera; the walls are of the material.
    pub fn text(&self, material: &str) -> String {
        let DVec3 { x, y, z } = self.place;
        let [tx, ty, tz] = TURN.to_array();
        let [sx, sy, sz] = self.scale.to_array();
        let [ex, ey, ez] = EYE.to_array();
        format!(
            "(film: (width: 16, height: 16), entities: {{\"wall\": {{{material}}},\
             \"place\": {{\"LocalTransform\": (translate: ({x:?}, {y:?}, {z:?}), rotate_deg: ({tx:?}, {ty:?}, {tz:?}), \
             scale: ({sx:?}, {sy:?}, {sz:?}))}}, {}\
             \"camera\": {{\"PerspectiveCamera\": (vfov_deg: 90), \"LocalTransform\": (translate: ({ex:?}, {ey:?}, {ez:?})), \
             \"ChildOf\": \"place\", \"ActiveCamera\": ()}}}})",
            self.shapes()
        )
    }

    fn shapes(&self) -> String {
        let shape = |name: &str, rest: String| {
            format!("\"{name}\": {{{rest}, \"MaterialRef\": \"wall\", \"ChildOf\": \"place\"}},")
        };
        match self.walls {
            Walls::Sphere => shape("room", "\"Sphere\": (radius: 1)".into()),
            Walls::Mesh => shape("room", mesh()),
            Walls::Doubled => shape("room", mesh()) + &shape("again", mesh()),
            Walls::Quads => {
                let quad = |name, at, turn| {
                    let placed = format!(
                        "\"Quad\": (width: 2, height: 2), \"LocalTransform\": (translate: {at}, rotate_deg: {turn})"
                    );
                    shape(name, placed)
                };
                [
                    quad("left", "(-1, 0, 0)", "(0, 90, 0)"),
                    quad("right", "(1, 0, 0)", "(0, -90, 0)"),
                    quad("floor", "(0, -1, 0)", "(-90, 0, 0)"),
                    quad("ceiling", "(0, 1, 0)", "(90, 0, 0)"),
                    quad("back", "(0, 0, -1)", "(0, 0, 0)"),
                    quad("front", "(0, 0, 1)", "(180, 0, 0)"),
                ]
                .concat()
            }
        }
    }

    fn turn() -> DMat3 {
        let [x, y, z] = TURN.to_array().map(f64::to_radians);
        DMat3::from_rotation_z(z) * DMat3::from_rotation_y(y) * DMat3::from_rotation_x(x)
    }

    /// A point of render space in coordinates of the room.
    pub fn local(&self, p: Vec3) -> DVec3 {
        Self::turn().transpose() * p.as_dvec3() / self.scale + EYE
    }

    /// A point or direction of the room in render space, less the camera's place.
    pub fn world(&self, v: DVec3) -> DVec3 {
        Self::turn() * (v * self.scale)
    }
}

/// The sealed scene of a pipeline that has compiled.
pub(super) fn sealed(world: &World) -> &SealedScene {
    world.resource::<SealedScene>()
}

/// Six walls of [`CELLS`]² cells, two triangles each.
fn mesh() -> String {
    let (mut positions, mut indices) = (String::new(), String::new());
    let at = |i: u32| -1.0 + 2.0 * f64::from(i) / f64::from(CELLS);
    let mut base = 0;
    for (axis, side) in (0..3).flat_map(|axis| [(axis, -1.0), (axis, 1.0)]) {
        for (i, j) in (0..=CELLS).flat_map(|i| (0..=CELLS).map(move |j| (i, j))) {
            let mut p = [0.0; 3];
            p[axis] = side;
            p[(axis + 1) % 3] = at(i);
            p[(axis + 2) % 3] = at(j);
            let _ = write!(positions, "({:?}, {:?}, {:?}),", p[0], p[1], p[2]);
        }
        for (i, j) in (0..CELLS).flat_map(|i| (0..CELLS).map(move |j| (i, j))) {
            let a = base + i * (CELLS + 1) + j;
            let [b, c, d] = [a + CELLS + 1, a + CELLS + 2, a + 1];
            let _ = write!(indices, "({a}, {b}, {c}), ({a}, {c}, {d}),");
        }
        base += (CELLS + 1) * (CELLS + 1);
    }
    format!("\"TriangleMesh\": (positions: [{positions}], indices: [{indices}])")
}
