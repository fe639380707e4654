//! One horizon: a piecewise linear function over columns.
//!
//! Its pieces form a list from left to right without gaps. A segment that is
//! added changes the pieces whose columns it has, and no others; they are
//! found from the piece that was changed last, for neighbours come one after
//! the other.
//!
//! A horizon may jump where a vertex ends a segment, but never strictly inside
//! a segment that is added later: what is nearer than that segment has no
//! jumps, and it is all of the horizon there. So at a break inside, both
//! neighbouring pieces meet, and one comparison serves both.

use super::breaks::{Break, Questions, Segment, UP};
use super::tracks::{State, Track};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Cut, Place, Policy};
use std::cmp::Ordering;

/// Ends a list.
const NONE: u32 = u32::MAX;

/// A part of the horizon on one segment, up to where the next one starts.
#[derive(Debug, Clone, Copy)]
struct Piece {
    segment: Segment,
    start: Break,
    previous: u32,
    next: u32,
}

/// An upper or a lower horizon.
#[derive(Debug)]
pub(super) struct Horizon {
    /// Positive for the upper one, which only rises.
    sense: Sign,
    pieces: Vec<Piece>,
    /// Places of `pieces` that are in no list.
    free: Vec<u32>,
    first: u32,
    last: u32,
    /// Where the last piece ends.
    end: Break,
    /// Where the last search ended.
    finger: u32,
    /// What takes the place of the pieces that a segment covers.
    fresh: Vec<(Break, Segment)>,
    /// The most pieces there were at a time.
    most: usize,
}

impl Horizon {
    /// Nothing is covered yet.
    pub(super) fn new(sense: Sign) -> Self {
        Horizon {
            sense,
            pieces: Vec::new(),
            free: Vec::new(),
            first: NONE,
            last: NONE,
            end: Break::Vertex(0),
            finger: NONE,
            fresh: Vec::new(),
            most: 0,
        }
    }

    /// The most pieces there were at a time.
    pub(super) fn most(&self) -> usize {
        self.most
    }

    /// Tells how a segment lies to the horizon, then moves the horizon to
    /// it where it is beyond.
    pub(super) fn add<P: Policy>(
        &mut self,
        questions: &Questions<'_, P>,
        segment @ [a, b]: Segment,
        track: &mut Track,
    ) {
        track.clear();
        if self.first == NONE {
            self.pieces.push(Piece {
                segment,
                start: Break::Vertex(a),
                previous: NONE,
                next: NONE,
            });
            (self.first, self.last, self.finger) = (0, 0, 0);
            self.end = Break::Vertex(b);
            return track.go(State::Beyond, Place::End);
        }
        self.fresh.clear();
        let first = self.piece(self.first);
        let start = match questions.compare(first.start, a) {
            Ordering::Greater => {
                self.fresh.push((Break::Vertex(a), segment));
                if questions.compare(first.start, b) != Ordering::Less {
                    track.go(State::Beyond, Place::End);
                    return self.replace(NONE, self.first);
                }
                track.go(State::Beyond, place_at(first.start, first.segment));
                self.first
            }
            _ if questions.compare(self.end, a) != Ordering::Greater => {
                track.go(State::Beyond, Place::End);
                self.fresh.push((Break::Vertex(a), segment));
                self.end = Break::Vertex(b);
                return self.replace(self.last, NONE);
            }
            _ => self.find(questions, a),
        };
        self.pass(questions, segment, start, track);
    }

    /// Compares a segment with the pieces from `start` on.
    fn pass<P: Policy>(
        &mut self,
        questions: &Questions<'_, P>,
        segment @ [a, b]: Segment,
        start: u32,
        track: &mut Track,
    ) {
        let mut index = start;
        let mut from = self.piece(start).start;
        let mut changed = !self.fresh.is_empty();
        // How much higher than the horizon the segment is, at its left end
        // or where the horizon begins.
        let mut left = if changed {
            self.rise(questions, segment, from)
        } else {
            let piece = self.piece(start);
            let rise = self.sense * questions.above(piece.segment, a);
            if questions.compare(from, a) == Ordering::Less {
                self.fresh.push((from, piece.segment));
                from = Break::Vertex(a);
            } else if rise == Sign::Positive {
                // A break is a point of the horizon, so it stays otherwise.
                from = Break::Vertex(a);
            }
            rise
        };
        loop {
            let piece = self.piece(index);
            let end = self.end_of(&piece);
            let beyond_end = questions.compare(end, b);
            let right = if beyond_end == Ordering::Less {
                debug_assert!(self.is_continuous(questions, &piece, end));
                self.rise(questions, segment, end)
            } else {
                self.sense * questions.above(piece.segment, b)
            };
            let until = match beyond_end {
                Ordering::Less if left.is_zero() && right.is_zero() && piece.next != NONE => {
                    // The segments part at the break, which the other tells.
                    place_at(end, self.piece(piece.next).segment)
                }
                Ordering::Less => place_at(end, piece.segment),
                _ => Place::End,
            };
            let crossing = Break::Crossing([piece.segment, segment]);
            let cut = Place::Cut(Cut::Silhouette(piece.segment));
            match (left, right) {
                (Sign::Zero, Sign::Zero) => {
                    self.cover(from, piece.segment);
                    track.go(State::On, until);
                }
                (Sign::Positive, Sign::Negative) => {
                    self.cover(from, segment);
                    self.cover(crossing, piece.segment);
                    track.go(State::Beyond, cut);
                    track.go(State::Within, until);
                    changed = true;
                }
                (Sign::Negative, Sign::Positive) => {
                    self.cover(from, piece.segment);
                    self.cover(crossing, segment);
                    track.go(State::Within, cut);
                    track.go(State::Beyond, until);
                    changed = true;
                }
                (Sign::Negative, _) | (_, Sign::Negative) => {
                    self.cover(from, piece.segment);
                    track.go(State::Within, until);
                }
                _ => {
                    self.cover(from, segment);
                    track.go(State::Beyond, until);
                    changed = true;
                }
            }
            match beyond_end {
                Ordering::Greater => self.cover(Break::Vertex(b), piece.segment),
                Ordering::Equal if right == Sign::Positive && piece.next != NONE => {
                    // The higher side of a jump gives it its name.
                    self.pieces[piece.next as usize].start = Break::Vertex(b);
                }
                Ordering::Less if piece.next == NONE => {
                    // The segment goes on where nothing is covered.
                    self.cover(end, segment);
                    track.go(State::Beyond, Place::End);
                    self.end = Break::Vertex(b);
                    changed = true;
                }
                _ => {}
            }
            if beyond_end != Ordering::Less || piece.next == NONE {
                break;
            }
            (index, left, from) = (piece.next, right, end);
        }
        if changed {
            let (before, behind) = (self.piece(start).previous, self.piece(index).next);
            self.remove(start, index);
            self.replace(before, behind);
        } else {
            self.finger = index;
        }
    }

    /// The segments of the horizon just left and just right of the column
    /// of a vertex.
    pub(super) fn beside<P: Policy>(
        &mut self,
        questions: &Questions<'_, P>,
        vertex: u32,
    ) -> [Option<Segment>; 2] {
        if self.first == NONE {
            return [None; 2];
        }
        if questions.compare(self.piece(self.first).start, vertex) == Ordering::Greater {
            return [None; 2];
        }
        match questions.compare(self.end, vertex) {
            Ordering::Less => return [None; 2],
            Ordering::Equal => return [Some(self.piece(self.last).segment), None],
            Ordering::Greater => {}
        }
        let right = self.find(questions, vertex);
        let right = self.piece(right);
        if questions.compare(right.start, vertex) == Ordering::Less {
            return [Some(right.segment); 2];
        }
        let left = (right.previous != NONE).then(|| self.piece(right.previous).segment);
        [left, Some(right.segment)]
    }

    /// The piece in which the column just right of a vertex lies; the
    /// vertex is neither left of the horizon nor at its end.
    fn find<P: Policy>(&mut self, questions: &Questions<'_, P>, vertex: u32) -> u32 {
        let mut index = self.finger;
        while questions.compare(self.piece(index).start, vertex) == Ordering::Greater {
            index = self.piece(index).previous;
        }
        loop {
            let next = self.piece(index).next;
            if next == NONE
                || questions.compare(self.piece(next).start, vertex) == Ordering::Greater
            {
                self.finger = index;
                return index;
            }
            index = next;
        }
    }

    /// How much higher than a break of the horizon a segment is.
    fn rise<P: Policy>(&self, questions: &Questions<'_, P>, segment: Segment, at: Break) -> Sign {
        -(self.sense * questions.break_above(segment, at))
    }

    /// Whether the piece and the one behind it meet at the break between.
    fn is_continuous<P: Policy>(
        &self,
        questions: &Questions<'_, P>,
        piece: &Piece,
        end: Break,
    ) -> bool {
        if piece.next == NONE {
            return true;
        }
        let next = self.piece(piece.next);
        [piece.segment, next.segment]
            .iter()
            .all(|&segment| questions.break_above(segment, end).is_zero())
    }

    fn piece(&self, index: u32) -> Piece {
        self.pieces[index as usize]
    }

    fn end_of(&self, piece: &Piece) -> Break {
        if piece.next == NONE { self.end } else { self.piece(piece.next).start }
    }

    /// From a break on, the horizon is on a segment.
    fn cover(&mut self, from: Break, segment: Segment) {
        if self.fresh.last().is_none_or(|&(_, last)| last != segment) {
            self.fresh.push((from, segment));
        }
    }

    /// Takes the pieces from one to another out of the list.
    fn remove(&mut self, first: u32, last: u32) {
        let mut index = first;
        loop {
            self.free.push(index);
            if index == last {
                return;
            }
            index = self.piece(index).next;
        }
    }

    /// Puts what is fresh between two pieces, which may be none.
    fn replace(&mut self, before: u32, behind: u32) {
        let mut previous = before;
        for at in 0..self.fresh.len() {
            let (start, segment) = self.fresh[at];
            let piece = Piece { segment, start, previous, next: NONE };
            let index = match self.free.pop() {
                Some(index) => {
                    self.pieces[index as usize] = piece;
                    index
                }
                None => {
                    self.pieces.push(piece);
                    self.pieces.len() as u32 - 1
                }
            };
            match previous {
                NONE => self.first = index,
                _ => self.pieces[previous as usize].next = index,
            }
            previous = index;
        }
        match behind {
            NONE => self.last = previous,
            _ => self.pieces[behind as usize].previous = previous,
        }
        match previous {
            NONE => self.first = behind,
            _ => self.pieces[previous as usize].next = behind,
        }
        self.finger = previous;
        self.most = self.most.max(self.pieces.len() - self.free.len());
    }
}

/// The place of a break on a segment that passes it, where that crosses the
/// line of `other`.
fn place_at(at: Break, other: Segment) -> Place {
    Place::Cut(match at {
        Break::Vertex(vertex) => Cut::Vertex(vertex, UP),
        Break::Crossing(_) => Cut::Silhouette(other),
    })
}
