//! Polygons with holes, cut into triangles.

mod triangulation;

pub use triangulation::{Triangles, TriangulationError, rings_of, triangulate};
