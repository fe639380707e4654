//! A shorter tour by small changes: 2-opt, Or-opt, and kicks.
//!
//! At every end the moves are tried that would link it with one of its
//! nearest ends instead of the one it is linked with, as far as those are
//! nearer (Croes 1958 with the neighbour lists of Johnson and McGeoch 1997):
//!
//! ```text
//! 2-opt    a b ... c d   ->   a c ... b d      the row between is reversed
//! Or-opt   b [e . f] g ... c d   ->   b g ... c [e . f] d     up to 3 strokes
//! ```
//!
//! The best of the moves at an end is made; ends whose links have changed are
//! looked at again (Bentley's "don't look bits"). When no end has a move left,
//! two short rows next to one another change places somewhere, which no such
//! move can do (the double bridge of Martin, Otto and Felten 1991), and the
//! surroundings are repaired; unless that has made the tour shorter, it is
//! undone. Kicks go along the tour from its beginning, again and again, so
//! that what they touch lies close together in memory.
//!
//! Work is counted in steps, one for each end that is looked at, never in
//! seconds: a budget of steps gives the same tour on every machine.

use super::nearest::Nearest;
use super::tour::Tour;
use crate::run::map_chunks;

/// How many of the nearest ends an end may be linked with.
const NEIGHBOURS: usize = 8;

/// The longest row of strokes that Or-opt moves.
const ROW: usize = 3;

/// The longest row of strokes that a kick moves.
const KICK: u64 = 30;

/// The most stops that one move may turn over; longer ones gain too little
/// for what they cost.
const LONGEST: usize = 25_000;

/// The same for the repairs after a kick.
const LONGEST_REPAIR: usize = 1_000;

/// Moves that gain less, mm, are rounding.
const LEAST: f64 = 1e-9;

/// A tour that is being made shorter.
pub(super) struct Improver {
    tour: Tour,
    /// `NEIGHBOURS` for each end, nearest first.
    neighbours: Vec<u32>,
    /// Ends to look at, and whether each is among them.
    queue: Vec<u32>,
    queued: Vec<bool>,
    longest: usize,
    /// Where the last kick was, and the state of the dice.
    kicked: usize,
    dice: u64,
}

/// A change of the tour.
#[derive(Clone, Copy)]
enum Move {
    /// Link the ends a and c, and those they were linked with.
    Turn { a: u32, c: u32 },
    /// Take the row from `e` to `f` out and put it beside `c`, `e` next to it.
    Carry { e: u32, f: u32, c: u32 },
}

impl Improver {
    /// Prepares lists of neighbours. O(n log n).
    pub(super) fn new(tour: Tour) -> Self {
        let ends = 2 * (tour.len() - 1);
        let points: Vec<_> = (0..ends as u32).map(|end| tour.point(end)).collect();
        let nearest = Nearest::new(&points);
        let neighbours = map_chunks(ends, 1024, |range| {
            let mut best = [(0.0, 0); NEIGHBOURS];
            let mut found = Vec::with_capacity(range.len() * NEIGHBOURS);
            for end in range {
                let other_strokes = |other: u32| other / 2 != end as u32 / 2;
                nearest.find_many(points[end], &mut best, &other_strokes);
                found.extend(best.iter().map(|entry| entry.1));
            }
            found
        });
        Improver {
            tour,
            neighbours: neighbours.concat(),
            queue: (0..ends as u32).rev().collect(),
            queued: vec![true; ends],
            longest: LONGEST,
            kicked: 0,
            dice: 0x9e37_79b9_7f4a_7c15,
        }
    }

    /// The tour.
    pub(super) fn tour(&self) -> &Tour {
        &self.tour
    }

    /// The tour, to move the ends of closed strokes, which are looked at
    /// again.
    pub(super) fn put(&mut self, stroke: u32, point: glam::DVec2) {
        self.tour.put(stroke, point);
        self.look_at(2 * stroke);
        self.look_at(2 * stroke + 1);
    }

    /// Makes moves until none is left or `more` says that it is enough; it is
    /// asked before every step. Returns whether none is left.
    pub(super) fn settle(&mut self, more: &mut impl FnMut() -> bool) -> bool {
        self.longest = LONGEST;
        let mut gained = 0.0;
        while !self.queue.is_empty() {
            if !more() {
                return false;
            }
            gained += self.step();
        }
        debug_assert!(0.0 <= gained);
        true
    }

    /// Kicks and repairs until `more` says that it is enough.
    pub(super) fn kick(&mut self, more: &mut impl FnMut() -> bool) {
        self.longest = LONGEST_REPAIR;
        if self.tour.len() < 8 {
            return;
        }
        while more() {
            self.tour.mark();
            let mut gained = self.change_places();
            while !self.queue.is_empty() {
                // A repair that was begun is finished.
                more();
                gained += self.step();
            }
            if gained < LEAST {
                self.tour.undo();
            }
        }
    }

    /// Looks at one end; returns what its best move has gained, mm.
    fn step(&mut self) -> f64 {
        let Some(end) = self.queue.pop() else { return 0.0 };
        self.queued[end as usize] = false;
        let Some((gain, best)) = self.best_move(end) else { return 0.0 };
        if !self.make(best) {
            return 0.0;
        }
        self.look_at(end);
        gain
    }

    fn look_at(&mut self, end: u32) {
        if self.tour.is_somewhere(end) && !std::mem::replace(&mut self.queued[end as usize], true) {
            self.queue.push(end);
        }
    }

    /// The move with the greatest gain that links `a` with a nearer end.
    fn best_move(&self, a: u32) -> Option<(f64, Move)> {
        let tour = &self.tour;
        let b = tour.linked(a);
        let old = tour.distance(a, b);
        let mut best: Option<(f64, Move)> = None;
        let mut offer = |gain: f64, what: Move| {
            if best.is_none_or(|(known, _)| known < gain) && LEAST < gain {
                best = Some((gain, what));
            }
        };
        let from = a as usize * NEIGHBOURS;
        for c in self.neighbours[from..from + NEIGHBOURS].iter().copied() {
            if c == u32::MAX {
                break;
            }
            let near = tour.distance(a, c);
            if !tour.is_somewhere(b) || old <= near {
                break;
            }
            let d = tour.linked(c);
            let saved = old + tour.distance(c, d) - near;
            if tour.is_entry(a) == tour.is_entry(c) {
                offer(saved - tour.distance(b, d), Move::Turn { a, c });
            }
            // The row that begins with a goes to c; the one with c goes to a.
            for (e, b, c, d) in [(a, b, c, d), (c, d, a, b)] {
                let mut f = e ^ 1;
                for _ in 0..ROW {
                    let g = tour.linked(f);
                    if f / 2 == c / 2 || f / 2 == d / 2 || !tour.is_somewhere(f) {
                        break;
                    }
                    if g != c {
                        let gain =
                            saved + tour.distance(f, g) - tour.distance(b, g) - tour.distance(f, d);
                        offer(gain, Move::Carry { e, f, c });
                    }
                    f = g ^ 1;
                }
            }
        }
        best
    }

    /// Makes a move, unless it would turn too much over.
    fn make(&mut self, what: Move) -> bool {
        match what {
            Move::Turn { a, c } => self.turn(a, c),
            Move::Carry { e, f, c } => self.carry(e, f, c),
        }
    }

    fn turn(&mut self, a: u32, c: u32) -> bool {
        let tour = &mut self.tour;
        let ends = [a, tour.linked(a), c, tour.linked(c)];
        // The row between the two links, forward from the first.
        let (one, other) = (tour.place(a), tour.place(c));
        let entry = usize::from(tour.is_entry(a));
        let count = tour.steps(one, other);
        let around = tour.len();
        let (place, count) = if 2 * count <= around {
            (one + 1 - entry, count)
        } else {
            (other + 1 - entry, around - count)
        };
        if self.longest < count {
            return false;
        }
        tour.reverse(place, count);
        ends.into_iter().for_each(|end| self.look_at(end));
        true
    }

    fn carry(&mut self, e: u32, f: u32, c: u32) -> bool {
        let tour = &mut self.tour;
        let ends = [e, f, c, tour.linked(e), tour.linked(f), tour.linked(c)];
        let e_is_first = tour.is_entry(e);
        let (first, last) = if e_is_first {
            (tour.place(e), tour.place(f))
        } else {
            (tour.place(f), tour.place(e))
        };
        let row = tour.steps(first, last) + 1;
        // The stop before the link into which the row goes.
        let c_is_before = !tour.is_entry(c);
        let before = if c_is_before { tour.place(c) } else { tour.place(tour.linked(c)) };
        let forward = tour.steps(last, before);
        let backward = tour.len() - row - forward;
        if self.longest < forward.min(backward) {
            return false;
        }
        let turned = c_is_before != e_is_first;
        if forward <= backward {
            // row, between  ->  between, row
            tour.reverse(first, row + forward);
            tour.reverse(first, forward);
            if !turned {
                tour.reverse(first + forward, row);
            }
        } else {
            let start = before + 1;
            tour.reverse(start, backward + row);
            tour.reverse(start + row, backward);
            if !turned {
                tour.reverse(start, row);
            }
        }
        ends.into_iter().for_each(|end| self.look_at(end));
        true
    }

    /// Lets two short rows change places; returns what that gains, which is
    /// mostly a loss.
    fn change_places(&mut self) -> f64 {
        let around = self.tour.len();
        let longest = KICK.min(around as u64 / 3);
        let [one, two] = [0, 1].map(|_| 1 + self.roll(longest) as usize);
        self.kicked = (self.kicked + 1 + self.roll(longest) as usize) % around;
        let tour = &mut self.tour;
        let start = self.kicked;
        let before = tour.stop(start) ^ 1;
        let [a, b, c, d, e] = [
            tour.stop(start + 1),
            tour.stop(start + one) ^ 1,
            tour.stop(start + one + 1),
            tour.stop(start + one + two) ^ 1,
            tour.stop(start + one + two + 1),
        ];
        let gain = tour.distance(before, a) + tour.distance(b, c) + tour.distance(d, e)
            - tour.distance(before, c)
            - tour.distance(d, a)
            - tour.distance(b, e);
        tour.reverse(start + 1, one + two);
        tour.reverse(start + 1, two);
        tour.reverse(start + 1 + two, one);
        [before, a, b, c, d, e].into_iter().for_each(|end| self.look_at(end));
        gain
    }

    /// A number below `sides` (xorshift, Marsaglia 2003).
    fn roll(&mut self, sides: u64) -> u64 {
        self.dice ^= self.dice << 13;
        self.dice ^= self.dice >> 7;
        self.dice ^= self.dice << 17;
        (self.dice >> 11) % sides.max(1)
    }
}
