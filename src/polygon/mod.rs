//! Polygons in the image of any eye, the plane included: clipping, convexity,
//! membership, cutting into convex parts and into triangles. In space: convex
//! polygons that are cut by planes, and the tree of them.

mod bsp;
pub mod clipping;
mod cycle;
mod membership;
mod plane_polygon;
mod splitting;
mod triangulation;
mod turning;
mod uncrossing;

pub use bsp::{Bsp, Fragment};
pub use cycle::canonical_cycle;
pub use membership::{Membership, membership};
pub use plane_polygon::{
    Cut, FaceParts, Part, PlaneCorner, PlanePolygon, Side, convex_parts as face_parts,
};
pub use splitting::convex_parts;
pub use triangulation::{Triangles, TriangulationError, rings_of, triangulate, triangulate_along};
pub use turning::{Turning, turning};
pub use uncrossing::{Uncrossed, uncross};
