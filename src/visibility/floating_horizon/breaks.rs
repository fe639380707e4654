//! Where pieces of a horizon end, and how such places lie to others.

use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Carrier, Cut, Points, Policy, Predicates};
use std::cell::Cell;
use std::cmp::Ordering;

/// The axis that points up, as cuts name it.
pub(super) const UP: u8 = 2;

/// A segment of the image, directed from left to right.
pub(super) type Segment = [u32; 2];

/// The end of a piece of a horizon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Break {
    /// The column of a vertex.
    Vertex(u32),
    /// Where two segments cross inside both.
    Crossing([Segment; 2]),
}

/// How many answers about columns are kept.
const KEPT: usize = 1 << 12;

/// What horizons ask.
///
/// Neighbouring sides ask the same of the same columns, for either horizon,
/// and where rows lie along columns, as squares do in an isometric view, that
/// is what floats cannot tell. So the last answers are kept.
#[derive(Debug)]
pub(super) struct Questions<'q, P: Policy> {
    pub(super) predicates: Predicates<'q, P>,
    /// Two vertices, the lesser first, and what there is to know of them.
    kept: Vec<Cell<([u32; 2], Sign)>>,
}

impl<'q, P: Policy> Questions<'q, P> {
    /// Nothing has been asked yet.
    pub(super) fn new(points: &'q Points) -> Self {
        let none = Cell::new(([u32::MAX; 2], Sign::Zero));
        Questions { predicates: Predicates::new(points), kept: vec![none; KEPT] }
    }

    /// On which side of the column of vertex `p` does vertex `q` lie?
    /// Positive is left.
    #[inline]
    fn column(&self, p: u32, q: u32) -> Sign {
        let pair = [p.min(q), p.max(q)];
        // Multipliers of Knuth's, for neighbours are to be kept apart.
        let mixed = pair[0].wrapping_mul(0x9e37_79b1) ^ pair[1].wrapping_mul(0x85eb_ca6b);
        let slot = &self.kept[(mixed >> 20) as usize % KEPT];
        let (kept, mut sign) = slot.get();
        if kept != pair {
            sign = self.predicates.column(pair[0], pair[1]);
            slot.set((pair, sign));
        }
        if p <= q { sign } else { -sign }
    }

    /// Whether a vertex lies above the line of a segment in its column.
    #[inline]
    pub(super) fn above(&self, segment: Segment, vertex: u32) -> Sign {
        if segment.contains(&vertex) {
            return Sign::Zero;
        }
        self.predicates.side(segment[0], segment[1], vertex)
    }

    /// Which of a break and a vertex is further to the left: less is the
    /// break.
    #[inline]
    pub(super) fn compare(&self, place: Break, vertex: u32) -> Ordering {
        match place {
            // Positive is left, and left is less.
            Break::Vertex(other) => (-self.column(vertex, other)).into(),
            Break::Crossing([first, second]) => {
                self.clearly(first, vertex).or_else(|| self.clearly(second, vertex)).unwrap_or_else(
                    || self.order(first, Cut::Silhouette(second), Cut::Vertex(vertex, UP)),
                )
            }
        }
    }

    /// Which of a point inside a segment and a vertex is further to the
    /// left, where the ends of the segment tell.
    fn clearly(&self, [left, right]: Segment, vertex: u32) -> Option<Ordering> {
        if self.column(vertex, right) != Sign::Negative {
            return Some(Ordering::Less);
        }
        (self.column(vertex, left) != Sign::Positive).then_some(Ordering::Greater)
    }

    /// Whether a break, a point of the horizon, lies above the line of a
    /// segment.
    pub(super) fn break_above(&self, segment: Segment, place: Break) -> Sign {
        let (first, second) = match place {
            Break::Vertex(vertex) => return self.above(segment, vertex),
            Break::Crossing([first, second]) => (first, second),
        };
        let [left, right] = first.map(|end| self.above(segment, end));
        if !left.is_opposite(right) {
            // The point lies strictly inside the first segment.
            return left.or(right);
        }
        match self.order(first, Cut::Silhouette(second), Cut::Silhouette(segment)) {
            Ordering::Less => left,
            Ordering::Equal => Sign::Zero,
            Ordering::Greater => right,
        }
    }

    /// The order of two cuts along a segment.
    pub(super) fn order(&self, [a, b]: [u32; 2], first: Cut, second: Cut) -> Ordering {
        let carrier = Carrier::edge(a, b);
        let values = |cut| carrier.ends.map(|end| self.predicates.value(cut, end));
        self.predicates.order(carrier, (first, &values(first)), (second, &values(second)))
    }
}
