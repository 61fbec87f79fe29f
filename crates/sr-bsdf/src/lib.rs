//! Scattering lobes, Fresnel terms and microfacet distributions
