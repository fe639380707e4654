//! Polygons with holes, cut into triangles.

pub mod clipping;
mod triangulation;

pub use triangulation::{Triangles, TriangulationError, rings_of, triangulate};
