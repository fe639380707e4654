//! A look at all faces: where sides have no partner, and which faces are no
//! wider than the tolerance.
//!
//! Every side of a face is a random number, and every place holds the sum,
//! without carry, of those of all sides there: sides that come in pairs cancel,
//! whatever their direction, so that a closed surface is found to be closed
//! without one edge of it being made. That a sum vanishes by chance happens
//! once in 2^64 cases; an open side would then be passed over.

use super::Tolerance;
use super::net::{FaceName, Net};
use crate::run::{map_chunks, map_small};
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// What is found.
pub(super) struct Survey {
    /// For each place a number that is not zero where a side is open.
    open: Vec<AtomicU64>,
    /// Faces that may be no wider than the tolerance.
    pub(super) thin: Vec<FaceName>,
    /// Faces of three different places in the file that now have fewer.
    pub(super) collapsed: usize,
}

#[derive(Default)]
struct Part {
    thin: Vec<FaceName>,
    collapsed: usize,
}

impl Survey {
    pub(super) fn of(net: &Net<'_>, tolerance: Tolerance) -> Self {
        let open: Vec<AtomicU64> = map_small(net.first.len(), |_| AtomicU64::new(0));
        let parts = net.map_faces(Part::default, |part, name, rings| {
            if let [a, b, c] = *rings.corners {
                let sides = [[a, b], [b, c], [c, a]].map(|side| number(name.object, side));
                let [ab, bc, ca] = sides;
                for (place, sum) in [(a, ca ^ ab), (b, ab ^ bc), (c, bc ^ ca)] {
                    open[place as usize].fetch_xor(sum, Relaxed);
                }
                if a == b || b == c || c == a {
                    part.collapsed += usize::from(had_more(net, name));
                } else if tolerance.is_width_of([a, b, c].map(|place| net.at(place))) {
                    part.thin.push(name);
                }
            } else {
                for side in rings.sides() {
                    let number = number(name.object, side);
                    for end in side {
                        open[end as usize].fetch_xor(number, Relaxed);
                    }
                }
                if rings.iter().next().is_some_and(has_fewer_than_three) {
                    part.collapsed += usize::from(had_more(net, name));
                } else if rings.corners.len() <= super::slivers::MOST_CORNERS {
                    part.thin.push(name);
                }
            }
        });
        let (mut thin, mut collapsed) = (Vec::new(), 0);
        for part in parts {
            thin.extend(part.thin);
            collapsed += part.collapsed;
        }
        Survey { open, thin, collapsed }
    }

    /// Whether a side ends at this place that has no partner.
    pub(super) fn is_open(&self, place: u32) -> bool {
        self.open[place as usize].load(Relaxed) != 0
    }

    /// Whether every side has a partner.
    pub(super) fn is_closed(&self) -> bool {
        let parts = map_chunks(self.open.len(), 1 << 16, |part| {
            self.open[part].iter().all(|sum| sum.load(Relaxed) == 0)
        });
        parts.into_iter().all(|closed| closed)
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

fn has_fewer_than_three(ring: &[u32]) -> bool {
    let Some(&first) = ring.first() else { return true };
    let Some(&second) = ring.iter().find(|&&corner| corner != first) else { return true };
    ring.iter().all(|&corner| corner == first || corner == second)
}

/// Whether a face had three different corners or more in its file.
fn had_more(net: &Net<'_>, name: FaceName) -> bool {
    let start = net.starts[name.object as usize];
    let mut rings = net.soups[name.object as usize].faces.rings(name.face as usize);
    let first = |&corner: &u32| net.first[(start + corner) as usize];
    let outer = rings.next().map(|ring| ring.iter().map(first).collect::<Vec<_>>());
    !has_fewer_than_three(&outer.unwrap_or_default())
}
