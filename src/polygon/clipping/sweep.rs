//! The sweep: all pieces of all edges, each classified exactly.
//!
//! A line moves over the image from left to right (from bottom to top where
//! it meets several points at once). It crosses some edges just now, known
//! from bottom to top. That order changes only at points where edges begin,
//! end or meet; at each of them
//!
//! 1. all pieces that arrive there are found, also those that merely touch
//!    it: they are neighbours in the order;
//! 2. what goes on and what begins there is sorted by direction; edges in
//!    one direction become one piece of several edges, so that collinear
//!    edges in any number are no special case;
//! 3. winding numbers are counted upward from what lies below the point, and
//!    pieces with different results on their two sides become borders;
//! 4. new neighbours are asked whether they will cross.
//!
//! (Bentley and Ottmann 1979; with overlapping edges and points of any
//! degree as in LEDA, Mehlhorn and Naeher 1994.) Ends of edges are sorted
//! beforehand, only crossings wait in a queue. Every comparison is exact, so
//! the sweep cannot get out of step. O((n + k) log n) for n edges with k
//! crossings of neighbours.

use super::borders::{Borders, NO_BORDER};
use super::fill::{OUTSIDE, State, States};
use super::queue::{Meeting, Queue};
use super::status::{NONE, Status};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Approximation, Chart, ImageLine, ImagePoint, Policy, Predicates};
use crate::run::{Growing, Run};
use std::cmp::Ordering;

/// An edge, directed with the sweep.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    pub(super) line: ImageLine,
    /// Its ends: numbers of [`Ends`].
    pub(super) left: u32,
    pub(super) right: u32,
    pub(super) counter: u32,
    /// What a step upward across it adds to its counter.
    pub(super) delta: i32,
}

/// The ends of all edges in the order of the sweep, each place once.
#[derive(Debug, Default)]
pub(super) struct Ends {
    pub(super) points: Vec<ImagePoint>,
    pub(super) approximations: Vec<Approximation>,
}

/// The place of a piece in the order along the sweep line.
#[derive(Debug, Clone, Copy)]
struct Slot {
    /// The first of the edges of the piece; the others follow by `more`.
    edge: u32,
    /// The first of their right ends.
    right: u32,
    /// A number no other piece ever has.
    piece: u32,
    border: u32,
    below: State,
    above: State,
    /// The face above.
    face: u32,
}

/// A point at which something happens.
#[derive(Clone, Copy)]
struct Event {
    point: ImagePoint,
    /// Its number, if edges end or begin there.
    end: Option<u32>,
}

/// What the pieces of a sweep take: two meetings in the queue, and a border
/// with its two ends.
const PIECE_BYTES: usize = 2 * size_of::<Meeting>() + 64;

/// The pieces of a sweep, which its run is told of.
pub(super) fn growing<'r>(run: &'r Run<'r>) -> Growing<'r> {
    Growing::new(run, PIECE_BYTES)
}

pub(super) struct Sweep<'a, 'p, P: Policy> {
    predicates: &'a Predicates<'p, P>,
    chart: &'a Chart,
    ends: &'a Ends,
    edges: &'a [Edge],
    states: States<'a>,
    /// The next edge of the same piece.
    more: Vec<u32>,
    /// The slot of each edge.
    slot_of: Vec<u32>,
    slots: Vec<Slot>,
    free: Vec<u32>,
    status: Status,
    queue: Queue,
    pieces: u32,
    pub(super) borders: Borders,
    arriving: Vec<u32>,
    leaving: Vec<u32>,
    /// The borders of the pieces that arrive.
    closing: Vec<u32>,
}

impl<'a, 'p, P: Policy> Sweep<'a, 'p, P> {
    pub(super) fn new(
        predicates: &'a Predicates<'p, P>,
        chart: &'a Chart,
        ends: &'a Ends,
        edges: &'a [Edge],
        states: States<'a>,
    ) -> Self {
        let mut borders = Borders::default();
        borders.new_face();
        Sweep {
            predicates,
            chart,
            ends,
            edges,
            states,
            more: vec![NONE; edges.len()],
            slot_of: vec![NONE; edges.len()],
            slots: Vec::new(),
            free: Vec::new(),
            status: Status::default(),
            queue: Queue::default(),
            pieces: 0,
            borders,
            arriving: Vec::new(),
            leaving: Vec::new(),
            closing: Vec::new(),
        }
    }

    /// Sweeps over all edges, which are sorted by their left ends. `goes_on` is
    /// asked at every point, with the number of pieces so far; false if it said
    /// no, and then borders end in the air.
    pub(super) fn run(&mut self, goes_on: &mut impl FnMut(u32) -> bool) -> bool {
        let mut ending = vec![NONE; self.ends.points.len()];
        for (number, edge) in self.edges.iter().enumerate() {
            ending[edge.right as usize] = number as u32;
        }
        let mut begun = 0;
        for (end, &ending) in ending.iter().enumerate() {
            if !self.meetings_before(end as u32, goes_on) || !goes_on(self.pieces) {
                return false;
            }
            let first = begun;
            while begun < self.edges.len() && self.edges[begun].left as usize == end {
                begun += 1;
            }
            let event = Event { point: self.ends.points[end], end: Some(end as u32) };
            let start = match ending {
                NONE => self.locate(event),
                edge => Ok(self.slot_of[edge as usize]),
            };
            let below = self.collect(event, start);
            self.step(event, below, first as u32..begun as u32);
        }
        true
    }

    /// Sees to all crossings that come before an end.
    fn meetings_before(&mut self, end: u32, goes_on: &mut impl FnMut(u32) -> bool) -> bool {
        while let Some(first) = self.queue.first() {
            let approximation = &self.ends.approximations[end as usize];
            let order = first.approximation.compare(approximation);
            let order = order.unwrap_or_else(|| {
                let point = self.ends.points[end as usize];
                self.predicates.sweep(self.chart, self.crossing(first.edges), point)
            });
            if order != Ordering::Less {
                return true;
            }
            if !goes_on(self.pieces) {
                return false;
            }
            let (edges, predicates, chart) = (self.edges, self.predicates, self.chart);
            let Some(meeting) = self.queue.pop(|a, b| before(predicates, chart, edges, a, b))
            else {
                return true;
            };
            let [low, high] = meeting.slots;
            let same = |i: usize| self.slots[meeting.slots[i] as usize].piece == meeting.pieces[i];
            if same(0) && same(1) && self.status.above(low) == high {
                let event = Event { point: self.crossing(meeting.edges), end: None };
                let below = self.collect(event, Ok(low));
                self.step(event, below, 0..0);
            }
        }
        true
    }

    /// Where the upper and the lower of two edges cross.
    fn crossing(&self, edges: [u32; 2]) -> ImagePoint {
        crossing(self.edges, edges)
    }

    fn line(&self, slot: u32) -> ImageLine {
        self.edges[self.slots[slot as usize].edge as usize].line
    }

    /// The slot on which a point lies, or the one below it.
    fn locate(&self, event: Event) -> Result<u32, u32> {
        self.status.locate(|slot| self.predicates.beside(self.chart, self.line(slot), event.point))
    }

    fn passes(&self, slot: u32, event: Event) -> bool {
        event.end == Some(self.slots[slot as usize].right)
            || self.predicates.beside(self.chart, self.line(slot), event.point).is_zero()
    }

    /// Collects the slots that arrive at a point, from bottom to top, given
    /// one of them or the one below; returns the one below.
    fn collect(&mut self, event: Event, start: Result<u32, u32>) -> u32 {
        self.arriving.clear();
        let mut lowest = match start {
            Ok(slot) => slot,
            Err(below) => return below,
        };
        let mut below = self.status.below(lowest);
        while below != NONE && self.passes(below, event) {
            lowest = below;
            below = self.status.below(lowest);
        }
        let mut slot = lowest;
        let mut known = true;
        while slot != NONE && (known || self.passes(slot, event)) {
            known = known && Ok(slot) != start;
            self.arriving.push(slot);
            slot = self.status.above(slot);
        }
        below
    }

    /// What lies above a slot: state and face.
    fn above(&self, slot: u32) -> (State, u32) {
        match slot {
            NONE => (OUTSIDE, 0),
            _ => {
                let slot = &self.slots[slot as usize];
                (slot.above, slot.face)
            }
        }
    }

    /// Replaces what arrives at a point by what leaves it.
    fn step(&mut self, event: Event, below: u32, begun: std::ops::Range<u32>) {
        if let (&[slot], 1) = (&*self.arriving, begun.len()) {
            let edge = self.slots[slot as usize].edge;
            let ends = event.end == Some(self.edges[edge as usize].right);
            if ends && self.more[edge as usize] == NONE {
                return self.go_on(event, slot, begun.start);
            }
        }
        let top = self.arriving.last().map_or(below, |&slot| slot);
        let (_, top_face) = self.above(top);
        self.sort_leaving(event, begun);
        let arrived = self.arriving.len().min(self.leaving.len());
        let (mut state, mut face) = self.above(below);

        // Leaving borders are collected first, for they come first around
        // the point; arriving ones keep their numbers meanwhile.
        self.closing.clear();
        self.closing.extend(self.arriving.iter().map(|&slot| self.slots[slot as usize].border));
        let mut at = NO_BORDER;
        self.borders.begin();
        let mut last = below;
        for i in 0..self.leaving.len() {
            let edge = self.leaving[i];
            let (right, above) = self.measure(edge, state);
            let labels = [self.states.label(above), self.states.label(state)];
            let is_border = labels[0] != labels[1];
            let face_above = match (i + 1 == self.leaving.len(), is_border) {
                (true, false) => {
                    self.borders.join(face, top_face);
                    top_face
                }
                (true, true) => top_face,
                (false, true) => self.borders.new_face(),
                (false, false) => face,
            };
            let mut border = NO_BORDER;
            if is_border {
                if at == NO_BORDER {
                    at = self.borders.point(event.point);
                }
                border = self.borders.start(edge, at, labels, [face_above, face]);
                self.borders.leaves(border);
            }
            self.pieces += 1;
            let slot = Slot {
                edge,
                right,
                piece: self.pieces,
                border,
                below: state,
                above,
                face: face_above,
            };
            last = self.place(slot, i, last);
            (state, face) = (above, face_above);
        }
        if self.leaving.is_empty() {
            self.borders.join(face, top_face);
        }
        debug_assert!(self.leaving.is_empty() || state == self.top_state(last));
        for &border in self.closing.iter().rev().filter(|&&border| border != NO_BORDER) {
            if at == NO_BORDER {
                at = self.borders.point(event.point);
            }
            self.borders.arrives(border, at);
        }
        self.borders.finish();
        for i in arrived..self.arriving.len() {
            let slot = self.arriving[i];
            self.slots[slot as usize].piece = NONE;
            self.status.remove(slot);
            self.free.push(slot);
        }
        self.meet(below, self.status.above(below));
        if !self.leaving.is_empty() {
            self.meet(last, self.status.above(last));
        }
    }

    /// What the slot above says about the state below it (for checks).
    fn top_state(&self, last: u32) -> State {
        let mut above = self.status.above(last);
        // Slots that are about to go stand in between.
        while above != NONE && self.arriving.contains(&above) {
            above = self.status.above(above);
        }
        if above == NONE { OUTSIDE } else { self.slots[above as usize].below }
    }

    /// Writes the leaving piece `i` into a slot: one that arrived as long as
    /// there are any, then new ones above the last.
    fn place(&mut self, piece: Slot, i: usize, last: u32) -> u32 {
        let slot = match self.arriving.get(i) {
            Some(&slot) => slot,
            None => {
                let slot = self.free.pop().unwrap_or(self.slots.len() as u32);
                self.status.insert_above(last, slot);
                slot
            }
        };
        match self.slots.get_mut(slot as usize) {
            Some(old) => *old = piece,
            None => self.slots.push(piece),
        }
        let mut edge = piece.edge;
        while edge != NONE {
            self.slot_of[edge as usize] = slot;
            edge = self.more[edge as usize];
        }
        slot
    }

    /// The first right end of a piece, and the state above it.
    fn measure(&mut self, first: u32, below: State) -> (u32, State) {
        let (mut right, mut state, mut edge) = (NONE, below, first);
        while edge != NONE {
            let Edge { right: end, counter, delta, .. } = self.edges[edge as usize];
            right = right.min(end);
            state = self.states.step(state, counter, delta);
            edge = self.more[edge as usize];
        }
        (right, state)
    }

    /// One edge ends and one begins, nothing else is there: all that was
    /// true of one is true of the other.
    fn go_on(&mut self, event: Event, slot: u32, edge: u32) {
        let old = self.slots[slot as usize];
        let mut border = NO_BORDER;
        if old.border != NO_BORDER {
            let at = self.borders.point(event.point);
            let super::borders::Border { labels, faces, .. } =
                self.borders.list[old.border as usize];
            border = self.borders.start(edge, at, labels, faces);
            self.borders.go_on(old.border, border, at);
        }
        self.pieces += 1;
        let right = self.edges[edge as usize].right;
        self.slots[slot as usize] = Slot { edge, right, piece: self.pieces, border, ..old };
        self.slot_of[edge as usize] = slot;
        self.meet(self.status.below(slot), slot);
        self.meet(slot, self.status.above(slot));
    }

    /// Sorts what leaves a point by direction, lowest first; each entry is
    /// the first edge of a piece.
    fn sort_leaving(&mut self, event: Event, begun: std::ops::Range<u32>) {
        self.leaving.clear();
        // What passes through the point turns its order around.
        for &slot in self.arriving.iter().rev() {
            let mut kept = NONE;
            let mut edge = self.slots[slot as usize].edge;
            while edge != NONE {
                let next = self.more[edge as usize];
                if event.end != Some(self.edges[edge as usize].right) {
                    self.more[edge as usize] = kept;
                    kept = edge;
                }
                edge = next;
            }
            if kept != NONE {
                self.leaving.push(kept);
            }
        }
        for edge in begun {
            let line = self.edges[edge as usize].line;
            let mut same = NONE;
            let place = self.leaving.partition_point(|&other| {
                let other_line = self.edges[other as usize].line;
                let bend = self.predicates.bend(self.chart, other_line, line);
                if bend.is_zero() {
                    same = other;
                }
                bend == Sign::Positive
            });
            if same == NONE {
                self.leaving.insert(place, edge);
            } else {
                self.more[edge as usize] = self.more[same as usize];
                self.more[same as usize] = edge;
            }
        }
    }

    /// Foresees the crossing of two neighbours.
    fn meet(&mut self, low: u32, high: u32) {
        if low == NONE || high == NONE {
            return;
        }
        let (a, b) = (&self.slots[low as usize], &self.slots[high as usize]);
        let beside = |slot, end: u32| {
            let point = self.ends.points[end as usize];
            self.predicates.beside(self.chart, self.line(slot), point)
        };
        // The one that ends first ends on its own side, or they cross.
        let cross = match a.right.cmp(&b.right) {
            Ordering::Equal => false,
            Ordering::Less => beside(high, a.right) == Sign::Positive,
            Ordering::Greater => beside(low, b.right) == Sign::Negative,
        };
        if !cross {
            return;
        }
        let edges = [a.edge, b.edge];
        let approximation = self.predicates.approximate(self.chart, self.crossing(edges));
        let meeting =
            Meeting { approximation, edges, slots: [low, high], pieces: [a.piece, b.piece] };
        let (edges, predicates, chart) = (self.edges, self.predicates, self.chart);
        self.queue.push(meeting, |a, b| before(predicates, chart, edges, a, b));
    }
}

fn crossing(edges: &[Edge], [low, high]: [u32; 2]) -> ImagePoint {
    ImagePoint::Crossing([edges[high as usize].line, edges[low as usize].line])
}

fn before<P: Policy>(
    predicates: &Predicates<'_, P>,
    chart: &Chart,
    edges: &[Edge],
    a: &Meeting,
    b: &Meeting,
) -> bool {
    let order = a.approximation.compare(&b.approximation);
    let order = order.unwrap_or_else(|| {
        predicates.sweep(chart, crossing(edges, a.edges), crossing(edges, b.edges))
    });
    order == Ordering::Less
}
