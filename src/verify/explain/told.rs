//! What is told of a place in a drawing.
//!
//! Objects are numbers into [`VisibleLines::objects`]. Vertices and faces are
//! numbered as in JSON drawings, from 0: vertices in the order of their file,
//! faces in the order of their object.
//!
//! [`VisibleLines::objects`]: crate::view::VisibleLines::objects

use crate::kernel::predicates::Probe;
use crate::model::LineClass;
use crate::view::LineSource;
use glam::DVec2;

/// What there is at a point of the image.
#[derive(Debug, Clone, PartialEq)]
pub struct Explanation {
    /// The piece of the drawing that is nearest to the point; nothing if the
    /// drawing is empty.
    pub line: Option<LineThere>,
    /// The triangles whose image has the point, nearest to the eye first.
    pub faces: Vec<FaceThere>,
}

/// A piece of a drawing, and why it is as visible as it is.
#[derive(Debug, Clone, PartialEq)]
pub struct LineThere {
    /// Index of the piece of the drawing.
    pub drawn: usize,
    /// Index of its line in the question.
    pub line: u32,
    /// Which piece of the line's answer it is part of.
    pub piece: usize,
    /// How far it is from the point that was asked about, in the image.
    pub distance: f64,
    /// Where it is nearest to that point, in the view frame.
    pub image: DVec2,
    /// Its depth there, world units.
    pub depth: f64,
    /// The exact point of the line, strictly inside the piece of the answer
    /// and about where `image` is, at which faces were asked what they hide.
    pub probe: Probe,
    /// The ends of the piece of the answer, in the sense of the line.
    pub ends: [EndThere; 2],
    /// Of an intersection line the two faces that it is common to.
    pub faces: Option<[FaceThere; 2]>,
    /// The faces that hide the point: as many as the piece's invisibility.
    pub hidden_by: Vec<FaceThere>,
    /// Beside which side of the line these were counted.
    pub side: Side,
    /// Other lines that lie on this one in the picture, at that very point,
    /// and of which the drawing shows nothing there.
    pub coincident: Vec<CoincidentLine>,
}

/// A triangle in front of something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceThere {
    /// Index of the triangle in the mesh.
    pub triangle: u32,
    /// Its object.
    pub object: u32,
    /// The face that it is, or is part of.
    pub face: u32,
    /// The triangle's vertices.
    pub vertices: [u32; 3],
    /// The depth of its plane behind the point of the image, world units,
    /// rounded.
    pub depth: f64,
}

/// On which side of a line in the picture, walking along it, the greater
/// number of faces hides it. Infinitely near to the line the two sides differ
/// where it lies exactly behind the edge of a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The same faces hide it on both sides.
    Both,
    /// On the left, or as many others on the right.
    Left,
    /// On the right.
    Right,
}

/// An end of a piece on which the invisibility does not change.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EndThere {
    /// Where it is in the view frame.
    pub image: DVec2,
    /// Its depth, world units.
    pub depth: f64,
    /// What is there.
    pub cause: EndCause,
    /// By how many faces the line is hidden beyond; nothing where the line
    /// ends, or the answer has no piece.
    pub beyond: Option<u32>,
}

/// What a piece of a line ends at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EndCause {
    /// A vertex, where the line ends.
    Vertex {
        /// Its object.
        object: u32,
        /// Its number.
        vertex: u32,
    },
    /// A point in which an edge goes through a face, where the line ends.
    Piercing {
        /// The edge's object.
        object: u32,
        /// The edge's vertices.
        edge: [u32; 2],
    },
    /// The image of an edge: the line goes behind the edge's faces there, or
    /// comes out from behind them.
    Edge {
        /// The edge's object.
        object: u32,
        /// Its vertices.
        edge: [u32; 2],
    },
    /// A face that the line goes through.
    Face {
        /// The face's object.
        object: u32,
        /// Vertices of the face that are no line.
        vertices: [u32; 3],
    },
    /// The near plane.
    NearPlane,
}

/// A line that lies on another one in the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoincidentLine {
    /// Index of the line in the question.
    pub line: u32,
    /// What it is.
    pub class: LineClass,
    /// Its object.
    pub object: u32,
    /// Which edge or pair of faces.
    pub source: LineSource,
    /// How many faces hide it there.
    pub invisibility: u32,
}
