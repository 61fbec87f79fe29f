//! The built-in integrators, written against the seam only
