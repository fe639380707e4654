//! The judge: every line against every triangle (Roberts 1963, in exact
//! form). Slow, and short enough to be proved by reading.
//!
//! A triangle hides one interval of a segment from p to q: where the point
//! is behind its plane and inside its three silhouette planes. Each of
//! these is a linear functional f of the point, turned so that it is
//! positive where the triangle hides. With `A = f(p)` and `B = f(q)`:
//!
//! ```text
//!   A <= 0 and B <= 0   f hides nothing of the open segment
//!   A >= 0 and B >= 0   f hides all of it (one of them positive)
//!   A < 0 < B           f hides what comes after the cut A / (A - B)
//!   A > 0 > B           f hides what comes before it
//!   A = 0 = B           plane: the segment lies in the triangle's plane and
//!                       is not hidden. Edge: the images coincide, and the
//!                       triangle covers the one side of the segment's image
//!                       on which its third corner lies
//! ```
//!
//! The last row is the only one in which the two sides of a line differ.
//! The shadow is the intersection of the four half lines; the near plane
//! is a fifth functional that bounds the segment itself. Cuts are compared
//! exactly, never computed. A sweep along the line counts the shadows on
//! its left and on its right; the larger count is the invisibility.
//!
//! Edge-on triangles hide nothing. Zeros that follow from a common vertex
//! are read from the indices, not computed.
//!
//! O(lines x triangles) at worst; an image grid leaves out triangles whose
//! boxes do not meet the line's box.

#[cfg(test)]
mod brute_force;
mod image_grid;
#[cfg(test)]
mod tests;

use crate::kernel::numbers::{Filtered, Ring, Sign};
use crate::kernel::predicates::{Carrier, Cut, Measured, Place, Point, Policy, Predicates};
use crate::model::LineOrigin;
use crate::run::{Cancelled, Counters, Run, map_chunks};
use crate::view::{ExactLines, ExactPiece, LineQuestion};
use image_grid::ImageGrid;
use std::cmp::Ordering;

/// Lines per task.
const PART: usize = 64;

/// The pieces of the lines of a question, or of those with the indices in
/// `selection`, in its order.
///
/// A line that the eye sees end on, and one wholly behind the near plane,
/// has no pieces.
///
/// # Errors
///
/// If the run is cancelled.
pub fn roberts<P: Policy>(
    question: &LineQuestion,
    selection: Option<&[u32]>,
    run: &Run,
) -> Result<ExactLines, Cancelled> {
    let count = selection.map_or(question.lines.len(), <[u32]>::len);
    let parts = run.stage("roberts", count as u64, || {
        let grid = ImageGrid::new(question);
        map_chunks(count, PART, |part| {
            run.check()?;
            let mut judge = Judge::<P>::new(question, &grid);
            let mut lines = ExactLines::default();
            for i in part {
                run.check()?;
                run.advance(1);
                let line = selection.map_or(i, |list| list[i] as usize);
                lines.push_line(judge.line(line));
            }
            run.merge(&judge.predicates.counters());
            run.merge(&judge.counters);
            Ok(lines)
        })
    });
    let parts: Vec<ExactLines> = parts.into_iter().collect::<Result<_, Cancelled>>()?;
    Ok(ExactLines::concat(&parts))
}

/// A cut of the line at hand, with its functional at both ends.
#[derive(Debug, Clone, Copy)]
struct Mark {
    cut: Cut,
    values: [Measured; 2],
}

/// An open interval of a line. No mark: it begins or ends with the line.
#[derive(Debug, Clone, Copy, Default)]
struct Interval {
    from: Option<Mark>,
    to: Option<Mark>,
}

/// What one triangle hides of a line, on its left and on its right.
#[derive(Debug, Clone, Copy)]
struct Shadow {
    interval: Interval,
    sides: [bool; 2],
}

/// One worker: it reads the question and asks the predicates.
struct Judge<'a, 'q, P: Policy> {
    question: &'a LineQuestion<'q>,
    grid: &'a ImageGrid,
    predicates: Predicates<'q, P>,
    candidates: Vec<u32>,
    counters: Counters,
}

impl<'a, 'q, P: Policy> Judge<'a, 'q, P> {
    fn new(question: &'a LineQuestion<'q>, grid: &'a ImageGrid) -> Self {
        Judge {
            question,
            grid,
            predicates: Predicates::new(question.points),
            candidates: Vec::new(),
            counters: Counters::default(),
        }
    }

    /// The pieces of one line.
    fn line(&mut self, index: usize) -> Vec<ExactPiece> {
        let carrier = self.question.carrier(&self.question.lines[index]);
        if self.predicates.axis_across(carrier).is_none() {
            return Vec::new();
        }
        let Some(seen) = self.seen(carrier) else {
            return Vec::new();
        };
        self.candidates.clear();
        self.grid.candidates(self.question, index, &mut self.candidates);
        let own = self.own_triangles(index);
        let shadows: Vec<Shadow> = self
            .candidates
            .iter()
            .filter(|triangle| !own.contains(triangle))
            .filter_map(|&triangle| self.shadow(carrier, seen, triangle))
            .collect();
        self.counters.add("roberts-pairs", self.candidates.len() as u64);
        self.counters.add("roberts-shadows", shadows.len() as u64);
        let mut pieces = self.sweep(carrier, seen, &shadows);
        if !self.question.hidden_wanted {
            pieces.retain(|piece| piece.invisibility == 0);
        }
        pieces
    }

    /// The triangles of an intersection line: it lies in their planes. (Of
    /// an edge's own triangles the zeros of common vertices say so.)
    fn own_triangles(&self, index: usize) -> [u32; 2] {
        match self.question.lines[index].origin {
            LineOrigin::Intersection(i) => self.question.intersections[i as usize].triangles,
            _ => [u32::MAX; 2],
        }
    }

    /// The part of a line in front of the near plane, if any.
    fn seen(&self, carrier: Carrier) -> Option<Interval> {
        let mut seen = Interval::default();
        if self.question.points.has_near_plane() {
            let near = self.measure(carrier, Cut::Near);
            if !self.restrict(carrier, &mut seen, near, Sign::Positive) {
                return None;
            }
        }
        Some(seen)
    }

    /// What a triangle hides of the part `seen` of a line.
    fn shadow(&self, carrier: Carrier, seen: Interval, triangle: u32) -> Option<Shadow> {
        let facing = self.question.facing[triangle as usize];
        if facing.is_zero() {
            return None;
        }
        let corners = self.question.mesh.triangles()[triangle as usize];
        let mut shadow = Shadow { interval: seen, sides: [true; 2] };
        for i in 0..3 {
            let [a, b, third] = [0, 1, 2].map(|k| corners[(i + k) % 3]);
            // An edge is named by its vertices in ascending order, so that
            // the triangles at it make the same cut.
            let (edge, inside) = if a < b { ([a, b], facing) } else { ([b, a], -facing) };
            let mark = self.measure(carrier, Cut::Silhouette(edge));
            if mark.values.iter().all(|value| value.sign.is_zero()) {
                let left = self.predicates.image_side(carrier, third) == Sign::Positive;
                shadow.sides = [shadow.sides[0] && left, shadow.sides[1] && !left];
            } else if !self.restrict(carrier, &mut shadow.interval, mark, inside) {
                return None;
            }
        }
        // A point is behind where the plane's sign is that of the facing.
        let mark = self.measure(carrier, Cut::Face(corners));
        self.restrict(carrier, &mut shadow.interval, mark, facing).then_some(shadow)
    }

    /// Takes from `interval` what lies where the functional does not have
    /// the sign `wanted`; says whether anything is left.
    fn restrict(
        &self,
        carrier: Carrier,
        interval: &mut Interval,
        mark: Mark,
        wanted: Sign,
    ) -> bool {
        let [start, end] = mark.values.map(|value| value.sign * wanted);
        match (start, end) {
            (Sign::Negative | Sign::Zero, Sign::Negative | Sign::Zero) => return false,
            (Sign::Negative, Sign::Positive) => {
                if self.is_earlier(carrier, interval.from, mark) {
                    interval.from = Some(mark);
                }
            }
            (Sign::Positive, Sign::Negative) => {
                if self.is_later(carrier, interval.to, mark) {
                    interval.to = Some(mark);
                }
            }
            (Sign::Zero | Sign::Positive, Sign::Zero | Sign::Positive) => return true,
        }
        match (interval.from, interval.to) {
            (Some(from), Some(to)) => self.order(carrier, &from, &to) == Ordering::Less,
            // A cut lies strictly between the ends of the line.
            _ => true,
        }
    }

    /// Whether a beginning lies before `mark`.
    fn is_earlier(&self, carrier: Carrier, from: Option<Mark>, mark: Mark) -> bool {
        from.is_none_or(|from| self.order(carrier, &from, &mark) == Ordering::Less)
    }

    /// Whether an end lies after `mark`.
    fn is_later(&self, carrier: Carrier, to: Option<Mark>, mark: Mark) -> bool {
        to.is_none_or(|to| self.order(carrier, &mark, &to) == Ordering::Less)
    }

    /// Which of two cuts comes first along the line.
    fn order(&self, carrier: Carrier, first: &Mark, second: &Mark) -> Ordering {
        self.predicates.order(carrier, (first.cut, &first.values), (second.cut, &second.values))
    }

    /// A cut's functional at both ends of the line.
    fn measure(&self, carrier: Carrier, cut: Cut) -> Mark {
        let values = carrier.ends.map(|end| {
            if lies_on(cut, end) {
                Measured { sign: Sign::Zero, value: Filtered::read(0.0, 0) }
            } else {
                self.predicates.value(cut, end)
            }
        });
        Mark { cut, values }
    }

    /// Maximal pieces of constant invisibility of the part `seen`.
    fn sweep(&self, carrier: Carrier, seen: Interval, shadows: &[Shadow]) -> Vec<ExactPiece> {
        let mut count = [0_i32; 2];
        let mut events = Vec::with_capacity(2 * shadows.len() + 2);
        for Shadow { interval, sides } in shadows {
            let change = sides.map(i32::from);
            match interval.from {
                Some(mark) => events.push((mark, change)),
                None => count = add(count, change),
            }
            if let Some(mark) = interval.to {
                events.push((mark, change.map(|sheets| -sheets)));
            }
        }
        self.sort(carrier, &mut events);
        // The part's own ends stand first among equals, and name the place.
        if let Some(mark) = seen.from {
            events.insert(0, (mark, [0; 2]));
        }
        if let Some(mark) = seen.to {
            let equal =
                |event: &&(Mark, [i32; 2])| self.order(carrier, &event.0, &mark) == Ordering::Equal;
            let last = events.iter().rev().take_while(equal).count();
            events.insert(events.len() - last, (mark, [0; 2]));
        }
        let mut pieces = Vec::new();
        let mut from = seen.from.is_none().then_some(Place::Start);
        let mut rest = &events[..];
        while let Some(&(mark, _)) = rest.first() {
            let place = Place::Cut(mark.cut);
            if let Some(from) = from {
                push(&mut pieces, from, place, count);
            }
            from = Some(place);
            let equal =
                |event: &&(Mark, [i32; 2])| self.order(carrier, &mark, &event.0) == Ordering::Equal;
            let (now, later) = rest.split_at(rest.iter().take_while(equal).count().max(1));
            count = now.iter().fold(count, |sum, event| add(sum, event.1));
            rest = later;
        }
        if let (Some(from), None) = (from, seen.to) {
            push(&mut pieces, from, Place::End, count);
        }
        pieces
    }

    /// Sorts events along the line: floats propose an order, exact
    /// comparisons of neighbours make it true (an insertion sort, which
    /// stops whatever an inexact policy answers).
    fn sort(&self, carrier: Carrier, events: &mut [(Mark, [i32; 2])]) {
        events.sort_by(|a, b| rough_place(&a.0).total_cmp(&rough_place(&b.0)));
        for i in 1..events.len() {
            let mut k = i;
            while k > 0 && self.order(carrier, &events[k].0, &events[k - 1].0) == Ordering::Less {
                events.swap(k, k - 1);
                k -= 1;
            }
        }
    }
}

/// Whether an end of a line lies on a cut's plane because the same vertices
/// define both.
fn lies_on(cut: Cut, end: Point) -> bool {
    match (cut, end) {
        (Cut::Face(face), Point::Vertex(vertex)) => face.contains(&vertex),
        (Cut::Face(face), Point::Piercing(piercing)) => {
            let within = |corners: &[u32]| corners.iter().all(|corner| face.contains(corner));
            within(&piercing.face) || within(&piercing.edge)
        }
        (Cut::Silhouette(edge), Point::Vertex(vertex)) => edge.contains(&vertex),
        (Cut::Silhouette(edge), Point::Piercing(piercing)) => {
            piercing.edge.iter().all(|vertex| edge.contains(vertex))
        }
        (Cut::Vertex(..) | Cut::Near | Cut::NearLine(_), _) => false,
    }
}

/// About where a cut lies, for a first guess of the order.
fn rough_place(mark: &Mark) -> f64 {
    let [a, b] = mark.values.map(|measured| measured.value.value());
    a / (a - b)
}

/// Adds the changes of both sides.
fn add(count: [i32; 2], change: [i32; 2]) -> [i32; 2] {
    [count[0] + change[0], count[1] + change[1]]
}

/// Appends a piece, or lengthens the last one if nothing changes.
fn push(pieces: &mut Vec<ExactPiece>, from: Place, to: Place, [left, right]: [i32; 2]) {
    let invisibility = left.max(right).max(0) as u32;
    match pieces.last_mut() {
        Some(last) if last.invisibility == invisibility => last.to = to,
        _ => pieces.push(ExactPiece { from, to, invisibility, outline: false }),
    }
}
