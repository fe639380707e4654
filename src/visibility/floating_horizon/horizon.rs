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
                let touching = questions.compare(first.start, b);
                if touching != Ordering::Less {
                    debug_assert!(touching == Ordering::Equal, "a gap in the horizon");
                    track.go(State::Beyond, Place::End);
                    return self.replace(NONE, self.first);
                }
                track.go(State::Beyond, place_at(first.start, first.segment));
                self.first
            }
            _ if questions.compare(self.end, a) != Ordering::Greater => {
                debug_assert!(questions.compare(self.end, a).is_eq(), "a gap in the horizon");
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
        segment @ [_, b]: Segment,
        start: u32,
        track: &mut Track,
    ) {
        let mut changed = !self.fresh.is_empty();
        let (mut from, mut left) = self.enter(questions, segment, start);
        let mut index = start;
        loop {
            let piece = self.piece(index);
            let end = self.end_of(&piece);
            let side = questions.compare(end, b);
            let goes_on = side == Ordering::Less;
            let right = if goes_on {
                debug_assert!(self.is_continuous(questions, &piece, end));
                self.rise(questions, segment, end)
            } else {
                self.sense * questions.above(piece.segment, b)
            };
            let until = match (goes_on, left.or(right)) {
                (false, _) => Place::End,
                // Where both lie on one line, the next piece tells the place.
                (true, Sign::Zero) if piece.next != NONE => {
                    place_at(end, self.piece(piece.next).segment)
                }
                (true, _) => place_at(end, piece.segment),
            };
            changed |= self.take(segment, &piece, from, [left, right], until, track);
            if goes_on && piece.next != NONE {
                (index, left, from) = (piece.next, right, end);
                continue;
            }
            changed |= self.leave(segment, &piece, side, right, track);
            break;
        }
        if changed {
            let (before, behind) = (self.piece(start).previous, self.piece(index).next);
            self.remove(start, index);
            self.replace(before, behind);
        } else {
            self.finger = index;
        }
    }

    /// Where a segment and the horizon have their first common column, and
    /// how much higher the segment is there.
    fn enter<P: Policy>(
        &mut self,
        questions: &Questions<'_, P>,
        segment @ [a, _]: Segment,
        start: u32,
    ) -> (Break, Sign) {
        let piece = self.piece(start);
        if !self.fresh.is_empty() {
            // The segment comes from where nothing is covered.
            return (piece.start, self.rise(questions, segment, piece.start));
        }
        let rise = self.sense * questions.above(piece.segment, a);
        if questions.compare(piece.start, a) == Ordering::Less {
            self.fresh.push((piece.start, piece.segment));
            return (Break::Vertex(a), rise);
        }
        // Both begin in one column. A break is a point of the horizon, so
        // the vertex takes its place only where it is one.
        let from = if rise == Sign::Positive { Break::Vertex(a) } else { piece.start };
        (from, rise)
    }

    /// Takes what is higher of a segment and a piece, from one break to the
    /// next, where the segment is higher than the piece by these signs.
    /// Whether that changes the horizon.
    fn take(
        &mut self,
        segment: Segment,
        piece: &Piece,
        from: Break,
        rise: [Sign; 2],
        until: Place,
        track: &mut Track,
    ) -> bool {
        let crossing = Break::Crossing([piece.segment, segment]);
        let cut = Place::Cut(Cut::Silhouette(piece.segment));
        match rise {
            [Sign::Zero, Sign::Zero] => {
                self.cover(from, piece.segment);
                track.go(State::On, until);
                false
            }
            [Sign::Positive, Sign::Negative] => {
                self.cover(from, segment);
                self.cover(crossing, piece.segment);
                track.go(State::Beyond, cut);
                track.go(State::Within, until);
                true
            }
            [Sign::Negative, Sign::Positive] => {
                self.cover(from, piece.segment);
                self.cover(crossing, segment);
                track.go(State::Within, cut);
                track.go(State::Beyond, until);
                true
            }
            [Sign::Negative, _] | [_, Sign::Negative] => {
                self.cover(from, piece.segment);
                track.go(State::Within, until);
                false
            }
            _ => {
                self.cover(from, segment);
                track.go(State::Beyond, until);
                true
            }
        }
    }

    /// What comes behind the last piece that a segment passes, whose end is
    /// on this side of the segment's. Whether that changes the horizon.
    fn leave(
        &mut self,
        segment @ [_, b]: Segment,
        piece: &Piece,
        side: Ordering,
        rise: Sign,
        track: &mut Track,
    ) -> bool {
        match side {
            Ordering::Greater => self.cover(Break::Vertex(b), piece.segment),
            Ordering::Equal if rise == Sign::Positive && piece.next != NONE => {
                // The higher side of a jump gives it its name.
                self.pieces[piece.next as usize].start = Break::Vertex(b);
            }
            Ordering::Equal => {}
            Ordering::Less => {
                // The segment goes on where nothing is covered.
                self.cover(self.end, segment);
                track.go(State::Beyond, Place::End);
                self.end = Break::Vertex(b);
                return true;
            }
        }
        false
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
