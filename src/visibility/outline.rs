//! The outer outline: where a visible line parts the picture from the empty
//! background.
//!
//! Technical and patent drawings give the outline of a thing a heavier line
//! than what lies within it. A point of a visible line is on the outline iff
//! beside it, in the image, one side is empty and the other is not: it is on
//! the border of the union of the images of all sheets, nearer and farther
//! ones alike. So a hole through which the background is seen has an
//! outline too, while a wire in the open, both sides of which are empty,
//! and a sheet seen from its edge have none. Of single objects the same is
//! asked of their own sheets.
//!
//! Appel (1967) counts the sheets in front of a line; here all are counted,
//! and so depth drops out of his method:
//!
//! 1. A triangle covers the beginning of a line on one side iff it lies on
//!    the inner side of its three edges there (the germ rule and the side
//!    rule of the first count, without the plane).
//! 2. Along the line that changes where the image crosses that of an
//!    effective edge, in front or behind. Where both cross in one direction
//!    from the eye and not in opposite ones, going along the line to the left
//!    of the edge is going along the edge to the right of the line.
//! 3. Visible pieces are cut where one of the two counts comes to zero or
//!    leaves it, exactly as all pieces are cut where they are hidden.
//!
//! What is beside a line belongs to the place in the image, so lines that
//! lie on one another agree. Edges with sheets of their own on both sides,
//! most of them, are passed over.
//!
//! Expected O(log n + k log k) for a line with k edges across its image.

use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{
    Carrier, Cut, Measured, Place, Point, Policy, Predicates, sort_by_predicates,
};
use crate::model::{FeatureLine, LineOrigin};
use crate::run::{Cancelled, Counters, Run, map_chunks};
use crate::spatial::{Crossings, Hierarchy};
use crate::view::{ExactLines, ExactPiece, LineQuestion, OutlineOf, ProbedLine};
use std::cmp::Ordering;

/// Lines that one task looks at.
const PART: usize = 256;

/// The pieces of an answer, visible ones cut where they come to the outline
/// or leave it and told apart by [`ExactPiece::outline`].
///
/// # Errors
///
/// If the run is cancelled.
pub fn outlined<P: Policy>(
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    of: OutlineOf,
    run: &Run<'_>,
) -> Result<ExactLines, Cancelled> {
    let triangles = question.hierarchy();
    run.check()?;
    let parts = run.stage("outline", answer.len() as u64, || {
        let effective = question.effective_crossings();
        map_chunks(answer.len(), PART, |part| {
            run.check()?;
            let predicates = Predicates::<P>::new(question.points);
            let mut seeker =
                Seeker { question, effective: &effective, triangles, of, predicates, crossed: 0 };
            let mut lines = ExactLines::default();
            for line in part {
                run.check()?;
                run.advance(1);
                lines.push_line(seeker.line(&question.lines[line], answer.line(line)));
            }
            run.merge(&seeker.counters());
            run.hold(seeker.crossed)?;
            Ok(lines)
        })
    });
    let parts: Vec<ExactLines> = parts.into_iter().collect::<Result<_, Cancelled>>()?;
    Ok(ExactLines::concat(&parts))
}

/// Numbers of sheets over the left and the right side of a line.
type Sides = [i32; 2];

/// A line as it is looked along: from an end in front of the near plane.
struct Way {
    carrier: Carrier,
    /// Where it may be, at any depth.
    probed: ProbedLine,
    /// The only object whose sheets count, if not all do.
    object: Option<u32>,
    /// Whether the way goes from the line's end to its start.
    backwards: bool,
}

/// Where something changes along a line.
#[derive(Debug, Clone, Copy)]
struct Change<T> {
    cut: Cut,
    values: [Measured; 2],
    to: T,
}

/// One worker.
struct Seeker<'a, 'q, P: Policy> {
    question: &'a LineQuestion<'q>,
    effective: &'a Crossings,
    /// View boxes of all triangles.
    triangles: &'a Hierarchy,
    of: OutlineOf,
    predicates: Predicates<'q, P>,
    crossed: u64,
}

impl<P: Policy> Seeker<'_, '_, P> {
    /// The pieces of one line.
    fn line(&mut self, line: &FeatureLine, pieces: &[ExactPiece]) -> Vec<ExactPiece> {
        let inner = || pieces.iter().map(|piece| ExactPiece { outline: false, ..*piece }).collect();
        if pieces.iter().all(|piece| 0 < piece.invisibility) || self.is_within_own(line) {
            return inner();
        }
        let Some(way) = self.way(line) else {
            return inner();
        };
        let first = self.covers_of_start(&way);
        let changes = self.changes(&way);
        self.crossed += changes.len() as u64;
        let turns = self.turns(&way, first, changes);
        let mut result = Vec::with_capacity(pieces.len() + turns.len());
        let turned = |piece: &ExactPiece| if way.backwards { turn(*piece) } else { *piece };
        let mut cut =
            |piece: ExactPiece| self.cut(&way, is_outer(first), &turns, piece, &mut result);
        match way.backwards {
            false => pieces.iter().map(turned).for_each(&mut cut),
            true => pieces.iter().rev().map(turned).for_each(&mut cut),
        }
        if way.backwards {
            result.reverse();
            result.iter_mut().for_each(|piece| *piece = turn(*piece));
        }
        result
    }

    /// Whether an edge has faces of its own on both sides: all along it
    /// neither side is empty.
    fn is_within_own(&self, line: &FeatureLine) -> bool {
        let LineOrigin::Edge(edge) = line.origin else {
            return false;
        };
        let [a, b] = self.question.mesh.edges().ends(edge);
        let mut sides = [false; 2];
        for &triangle in self.question.mesh.edges().triangles(edge) {
            let corners = self.question.mesh.triangles()[triangle as usize];
            if self.question.facing[triangle as usize].is_zero() {
                continue;
            }
            for third in corners.into_iter().filter(|corner| ![a, b].contains(corner)) {
                let left = self.predicates.side(a, b, third) == Sign::Positive;
                sides[usize::from(!left)] = true;
            }
        }
        sides == [true; 2]
    }

    /// The way along a line, if some of it is in front of the near plane
    /// and has sheets to be outlined.
    fn way(&self, line: &FeatureLine) -> Option<Way> {
        let question = self.question;
        let carrier = question.carrier(line);
        let object = match (self.of, line.origin) {
            (OutlineOf::Scene, _) => None,
            (
                OutlineOf::Objects,
                LineOrigin::Edge(_) | LineOrigin::Stretch(_) | LineOrigin::Loose(_),
            ) => Some(question.source(line).0),
            // Within two faces; where it runs along a border of one of them,
            // that is a line too.
            (OutlineOf::Objects, LineOrigin::Intersection(_)) => return None,
        };
        let probed = question.probe(&self.predicates, line).of_any_depth();
        let backwards = question.points.has_near_plane()
            && self.predicates.value_sign(Cut::Near, carrier.ends[0]) != Sign::Positive;
        let carrier = if backwards { carrier.reversed() } else { carrier };
        if backwards && self.predicates.value_sign(Cut::Near, carrier.ends[0]) != Sign::Positive {
            return None;
        }
        let probed = if backwards { probed.turned() } else { probed };
        Some(Way { carrier, probed, object, backwards })
    }

    /// How many sheets are over the two sides of the beginning of a way.
    fn covers_of_start(&self, way: &Way) -> Sides {
        let mut sum = [0; 2];
        self.triangles.visit(
            |group| group.hiding(&way.probed.ends[0]),
            |triangle| {
                let covers = self.covers_start(way, triangle);
                sum = [0, 1].map(|side| sum[side] + i32::from(covers[side]));
            },
        );
        sum
    }

    /// Whether a triangle is over the left and the right side of the
    /// beginning of a way.
    fn covers_start(&self, way: &Way, triangle: u32) -> [bool; 2] {
        let facing = self.question.facing[triangle as usize];
        let foreign = |own| own != self.question.mesh.object_of_triangle(triangle);
        if facing.is_zero() || way.object.is_some_and(foreign) {
            return [false; 2];
        }
        let corners = self.question.mesh.triangles()[triangle as usize];
        let mut covers = [true; 2];
        for i in 0..3 {
            let [a, b, third] = [0, 1, 2].map(|k| corners[(i + k) % 3]);
            let [start, end] = way.carrier.ends;
            let sign = match self.side_of([a, b], start) {
                Sign::Zero => self.side_of([a, b], end),
                sign => sign,
            };
            if sign.is_zero() {
                let left = self.predicates.image_side(way.carrier, third) == Sign::Positive;
                covers = [covers[0] && left, covers[1] && !left];
            } else if sign != facing {
                return [false; 2];
            }
        }
        covers
    }

    /// On which side of an edge a point lies in the image; zero by identity
    /// at its ends.
    fn side_of(&self, edge: [u32; 2], point: Point) -> Sign {
        match point {
            Point::Vertex(vertex) if edge.contains(&vertex) => Sign::Zero,
            _ => self.predicates.value_sign(Cut::Silhouette(edge), point),
        }
    }

    /// How the counts change along a way, in its order.
    fn changes(&self, way: &Way) -> Vec<Change<Sides>> {
        let mut changes = Vec::new();
        self.effective
            .candidates(&way.probed.probe, |index| changes.extend(self.change(way, index)));
        sort_by_predicates::<P, _>(&mut changes, |a, b| self.order(way.carrier, a, b));
        changes
    }

    /// The change at an effective edge, if the images cross.
    fn change(&self, way: &Way, index: u32) -> Option<Change<Sides>> {
        let effective = self.question.effective[index as usize];
        let edge = self.question.mesh.edges().ends(effective.edge);
        let foreign = |own| own != self.question.mesh.object_of_vertex(edge[0]);
        if way.object.is_some_and(foreign) {
            return None;
        }
        let is_own = |end| matches!(end, Point::Vertex(vertex) if edge.contains(&vertex));
        if way.carrier.ends.into_iter().any(is_own) {
            return None;
        }
        let cut = Cut::Silhouette(edge);
        let values = way.carrier.ends.map(|end| self.predicates.value(cut, end));
        let [first, last] = values.map(|value| value.sign);
        if !first.is_opposite(last) {
            return None;
        }
        let sides = edge.map(|vertex| self.predicates.image_side(way.carrier, vertex));
        let onward = if sides[1].is_zero() { -sides[0] } else { sides[1] };
        if sides[0] == sides[1] || !onward.is_opposite(last) {
            return None;
        }
        // From the left of the edge to its right the line gains sheets. An end
        // of the edge on the line lies to the right of its left side.
        let gain = effective.gain * first.to_i32();
        let met = |aside| {
            let [a, b] = sides.map(|side| side.or(aside));
            if a == b { 0 } else { gain }
        };
        Some(Change { cut, values, to: [met(Sign::Negative), met(Sign::Positive)] })
    }

    /// Where a way comes to the outline (true) or leaves it.
    fn turns(&self, way: &Way, first: Sides, changes: Vec<Change<Sides>>) -> Vec<Change<bool>> {
        let mut turns = Vec::new();
        let mut sum = first;
        let equal = |a: &Change<Sides>, b: &Change<Sides>| self.order(way.carrier, a, b).is_eq();
        for group in changes.chunk_by(equal) {
            let before = is_outer(sum);
            for change in group {
                sum = [0, 1].map(|side| sum[side] + change.to[side]);
            }
            if is_outer(sum) != before {
                let Change { cut, values, .. } = group[0];
                turns.push(Change { cut, values, to: !before });
            }
        }
        turns
    }

    /// Appends the parts of a piece between turns.
    fn cut(
        &self,
        way: &Way,
        first: bool,
        turns: &[Change<bool>],
        piece: ExactPiece,
        parts: &mut Vec<ExactPiece>,
    ) {
        if 0 < piece.invisibility {
            parts.push(ExactPiece { outline: false, ..piece });
            return;
        }
        let before = |place: Place, orders: [Ordering; 2]| {
            let (start, end) = match place {
                Place::Start => return 0,
                Place::End => return turns.len(),
                Place::Cut(cut) => (cut, way.carrier.ends.map(|p| self.predicates.value(cut, p))),
            };
            let place = Change { cut: start, values: end, to: () };
            turns.partition_point(|turn| orders.contains(&self.order(way.carrier, turn, &place)))
        };
        let begin = before(piece.from, [Ordering::Less, Ordering::Equal]);
        let end = before(piece.to, [Ordering::Less; 2]).max(begin);
        let mut outline = if begin == 0 { first } else { turns[begin - 1].to };
        let mut from = piece.from;
        for turn in &turns[begin..end] {
            let to = Place::Cut(turn.cut);
            parts.push(ExactPiece { from, to, outline, ..piece });
            (from, outline) = (to, turn.to);
        }
        parts.push(ExactPiece { from, outline, ..piece });
    }

    fn order<S, T>(&self, carrier: Carrier, a: &Change<S>, b: &Change<T>) -> Ordering {
        self.predicates.order(carrier, (a.cut, &a.values), (b.cut, &b.values))
    }

    fn counters(&self) -> Counters {
        let mut counters = self.predicates.counters();
        counters.add("outline-crossings", self.crossed);
        counters
    }
}

/// Whether one side is empty and the other is not.
fn is_outer([left, right]: Sides) -> bool {
    (left == 0) != (right == 0)
}

/// The same piece of the line walked the other way.
fn turn(piece: ExactPiece) -> ExactPiece {
    let turned = |place| match place {
        Place::Start => Place::End,
        Place::End => Place::Start,
        Place::Cut(cut) => Place::Cut(cut),
    };
    ExactPiece { from: turned(piece.to), to: turned(piece.from), ..piece }
}
