//! What a scene has, as bits: what is not set is left out of the work.

use std::fmt;
use std::ops::{BitAnd, BitOr, BitOrAssign};

/// A set of scene features.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct SceneFeatures(u32);

macro_rules! features {
    ($($(#[doc = $doc:literal])* $name:ident = $bit:literal, $label:literal;)*) => {
        impl SceneFeatures {
            $($(#[doc = $doc])* pub const $name: Self = Self(1 << $bit);)*
            /// Every feature there is.
            pub const ALL: Self = Self($((1 << $bit) |)* 0);
            /// Name and bit of each feature.
            pub const TABLE: &'static [(&'static str, Self)] = &[$(($label, Self::$name)),*];
        }
    };
}

features! {
    /// Triangle meshes.
    TRIANGLES = 0, "triangles";
    /// Analytic spheres.
    SPHERES = 1, "spheres";
    /// Analytic rectangles.
    QUADS = 2, "quads";
    /// Meshes with interpolated shading normals.
    SMOOTH_NORMALS = 3, "smooth normals";
    /// A lobe that is no delta function, so that light sampling has something to do.
    SMOOTH_LOBES = 4, "non-delta lobes";
    /// A lobe that is a delta function.
    DELTA_LOBES = 5, "delta lobes";
    /// A glossy lobe.
    GLOSSY_LOBES = 6, "glossy lobes";
    /// A lobe that lets light through.
    TRANSMISSION = 7, "transmission";
    /// Surfaces that glow.
    AREA_LIGHTS = 8, "area lights";
    /// Point, spot and directional lights, which no ray can hit.
    DELTA_LIGHTS = 9, "delta lights";
    /// Light from infinitely far away that rays can reach.
    ENVIRONMENT = 10, "environment";
    /// More than one light to choose from.
    MANY_LIGHTS = 11, "several lights";
    /// A lobe that looks different from different sides, so that shapes need tangents.
    ANISOTROPY = 12, "anisotropic lobes";
}

impl SceneFeatures {
    /// No feature.
    pub const NONE: Self = Self(0);

    /// Has all of `other`.
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// Has any of `other`.
    pub const fn intersects(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// Both sets; for constants.
    pub const fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// What `self` has and `other` lacks.
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// The names of the features that are set.
    pub fn names(self) -> impl Iterator<Item = &'static str> {
        Self::TABLE
            .iter()
            .filter(move |(_, f)| self.contains(*f))
            .map(|(n, _)| *n)
    }
}

impl BitOr for SceneFeatures {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        self.union(other)
    }
}

impl BitAnd for SceneFeatures {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl BitOrAssign for SceneFeatures {
    fn bitor_assign(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

impl fmt::Display for SceneFeatures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if *self == Self::NONE {
            return f.write_str("none");
        }
        f.write_str(&self.names().collect::<Vec<_>>().join(", "))
    }
}
