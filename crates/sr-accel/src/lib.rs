//! Ray queries: which primitive a ray meets first, and whether it meets any.
//!
//! A [`Geometry`] of triangles, spheres and quads goes in, an immutable [`Accel`] comes out. The
//! tree is built by obvhs with one primitive a leaf, where boxes that hold one another count as one,
//! and collapsed to eight children a node by dynamic programming over the surface area cost. The
//! traversal is ours, because the answers have to be these:
//!
//! - **Watertight.** A ray that meets an edge or a vertex of a closed mesh hits one of the
//!   triangles there (Woop, Benthin, Wald 2013), and no box that holds a hit is culled.
//! - **Independent of the tree.** Of two hits at the same `t` the smaller primitive id wins, so
//!   threads, build quality and instruction set cannot show in a picture.
//! - **Bounded.** [`Accel::hit_point`] tells how far off its point may be, so that a ray leaves a
//!   surface by [`sr_math::offset_ray_origin`] and no tuned constant.
//!
//! Queries come in batches ([`Accel::closest`], [`Accel::occluded`]); both run on the calling
//! thread, which owns a part of the picture. Rays that are not finite hit nothing.
//!
//! # Domain
//! Coordinates are `f32`, best relative to the camera. Products of three of them must neither
//! overflow nor vanish: coordinates within ±10¹², features and ray directions longer than 10⁻¹².
//! Beyond that hits may be missed; nothing panics.

mod accel;
mod collapse;
mod flight;
mod geometry;
mod hit_point;
mod lanes;
mod leaf;
mod node;
pub mod oracle;
mod ray;
mod runs;
mod sphere;
mod traverse;
mod triangle;
mod walk;

pub use accel::{Accel, BuildReport, BuildSettings, Quality};
pub use geometry::{Geometry, Prim, QuadShape, SphereShape};
pub use hit_point::HitPoint;
pub use lanes::SimdLevel;
pub use node::MAX_PRIMS;
#[doc(hidden)]
pub use node::{Conservative, SlabMargin};
pub use ray::{Hit, PRIM_NONE, Ray};
