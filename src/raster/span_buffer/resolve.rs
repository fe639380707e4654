//! Which of several equal spans is seen, and where another takes over.

use super::Compare;
use super::faces::{Faces, Span};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Policy, Predicates};
use crate::raster::item_buffer::tie_order;
use std::cmp::Ordering;
use std::ops::Range;

/// Decides about groups of equal spans; one per worker.
pub(super) struct Resolver<'f, 'p, P: Policy> {
    faces: &'f Faces<'f>,
    predicates: &'p Predicates<'p, P>,
    compare: Compare,
    crossings: u64,
    /// What is nearest so far, from left to right, and the next such list.
    nearest: Vec<Span>,
    next: Vec<Span>,
}

impl<'f, 'p, P: Policy> Resolver<'f, 'p, P> {
    pub(super) fn new(
        faces: &'f Faces<'f>,
        predicates: &'p Predicates<'p, P>,
        compare: Compare,
    ) -> Self {
        let (nearest, next) = (Vec::new(), Vec::new());
        Resolver { faces, predicates, compare, crossings: 0, nearest, next }
    }

    pub(super) fn predicates(&self) -> &'p Predicates<'p, P> {
        self.predicates
    }

    /// How often two spans of a group were cut where they cross.
    pub(super) fn crossings(&self) -> u64 {
        self.crossings
    }

    /// The nearest of the faces of a group over some columns of a row, all
    /// of which all of them cover: pieces from left to right.
    pub(super) fn nearest(&mut self, group: &[Span], columns: Range<u32>, row: u32) -> &[Span] {
        self.nearest.clear();
        if self.compare != Compare::Crossings {
            let at = match self.compare {
                Compare::Start => columns.start,
                _ => columns.start + (columns.end - columns.start) / 2,
            };
            let wins = |best: u32, face: u32| {
                if self.is_nearer(face, best, at, row) { face } else { best }
            };
            let best = group.iter().map(|span| span.face).reduce(wins);
            self.nearest.extend(best.map(|face| Span { face, columns }));
            return &self.nearest;
        }
        let Some((first, rest)) = group.split_first() else {
            return &[];
        };
        self.nearest.push(Span { face: first.face, columns });
        for span in rest {
            let mut next = std::mem::take(&mut self.next);
            for piece in std::mem::take(&mut self.nearest) {
                self.cut(piece, span.face, row, &mut next);
            }
            self.nearest = next;
        }
        &self.nearest
    }

    /// Cuts a piece where `face` comes before it or falls behind it: where
    /// the difference of their nearnesses changes its sign.
    fn cut(&mut self, piece: Span, face: u32, row: u32, out: &mut Vec<Span>) {
        let difference = self.faces.nearness(face).minus(self.faces.nearness(piece.face));
        let columns = piece.columns;
        let nearer = difference.positive(columns.clone(), row);
        if nearer == columns {
            return push(out, face, columns);
        }
        let farther = difference.times(Sign::Negative).positive(columns.clone(), row);
        if farther == columns {
            return push(out, piece.face, columns);
        }
        if nearer.is_empty() && farther.is_empty() && self.are_coplanar(face, piece.face) {
            return push(out, self.lesser(face, piece.face), columns);
        }
        let before = out.len();
        let mut column = columns.start;
        while column < columns.end {
            let (winner, end) = if nearer.contains(&column) {
                (face, nearer.end)
            } else if farther.contains(&column) {
                (piece.face, farther.end)
            } else if self.is_nearer(face, piece.face, column, row) {
                (face, column + 1)
            } else {
                (piece.face, column + 1)
            };
            push(out, winner, column..end);
            column = end;
        }
        self.crossings += (out.len() - before).saturating_sub(1) as u64;
    }

    /// Whether face `s` owns a sample rather than face `t`, both of which
    /// cover it.
    fn is_nearer(&self, s: u32, t: u32, column: u32, row: u32) -> bool {
        let difference = self.faces.nearness(s).minus(self.faces.nearness(t));
        let sign = difference.sign(column, row).unwrap_or_else(|| {
            let sample = self.faces.sample(column, row);
            self.predicates.nearer(sample, self.faces.corners(s), self.faces.corners(t))
        });
        match sign {
            Sign::Positive => true,
            Sign::Negative => false,
            Sign::Zero => self.lesser(s, t) == s,
        }
    }

    /// Which of two equally near faces owns a sample.
    fn lesser(&self, s: u32, t: u32) -> u32 {
        let [a, b] = [s, t].map(|face| self.faces.triangle(face));
        if tie_order(self.faces.question().mesh, a, b) == Ordering::Less { s } else { t }
    }

    /// Whether two faces lie in one plane.
    fn are_coplanar(&self, s: u32, t: u32) -> bool {
        let plane = self.faces.corners(s).0;
        let corners = self.faces.corners(t).0;
        corners.iter().all(|&x| plane.contains(&x) || self.predicates.plane(plane, x).is_zero())
    }
}

/// Appends a piece, or lengthens the last one if it is of the same face.
fn push(out: &mut Vec<Span>, face: u32, columns: Range<u32>) {
    match out.last_mut() {
        Some(last) if last.face == face && last.columns.end == columns.start => {
            last.columns.end = columns.end;
        }
        _ => out.push(Span { face, columns }),
    }
}
