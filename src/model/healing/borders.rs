//! Sides without a partner: which there are, and how many have found one.
//!
//! Every side of a face is a random number, and every place holds the sum,
//! without carry, of those of all sides there: sides that come in pairs cancel,
//! whatever their direction, so that a closed surface is found to be closed
//! without one edge of it being made. That a sum vanishes by chance happens
//! once in 2^64 cases; a border would then be passed over.

use super::net::{FaceName, Net, Rings};
use super::splits::Side;
use crate::run::{map_chunks, map_small, sort_by};
use rustc_hash::FxHashSet;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// The sum of all sides at each place.
pub(super) struct SideSums(Vec<AtomicU64>);

impl SideSums {
    pub(super) fn zero(places: usize) -> Self {
        SideSums(map_small(places, |_| AtomicU64::new(0)))
    }

    /// Adds the sides of a face of an object.
    #[inline]
    pub(super) fn add(&self, object: u32, rings: &Rings) {
        if let [a, b, c] = *rings.corners {
            let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|side| number(object, side));
            for (place, sum) in [(a, ca ^ ab), (b, ab ^ bc), (c, bc ^ ca)] {
                self.0[place as usize].fetch_xor(sum, Relaxed);
            }
            return;
        }
        for side in rings.sides() {
            for end in side {
                self.0[end as usize].fetch_xor(number(object, side), Relaxed);
            }
        }
    }

    fn at(&self, place: u32) -> u64 {
        self.0[place as usize].load(Relaxed)
    }

    /// Whether every side has a partner.
    pub(super) fn are_closed(&self) -> bool {
        let parts = map_chunks(self.0.len(), 1 << 16, |part| {
            self.0[part].iter().all(|sum| sum.load(Relaxed) == 0)
        });
        parts.into_iter().all(|closed| closed)
    }

    /// Whether a side may be a border: both its ends are open.
    fn may_be_open(&self, side: [u32; 2]) -> bool {
        side[0] != side[1] && side.into_iter().all(|end| self.at(end) != 0)
    }
}

/// The number of a side of an object, in either direction; 0 if it has no
/// length.
#[inline(always)]
fn number(object: u32, [a, b]: [u32; 2]) -> u64 {
    if a == b {
        return 0;
    }
    let side = u64::from(a.max(b)) << 32 | u64::from(a.min(b));
    let factor = u64::from(object).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0xd6e8_feb8_6659_fd93;
    let product = u128::from(side ^ 0xa076_1d64_78bd_642f) * u128::from(factor | 1);
    let mixed = (product >> 64) as u64 ^ product as u64;
    mixed ^ mixed.wrapping_mul(0xe703_7ed1_a0b4_28db).rotate_left(32)
}

/// All borders, sorted: sides that an odd number of faces have.
pub(super) fn borders(net: &Net<'_>, sums: &SideSums) -> Vec<Side> {
    let parts = net.map_faces(Vec::new, |sides: &mut Vec<Side>, name, rings| {
        let open = rings.sides().filter(|&side| sums.may_be_open(side));
        sides.extend(open.map(|side| Side::new(name.object, side)));
    });
    let mut sides = parts.concat();
    sort_by(&mut sides, Ord::cmp);
    let odd = sides.chunk_by(|a, b| a == b).filter(|same| same.len() % 2 == 1);
    odd.map(|same| same[0]).collect()
}

/// What is to be counted, part by part.
#[derive(Default)]
struct Counted {
    closed: usize,
    /// Sides that have to be compared with others, by their places in the file.
    unclear: Vec<Side>,
}

/// How many sides of the file were borders and are none now. `before` are the
/// sums of the file, `left` the borders that there are now.
pub(super) fn count_closed(net: &Net<'_>, before: &SideSums, left: &[Side]) -> usize {
    let left: FxHashSet<Side> = left.iter().copied().collect();
    let parts = net.map_faces(Counted::default, |counted, name, rings| {
        if rings.ends.is_empty() {
            return;
        }
        let start = net.starts[name.object as usize];
        let old_rings = || net.soups[name.object as usize].faces.rings(name.face as usize);
        let was_side = |side: [u32; 2]| {
            old_rings().any(|ring| {
                let now = |corner: usize| net.now[(start + ring[corner % ring.len()]) as usize];
                (0..ring.len()).any(|i| is_same([now(i), now(i + 1)], side))
            })
        };
        for ring in old_rings() {
            let [first, now] = [&net.first, &net.now].map(|names| {
                move |corner: usize| names[(start + ring[corner % ring.len()]) as usize]
            });
            let number = |i: usize| number(name.object, [first(i), first(i + 1)]);
            for i in 0..ring.len() {
                let (old, side) = ([first(i), first(i + 1)], [now(i), now(i + 1)]);
                let sums = old.map(|end| before.at(end));
                let is_open = sums[0] != 0 && sums[1] != 0 && old[0] != old[1];
                if !is_open || !is_closed(net, &left, name, rings, side, was_side) {
                    continue;
                }
                // Where nothing is open but two sides of one face.
                let corner = |i: usize| number(i + ring.len() - 1) ^ number(i);
                if sums[0] == corner(i) || sums[1] == corner(i + 1) {
                    counted.closed += 1;
                } else {
                    counted.unclear.push(Side::new(name.object, old));
                }
            }
        }
    });
    let mut unclear = Vec::new();
    let mut closed = 0;
    for part in parts {
        unclear.extend(part.unclear);
        closed += part.closed;
    }
    sort_by(&mut unclear, Ord::cmp);
    let odd = unclear.chunk_by(|a, b| a == b).filter(|same| same.len() % 2 == 1);
    closed + odd.map(<[Side]>::len).sum::<usize>()
}

/// Whether a side that a face had is no border of it now.
fn is_closed(
    net: &Net<'_>,
    left: &FxHashSet<Side>,
    name: FaceName,
    rings: &Rings,
    side: [u32; 2],
    was_side: impl Fn([u32; 2]) -> bool,
) -> bool {
    if side[0] == side[1] {
        return false;
    }
    let is_left = |side: [u32; 2]| left.contains(&Side::new(name.object, side));
    if left.is_empty() {
        return true;
    }
    if !net.changed.contains_key(&name) || rings.sides().any(|other| is_same(other, side)) {
        return !is_left(side);
    }
    // The side was split: none of what is new of the face may be open.
    !rings.sides().any(|new| is_left(new) && !was_side(new))
}

fn is_same([a, b]: [u32; 2], other: [u32; 2]) -> bool {
    other == [a, b] || other == [b, a]
}
