//! A part of a piece, with its depths.

use crate::view::{LinePiece, Projection};

/// The part of a piece between two shares of its image, from 0 to 1. Its own
/// ends stay what they are, bit for bit.
pub(super) fn part_of(piece: &LinePiece, range: [f64; 2], projection: Projection) -> LinePiece {
    let point = |t: f64| match t {
        0.0 => piece.points[0],
        1.0 => piece.points[1],
        t => piece.points[0].lerp(piece.points[1], t),
    };
    let [near, far] = piece.depth;
    let depth = |t: f64| match t {
        0.0 => near,
        1.0 => far,
        // The inverse of a depth is linear in a perspective image.
        t if projection == Projection::Perspective => 1.0 / ((1.0 - t) / near + t / far),
        t => near + (far - near) * t,
    };
    LinePiece { points: range.map(point), depth: range.map(depth), ..*piece }
}
