//! Light that an image describes, and how to sample it.

mod equirect;
mod table;
mod texels;

pub use equirect::{direction_of, place_of};
use table::Table;
use texels::Texels;

use glam::{DVec3, Vec3};
use sr_math::Real;
use sr_math::color::luminance_of;
use std::f64::consts::PI;
use std::fmt;

/// A latitude–longitude map of radiance with what it takes to sample it, in a frame of its own.
///
/// v = acos(y)/π from the top, u = 1/2 + atan2(x, −z)/2π, texel centres at half integers; between them
/// the map is bilinear, across the seam too; nearer to a pole than half a texel it is constant along v.
///
/// It holds 12 bytes a texel for the colours and 8 for the sampling.
#[derive(Debug)]
pub struct EnvironmentMap {
    texels: Texels,
    /// `None` when all is black.
    table: Option<Table>,
    average: Vec3,
    brightest: f32,
}

/// Why there is no map of these texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapError {
    /// No texels, or not as many as width and height say.
    Size,
    /// Channels that are NaN, infinite or beyond [`EnvironmentMap::BRIGHTEST`].
    OutOfRange(BadTexels),
    /// Channels below 0.
    Negative(BadTexels),
}

/// Texels that cannot be taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BadTexels {
    /// How many.
    pub count: u64,
    /// Column and row of the first.
    pub first: (u32, u32),
}

impl fmt::Display for BadTexels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (x, y) = self.first;
        match self.count {
            1 => write!(f, "the texel at ({x}, {y}) is"),
            n => write!(f, "{n} texels, the first at ({x}, {y}), are"),
        }
    }
}

impl fmt::Display for MapError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (bad, what) = match self {
            Self::Size => return f.write_str("the number of texels is not width times height"),
            Self::OutOfRange(bad) => (bad, "not finite, or beyond the range"),
            Self::Negative(bad) => (bad, "negative"),
        };
        write!(f, "{bad} {what}")
    }
}

impl std::error::Error for MapError {}

/// Takes finite negative channels for 0 and says which there were: resampled pictures and those with
/// colours beyond Rec. 709 have them.
pub fn clamp_negative(width: u32, rgb: &mut [Vec3]) -> Option<BadTexels> {
    let bad = find(width, rgb, |c| c < 0.0 && c.is_finite());
    if bad.is_some() {
        for texel in rgb {
            // Not `max`, which takes NaN for a number.
            *texel = texel.map(|c| if c < 0.0 && c.is_finite() { 0.0 } else { c });
        }
    }
    bad
}

/// The texels with a channel that is bad.
fn find(width: u32, rgb: &[Vec3], is_bad: fn(f32) -> bool) -> Option<BadTexels> {
    let any = |t: &Vec3| t.to_array().into_iter().any(is_bad);
    let first = rgb.iter().position(any)? as u64;
    let width = u64::from(width);
    Some(BadTexels {
        count: rgb.iter().filter(|t| any(t)).count() as u64,
        first: ((first % width) as u32, (first / width) as u32),
    })
}

impl EnvironmentMap {
    /// The largest value of a channel: a quarter of the `f32` range, so that neither interpolation nor
    /// a luminance, which are a few roundings above the largest channel at most, can leave it.
    pub const BRIGHTEST: f32 = f32::MAX / 4.0;

    /// From texels in rows from the top.
    ///
    /// # Errors
    /// A number of texels that is not `width · height` or is 0; channels that are not in
    /// `[0, BRIGHTEST]`.
    pub fn new(width: u32, height: u32, rgb: Vec<Vec3>) -> Result<Self, MapError> {
        if rgb.is_empty() || rgb.len() as u64 != u64::from(width) * u64::from(height) {
            return Err(MapError::Size);
        }
        if let Some(bad) = find(width, &rgb, |c| c.is_nan() || c.abs() > Self::BRIGHTEST) {
            return Err(MapError::OutOfRange(bad));
        }
        if let Some(bad) = find(width, &rgb, |c| c < 0.0) {
            return Err(MapError::Negative(bad));
        }
        let brightest = rgb.iter().fold(0.0f32, |m, t| m.max(t.max_element()));
        let texels = Texels::new(width, height, rgb);
        Ok(Self {
            average: average(&texels),
            table: Table::new(&texels),
            texels,
            brightest,
        })
    }

    /// Columns.
    pub fn width(&self) -> u32 {
        self.texels.width()
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.texels.height()
    }

    /// Texels in rows from the top.
    pub fn texels(&self) -> &[Vec3] {
        self.texels.rgb()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of_val(self.texels()) + self.table.as_ref().map_or(0, Table::bytes)
    }

    /// Mean radiance over all directions, that of the bilinear map.
    pub fn average(&self) -> Vec3 {
        self.average
    }

    /// The largest channel of all texels.
    pub fn brightest(&self) -> f32 {
        self.brightest
    }

    /// Radiance from a direction of any length.
    #[inline]
    pub fn radiance(&self, d: Vec3) -> Vec3 {
        self.texels.at(place_of(d.to_array())).into()
    }

    /// A unit direction with density in proportion to the luminance of [`EnvironmentMap::radiance`];
    /// `None` when the map is black.
    #[inline]
    pub fn sample(&self, u: [f32; 2]) -> Option<Vec3> {
        self.sample_real(u).map(Vec3::from)
    }

    /// [`EnvironmentMap::sample`] in either type.
    #[inline]
    pub fn sample_real<R: Real>(&self, u: [R; 2]) -> Option<[R; 3]> {
        let u = u.map(R::to_f64);
        let place = self.table.as_ref()?.sample(&self.texels, u)?;
        Some(direction_of(place).map(R::lit))
    }

    /// The density per solid angle of [`EnvironmentMap::sample`].
    #[inline]
    pub fn pdf(&self, d: Vec3) -> f32 {
        self.radiance_and_pdf_real(d.to_array()).1
    }

    /// Radiance and density in one look, in either type.
    #[inline]
    pub fn radiance_and_pdf_real<R: Real>(&self, d: [R; 3]) -> ([R; 3], R) {
        let radiance = self.texels.at(place_of(d));
        let pdf = self.table.as_ref().map_or(R::ZERO, |table| {
            R::lit(luminance_of(radiance).to_f64() / table.integral)
        });
        (radiance, pdf)
    }
}

/// The integral over the sphere by 4π, row by row of cells: what the tables do for luminance.
fn average(texels: &Texels) -> Vec3 {
    let width = texels.width();
    let rows = (0..=texels.height()).map(|row| {
        let [falling, rising] = table::RowSpan::new(row, texels.height()).weights();
        // Each texel of a row is the left end of one cell and the right end of another.
        let mean = |row: u32| {
            let first = row as usize * width as usize;
            let texels = &texels.rgb()[first..first + width as usize];
            texels.iter().map(|t| t.as_dvec3()).sum::<DVec3>() / f64::from(width)
        };
        let (top, bottom) = (row.max(1) - 1, row.min(texels.height() - 1));
        falling * mean(top) + rising * mean(bottom)
    });
    let integral = 2.0 * PI * rows.sum::<DVec3>();
    (integral / (4.0 * PI)).as_vec3()
}
