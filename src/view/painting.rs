//! The exact answer of a painter, before anything is rounded.

use super::ImageRegion;
use crate::polygon::PlanePolygon;
use std::ops::Range;

/// A convex piece of a face.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PaintedPiece {
    /// The face, numbered through the scene.
    pub face: u32,
    /// The object it belongs to.
    pub object: u32,
    /// The flat area it belongs to, as the first triangle of it: triangles of
    /// the face and of others in its plane, across edges that are no lines.
    pub area: u32,
    /// A triangle of the face that lies in the same plane.
    pub triangle: u32,
    /// What is painted, as far as it lies in front of the near plane.
    pub polygon: PlanePolygon,
}

/// All that has an image, from back to front: whoever paints the pieces in
/// this order, each over those before it, paints the scene.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PaintOrder {
    /// The pieces; those of one face share no inside.
    pub pieces: Vec<PaintedPiece>,
    /// How many cuts were made to bring them into an order.
    pub cuts: usize,
}

/// A flat area, or some pieces of it, in coordinates of the view frame.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintedFace {
    /// What is painted: the pieces joined, as far as they follow one another.
    pub region: ImageRegion,
    /// Which of the lines are those of its border that are drawn, over it.
    pub lines: Range<u32>,
}
