//! A round trip through all strokes, and what it costs to change it.
//!
//! Stroke i has the ends 2 i and 2 i + 1; the partner of an end is `end ^ 1`.
//! A stop of the tour is the end at which its stroke is entered, so the same
//! number says which stroke comes and in which sense. A last stroke that is
//! nowhere, at no distance from anything, closes the tour: where it stands
//! the pen begins and ends.
//!
//! There is one way of changing a tour: reversing some stops in a row. All
//! moves are made of that, and all are undone by it.

use glam::DVec2;

/// The stops, in a ring.
pub(super) struct Tour {
    /// Where each end is.
    points: Vec<DVec2>,
    stops: Vec<u32>,
    /// Where each stroke stands among the stops.
    places: Vec<u32>,
    /// Reversals since the last `mark`.
    log: Vec<(u32, u32)>,
}

impl Tour {
    /// Strokes with these two ends each, in their order, and the one that is
    /// nowhere.
    pub(super) fn new(ends: &[[DVec2; 2]]) -> Self {
        let strokes = ends.len() as u32;
        Tour {
            points: ends.iter().flatten().copied().collect(),
            stops: (0..=strokes).map(|stroke| 2 * stroke).collect(),
            places: (0..=strokes).collect(),
            log: Vec::new(),
        }
    }

    /// The number of stops, the one that is nowhere included.
    pub(super) fn len(&self) -> usize {
        self.stops.len()
    }

    /// Whether this is the end of a stroke that is somewhere.
    pub(super) fn is_somewhere(&self, end: u32) -> bool {
        (end as usize) < self.points.len()
    }

    /// Where an end is; the end must be somewhere.
    pub(super) fn point(&self, end: u32) -> DVec2 {
        self.points[end as usize]
    }

    /// Moves both ends of a closed stroke.
    pub(super) fn put(&mut self, stroke: u32, point: DVec2) {
        self.points[2 * stroke as usize..2 * stroke as usize + 2].fill(point);
    }

    /// The way with the pen up between two ends, mm.
    pub(super) fn distance(&self, a: u32, b: u32) -> f64 {
        match (self.points.get(a as usize), self.points.get(b as usize)) {
            (Some(a), Some(b)) => a.distance(*b),
            _ => 0.0,
        }
    }

    /// Whether the pen enters its stroke at this end.
    pub(super) fn is_entry(&self, end: u32) -> bool {
        self.stops[self.place(end)] == end
    }

    /// The end on the other side of the pen-up move that this end is part of.
    pub(super) fn linked(&self, end: u32) -> u32 {
        let place = self.place(end);
        if self.stops[place] == end { self.before(place) ^ 1 } else { self.after(place) }
    }

    /// Where the stroke of an end stands.
    pub(super) fn place(&self, end: u32) -> usize {
        self.places[(end / 2) as usize] as usize
    }

    /// The stop at a place, counted around the ring.
    pub(super) fn stop(&self, place: usize) -> u32 {
        let place = if self.stops.len() <= place { place - self.stops.len() } else { place };
        self.stops[place]
    }

    fn before(&self, place: usize) -> u32 {
        self.stops[if place == 0 { self.stops.len() - 1 } else { place - 1 }]
    }

    fn after(&self, place: usize) -> u32 {
        self.stops[if place + 1 == self.stops.len() { 0 } else { place + 1 }]
    }

    /// How many steps lead forward from one place to another.
    pub(super) fn steps(&self, from: usize, to: usize) -> usize {
        if from <= to { to - from } else { to + self.stops.len() - from }
    }

    /// Reverses `count` stops from `place` on, each in itself too. Takes
    /// `count` steps.
    pub(super) fn reverse(&mut self, place: usize, count: usize) {
        self.log.push((place as u32, count as u32));
        self.reverse_unlogged(place, count);
    }

    fn reverse_unlogged(&mut self, place: usize, count: usize) {
        let around = self.stops.len();
        let wrap = |place: usize| if around <= place { place - around } else { place };
        let (mut low, mut high) = (wrap(place), wrap(place + count - 1 + usize::from(count == 0)));
        for _ in 0..count / 2 {
            let (first, last) = (self.stops[low] ^ 1, self.stops[high] ^ 1);
            self.set(low, last);
            self.set(high, first);
            low = if low + 1 == around { 0 } else { low + 1 };
            high = if high == 0 { around - 1 } else { high - 1 };
        }
        if count % 2 == 1 {
            self.stops[low] ^= 1;
        }
    }

    fn set(&mut self, place: usize, stop: u32) {
        self.stops[place] = stop;
        self.places[(stop / 2) as usize] = place as u32;
    }

    /// From here on changes can be undone.
    pub(super) fn mark(&mut self) {
        self.log.clear();
    }

    /// How many stops have been turned over since the mark.
    pub(super) fn undo(&mut self) {
        while let Some((place, count)) = self.log.pop() {
            self.reverse_unlogged(place as usize, count as usize);
        }
    }

    /// The stops from the first after the one that is nowhere.
    pub(super) fn open(&self) -> impl Iterator<Item = u32> + '_ {
        let nowhere = self.place(self.points.len() as u32);
        (1..self.stops.len()).map(move |step| self.stop(nowhere + step))
    }
}
