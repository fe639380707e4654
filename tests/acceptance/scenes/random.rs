//! A small generator whose numbers are the same everywhere and for ever.

use crate::split_mix::split_mix;
use glam::DVec3;

/// Numbers that look like chance.
#[derive(Debug, Clone)]
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> u64 {
        split_mix(&mut self.0)
    }

    /// An integer from 0 to `bound - 1`.
    pub(crate) fn below(&mut self, bound: u64) -> u64 {
        self.next() % bound
    }

    /// True once in `count` times.
    pub(crate) fn one_in(&mut self, count: u64) -> bool {
        self.below(count) == 0
    }

    /// A number in [-1, 1) with all bits of its mantissa.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn point(&mut self) -> DVec3 {
        DVec3::new(self.unit(), self.unit(), self.unit())
    }

    /// A point of the integer grid with `side` places per axis.
    pub(crate) fn grid_point(&mut self, side: u64) -> DVec3 {
        DVec3::from([0; 3].map(|_| self.below(side) as f64))
    }

    pub(crate) fn choose<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len() as u64) as usize]
    }

    pub(crate) fn shuffle<T>(&mut self, list: &mut [T]) {
        for i in (1..list.len()).rev() {
            list.swap(i, self.below(i as u64 + 1) as usize);
        }
    }
}

/// How many rounds a test runs: `few`, or a hundred times as many on request.
pub(crate) fn rounds(few: u64) -> u64 {
    if std::env::var_os("UMRISS_LONG").is_some_and(|value| value == "1") { 100 * few } else { few }
}
