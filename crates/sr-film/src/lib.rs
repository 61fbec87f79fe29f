//! Film accumulation, variance, tone mapping and image files
