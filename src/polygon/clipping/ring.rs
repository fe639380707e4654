//! Polygons whose corners are known by name: what clipping takes and gives.

use crate::kernel::predicates::{ImageLine, ImagePoint};

/// A corner of a ring and the line on which the ring goes on from there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Corner {
    /// Where it is.
    pub point: ImagePoint,
    /// The line through this corner and the next, directed that way.
    pub line: ImageLine,
}

impl Corner {
    /// The same corner where vertex 0 has another number, and so on.
    pub(super) fn shifted(self, by: u32) -> Self {
        self.renumbered(&|vertex| vertex + by)
    }

    /// The same corner where vertices have other numbers.
    pub(super) fn renumbered(self, number: &dyn Fn(u32) -> u32) -> Self {
        let line = |line| match line {
            ImageLine::Edge(ends) => ImageLine::Edge(ends.map(number)),
            ImageLine::Planes(faces) => ImageLine::Planes(faces.map(|face| face.map(number))),
            ImageLine::Near(face) => ImageLine::Near(face.map(number)),
        };
        let point = match self.point {
            ImagePoint::Vertex(vertex) => ImagePoint::Vertex(number(vertex)),
            ImagePoint::Crossing(lines) => ImagePoint::Crossing(lines.map(line)),
        };
        Corner { point, line: line(self.line) }
    }

    /// Calls `found` with all vertices that name this corner and its line.
    pub(super) fn vertices(&self, mut found: impl FnMut(u32)) {
        let mut of_line = |line: &ImageLine| match line {
            ImageLine::Edge(ends) => ends.iter().for_each(|&vertex| found(vertex)),
            ImageLine::Planes(faces) => faces.iter().flatten().for_each(|&vertex| found(vertex)),
            ImageLine::Near(face) => face.iter().for_each(|&vertex| found(vertex)),
        };
        of_line(&self.line);
        match &self.point {
            ImagePoint::Vertex(vertex) => found(*vertex),
            ImagePoint::Crossing(lines) => lines.iter().for_each(of_line),
        }
    }
}

/// A closed sequence of corners; the last is followed by the first.
pub type Ring = Vec<Corner>;

/// An outline with its holes.
///
/// As a result the outline runs counterclockwise and the holes clockwise, so
/// that the inside is on the left of all rings; no ring meets itself, rings
/// of a polygon meet in single points at most, and the inside is connected.
/// As an operand the first ring is the outline under
/// [`super::FillRule::Polygons`]; the other rules make no difference between
/// rings.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Polygon {
    /// The outline first, then the holes.
    pub rings: Vec<Ring>,
}

impl Polygon {
    /// The ring that runs around everything else, in a result.
    pub fn outline(&self) -> &[Corner] {
        self.rings.first().map_or(&[], Vec::as_slice)
    }

    /// The holes, in a result.
    pub fn holes(&self) -> &[Ring] {
        self.rings.get(1..).unwrap_or_default()
    }

    /// The polygon between vertices: each ring a list of their numbers.
    /// Vertices that follow one another at one place are no edge.
    pub fn of_vertices<R: AsRef<[u32]>>(rings: impl IntoIterator<Item = R>) -> Self {
        let ring = |vertices: &[u32]| {
            let next = vertices.iter().cycle().skip(1);
            let corner = |(&a, &b): (&u32, &u32)| Corner {
                point: ImagePoint::Vertex(a),
                line: ImageLine::Edge([a, b]),
            };
            vertices.iter().zip(next).map(corner).collect()
        };
        Polygon { rings: rings.into_iter().map(|vertices| ring(vertices.as_ref())).collect() }
    }
}
