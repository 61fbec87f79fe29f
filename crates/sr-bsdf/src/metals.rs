//! Measured complex indices of metals, reduced to linear Rec. 709.
//!
//! The tables of η(λ) and k(λ) are those that refractiveindex.info collects (Polyanskiy 2024, in the public
//! domain, CC0) of the measurements named with each metal:
//!
//! - Johnson and Christy 1972, Phys. Rev. B 6, 4370: Ag, Au, Cu, evaporated films.
//! - Johnson and Christy 1974, Phys. Rev. B 9, 5056: Co, Cr, Fe, Ni, Pd, Ti, V, evaporated films.
//! - Rakić 1995, Appl. Opt. 34, 4755: Al, from several measurements made consistent.
//! - Rakić, Djurišić, Elazar and Majewski 1998, Appl. Opt. 37, 5271: Pt, a Lorentz–Drude model fitted to
//!   measurements.
//! - Smith 1969, Phys. Rev. 183, 634: K, Na, at a surface in vacuum.
//! - Weaver, Olson and Lynch 1975, Phys. Rev. B 12, 1293: W, read off their figure.
//! - Weaver, Olson and Lynch 1977, Phys. Rev. B 15, 4115: Rh.
//! - Inagaki, Arakawa and Williams 1981, Phys. Rev. B 23, 5246: Hg, liquid.
//!
//! Each number is the mean of η(λ) or k(λ), interpolated linearly from 380 to 780 nm in steps of 5 nm, with the weights
//! that turn a reflectance under illuminant D65 into linear Rec. 709: D65 times the colour matching functions of
//! the CIE 1931 observer, times the matrix of Rec. 709, normalised so that a constant stays what it is. Rounded to
//! four decimals. The reflectance at normal incidence of the three numbers differs from that of the whole spectrum by
//! less than 0.011 in each channel, but for gold's red: there the spectrum's is 1.04, outside of the colours that
//! Rec. 709 has, and the numbers give 0.98.

use glam::Vec3;

/// A metal and its index.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metal {
    /// Chemical symbol.
    pub symbol: &'static str,
    /// English name.
    pub name: &'static str,
    /// Real part of the index, by channel.
    pub eta: Vec3,
    /// Imaginary part, by channel.
    pub k: Vec3,
    /// Who measured it, and when.
    pub source: &'static str,
}

const fn metal(
    symbol: &'static str,
    name: &'static str,
    eta: [f32; 3],
    k: [f32; 3],
    source: &'static str,
) -> Metal {
    Metal {
        symbol,
        name,
        eta: Vec3::from_array(eta),
        k: Vec3::from_array(k),
        source,
    }
}

/// All metals, by symbol.
pub const METALS: &[Metal] = &[
    metal(
        "Ag",
        "silver",
        [0.0555, 0.0547, 0.0429],
        [4.3651, 3.5295, 2.5676],
        "Johnson and Christy 1972",
    ),
    metal(
        "Al",
        "aluminium",
        [1.481, 0.9821, 0.5981],
        [7.6513, 6.5492, 5.347],
        "Rakić 1995",
    ),
    metal(
        "Au",
        "gold",
        [0.0583, 0.5002, 1.459],
        [3.6132, 2.3239, 1.8186],
        "Johnson and Christy 1972",
    ),
    metal(
        "Co",
        "cobalt",
        [2.2502, 2.0327, 1.7093],
        [4.218, 3.7909, 3.2329],
        "Johnson and Christy 1974",
    ),
    metal(
        "Cr",
        "chromium",
        [3.251, 3.1072, 2.2792],
        [3.2887, 3.3375, 3.1243],
        "Johnson and Christy 1974",
    ),
    metal(
        "Cu",
        "copper",
        [0.1734, 1.0435, 1.2899],
        [3.2825, 2.5994, 2.3667],
        "Johnson and Christy 1972",
    ),
    metal(
        "Fe",
        "iron",
        [2.9242, 2.9171, 2.5453],
        [3.0762, 2.9371, 2.7499],
        "Johnson and Christy 1974",
    ),
    metal(
        "Hg",
        "mercury",
        [2.0282, 1.5154, 1.0162],
        [5.3037, 4.6039, 3.791],
        "Inagaki, Arakawa and Williams 1981",
    ),
    metal(
        "K",
        "potassium",
        [0.0539, 0.0489, 0.0418],
        [1.7694, 1.4223, 1.0185],
        "Smith 1969",
    ),
    metal(
        "Na",
        "sodium",
        [0.0489, 0.059, 0.0682],
        [2.6678, 2.2276, 1.7518],
        "Smith 1969",
    ),
    metal(
        "Ni",
        "nickel",
        [2.0223, 1.9012, 1.7243],
        [4.1728, 3.5645, 2.8856],
        "Johnson and Christy 1974",
    ),
    metal(
        "Pd",
        "palladium",
        [1.7878, 1.6197, 1.3921],
        [4.345, 3.8074, 3.2048],
        "Johnson and Christy 1974",
    ),
    metal(
        "Pt",
        "platinum",
        [2.3392, 2.0732, 1.828],
        [4.2184, 3.6644, 3.0878],
        "Rakić et al. 1998, Lorentz–Drude model",
    ),
    metal(
        "Rh",
        "rhodium",
        [2.1596, 1.96, 1.7226],
        [5.6805, 4.9555, 4.3901],
        "Weaver, Olson and Lynch 1977",
    ),
    metal(
        "Ti",
        "titanium",
        [2.737, 2.5073, 2.2363],
        [3.8281, 3.3973, 3.0099],
        "Johnson and Christy 1974",
    ),
    metal(
        "V",
        "vanadium",
        [3.476, 3.9585, 3.6165],
        [2.9725, 3.0824, 3.4721],
        "Johnson and Christy 1974",
    ),
    metal(
        "W",
        "tungsten",
        [3.6345, 3.4936, 3.3123],
        [2.9227, 2.7469, 2.5044],
        "Weaver, Olson and Lynch 1975",
    ),
];

/// A metal by its symbol or its name, in upper or lower case.
pub fn find(name: &str) -> Option<&'static Metal> {
    METALS
        .iter()
        .find(|m| m.symbol.eq_ignore_ascii_case(name) || m.name.eq_ignore_ascii_case(name))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::fresnel_conductor;

    #[test]
    fn metals_are_found_by_symbol_and_by_name_in_any_case() {
        for m in METALS {
            assert_eq!(find(&m.symbol.to_uppercase()), Some(m));
            assert_eq!(find(&m.name.to_uppercase()), Some(m));
        }
        assert!(find("unobtainium").is_none() && find("").is_none());
        assert!(METALS.is_sorted_by_key(|m| m.symbol));
    }

    /// The constants that the classic assignment's scenes carry were picked at three wavelengths and not
    /// reduced; the reflectances are alike to 0.09 in every channel, and in the order of the channels.
    #[test]
    fn reflectances_are_near_those_of_the_classic_assignment() {
        let course = [
            ("Cu", [0.33228, 1.0162, 1.2474], [3.1646, 2.5785, 2.4603]),
            ("Al", [1.3352, 1.0109, 0.68955], [7.3398, 6.6157, 5.6471]),
            (
                "Ag",
                [0.059193, 0.059881, 0.047366],
                [4.1283, 3.5892, 2.8132],
            ),
            ("Au", [0.21646, 0.42833, 1.3284], [3.239, 2.4599, 1.8661]),
        ];
        for (name, eta, k) in course {
            let m = find(name).expect("a metal");
            for c in 0..3 {
                let ours = fresnel_conductor(1.0, m.eta[c], m.k[c]);
                let theirs = fresnel_conductor(1.0, eta[c], k[c]);
                assert!((ours - theirs).abs() < 0.09, "{name} {c}: {ours} {theirs}");
            }
        }
    }
}
