//! Vertices that are equal, and vertices that are near one another.
//!
//! Space is cut into cells much wider than the tolerance. A vertex belongs to
//! its own cell and, within the tolerance of a wall, to those beyond it too,
//! so two vertices that are near have a cell in common, and most cells hold
//! one vertex. Cells go by a hash; where two have the same, a few distances
//! are measured for nothing. Vertices are dealt into buckets by it as in
//! [`super::super::weld`]. In a crowded cell a plane is swept along its longest
//! side. Expected O(n) while few vertices are near one another.

use super::super::components::{join, root};
use super::Tolerance;
use crate::run::{map_chunks, map_indexed, map_small};
use glam::DVec3;
use std::cmp::Ordering;
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// What is found.
pub(super) struct Near {
    /// The first vertex at the position of each.
    pub(super) first: Vec<u32>,
    /// Pairs of first vertices that are near one another: not all of them, but
    /// so many that what hangs together by all hangs together by these.
    pub(super) links: Vec<[u32; 2]>,
}

/// Vertices a bucket holds on average, and those of one part of the dealing.
const BUCKET: usize = 1 << 12;
const PART: usize = 1 << 16;

/// Sides of a cell in tolerances: at least, and where vertices are sparse.
const NARROW: f64 = 16.0;
const WIDE: f64 = 64.0;

/// Finds them among finite positions.
pub(super) fn near(positions: &[DVec3], tolerance: Tolerance) -> Near {
    let grid = Grid::for_positions(positions, tolerance);
    let count = positions.len();
    let bits = (count / BUCKET).max(1).next_power_of_two().trailing_zeros().min(15);
    let parts = map_chunks(count, PART, |part| deal(positions, &grid, part, bits));
    let first: Vec<AtomicU32> = map_small(count, |vertex| AtomicU32::new(vertex as u32));
    let links = map_indexed(1 << bits, |bucket| {
        let mut entries: Vec<Entry> = Vec::new();
        parts.iter().for_each(|part| entries.extend_from_slice(part.bucket(bucket)));
        entries.sort_unstable();
        let mut cell = Cell { positions, tolerance, first: &first, links: Vec::new() };
        for together in entries.chunk_by(|a, b| a.cell() == b.cell()) {
            if together.len() > 1 {
                cell.compare(together);
            }
        }
        cell.links
    });
    Near { first: first.into_iter().map(AtomicU32::into_inner).collect(), links: links.concat() }
}

/// Cells of space.
struct Grid {
    side: f64,
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
        // Far from the origin the number of a cell has to stay finite.
        let least = low.abs().max(high.abs()).max_element() * 1e-300;
        let side = apart.clamp(NARROW * reach, WIDE * reach).max(least).min(f64::MAX);
        Grid { side, margin: reach / side * 1.01 }
    }

    /// Calls `found` with the cells of a position, its own first.
    #[inline(always)]
    fn cells(&self, position: DVec3, mut found: impl FnMut(u64)) {
        let place = position / self.side;
        let own = place.floor();
        found(hash(own));
        let inside = place - own;
        // Quotients are rounded too.
        let margin = DVec3::splat(self.margin) + place.abs() * f64::EPSILON;
        let low = inside.cmple(margin);
        let high = (DVec3::ONE - inside).cmple(margin);
        if !(low | high).any() {
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
                found(hash(own + steps * chosen));
            }
        }
    }
}

fn hash(cell: DVec3) -> u64 {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    for number in (cell + DVec3::ZERO).to_array() {
        let product = u128::from(state ^ number.to_bits()) * 0xd6e8_feb8_6659_fd93_u128;
        state = (product as u64) ^ ((product >> 64) as u64).rotate_left(17);
    }
    state ^ (state >> 29)
}

/// A vertex in a cell, in one word for the sake of sorting: 31 bits of the
/// cell's hash, whether the cell is not its own, the vertex.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Entry(u64);

impl Entry {
    fn new(hash: u64, is_guest: bool, vertex: u32) -> Self {
        Entry(hash >> 33 << 33 | u64::from(is_guest) << 32 | u64::from(vertex))
    }

    fn cell(self) -> u64 {
        self.0 >> 33
    }

    fn is_guest(self) -> bool {
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
        grid.cells(positions[vertex], |hash| {
            all.push(Entry::new(hash, is_guest, vertex as u32));
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

/// What is done with the vertices of a cell.
struct Cell<'a> {
    positions: &'a [DVec3],
    tolerance: Tolerance,
    first: &'a [AtomicU32],
    links: Vec<[u32; 2]>,
}

impl Cell<'_> {
    fn position(&self, entry: Entry) -> DVec3 {
        self.positions[entry.vertex() as usize]
    }

    fn compare(&mut self, together: &[Entry]) {
        if let &[a, b] = together {
            let [p, q] = [a, b].map(|entry| self.position(entry));
            if p == q {
                self.equal(&[a, b]);
            } else if self.tolerance.allows(p, q) {
                self.links.push([a.vertex(), b.vertex()]);
            }
            return;
        }
        let axis = longest_side(together.iter().map(|&entry| self.position(entry)));
        let mut sorted: Vec<(DVec3, Entry)> =
            together.iter().map(|&entry| (self.position(entry) + DVec3::ZERO, entry)).collect();
        sorted.sort_unstable_by(|(p, a), (q, b)| {
            let places = [axis, (axis + 1) % 3, (axis + 2) % 3].map(|k| p[k].total_cmp(&q[k]));
            let place = places.into_iter().fold(Ordering::Equal, Ordering::then);
            place.then(a.vertex().cmp(&b.vertex()))
        });
        let mut distinct: Vec<(DVec3, u32)> = Vec::with_capacity(sorted.len());
        for equal in sorted.chunk_by(|(p, _), (q, _)| p == q) {
            distinct.push((equal[0].0, equal[0].1.vertex()));
            if equal.len() > 1 {
                self.equal(&equal.iter().map(|(_, entry)| *entry).collect::<Vec<_>>());
            }
        }
        self.sweep(&distinct, axis);
    }

    /// Notes that vertices, the first in front, have one position.
    fn equal(&mut self, vertices: &[Entry]) {
        let first = vertices.iter().map(|entry| entry.vertex()).min().unwrap_or(0);
        // A guest is at home with the same company.
        let at_home = vertices.iter().filter(|entry| !entry.is_guest());
        at_home.for_each(|entry| self.first[entry.vertex() as usize].store(first, Relaxed));
    }

    /// Links positions that are sorted along an axis.
    fn sweep(&mut self, sorted: &[(DVec3, u32)], axis: usize) {
        let mut parents: Vec<u32> = (0..sorted.len() as u32).collect();
        let reach = self.tolerance.distance();
        for (i, &(p, vertex)) in sorted.iter().enumerate() {
            for (j, &(q, other)) in sorted.iter().enumerate().skip(i + 1) {
                if q[axis] - p[axis] > reach {
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
        let found = near(positions, tolerance);
        let (first, roots) = by_all_pairs(positions, tolerance);
        assert_eq!(found.first, first);
        let mut parents: Vec<u32> = found.first.clone();
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
