//! A set of points that may hold more than was put in (Bloom 1970): most
//! points of a drawing are told by one look that they are not in it.

use super::paths::key;
use glam::DVec2;
use rustc_hash::FxBuildHasher;
use std::hash::BuildHasher;

/// Bits for each point.
const BITS: usize = 16;

/// Some points, as bits of their hashes.
pub(in crate::drawing) struct Filter {
    words: Vec<u64>,
    mask: u64,
}

impl Filter {
    pub(in crate::drawing) fn new(points: impl Iterator<Item = DVec2> + Clone) -> Self {
        let bits = (BITS * points.clone().count()).next_power_of_two().max(64);
        let mut filter = Filter { words: vec![0; bits / 64], mask: bits as u64 - 1 };
        for point in points {
            let bit = filter.bit(point);
            filter.words[(bit / 64) as usize] |= 1 << (bit % 64);
        }
        filter
    }

    /// No, if the point was not put in; yes if it was.
    #[inline]
    pub(in crate::drawing) fn may_hold(&self, point: DVec2) -> bool {
        let bit = self.bit(point);
        self.words[(bit / 64) as usize] >> (bit % 64) & 1 == 1
    }

    fn bit(&self, point: DVec2) -> u64 {
        (FxBuildHasher.hash_one(key(point)) >> 20) & self.mask
    }
}
