//! The answer of a line method: pieces of lines with constant invisibility.

use super::Frame;
use crate::run::Counters;
use glam::DVec2;

/// What makes an edge a line. The order is the order of precedence where
/// one edge is several things.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum LineClass {
    /// Two faces on one side of the edge's image: the outline of a surface.
    Contour,
    /// One face only: the border of an open surface.
    Boundary,
    /// Three faces or more.
    NonManifold,
    /// Two faces that meet at a fold sharper than the threshold.
    Crease,
    /// Where two faces pass through one another.
    Intersection,
    /// A loose line of the model (OBJ `l`).
    Line,
    /// Any other edge of a face.
    Mesh,
}

impl LineClass {
    /// All classes, in order of precedence.
    pub const ALL: [LineClass; 7] = [
        LineClass::Contour,
        LineClass::Boundary,
        LineClass::NonManifold,
        LineClass::Crease,
        LineClass::Intersection,
        LineClass::Line,
        LineClass::Mesh,
    ];

    /// The name in flags, layers and JSON.
    pub fn name(self) -> &'static str {
        match self {
            LineClass::Contour => "contour",
            LineClass::Boundary => "boundary",
            LineClass::NonManifold => "non-manifold",
            LineClass::Crease => "crease",
            LineClass::Intersection => "intersection",
            LineClass::Line => "line",
            LineClass::Mesh => "mesh",
        }
    }

    /// The class called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|class| class.name() == name)
    }
}

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
