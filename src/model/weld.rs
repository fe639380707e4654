//! Welding: vertices of one object with bitwise equal positions become one.
//!
//! Vertices are dealt into buckets by a hash of their position, each
//! bucket is small enough for its table to stay in the cache, and buckets
//! are independent, so they run in parallel. The representative of a
//! position is its first vertex, so the result does not depend on the
//! number of threads. Expected O(n).
//!
//! Merging within a tolerance is another matter: it is not an equivalence,
//! so it is done only on request, greedily in file order, before anything
//! else.

use crate::run::{map_chunks, map_indexed, map_small};
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// Which vertices became which.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Welded {
    /// New number of each old vertex. New numbers follow the order of
    /// first appearance.
    pub(super) new_of_old: Vec<u32>,
    /// First old vertex of each new one.
    pub(super) first_old: Vec<u32>,
}

/// Vertices a bucket holds on average.
const BUCKET: usize = 1 << 13;

/// Vertices of one part of the counting sort.
const PART: usize = 1 << 16;

/// The bits of a position, with -0 and 0 made equal.
fn key(position: DVec3) -> [u64; 3] {
    position.to_array().map(|x| (x + 0.0).to_bits())
}

/// A hash of position and object; the upper bits choose the bucket, the
/// lower ones the slot.
fn hash(position: DVec3, object: u32) -> u64 {
    let [x, y, z] = key(position);
    let mut state = u64::from(object) ^ 0x9e37_79b9_7f4a_7c15;
    for word in [x, y, z] {
        let product = u128::from(state ^ word) * 0xd6e8_feb8_6659_fd93_u128;
        state = (product as u64) ^ ((product >> 64) as u64).rotate_left(17);
    }
    state ^ (state >> 29)
}

/// The object of each vertex, from where the objects begin.
fn object_of(starts: &[u32], vertex: usize) -> u32 {
    if starts.len() <= 1 {
        return 0;
    }
    starts.partition_point(|&start| start as usize <= vertex) as u32 - 1
}

/// The vertices of one part of the input, ordered by bucket.
struct Dealt {
    vertices: Vec<u32>,
    ends: Vec<u32>,
}

fn deal(positions: &[DVec3], starts: &[u32], part: std::ops::Range<usize>, shift: u32) -> Dealt {
    let buckets = 1_usize << (64 - shift).min(63);
    let bucket = |vertex: usize| match shift {
        64 => 0,
        _ => (hash(positions[vertex], object_of(starts, vertex)) >> shift) as usize,
    };
    let buckets = if shift == 64 { 1 } else { buckets };
    let of_vertex: Vec<u16> = part.clone().map(|vertex| bucket(vertex) as u16).collect();
    let mut ends = vec![0_u32; buckets];
    of_vertex.iter().for_each(|&b| ends[b as usize] += 1);
    let mut next = Vec::with_capacity(buckets);
    let mut sum = 0;
    for end in &mut ends {
        next.push(sum);
        sum += *end;
        *end = sum;
    }
    let mut vertices = vec![0; part.len()];
    for (offset, &b) in of_vertex.iter().enumerate() {
        vertices[next[b as usize] as usize] = (part.start + offset) as u32;
        next[b as usize] += 1;
    }
    Dealt { vertices, ends }
}

impl Dealt {
    fn bucket(&self, bucket: usize) -> &[u32] {
        let start = if bucket == 0 { 0 } else { self.ends[bucket - 1] as usize };
        &self.vertices[start..self.ends[bucket] as usize]
    }
}

/// Welds equal positions within each object; `starts` holds the first
/// vertex of each object.
pub(super) fn weld(positions: &[DVec3], starts: &[u32]) -> Welded {
    let count = positions.len();
    // At most 2^16 buckets, so that a bucket number fits 16 bits.
    let bits = (count / BUCKET).max(1).next_power_of_two().trailing_zeros().min(16);
    let shift = 64 - bits;
    let parts = map_chunks(count, PART, |part| deal(positions, starts, part, shift));
    let firsts: Vec<AtomicU32> = map_small(count, |_| AtomicU32::new(0));
    map_indexed(1 << bits, |bucket| {
        let vertices = || parts.iter().flat_map(|part| part.bucket(bucket).iter().copied());
        weld_bucket(positions, starts, vertices, &firsts);
    });
    number(firsts.into_iter().map(AtomicU32::into_inner).collect())
}

/// Finds the first equal vertex of every vertex of one bucket, by open
/// addressing.
fn weld_bucket<I: Iterator<Item = u32>>(
    positions: &[DVec3],
    starts: &[u32],
    vertices: impl Fn() -> I,
    firsts: &[AtomicU32],
) {
    const EMPTY: u32 = u32::MAX;
    let slots = (2 * vertices().count()).max(4).next_power_of_two();
    let mut table = vec![EMPTY; slots];
    for vertex in vertices() {
        let position = positions[vertex as usize];
        let object = object_of(starts, vertex as usize);
        let mut slot = hash(position, object) as usize & (slots - 1);
        let first = loop {
            let other = table[slot];
            if other == EMPTY {
                table[slot] = vertex;
                break vertex;
            }
            if positions[other as usize] == position && object_of(starts, other as usize) == object
            {
                break other;
            }
            slot = (slot + 1) & (slots - 1);
        };
        firsts[vertex as usize].store(first, Relaxed);
    }
}

/// Turns first vertices into numbers in order of appearance.
fn number(mut firsts: Vec<u32>) -> Welded {
    let mut first_old = Vec::with_capacity(firsts.len());
    for vertex in 0..firsts.len() {
        let first = firsts[vertex] as usize;
        // A first vertex comes before all its equals, so its new number is
        // already in its place when they are reached.
        firsts[vertex] = if first == vertex {
            first_old.push(vertex as u32);
            first_old.len() as u32 - 1
        } else {
            firsts[first]
        };
    }
    Welded { new_of_old: firsts, first_old }
}

/// Merges each vertex with the first earlier representative of its object
/// within `tolerance`; returns how many vertices moved.
pub(super) fn merge_close(positions: &mut [DVec3], starts: &[u32], tolerance: f64) -> usize {
    let mut moved = 0;
    let mut grid: FxHashMap<(u32, [i64; 3]), Vec<u32>> = FxHashMap::default();
    for vertex in 0..positions.len() {
        let position = positions[vertex];
        let object = object_of(starts, vertex);
        let cell = (position / tolerance).floor().to_array().map(|x| x as i64);
        let mut nearest: Option<u32> = None;
        for offset in 0..27_i64 {
            let shift = [offset % 3 - 1, offset / 3 % 3 - 1, offset / 9 - 1];
            let neighbour = [0, 1, 2].map(|i| cell[i].saturating_add(shift[i]));
            for &other in grid.get(&(object, neighbour)).into_iter().flatten() {
                let close = positions[other as usize].distance(position) <= tolerance;
                if close && nearest.is_none_or(|best| other < best) {
                    nearest = Some(other);
                }
            }
        }
        match nearest {
            Some(other) => {
                moved += usize::from(positions[other as usize] != position);
                positions[vertex] = positions[other as usize];
            }
            None => grid.entry((object, cell)).or_default().push(vertex as u32),
        }
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_positions_become_one_and_signed_zeros_are_equal() {
        let positions = [
            DVec3::new(0.0, 1.0, 2.0),
            DVec3::new(3.0, 0.0, 0.0),
            DVec3::new(-0.0, 1.0, 2.0),
            DVec3::new(3.0, f64::from_bits(1), 0.0),
        ];
        let welded = weld(&positions, &[0]);
        assert_eq!(welded.new_of_old, [0, 1, 0, 2]);
        assert_eq!(welded.first_old, [0, 1, 3]);
    }

    #[test]
    fn objects_are_never_welded_together() {
        let welded = weld(&[DVec3::ONE, DVec3::ONE, DVec3::ONE], &[0, 1]);
        assert_eq!(welded.new_of_old, [0, 1, 1]);
    }

    #[test]
    fn many_vertices_agree_with_a_plain_table() {
        let positions: Vec<DVec3> = (0..300_000_u64)
            .map(|i| {
                let x = i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 48;
                DVec3::new((x % 97) as f64, (x % 89) as f64 * 1e-3, (x % 11) as f64)
            })
            .collect();
        let welded = weld(&positions, &[0, 100_000]);
        let mut table = FxHashMap::default();
        for (i, position) in positions.iter().enumerate() {
            let next = table.len() as u32;
            let number = *table.entry((i >= 100_000, key(*position))).or_insert(next);
            assert_eq!(welded.new_of_old[i], number);
        }
    }

    #[test]
    fn vertices_within_the_tolerance_merge_with_the_earliest() {
        let mut positions = [DVec3::ZERO, DVec3::X * 0.9, DVec3::X * 1.8];
        assert_eq!(merge_close(&mut positions, &[0], 1.0), 1);
        assert_eq!(positions, [DVec3::ZERO, DVec3::ZERO, DVec3::X * 1.8]);
    }
}
