//! A ray that leaves a surface by its error bound does not meet it again.

use crate::{direction, in_cube, unit};
use glam::Vec3;
use sr_accel::{Accel, BuildSettings, Geometry, Hit, HitPoint, QuadShape, Ray, SphereShape};
use sr_math::offset_ray_origin;

/// One shape of a size from 10⁻³ to 10⁴, from 0 to 1000 of its sizes away from the origin, some of
/// its points exactly there.
fn placed(i: u32) -> (f32, Vec3) {
    let size = 10f32.powf(-3.0 + 7.0 * unit(i, 0));
    let away = match i % 4 {
        0 => 0.0,
        1 => 1.0,
        _ => 10f32.powf(3.0 * unit(i, 1)),
    };
    (size, direction(i, 2) * (size * away))
}

fn accel_of(g: Geometry) -> Accel {
    Accel::build(g, &BuildSettings::default())
}

/// Where a ray from a random point beside the shape to a point of it meets it.
fn first_hit(accel: &Accel, target: Vec3, size: f32, key: u32) -> Option<(HitPoint, Hit)> {
    let from = target + direction(key, 10) * (size * 10f32.powf(3.0 * unit(key, 12) - 1.0));
    let ray = Ray {
        o: from,
        t_max: f32::INFINITY,
        d: target - from,
    };
    let hit = accel.closest_one(&ray);
    hit.is_hit().then(|| (accel.hit_point(&ray, &hit), hit))
}

/// A direction on a given side of the normal, most often grazing: down to a cosine of 10⁻⁷.
fn leaving(ng: Vec3, side: f32, key: u32) -> Vec3 {
    let cos = match key % 3 {
        0 => unit(key, 20),
        _ => 10f32.powf(-7.0 * unit(key, 20)),
    };
    let (s, t) = sr_math::orthonormal_basis(ng.to_array());
    let (sin_phi, cos_phi) = (std::f32::consts::TAU * unit(key, 21)).sin_cos();
    let tangent = Vec3::from(s) * cos_phi + Vec3::from(t) * sin_phi;
    let length = 10f32.powf(2.0 * unit(key, 22) - 1.0);
    (tangent * (1.0 - cos * cos).max(0.0).sqrt() + ng * (cos * side)) * length
}

fn spawned(point: &HitPoint, w: Vec3) -> Ray {
    Ray {
        o: offset_ray_origin(point.p, point.p_err, point.ng, w),
        t_max: f32::INFINITY,
        d: w,
    }
}

/// No hit, on either side, from many points of one flat shape.
fn check_flat(accel: &Accel, target: impl Fn(u32) -> Vec3, size: f32, i: u32) -> usize {
    let mut tested = 0;
    for k in 0..24 {
        let key = i * 24 + k;
        let Some((point, _)) = first_hit(accel, target(key), size, key) else {
            continue;
        };
        for side in [1.0, -1.0] {
            let ray = spawned(&point, leaving(point.ng, side, key));
            let again = accel.closest_one(&ray);
            assert!(!again.is_hit(), "shape {i}: {point:?} {ray:?} {again:?}");
            assert!(!accel.occluded_one(&ray));
            tested += 1;
        }
    }
    tested
}

/// A fraction that is often next to 0 or 1.
fn fraction(key: u32, k: u32) -> f32 {
    let x = unit(key, k);
    match key % 5 {
        0 => 10f32.powf(-9.0 * x),
        1 => 1.0 - 10f32.powf(-9.0 * x),
        2 => x.round(),
        _ => x,
    }
}

/// For shapes `i` of which `i % 4 < 2`: a vertex at the origin or next to it, where coordinates are
/// far finer than at the other end of the shape.
fn next_to_origin(i: u32, size: f32) -> Vec3 {
    let near = 10f32.powf(-1.0 - 8.0 * unit(i, 64)) * (i % 4) as f32;
    direction(i, 65) * (size * near)
}

#[test]
fn rays_from_triangles_needles_included_do_not_hit_them_again() {
    let mut tested = 0;
    for i in 0..120_000 {
        let (size, offset) = placed(i);
        let mut p = [30, 40, 50].map(|k| offset + in_cube(i, k) * size);
        if i % 4 < 2 {
            p[(i / 4 % 3) as usize] = next_to_origin(i, size);
        }
        if i % 3 == 0 {
            // A needle: the third vertex next to the edge of the others.
            let thin = 10f32.powf(-1.0 - 3.0 * unit(i, 60));
            p[2] = p[0] + (p[1] - p[0]) * unit(i, 61) + (p[2] - p[0]) * thin;
        }
        let accel = accel_of(Geometry {
            positions: p.to_vec(),
            triangles: vec![[0, 1, 2]],
            ..Geometry::default()
        });
        let target = |key| {
            let (u, v) = (fraction(key, 62), fraction(key, 63));
            p[0] + u * (1.0 - v) * (p[1] - p[0]) + u * v * (p[2] - p[0])
        };
        tested += check_flat(&accel, target, size, i);
    }
    assert!(tested > 500_000, "{tested}");
}

#[test]
fn rays_from_quads_do_not_hit_them_again() {
    let mut tested = 0;
    for i in 0..100_000 {
        let (size, offset) = placed(i);
        let mut quad = QuadShape {
            corner: offset + in_cube(i, 30) * size,
            edge_u: in_cube(i, 40) * size,
            edge_v: in_cube(i, 50) * size,
        };
        if i % 4 < 2 {
            quad.corner = next_to_origin(i, size);
        }
        let accel = accel_of(Geometry {
            quads: vec![quad],
            ..Geometry::default()
        });
        let target =
            |key| quad.corner + fraction(key, 62) * quad.edge_u + fraction(key, 63) * quad.edge_v;
        tested += check_flat(&accel, target, size, i);
    }
    assert!(tested > 250_000, "{tested}");
}

/// A parallelogram in an axis plane; a fifth of the planes go through the origin.
fn in_axis_plane(i: u32) -> (usize, f32, QuadShape) {
    let (size, offset) = placed(i);
    let axis = (i / 4 % 3) as usize;
    let flat = |k| {
        let mut v = in_cube(i, k) * size;
        v[axis] = 0.0;
        v
    };
    let mut quad = QuadShape {
        corner: offset + in_cube(i, 30) * size,
        edge_u: flat(40),
        edge_v: flat(50),
    };
    if i % 4 < 2 {
        quad.corner = next_to_origin(i, size);
    }
    if i.is_multiple_of(5) {
        quad.corner[axis] = 0.0;
    }
    if i.is_multiple_of(2) {
        // A rectangle along the axes, whose edges are met head-on.
        quad.edge_u[(axis + 1) % 3] = 0.0;
        quad.edge_v[(axis + 2) % 3] = 0.0;
    }
    (axis, size, quad)
}

/// However large a floor is, rays leave it from its plane, not from above.
#[test]
fn rays_from_axis_planes_start_next_to_them_and_do_not_hit_them_again() {
    let (mut tested, mut near) = (0, 0);
    for i in 0..60_000 {
        let (axis, size, quad) = in_axis_plane(i);
        let [a, b] = [quad.corner + quad.edge_u, quad.corner + quad.edge_v];
        let as_quad = Geometry {
            quads: vec![quad],
            ..Geometry::default()
        };
        let as_triangle = Geometry {
            positions: vec![quad.corner, a, b],
            triangles: vec![[0, 1, 2]],
            ..Geometry::default()
        };
        for (g, reach) in [(as_quad, 1.0), (as_triangle, 0.5)] {
            let accel = accel_of(g);
            let target = |key| {
                let (u, v) = (reach * fraction(key, 62), reach * fraction(key, 63));
                quad.corner + u * quad.edge_u + v * quad.edge_v
            };
            tested += check_flat(&accel, target, size, i);
            if let Some((point, _)) = first_hit(&accel, target(i), size, i) {
                let height = quad.corner[axis];
                assert_eq!(point.p[axis], height);
                let w = leaving(point.ng, 1.0, i);
                let above = (spawned(&point, w).o[axis] - height).abs();
                near += usize::from(above <= 8.0 * f32::EPSILON * height.abs());
            }
        }
    }
    // All but the most slender ones.
    assert!(tested > 250_000 && near > 40_000, "{tested} {near}");
}

#[test]
fn rays_leave_spheres_outward_for_good_and_cross_them_inward() {
    let (mut outward, mut inward) = (0, 0);
    for i in 0..100_000 {
        let (size, center) = placed(i);
        let sphere = SphereShape {
            center,
            radius: size,
        };
        let accel = accel_of(Geometry {
            spheres: vec![sphere],
            ..Geometry::default()
        });
        for k in 0..24 {
            let key = i * 24 + k;
            let target = center + direction(key, 62) * (size * unit(key, 64));
            let Some((point, _)) = first_hit(&accel, target, size, key) else {
                continue;
            };
            // At a cosine of 10⁻⁷ rounding may turn the side.
            let w = leaving(point.ng, 1.0, key);
            if w.dot(point.ng) >= 0.0 {
                let ray = spawned(&point, w);
                let again = accel.closest_one(&ray);
                assert!(!again.is_hit(), "{sphere:?} {point:?} {ray:?} {again:?}");
                outward += 1;
            }

            let w = leaving(point.ng, -1.0, key);
            let cos = -f64::from(w.dot(point.ng) / w.length());
            let ray = spawned(&point, w);
            let again = accel.closest_one(&ray);
            // Where the chord stands clear of the error bound, it is all crossed.
            let chord = 2.0 * f64::from(size) * cos;
            let blur = f64::from(point.ng.abs().dot(point.p_err)) / cos;
            if cos > 0.0 && chord > 20.0 * blur {
                assert!(again.is_hit(), "{sphere:?} {point:?} {ray:?}");
                // Depth shortens the chord by up to 2 blur; a point that rounding moves along the
                // surface has another normal. Twice that, and the rounding of the origin.
                let bound = 8.0 * (blur + f64::from(point.p_err.length()));
                let crossed = f64::from(again.t * w.length());
                assert!(
                    (crossed - chord).abs() < bound + 1e-4 * chord,
                    "{sphere:?} {point:?} {ray:?} {crossed} {chord} {bound}"
                );
                inward += 1;
            }
        }
    }
    assert!(outward > 200_000 && inward > 100_000, "{outward} {inward}");
}
