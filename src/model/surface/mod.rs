//! Surfaces y = f(x, z) over a rectangle, as grids of heights.
//!
//! A surface is given by an expression ([`Heights::of_expression`]) or by a
//! file (`import::read_heights`). The heights at the grid's points, in
//! doubles, are the input; how they were computed is not looked into. Cells
//! are two triangles each, cut from their corner of least x and z to that of
//! greatest, so the surface is a mesh and everything about it is exact.
//! [`Surface`] has a height everywhere, which a floating horizon needs;
//! [`SurfaceWithHoles`] has them where the data has.
//!
//! In a surface y points up and z to the viewer of the front view; the
//! point (x, y, z) is (x, -z, y) in the world, as for models whose y is up.

mod curves;
mod degrees;
mod error;
#[cfg(feature = "surface")]
mod expression;
mod heights;
mod holes;
#[cfg(feature = "surface")]
mod powers;
mod solid;

pub use curves::{CurveOptions, Curves};
pub use error::SurfaceError;
pub use heights::{Heights, Rectangle};
pub use holes::SurfaceWithHoles;
pub use solid::Surface;
