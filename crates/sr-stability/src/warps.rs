//! The maps of `sr_math::warp` under one name, for suites and for kernels that replace one.

use sr_pipeline::math::{Real, warp};

/// A map from the unit square.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Warp {
    /// [`warp::concentric_disk`], z = 0.
    Disk,
    /// [`warp::cosine_hemisphere`].
    CosineHemisphere,
    /// [`warp::uniform_hemisphere`].
    Hemisphere,
    /// [`warp::uniform_sphere`].
    Sphere,
    /// [`warp::uniform_cone`], of this sin²θ.
    Cone(f32),
    /// [`warp::uniform_triangle`], z = 0.
    Triangle,
    /// [`warp::regular_polygon`], of so many corners, z = 0.
    Polygon(u32),
    /// [`warp::SphericalRectangle`], of 2 × 1 at this height, z = 0.
    Rectangle(f32),
}

/// Where a map leads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Unit vectors.
    Sphere,
    /// Unit vectors with z ≥ 0.
    Hemisphere,
    /// Within the unit circle.
    Disk,
    /// Coordinates of at least 0 whose sum is at most 1.
    Triangle,
    /// Within these ranges of x and y.
    Rectangle([[f64; 2]; 2]),
}

/// The sides of [`Warp::Rectangle`].
const SIDES: [[f32; 2]; 2] = [[-0.75, 1.25], [0.25, 1.25]];

impl Warp {
    /// Each map, with parameters at which it changes its way.
    pub const ALL: [Self; 13] = [
        Self::Disk,
        Self::CosineHemisphere,
        Self::Hemisphere,
        Self::Sphere,
        Self::Cone(1.0),
        Self::Cone(0.25),
        Self::Cone(1e-6),
        Self::Cone(1e-14),
        Self::Triangle,
        Self::Polygon(3),
        Self::Polygon(6),
        Self::Rectangle(0.5),
        Self::Rectangle(2.0),
    ];

    /// The point or direction of `u`.
    pub fn at<R: Real>(self, u: [R; 2]) -> [R; 3] {
        let flat = |[x, y]: [R; 2]| [x, y, R::ZERO];
        let lit = |x: f32| R::lit(f64::from(x));
        match self {
            Self::Disk => flat(warp::concentric_disk(u)),
            Self::CosineHemisphere => warp::cosine_hemisphere(u),
            Self::Hemisphere => warp::uniform_hemisphere(u),
            Self::Sphere => warp::uniform_sphere(u),
            Self::Cone(sin2) => warp::uniform_cone(u, lit(sin2)),
            Self::Triangle => flat(warp::uniform_triangle(u)),
            Self::Polygon(corners) => flat(warp::regular_polygon(u, corners)),
            Self::Rectangle(z) => {
                let [x, y] = SIDES.map(|side| side.map(lit));
                let nowhere = [R::lit(f64::NAN); 2];
                let rectangle = warp::SphericalRectangle::new(x, y, lit(z));
                flat(rectangle.map_or(nowhere, |r| r.sample(u)))
            }
        }
    }

    /// Where it leads.
    pub fn shape(self) -> Shape {
        match self {
            Self::Disk | Self::Polygon(_) => Shape::Disk,
            Self::CosineHemisphere | Self::Hemisphere | Self::Cone(_) => Shape::Hemisphere,
            Self::Sphere => Shape::Sphere,
            Self::Triangle => Shape::Triangle,
            Self::Rectangle(_) => Shape::Rectangle(SIDES.map(|side| side.map(f64::from))),
        }
    }

    /// Half the extent along x, y and z, in which errors are told.
    pub fn size(self) -> [f64; 3] {
        match self {
            // Narrow cones have nothing along z but the rounding of 1.
            Self::Cone(sin2) => {
                let sin = f64::from(sin2).sqrt();
                [sin, sin, 1.0]
            }
            _ => [1.0; 3],
        }
    }
}
