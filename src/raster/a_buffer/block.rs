//! The samples of one pixel.

use super::Division;
use crate::raster::samples::Footprint;

/// A pixel among the samples of a band: its first sample, and the bits that
/// are looked at.
#[derive(Debug, Clone, Copy)]
pub(super) struct Block {
    /// Column and row of the first sample.
    pub(super) first: [u32; 2],
    /// Sub-pixels in the footprint at hand.
    pub(super) bits: u32,
}

impl Block {
    /// The part of a pixel that lies in a footprint.
    pub(super) fn new(pixel: [u32; 2], division: Division, footprint: &Footprint) -> Self {
        let first = [pixel[0] * division.columns(), pixel[1] * division.rows()];
        let inside = |axis: usize, count: u32, [low, high]: [u32; 2]| {
            let from = low.saturating_sub(first[axis]).min(count);
            let to = (high + 1).saturating_sub(first[axis]).min(count);
            from..to.max(from)
        };
        let columns = inside(0, division.columns(), footprint.columns);
        let row = columns.fold(0, |mask, column| mask | 1_u32 << column);
        let rows = inside(1, division.rows(), footprint.rows);
        let bits = rows.fold(0, |mask, j| mask | row << (j * division.columns()));
        Block { first, bits }
    }

    /// The sample of a bit.
    #[inline(always)]
    pub(super) fn sample(&self, bit: u32) -> [u32; 2] {
        [self.first[0] + (bit & 3), self.first[1] + (bit >> 2)]
    }
}

/// The bits of a mask, lowest first.
#[inline(always)]
pub(super) fn bits(mut mask: u32) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        let bit = mask.trailing_zeros();
        (mask != 0).then(|| {
            mask &= mask - 1;
            bit
        })
    })
}
