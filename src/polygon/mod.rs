//! Polygons in the image of any eye, the plane included: clipping, convexity,
//! membership, cutting into convex parts and into triangles.

pub mod clipping;
mod membership;
mod splitting;
mod triangulation;
mod turning;

pub use membership::{Membership, membership};
pub use splitting::convex_parts;
pub use triangulation::{Triangles, TriangulationError, rings_of, triangulate};
pub use turning::{Turning, turning};
