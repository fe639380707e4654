//! The answer of a line method: pieces of lines with constant invisibility.

use super::{Frame, LineClass};
use crate::run::Counters;
use glam::DVec2;

/// Where a line comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum LineSource {
    /// An edge or loose line: vertex numbers in the object's file order.
    Edge([u32; 2]),
    /// The common line of two faces: face numbers in their objects' file order.
    Faces([u32; 2]),
}

/// A maximal piece of one line with constant invisibility.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinePiece {
    /// What the line is.
    pub class: LineClass,
    /// How many sheets hide it; zero is visible.
    pub invisibility: u32,
    /// Whether it is visible and part of the outer outline, where that was
    /// asked; else not.
    pub outline: bool,
    /// Ends in the view frame.
    pub points: [DVec2; 2],
    /// Depths of the two ends, world units.
    pub depth: [f64; 2],
    /// Index into [`VisibleLines::objects`].
    pub object: u32,
    /// Which edge or pair of faces.
    pub source: LineSource,
    /// Pieces with the same run lie on one exact straight line in the image
    /// and follow one another without a gap.
    pub run: u32,
}

impl LinePiece {
    /// Whether nothing hides the piece.
    pub fn is_visible(&self) -> bool {
        self.invisibility == 0
    }
}

/// All pieces of a view, coincident ones reduced to one, in an order that
/// depends on the scene alone.
#[derive(Debug, Clone, PartialEq)]
pub struct VisibleLines {
    /// The frame of all coordinates.
    pub frame: Frame,
    /// Names of the objects.
    pub objects: Vec<String>,
    /// The pieces.
    pub pieces: Vec<LinePiece>,
    /// What the computation counted.
    pub counters: Counters,
}
