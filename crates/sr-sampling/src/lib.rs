//! Samplers and pixel filters
