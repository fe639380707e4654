//! Which of several equal spans is seen, and where another takes over.

use super::runs::turn;
use super::{Compare, Span};
use crate::kernel::predicates::Policy;
use crate::raster::samples::{Face, Judge};
use std::ops::Range;

/// Decides about groups of equal spans; one per worker.
pub(super) struct Resolver<'f, P: Policy> {
    faces: &'f [Face],
    judge: Judge<'f, P>,
    compare: Compare,
    crossings: u64,
    /// What is nearest so far, from left to right.
    nearest: Vec<Span>,
}

impl<'f, P: Policy> Resolver<'f, P> {
    pub(super) fn new(faces: &'f [Face], judge: Judge<'f, P>, compare: Compare) -> Self {
        Resolver { faces, judge, compare, crossings: 0, nearest: Vec::new() }
    }

    pub(super) fn judge(&self) -> &Judge<'f, P> {
        &self.judge
    }

    /// How often two spans of a group were cut where they cross.
    pub(super) fn crossings(&self) -> u64 {
        self.crossings
    }

    /// The nearest of the faces of a group over some columns of a row, all
    /// of which all of them cover: pieces from left to right.
    pub(super) fn nearest(&mut self, group: &[Span], columns: Range<u32>, row: u32) -> &[Span] {
        self.nearest.clear();
        let at = match self.compare {
            Compare::Crossings => {
                for span in group {
                    self.insert(span.face, &columns, row);
                }
                return &self.nearest;
            }
            Compare::Start => columns.start,
            Compare::Middle => columns.start + (columns.end - columns.start) / 2,
        };
        let nearer = |best, face| if self.beats(face, best, [at, row]) { face } else { best };
        let best = group.iter().map(|span| span.face).reduce(nearer);
        self.nearest.extend(best.map(|face| Span { face, columns }));
        &self.nearest
    }

    /// Lets one more face take what it is nearest of.
    fn insert(&mut self, face: u32, columns: &Range<u32>, row: u32) {
        if self.nearest.is_empty() {
            self.nearest.push(Span { face, columns: columns.clone() });
            return;
        }
        for piece in std::mem::take(&mut self.nearest) {
            self.cut(piece, face, row);
        }
    }

    /// Cuts a piece where `face` comes before it or falls behind it.
    fn cut(&mut self, Span { face: old, columns }: Span, face: u32, row: u32) {
        let beats = |column| self.beats(face, old, [column, row]);
        let starts = beats(columns.start);
        let [one, other] = if starts { [face, old] } else { [old, face] };
        if beats(columns.end - 1) == starts {
            return self.push(one, columns);
        }
        let [new, before] = [face, old].map(|face| self.faces[face as usize].depth);
        let gap = new.at([columns.start, row]) - before.at([columns.start, row]);
        let guess = gap / (before.right() - new.right());
        let cut = turn(&columns, guess, |column| beats(column) == starts);
        self.crossings += 1;
        self.push(one, columns.start..cut);
        self.push(other, cut..columns.end);
    }

    /// Appends a piece, or lengthens the last one if it is of the same face.
    fn push(&mut self, face: u32, columns: Range<u32>) {
        match self.nearest.last_mut() {
            Some(last) if last.face == face => last.columns.end = columns.end,
            _ => self.nearest.push(Span { face, columns }),
        }
    }

    /// Whether the sample at `at`, which two faces cover, sees the first.
    fn beats(&self, first: u32, second: u32, at: [u32; 2]) -> bool {
        let [first, second] = [first, second].map(|face| &self.faces[face as usize]);
        self.judge.beats(first, second, at)
    }
}
