//! Lobes of facets in the coordinates of their facets.
//!
//! A lobe of roughness 10⁻⁴, or of 1 in one direction and of 10⁻³ in the other, is a needle on the sphere of directions
//! that no grid finds. Over the normals of its facets, stretched by 1/α, each lobe is as wide as one of
//! roughness 1. So bins and quadratures are over stretched normals h', and the densities are turned by
//!
//!   dω_i/dω_h' = dω_i/dω_h · α_xα_y·(cosθ_h/cosθ_h')³,
//!
//! with dω_i/dω_h = 4 wo·h of a reflection and |wo + η wi|²/(η²|wi·h|) of a refraction (Walter et al. 2007, eq. 14 and 17).
//! This is written without the code that is under examination, so it finds a wrong Jacobian there.

use super::{NDFS, gltf, surfaces, white_conductor, white_glass};
use sr_pipeline::bsdf::{Bsdf, Microsurface, Ndf};
use sr_pipeline::glam::{DVec2, DVec3, Vec3};
use sr_stats::SphereBins;

/// How a facet passes on light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::suites) enum Sheet {
    Reflected,
    Refracted,
    /// Reflected, then mirrored through the surface: thin glass of glTF.
    Mirrored,
}

/// A white lobe of facets.
#[derive(Clone, Debug)]
pub(in crate::suites) struct Facets {
    pub name: String,
    pub bsdf: Bsdf,
    alpha: DVec2,
    sheets: &'static [Sheet],
    ior: f64,
}

/// `wo` and what depends on it, as if it were on the upper side.
#[derive(Clone, Copy, Debug)]
struct View {
    wo: DVec3,
    below: bool,
    eta: f64,
}

impl Facets {
    fn of(name: String, bsdf: Bsdf, surface: Microsurface, sheets: &'static [Sheet]) -> Self {
        let alpha = surface.alpha();
        Self {
            name,
            bsdf,
            alpha: DVec2::new(
                f64::from(alpha.x),
                f64::from(alpha.x) * f64::from(alpha.ratio),
            ),
            sheets,
            ior: 1.5,
        }
    }

    /// White metal and glass of every surface of roughness `alpha`, and what glTF has of them; `alpha` must not
    /// be below the limit of smoothness.
    pub fn all(alpha: f32) -> Vec<Self> {
        let mut all = Vec::new();
        for (name, surface) in surfaces(alpha) {
            let (metal, glass) = (white_conductor(surface), white_glass(surface));
            let metal = Bsdf::Conductor(metal);
            all.push(Self::metal(format!("metal {name}"), metal, surface));
            let glass = Bsdf::RoughDielectric(glass);
            all.push(Self::glass(format!("glass {name}"), glass, surface));
        }
        // glTF knows √α.
        let roughness = alpha.sqrt();
        let surface = Microsurface::isotropic(Ndf::Ggx, roughness * roughness);
        let gltf = |name: &str, metallic, transmission, sheets| {
            let bsdf = gltf(metallic, alpha, transmission);
            Self::of(format!("MetallicRoughness {name}"), bsdf, surface, sheets)
        };
        all.push(gltf("metal", 1.0, 0.0, &[Sheet::Reflected]));
        all.push(gltf("thin", 0.0, 1.0, &[Sheet::Reflected, Sheet::Mirrored]));
        all
    }

    /// White metal and glass with what single scattering loses given back.
    pub fn compensated(alpha: f32) -> Vec<Self> {
        let of = |ndf| {
            let surface = Microsurface::isotropic(ndf, alpha);
            let metal = Bsdf::Conductor(white_conductor(surface).compensated());
            let glass = Bsdf::RoughDielectric(white_glass(surface).compensated());
            [
                Self::metal(format!("metal {ndf:?}"), metal, surface),
                Self::glass(format!("glass {ndf:?}"), glass, surface),
            ]
        };
        NDFS.into_iter().flat_map(of).collect()
    }

    fn metal(name: String, bsdf: Bsdf, surface: Microsurface) -> Self {
        Self::of(name, bsdf, surface, &[Sheet::Reflected])
    }

    fn glass(name: String, bsdf: Bsdf, surface: Microsurface) -> Self {
        Self::of(name, bsdf, surface, &[Sheet::Reflected, Sheet::Refracted])
    }

    /// The same from `wos` of the upper side, and from below where that is another side.
    pub fn views(&self, wos: impl IntoIterator<Item = Vec3>) -> Vec<Vec3> {
        let sides: &[f32] = if self.sheets.contains(&Sheet::Refracted) {
            &[1.0, -1.0]
        } else {
            &[1.0]
        };
        let both = |wo: Vec3| sides.iter().map(move |s| Vec3::new(wo.x, wo.y, wo.z * s));
        wos.into_iter().flat_map(both).collect()
    }

    fn view(&self, wo: Vec3) -> View {
        let below = wo.z < 0.0;
        View {
            wo: flip(wo.as_dvec3(), below),
            below,
            eta: if below { 1.0 / self.ior } else { self.ior },
        }
    }

    /// Where the facet of the stretched normal sends light to, and dω_i/dω_h'.
    fn direction(&self, sheet: Sheet, view: View, stretched: DVec3) -> Option<(DVec3, f64)> {
        let h = (stretched * self.alpha.extend(1.0)).normalize();
        let seen = view.wo.dot(h);
        if stretched.z <= 0.0 || seen <= 0.0 {
            return None;
        }
        let stretch = self.alpha.x * self.alpha.y * (h.z / stretched.z).powi(3);
        let (wi, turn) = match sheet {
            Sheet::Reflected | Sheet::Mirrored => {
                let wi = 2.0 * seen * h - view.wo;
                let wi = (wi.z > 0.0).then_some(wi)?;
                (flip(wi, sheet == Sheet::Mirrored), 4.0 * seen)
            }
            Sheet::Refracted => {
                let sin2 = (view.wo - seen * h).length_squared() / view.eta.powi(2);
                let cos = (sin2 < 1.0).then_some((1.0 - sin2).sqrt())?;
                let wi = -(view.wo - seen * h) / view.eta - cos * h;
                let wi = (wi.z < 0.0).then_some(wi)?;
                let length2 = (view.wo + view.eta * wi).length_squared();
                (wi, length2 / (view.eta.powi(2) * cos))
            }
        };
        Some((flip(wi, view.below), turn * stretch))
    }

    /// On which sheet a direction lies, and the stretched normal that sends it there.
    fn normal(&self, view: View, wi: Vec3) -> Option<(usize, DVec3)> {
        let wi = flip(wi.as_dvec3(), view.below);
        let crosses = wi.z < 0.0;
        let at = |s: &Sheet| (*s != Sheet::Reflected) == crosses;
        let index = self.sheets.iter().position(at)?;
        let h = match self.sheets[index] {
            Sheet::Reflected => view.wo + wi,
            Sheet::Mirrored => view.wo + flip(wi, true),
            Sheet::Refracted => view.wo + view.eta * wi,
        };
        let h = h * h.z.signum();
        Some((index, h / self.alpha.extend(1.0)))
    }

    /// The integral of a density per solid angle over each bin of stretched normals, sheet by sheet.
    pub fn masses(&self, bins: &SphereBins, wo: Vec3, density: impl Fn(Vec3) -> f64) -> Vec<f64> {
        let view = self.view(wo);
        let of = |sheet: &Sheet| {
            bins.integrate(|h| {
                self.direction(*sheet, view, DVec3::from(h))
                    .map_or(0.0, |(wi, turn)| turn * density(wi.as_vec3()))
            })
        };
        self.sheets.iter().flat_map(of).collect()
    }

    /// How many directions fall into each of these bins; the last entry counts the `None`s.
    pub fn count(
        &self,
        bins: &SphereBins,
        wo: Vec3,
        directions: impl Iterator<Item = Option<Vec3>>,
    ) -> Vec<u64> {
        let view = self.view(wo);
        let mut counts = vec![0; self.sheets.len() * bins.len() + 1];
        let failed = counts.len() - 1;
        for wi in directions {
            let place = wi.and_then(|wi| self.normal(view, wi));
            let bin = |(sheet, h): (usize, DVec3)| sheet * bins.len() + bins.index(h.to_array());
            counts[place.map_or(failed, bin)] += 1;
        }
        counts
    }

    /// Directions that the facets of some normals send light to, rounded to `f32`; the normals are up to 2.4 α steep.
    pub fn directions(&self, wo: Vec3) -> Vec<Vec3> {
        let view = self.view(wo);
        let normal = |i: u32| {
            let (slope, phi) = (0.2 * f64::from(i % 13), 2.4 * f64::from(i));
            DVec3::new(slope * phi.cos(), slope * phi.sin(), 1.0)
        };
        let of = |sheet: &Sheet| {
            let at = |i| self.direction(*sheet, view, normal(i).normalize());
            (0..26)
                .filter_map(at)
                .map(|(wi, _)| wi.as_vec3())
                .collect::<Vec<_>>()
        };
        self.sheets.iter().flat_map(of).collect()
    }
}

fn flip(w: DVec3, below: bool) -> DVec3 {
    if below { DVec3::new(w.x, w.y, -w.z) } else { w }
}
