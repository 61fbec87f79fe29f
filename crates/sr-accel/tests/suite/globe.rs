//! A closed bumpy sphere by latitude and longitude, needles at the poles included.

use glam::Vec3;
use sr_accel::Geometry;

/// `2 · columns · (rows − 1)` triangles around the origin, of radius about 1, seen
/// counter-clockwise from outside.
pub fn globe(rows: u32, columns: u32) -> Geometry {
    let mut g = Geometry::default();
    let point = |row: u32, column: u32| {
        let theta = std::f32::consts::PI * row as f32 / rows as f32;
        let phi = std::f32::consts::TAU * column as f32 / columns as f32;
        let bump = 1.0 + 0.1 * (7.0 * theta).sin() * (11.0 * phi).sin();
        Vec3::new(
            theta.sin() * phi.cos(),
            theta.cos(),
            -theta.sin() * phi.sin(),
        ) * bump
    };
    g.positions.push(Vec3::Y);
    for row in 1..rows {
        g.positions.extend((0..columns).map(|c| point(row, c)));
    }
    g.positions.push(-Vec3::Y);
    let south = g.positions.len() as u32 - 1;
    let vertex = |row: u32, column: u32| {
        if row == 0 {
            0
        } else if row == rows {
            south
        } else {
            1 + (row - 1) * columns + column % columns
        }
    };
    for row in 0..rows {
        for c in 0..columns {
            let (a, b) = (vertex(row, c), vertex(row, c + 1));
            let (d, e) = (vertex(row + 1, c), vertex(row + 1, c + 1));
            if row > 0 {
                g.triangles.push([a, d, b]);
            }
            if row + 1 < rows {
                g.triangles.push([b, d, e]);
            }
        }
    }
    g
}
