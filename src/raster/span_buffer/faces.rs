//! Triangles as runs of samples.

use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Cut, Form, Lattice, Point, Points, Policy, Predicates};
use crate::model::View;
use crate::raster::Samples;
use crate::run::{Cancelled, Run, map_chunks};
use crate::view::LineQuestion;
use std::ops::Range;

/// Triangles per task.
const PART: usize = 4096;

/// A triangle that some sample may see.
#[derive(Debug, Clone)]
struct Face {
    triangle: u32,
    corners: [u32; 3],
    facing: Sign,
    /// Positive inside.
    sides: [Form; 3],
    nearness: Form,
    columns: Range<u32>,
    rows: Range<u32>,
    /// Whether the near plane cuts it.
    is_cut: bool,
}

/// Consecutive samples of a row that a face covers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) face: u32,
    pub(super) columns: Range<u32>,
}

/// All faces of a view over a grid of samples.
pub(super) struct Faces<'q> {
    question: &'q LineQuestion<'q>,
    points: Points,
    faces: Vec<Face>,
    /// The first sample among the points.
    first: u32,
    width: u32,
    height: u32,
}

/// Which faces may be met in which row.
pub(super) struct Rows {
    faces: Vec<Vec<u32>>,
}

impl Rows {
    pub(super) fn of(&self, row: u32) -> &[u32] {
        &self.faces[row as usize]
    }
}

impl<'q> Faces<'q> {
    pub(super) fn new<P: Policy>(
        view: &View,
        question: &'q LineQuestion<'q>,
        samples: &Samples,
        run: &Run,
    ) -> Result<Self, Cancelled> {
        let mesh = question.mesh;
        let first = mesh.vertices().len() as u32;
        let (width, height) = (samples.width(), samples.height());
        // Samples become vertices behind those of the mesh.
        let mut vertices = mesh.vertices().to_vec();
        vertices.extend(samples.points(0..height));
        let points = Points::new(&vertices, view.eye, view.near);
        let lattice = Lattice::new(&points, first, width, height);
        let count = mesh.triangles().len();
        let parts = run.stage("span-faces", count as u64, || {
            map_chunks(count, PART, |part| {
                run.check()?;
                let predicates = Predicates::<P>::new(&points);
                let units = part.len() as u64;
                let faces: Vec<Face> = part
                    .filter_map(|i| face(&predicates, &lattice, question, samples, i as u32))
                    .collect();
                run.merge(&predicates.counters());
                run.advance(units);
                Ok(faces)
            })
        });
        let mut faces = Vec::new();
        for part in parts {
            faces.extend(part?);
        }
        Ok(Faces { question, points, faces, first, width, height })
    }

    pub(super) fn len(&self) -> usize {
        self.faces.len()
    }

    pub(super) fn points(&self) -> &Points {
        &self.points
    }

    pub(super) fn question(&self) -> &LineQuestion<'q> {
        self.question
    }

    /// The triangle of the mesh.
    pub(super) fn triangle(&self, face: u32) -> u32 {
        self.faces[face as usize].triangle
    }

    /// Its corners and facing, as the predicates want them.
    pub(super) fn corners(&self, face: u32) -> ([u32; 3], Sign) {
        let face = &self.faces[face as usize];
        (face.corners, face.facing)
    }

    pub(super) fn nearness(&self, face: u32) -> &Form {
        &self.faces[face as usize].nearness
    }

    /// A sample's number among the points.
    pub(super) fn sample(&self, column: u32, row: u32) -> u32 {
        self.first + row * self.width + column
    }

    /// The faces of each row, each row in the order of `order`.
    pub(super) fn rows(&self, order: impl IntoIterator<Item = u32>) -> Rows {
        let mut faces = vec![Vec::new(); self.height as usize];
        for face in order {
            for row in self.faces[face as usize].rows.clone() {
                faces[row as usize].push(face);
            }
        }
        Rows { faces }
    }

    /// The runs of samples of a row that a face covers, borders included.
    pub(super) fn spans<P: Policy>(
        &self,
        predicates: &Predicates<'_, P>,
        face: u32,
        row: u32,
        mut found: impl FnMut(Range<u32>),
    ) {
        let face = &self.faces[face as usize];
        let mut maybe = face.columns.clone();
        for side in &face.sides {
            maybe = side.not_negative(maybe, row);
        }
        let mut surely = maybe.clone();
        for side in &face.sides {
            surely = side.positive(surely, row);
        }
        if face.is_cut {
            surely = maybe.start..maybe.start;
        }
        let mut start = None;
        let mut column = maybe.start;
        while column < maybe.end {
            let (inside, next) = if surely.contains(&column) {
                (true, surely.end)
            } else {
                (self.covers(predicates, face, column, row), column + 1)
            };
            match (inside, start) {
                (true, None) => start = Some(column),
                (false, Some(first)) => {
                    found(first..column);
                    start = None;
                }
                _ => {}
            }
            column = next;
        }
        if let Some(first) = start {
            found(first..maybe.end);
        }
    }

    /// Whether a sample's ray meets a face, for certain.
    fn covers<P: Policy>(
        &self,
        predicates: &Predicates<'_, P>,
        face: &Face,
        column: u32,
        row: u32,
    ) -> bool {
        let sample = self.sample(column, row);
        let [a, b, c] = face.corners;
        let inside = |side: &Form, p: u32, q: u32| {
            let sign = side.sign(column, row);
            sign.unwrap_or_else(|| predicates.side(p, q, sample) * face.facing) != Sign::Negative
        };
        let [first, second, third] = &face.sides;
        inside(first, a, b)
            && inside(second, b, c)
            && inside(third, c, a)
            && (!face.is_cut || predicates.meets_in_front(sample, face.corners, face.facing))
    }
}

/// A triangle as a face, unless no sample can see it.
fn face<P: Policy>(
    predicates: &Predicates<'_, P>,
    lattice: &Lattice,
    question: &LineQuestion,
    samples: &Samples,
    triangle: u32,
) -> Option<Face> {
    let facing = question.facing[triangle as usize];
    let corners = question.mesh.triangles()[triangle as usize];
    let [columns, rows] = samples.reached_by(question.coordinates.image_range(corners));
    if facing.is_zero() || columns.is_empty() || rows.is_empty() {
        return None;
    }
    let in_front = corners
        .map(|corner| predicates.value_sign(Cut::Near, Point::Vertex(corner)) == Sign::Positive);
    if in_front == [false; 3] {
        return None;
    }
    let [a, b, c] = corners;
    Some(Face {
        triangle,
        corners,
        facing,
        sides: [(a, b), (b, c), (c, a)]
            .map(|(p, q)| predicates.side_form(lattice, p, q).times(facing)),
        nearness: predicates.nearness_form(lattice, corners),
        columns,
        rows,
        is_cut: in_front != [true; 3],
    })
}
