//! Rounding of exact places to the view frame.

use crate::kernel::predicates::{Carrier, Cut, Division, Place, Point, Policy, Predicates};
use crate::view::{ExactPiece, LineQuestion};
use glam::{DVec2, DVec3};

/// A piece with its exact and its rounded ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct RoundedPiece {
    /// Index of the line.
    pub(super) line: u32,
    pub(super) invisibility: u32,
    pub(super) outline: bool,
    /// The exact ends, on the line's own carrier.
    pub(super) places: [Place; 2],
    /// The ends in the image.
    pub(super) image: [DVec2; 2],
    /// Depths of the ends.
    pub(super) depth: [f64; 2],
    /// A bound of the error of `image`.
    pub(super) slack: f64,
    /// See `LinePiece::run`.
    pub(super) run: u32,
}

/// Appends the pieces of a line.
pub(super) fn round_line<P: Policy>(
    question: &LineQuestion<'_>,
    predicates: &Predicates<'_, P>,
    line: u32,
    exact: &[ExactPiece],
    pieces: &mut Vec<RoundedPiece>,
) {
    if exact.is_empty() {
        return;
    }
    let carrier = question.carrier(&question.lines[line as usize]);
    let ends = carrier.ends.map(|point| round_point(question, predicates, point));
    let division = predicates.division(carrier);
    let rounded = |place| {
        let point = match place {
            Place::Start => ends[0],
            Place::End => ends[1],
            Place::Cut(cut) => round_cut(predicates, (carrier, &division), cut, ends),
        };
        let (image, depth) = question.coordinates.project(point);
        Rounded { image, depth, slack: question.coordinates.image_slack(point) }
    };
    // Most pieces begin where the one before them ends.
    let mut last: Option<(Place, Rounded)> = None;
    for piece in exact {
        let from = match last {
            Some((place, known)) if place == piece.from => known,
            _ => rounded(piece.from),
        };
        let to = rounded(piece.to);
        last = Some((piece.to, to));
        pieces.push(RoundedPiece {
            line,
            invisibility: piece.invisibility,
            outline: piece.outline,
            places: [piece.from, piece.to],
            image: [from.image, to.image],
            depth: [from.depth, to.depth],
            slack: from.slack.max(to.slack),
            run: 0,
        });
    }
}

/// A place in the view frame.
#[derive(Clone, Copy)]
struct Rounded {
    image: DVec2,
    depth: f64,
    slack: f64,
}

/// A point along right, up and forward.
fn round_point<P: Policy>(
    question: &LineQuestion<'_>,
    predicates: &Predicates<'_, P>,
    point: Point,
) -> DVec3 {
    match point {
        Point::Vertex(vertex) => question.coordinates.point(vertex),
        Point::Piercing(piercing) => {
            // As the edge itself is rounded there.
            let [a, b] = piercing.edge;
            let edge = [a.min(b), a.max(b)];
            let carrier = Carrier::edge(edge[0], edge[1]);
            let ends = edge.map(|vertex| question.coordinates.point(vertex));
            let division = predicates.division(carrier);
            round_cut(predicates, (carrier, &division), Cut::Face(piercing.face), ends)
        }
    }
}

/// The place of a cut on a carrier with these rounded ends.
fn round_cut<P: Policy>(
    predicates: &Predicates<'_, P>,
    (carrier, division): (Carrier, &Division<'_>),
    cut: Cut,
    ends: [DVec3; 2],
) -> DVec3 {
    let values = carrier.ends.map(|point| predicates.value(cut, point));
    let parameter = division.parameter(cut, &values);
    // From the nearer end, so that a cut next to an end keeps its digits.
    if parameter <= 0.5 {
        ends[0] + (ends[1] - ends[0]) * parameter
    } else {
        ends[1] + (ends[0] - ends[1]) * (1.0 - parameter)
    }
}
