//! Kinds of lines.

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
