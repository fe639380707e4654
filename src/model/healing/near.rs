//! Vertices that are equal, and vertices that are near one another.
//!
//! Space is cut into cells much wider than the tolerance. A vertex belongs to
//! its own cell and, within the tolerance of a wall, to those beyond it too,
//! so two vertices that are near have a cell in common, and most cells hold
//! one vertex. Cells go by a hash; where two have the same, a few distances
//! are measured for nothing. Vertices are dealt into buckets by it as when they
//! are welded. In a crowded cell a plane is swept along its longest side.
//! Expected O(n) while few vertices are near one another.
//!
//! Most that is near is a handful of copies of one vertex, alone in their cell
//! and all near one another: which of them is kept is settled there, where they
//! are at hand.

use super::{Tolerance, compare, rank};
use crate::model::components::{join, root};
use crate::run::{map_chunks, map_indexed, map_small};
use glam::DVec3;
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// What is found.
pub(super) struct Near {
    /// The first vertex at the position of each.
    pub(super) first: Vec<u32>,
    /// The same, but where all that hangs together with a vertex is near one
    /// another, the one that is kept of them.
    pub(super) kept: Vec<u32>,
    /// Pairs of other first vertices that are near one another: not all of them,
    /// but so many that what hangs together by all hangs together by these.
    pub(super) links: Vec<[u32; 2]>,
}

/// Vertices a bucket holds on average, and those of one part of the dealing.
const BUCKET: usize = 1 << 12;
const PART: usize = 1 << 16;

/// Sides of a cell in tolerances: at least, and where vertices are sparse.
const NARROW: f64 = 16.0;
const WIDE: f64 = 64.0;

/// Finds them among finite positions, of which some coordinates are locked to
/// planes (bits by axis).
pub(super) fn near(positions: &[DVec3], locks: &[u8], tolerance: Tolerance) -> Near {
    let grid = Grid::for_positions(positions, tolerance);
    let count = positions.len();
    let bits = (count / BUCKET).max(1).next_power_of_two().trailing_zeros().min(15);
    let parts = map_chunks(count, PART, |part| deal(positions, &grid, part, bits));
    let names = || map_small(count, |vertex| AtomicU32::new(vertex as u32));
    let (first, kept) = (names(), names());
    let links = map_indexed(1 << bits, |bucket| {
        let entries = parts.iter().map(|part| part.bucket(bucket)).collect::<Vec<_>>().concat();
        let links = Vec::new();
        let mut bucket = Bucket { positions, locks, tolerance, first: &first, kept: &kept, links };
        for_each_cell(&entries, |cell| bucket.compare(cell));
        bucket.links
    });
    let plain = |names: Vec<AtomicU32>| names.into_iter().map(AtomicU32::into_inner).collect();
    Near { first: plain(first), kept: plain(kept), links: links.concat() }
}

/// Cells of space.
struct Grid {
    /// Cells in one unit of length.
    per_unit: f64,
    /// How near to a wall a vertex is in both cells, in sides.
    margin: f64,
}

impl Grid {
    fn for_positions(positions: &[DVec3], tolerance: Tolerance) -> Self {
        let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let join = |a: (DVec3, DVec3), b: (DVec3, DVec3)| (a.0.min(b.0), a.1.max(b.1));
        let parts = map_chunks(positions.len(), PART, |part| {
            positions[part].iter().fold(empty, |bounds, &p| join(bounds, (p, p)))
        });
        let (low, high) = parts.into_iter().fold(empty, join);
        let size = (high - low).max_element();
        let apart = 0.5 * size / (positions.len().max(1) as f64).sqrt();
        let reach = tolerance.distance();
        // The number of a cell, and that of cells in a unit, have to be finite.
        let least = (low.abs().max(high.abs()).max_element() * 1e-300).max(1e-300);
        let side = apart.clamp(NARROW * reach, WIDE * reach).max(least).min(f64::MAX);
        Grid { per_unit: 1.0 / side, margin: reach / side * 1.01 }
    }

    /// Calls `found` with a position's own cell, and whether others are near;
    /// then with these.
    #[inline(always)]
    fn cells(&self, position: DVec3, mut found: impl FnMut(u64, bool)) {
        let place = position * self.per_unit;
        let own = DVec3::new(floor(place.x), floor(place.y), floor(place.z));
        let inside = place - own;
        // Products are rounded too.
        let margin = DVec3::splat(self.margin) + place.abs() * f64::EPSILON;
        let low = inside.cmple(margin);
        let high = (DVec3::ONE - inside).cmple(margin);
        let is_at_wall = (low | high).any();
        found(hash(own), is_at_wall);
        if !is_at_wall {
            return;
        }
        let step = |axis: usize| match (low.test(axis), high.test(axis)) {
            (true, _) => -1.0,
            (false, true) => 1.0,
            (false, false) => 0.0,
        };
        let steps = DVec3::new(step(0), step(1), step(2));
        for which in 1..8 {
            let chosen =
                DVec3::new(f64::from(which & 1), f64::from(which >> 1 & 1), f64::from(which >> 2));
            // Without a wall on a chosen side that cell has been told.
            if chosen.cmpgt(DVec3::ZERO).bitmask() & steps.cmpeq(DVec3::ZERO).bitmask() == 0 {
                found(hash(own + steps * chosen), true);
            }
        }
    }
}

/// The greatest whole number not above this one: without a call where the
/// processor has no instruction for it.
#[inline(always)]
fn floor(number: f64) -> f64 {
    const WHOLE: f64 = (1_u64 << 52) as f64;
    let cut = number as i64 as f64;
    let floor = if cut > number { cut - 1.0 } else { cut };
    if number.abs() < WHOLE { floor } else { number }
}

#[inline(always)]
fn hash(cell: DVec3) -> u64 {
    let [x, y, z] = (cell + DVec3::ZERO).to_array().map(f64::to_bits);
    let mixed = (x.wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29) ^ y)
        .wrapping_mul(0xd6e8_feb8_6659_fd93)
        .rotate_left(31)
        ^ z;
    let mixed = (mixed ^ mixed >> 32).wrapping_mul(0xa076_1d64_78bd_642f);
    (mixed ^ mixed >> 29).wrapping_mul(0xe703_7ed1_a0b4_28db)
}

/// A vertex in a cell, in one word: 30 bits of the cell's hash, whether the
/// cell is not its own, whether it is in others too, the vertex.
#[derive(Clone, Copy)]
struct Entry(u64);

impl Entry {
    fn new(hash: u64, is_guest: bool, is_at_wall: bool, vertex: u32) -> Self {
        let flags = u64::from(is_guest) << 33 | u64::from(is_at_wall) << 32;
        Entry(hash >> 34 << 34 | flags | u64::from(vertex))
    }

    fn cell(self) -> u64 {
        self.0 >> 34
    }

    fn is_guest(self) -> bool {
        self.0 >> 33 & 1 == 1
    }

    fn is_at_wall(self) -> bool {
        self.0 >> 32 & 1 == 1
    }

    fn vertex(self) -> u32 {
        self.0 as u32
    }

    fn bucket(self, bits: u32) -> usize {
        // A shift by 64 would be none.
        (self.0 >> 1 >> (63 - bits)) as usize
    }
}

/// Entries of one part of the vertices, ordered by bucket.
struct Dealt {
    entries: Vec<Entry>,
    ends: Vec<u32>,
}

impl Dealt {
    fn bucket(&self, bucket: usize) -> &[Entry] {
        let start = if bucket == 0 { 0 } else { self.ends[bucket - 1] as usize };
        &self.entries[start..self.ends[bucket] as usize]
    }
}

fn deal(positions: &[DVec3], grid: &Grid, part: Range<usize>, bits: u32) -> Dealt {
    let mut all = Vec::with_capacity(part.len() * 3 / 2);
    for vertex in part {
        let mut is_guest = false;
        grid.cells(positions[vertex], |hash, is_at_wall| {
            all.push(Entry::new(hash, is_guest, is_at_wall, vertex as u32));
            is_guest = true;
        });
    }
    let mut ends = vec![0_u32; 1 << bits];
    all.iter().for_each(|entry| ends[entry.bucket(bits)] += 1);
    let mut sum = 0;
    let start = |end: &mut u32| {
        let start = sum;
        sum += *end;
        *end = sum;
        start
    };
    let mut next: Vec<u32> = ends.iter_mut().map(start).collect();
    let mut entries = vec![Entry(0); all.len()];
    for entry in all {
        let slot = &mut next[entry.bucket(bits)];
        entries[*slot as usize] = entry;
        *slot += 1;
    }
    Dealt { entries, ends }
}

/// Calls `work` with the entries of each cell that has more than one.
fn for_each_cell(entries: &[Entry], mut work: impl FnMut(&[Entry])) {
    const NONE: u32 = u32::MAX;
    let slots = (2 * entries.len()).max(4).next_power_of_two();
    // The last entry of the cell in each slot, and for each entry the one
    // before it in its cell.
    let mut last = vec![NONE; slots];
    let mut before = vec![NONE; entries.len()];
    for (number, entry) in entries.iter().enumerate() {
        let mut slot = entry.cell() as usize & (slots - 1);
        while last[slot] != NONE && entries[last[slot] as usize].cell() != entry.cell() {
            slot = (slot + 1) & (slots - 1);
        }
        before[number] = last[slot];
        last[slot] = number as u32;
    }
    let mut cell = Vec::new();
    for mut number in last {
        if number == NONE || before[number as usize] == NONE {
            continue;
        }
        cell.clear();
        while number != NONE {
            cell.push(entries[number as usize]);
            number = before[number as usize];
        }
        work(&cell);
    }
}

/// So many vertices of a cell are compared one with another.
const FEW: usize = 12;

/// What is done with the vertices of a bucket.
struct Bucket<'a> {
    positions: &'a [DVec3],
    locks: &'a [u8],
    tolerance: Tolerance,
    first: &'a [AtomicU32],
    kept: &'a [AtomicU32],
    links: Vec<[u32; 2]>,
}

/// A position in a cell.
#[derive(Clone, Copy)]
struct Place {
    position: DVec3,
    /// The first vertex there.
    first: u32,
    locks: u8,
}

impl Bucket<'_> {
    fn position(&self, entry: Entry) -> DVec3 {
        self.positions[entry.vertex() as usize]
    }

    fn compare(&mut self, cell: &[Entry]) {
        let mut places = [Place { position: DVec3::ZERO, first: 0, locks: 0 }; FEW];
        if cell.len() > FEW {
            return self.compare_many(cell);
        }
        let places = &mut places[..cell.len()];
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for (place, &entry) in places.iter_mut().zip(cell) {
            let (position, locks) = (self.position(entry), self.locks[entry.vertex() as usize]);
            (low, high) = (low.min(position), high.max(position));
            *place = Place { position, first: entry.vertex(), locks };
        }
        if low == high {
            return self.equal(cell);
        }
        // Equal ones get one name, the least.
        for i in 0..places.len() {
            for j in 0..places.len() {
                if places[i].position == places[j].position {
                    places[i].first = places[i].first.min(places[j].first);
                    places[i].locks |= places[j].locks;
                }
            }
        }
        let all_are_near = self.tolerance.allows(low, high);
        let is_alone = !cell.iter().any(|entry| entry.is_at_wall());
        let keeper = if all_are_near && is_alone { keeper(places) } else { None };
        for (place, entry) in places.iter().zip(cell).filter(|(_, entry)| !entry.is_guest()) {
            let kept = keeper.unwrap_or(place.first);
            self.first[entry.vertex() as usize].store(place.first, Relaxed);
            self.kept[entry.vertex() as usize].store(kept, Relaxed);
        }
        if keeper.is_some() {
            return;
        }
        for i in 1..places.len() {
            for j in 0..i {
                let is_other = places[i].first != places[j].first;
                if is_other && self.tolerance.allows(places[i].position, places[j].position) {
                    self.links.push([places[i].first, places[j].first]);
                }
            }
        }
    }

    /// Notes that vertices have one position.
    fn equal(&mut self, vertices: &[Entry]) {
        let first = vertices.iter().map(|entry| entry.vertex()).min().unwrap_or(0);
        // A guest is at home with the same company.
        for entry in vertices.iter().filter(|entry| !entry.is_guest()) {
            self.first[entry.vertex() as usize].store(first, Relaxed);
            self.kept[entry.vertex() as usize].store(first, Relaxed);
        }
    }

    fn compare_many(&mut self, cell: &[Entry]) {
        let axis = longest_side(cell.iter().map(|&entry| self.position(entry)));
        let turned = |p: DVec3| DVec3::new(p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]);
        let mut sorted: Vec<(DVec3, Entry)> =
            cell.iter().map(|&entry| (turned(self.position(entry)) + DVec3::ZERO, entry)).collect();
        sorted.sort_unstable_by(|(p, a), (q, b)| compare(*p, *q).then(a.vertex().cmp(&b.vertex())));
        let mut distinct: Vec<(DVec3, u32)> = Vec::with_capacity(sorted.len());
        for equal in sorted.chunk_by(|(p, _), (q, _)| p == q) {
            distinct.push((equal[0].0, equal[0].1.vertex()));
            if equal.len() > 1 {
                self.equal(&equal.iter().map(|(_, entry)| *entry).collect::<Vec<_>>());
            }
        }
        self.sweep(&distinct);
    }

    /// Links positions that are sorted.
    fn sweep(&mut self, sorted: &[(DVec3, u32)]) {
        let mut parents: Vec<u32> = (0..sorted.len() as u32).collect();
        let reach = self.tolerance.distance();
        for (i, &(p, vertex)) in sorted.iter().enumerate() {
            for (j, &(q, other)) in sorted.iter().enumerate().skip(i + 1) {
                if q.x - p.x > reach {
                    break;
                }
                let pair = [i as u32, j as u32];
                let [a, b] = pair.map(|item| root(&mut parents, item));
                if a != b && self.tolerance.allows(p, q) {
                    join(&mut parents, pair);
                    self.links.push([vertex, other]);
                }
            }
        }
    }
}

/// The place that is kept of some that are all near one another, if it is in
/// the planes of all others.
fn keeper(places: &[Place]) -> Option<u32> {
    let best = places.iter().min_by(|a, b| {
        (b.locks.count_ones().cmp(&a.locks.count_ones())).then(rank(a.position, b.position))
    })?;
    let is_in_plane = |place: &Place| {
        let same = best.position.cmpeq(place.position).bitmask() as u8;
        place.locks & !same == 0
    };
    places.iter().all(is_in_plane).then_some(best.first)
}

fn longest_side(positions: impl Iterator<Item = DVec3>) -> usize {
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = positions.fold(empty, |(low, high), p| (low.min(p), high.max(p)));
    let size = high - low;
    (0..3).fold(0, |longest, axis| if size[axis] > size[longest] { axis } else { longest })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// What hangs together, and which is the first of equals, by comparing all.
    fn by_all_pairs(positions: &[DVec3], tolerance: Tolerance) -> (Vec<u32>, Vec<u32>) {
        let mut parents: Vec<u32> = (0..positions.len() as u32).collect();
        let mut first = parents.clone();
        for j in 0..positions.len() {
            for i in (0..j).rev() {
                if positions[i] == positions[j] {
                    first[j] = i as u32;
                }
                if tolerance.allows(positions[i], positions[j]) {
                    join(&mut parents, [i as u32, j as u32]);
                }
            }
        }
        let roots = (0..positions.len() as u32).map(|item| root(&mut parents, item)).collect();
        (first, roots)
    }

    fn check(positions: &[DVec3], distance: f64) {
        let tolerance = Tolerance::new(distance);
        let found = near(positions, &vec![0; positions.len()], tolerance);
        let (first, roots) = by_all_pairs(positions, tolerance);
        assert_eq!(found.first, first);
        let mut parents: Vec<u32> = found.first.clone();
        for (vertex, &kept) in (0..).zip(&found.kept) {
            join(&mut parents, [vertex, kept]);
        }
        found.links.into_iter().for_each(|link| {
            join(&mut parents, link);
        });
        let joined: Vec<u32> = (0..positions.len() as u32).map(|i| root(&mut parents, i)).collect();
        assert_eq!(joined, roots);
    }

    proptest! {
        #[test]
        fn cells_find_what_all_pairs_find(
            places in prop::collection::vec(prop::array::uniform3(-40_i32..40), 0..60),
            shifts in prop::collection::vec(prop::array::uniform3(-3_i32..4), 60),
            far in prop::sample::select(vec![0.0, 1e3, -1e9]),
        ) {
            let place = |(p, s): (&[i32; 3], &[i32; 3])| {
                let at = |axis: usize| f64::from(p[axis]) * 0.25 + f64::from(s[axis]) * 1e-3;
                DVec3::new(at(0) + far, at(1), at(2))
            };
            let positions: Vec<DVec3> = places.iter().zip(&shifts).map(place).collect();
            for distance in [1e-4, 1.001e-3, 2.5e-3, 0.26, 5.0] {
                check(&positions, distance);
            }
        }
    }

    #[test]
    fn zeros_are_equal_and_the_ends_of_the_doubles_apart() {
        let far = f64::MAX;
        let positions = [
            DVec3::new(0.0, far, -far),
            DVec3::new(-0.0, far, -far),
            DVec3::new(5e-324, far, -far),
            DVec3::splat(-far),
            DVec3::splat(far),
        ];
        check(&positions, 1e-9);
        check(&positions, 1e-320);
    }
}
