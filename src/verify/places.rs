//! Places of lines: compared exactly, and located roughly for lengths and
//! pictures.

use crate::kernel::predicates::{Carrier, Cut, Measured, Place, Point, Policy, Predicates};
use crate::model::FeatureLine;
use crate::view::{ExactPiece, LineQuestion};
use glam::{DVec2, DVec3};
use std::cmp::Ordering;

/// Answers questions about the places of a question's lines.
pub(super) struct Places<'a, 'q, P: Policy> {
    question: &'a LineQuestion<'q>,
    predicates: Predicates<'q, P>,
}

impl<'a, 'q, P: Policy> Places<'a, 'q, P> {
    pub(super) fn new(question: &'a LineQuestion<'q>) -> Self {
        Places { question, predicates: Predicates::new(question.points) }
    }

    pub(super) fn question(&self) -> &'a LineQuestion<'q> {
        self.question
    }

    pub(super) fn predicates(&self) -> &Predicates<'q, P> {
        &self.predicates
    }

    pub(super) fn carrier(&self, line: usize) -> Carrier {
        self.question.carrier(&self.question.lines[line])
    }

    fn values(&self, carrier: Carrier, cut: Cut) -> [Measured; 2] {
        carrier.ends.map(|end| self.predicates.value(cut, end))
    }

    /// Whether a place is one of the line: an end, or a cut strictly
    /// between the ends.
    pub(super) fn is_on(&self, line: usize, place: Place) -> bool {
        let Place::Cut(cut) = place else {
            return true;
        };
        let [a, b] = self.values(self.carrier(line), cut);
        a.sign.is_opposite(b.sign)
    }

    /// Which of two places of a line comes first.
    pub(super) fn order(&self, line: usize, first: Place, second: Place) -> Ordering {
        match (first, second) {
            (Place::Start, Place::Start) | (Place::End, Place::End) => Ordering::Equal,
            (Place::Start, _) | (_, Place::End) => Ordering::Less,
            (_, Place::Start) | (Place::End, _) => Ordering::Greater,
            (Place::Cut(first), Place::Cut(second)) => {
                let carrier = self.carrier(line);
                let values = [first, second].map(|cut| self.values(carrier, cut));
                self.predicates.order(carrier, (first, &values[0]), (second, &values[1]))
            }
        }
    }

    /// Where a place lies, about, from 0 at the line's start to 1.
    pub(super) fn parameter(&self, line: usize, place: Place) -> f64 {
        match place {
            Place::Start => 0.0,
            Place::End => 1.0,
            Place::Cut(cut) => {
                let carrier = self.carrier(line);
                let values = self.values(carrier, cut);
                self.predicates.parameter(carrier, cut, &values)
            }
        }
    }

    /// A point in the coordinates before projection.
    fn point(&self, point: Point) -> DVec3 {
        let at = |vertex| self.question.coordinates.point(vertex);
        match point {
            Point::Vertex(vertex) => at(vertex),
            Point::Piercing(piercing) => {
                let [a, b] = piercing.edge;
                let (edge, cut) = (Carrier::edge(a, b), Cut::Face(piercing.face));
                let share = self.predicates.parameter(edge, cut, &self.values(edge, cut));
                at(a).lerp(at(b), share)
            }
        }
    }

    /// The ends of a line in the coordinates before projection.
    pub(super) fn ends_of(&self, line: &FeatureLine) -> [DVec3; 2] {
        self.question.carrier(line).ends.map(|end| self.point(end))
    }

    /// About where the image of a line is at a parameter.
    pub(super) fn image_at(&self, line: usize, parameter: f64) -> DVec2 {
        let [start, end] = self.ends_of(&self.question.lines[line]);
        let point = start.lerp(end, parameter);
        self.question.coordinates.project(point).0
    }

    /// The image of the part between two places.
    pub(super) fn span(&self, line: usize, places: [Place; 2]) -> [DVec2; 2] {
        places.map(|place| self.image_at(line, self.parameter(line, place)))
    }

    /// The image of what a line's pieces span; nothing if they are none.
    pub(super) fn whole(&self, line: usize, pieces: &[ExactPiece]) -> Vec<[DVec2; 2]> {
        match (pieces.first(), pieces.last()) {
            (Some(first), Some(last)) => vec![self.span(line, [first.from, last.to])],
            _ => Vec::new(),
        }
    }
}
