//! Eight boxes side by side, coordinate by coordinate, so that all of them
//! are compared with one box in a dozen vector instructions.
//!
//! Answers are bits: bit `i` is about box `i`.

use super::{Bounds, SegmentProbe};
use glam::{BVec4A, Vec3A, Vec4};

/// Boxes of a group.
pub(super) const SIZE: usize = 8;

/// Up to eight boxes. Places without a box hold NaN, which overlaps nothing.
#[derive(Debug, Clone, Copy)]
pub struct Group {
    low: [[f32; SIZE]; 3],
    high: [[f32; SIZE]; 3],
}

impl Group {
    /// No boxes yet.
    const NOTHING: Group = Group { low: [[f32::NAN; SIZE]; 3], high: [[f32::NAN; SIZE]; 3] };

    /// Groups at most eight boxes. Empty boxes are as good as none.
    pub(super) fn of(boxes: impl Iterator<Item = Bounds>) -> Self {
        let mut group = Group::NOTHING;
        for (place, bounds) in boxes.take(SIZE).enumerate().filter(|(_, one)| !one.is_empty()) {
            for axis in 0..3 {
                group.low[axis][place] = bounds.low[axis];
                group.high[axis][place] = bounds.high[axis];
            }
        }
        group
    }

    /// The box around all boxes.
    pub(super) fn around(&self) -> Bounds {
        // The smaller of a number and NaN is the number.
        let least = |list: &[f32; SIZE]| list.iter().fold(f32::INFINITY, |a, &b| a.min(b));
        let most = |list: &[f32; SIZE]| list.iter().fold(f32::NEG_INFINITY, |a, &b| a.max(b));
        Bounds {
            low: self.low.each_ref().map(least).into(),
            high: self.high.each_ref().map(most).into(),
        }
    }

    /// One of the boxes.
    #[inline(always)]
    pub(super) fn get(&self, place: usize) -> Bounds {
        let at = |list: &[[f32; SIZE]; 3]| Vec3A::from_array([0, 1, 2].map(|i| list[i][place]));
        Bounds { low: at(&self.low), high: at(&self.high) }
    }

    /// Which closed boxes share a point with `other`.
    #[inline(always)]
    pub fn overlapping(&self, other: &Bounds) -> u8 {
        let (low, high) = (other.low.to_array(), other.high.to_array());
        each_half(|half| {
            self.starts_by(half, 0, high[0])
                & self.ends_after(half, 0, low[0])
                & self.starts_by(half, 1, high[1])
                & self.ends_after(half, 1, low[1])
                & self.starts_by(half, 2, high[2])
                & self.ends_after(half, 2, low[2])
        })
    }

    /// Of which boxes the images overlap that of `other` and something may
    /// lie in front of something of it.
    #[inline(always)]
    pub fn hiding(&self, other: &Bounds) -> u8 {
        let (low, high) = (other.low.to_array(), other.high.to_array());
        each_half(|half| {
            self.starts_by(half, 0, high[0])
                & self.ends_after(half, 0, low[0])
                & self.starts_by(half, 1, high[1])
                & self.ends_after(half, 1, low[1])
                & self.starts_by(half, 2, high[2])
        })
    }

    /// Which boxes' images may meet the line through the image of a segment;
    /// any answer for a place without a box.
    #[inline(always)]
    pub fn meeting_line(&self, probe: &SegmentProbe) -> u8 {
        let ([nx, ny], [sx, sy]) = (probe.normal, probe.start);
        each_half(|half| {
            let (low_x, high_x) = (self.low(half, 0) * 0.5, self.high(half, 0) * 0.5);
            let (low_y, high_y) = (self.low(half, 1) * 0.5, self.high(half, 1) * 0.5);
            let x = low_x + high_x - Vec4::splat(sx);
            let y = low_y + high_y - Vec4::splat(sy);
            let reach = (high_x - low_x) * nx.abs() + (high_y - low_y) * ny.abs();
            // Not comparable, where something is unbounded, says "maybe".
            !(x * nx + y * ny).abs().cmpgt(reach + Vec4::splat(probe.slack))
        })
    }

    #[inline(always)]
    fn low(&self, half: usize, axis: usize) -> Vec4 {
        Vec4::from_slice(&self.low[axis][4 * half..])
    }

    #[inline(always)]
    fn high(&self, half: usize, axis: usize) -> Vec4 {
        Vec4::from_slice(&self.high[axis][4 * half..])
    }

    #[inline(always)]
    fn starts_by(&self, half: usize, axis: usize, end: f32) -> BVec4A {
        self.low(half, axis).cmple(Vec4::splat(end))
    }

    #[inline(always)]
    fn ends_after(&self, half: usize, axis: usize, start: f32) -> BVec4A {
        self.high(half, axis).cmpge(Vec4::splat(start))
    }
}

/// Joins the answers for the first four boxes and the last four.
#[inline(always)]
fn each_half(answer: impl Fn(usize) -> BVec4A) -> u8 {
    (answer(0).bitmask() | answer(1).bitmask() << 4) as u8
}

/// The places whose bits are set, in ascending order.
#[inline(always)]
pub(super) fn places(mut bits: u8) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let place = bits.trailing_zeros() as usize;
        bits &= bits.wrapping_sub(1);
        (place < SIZE).then_some(place)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounds(low: [f32; 3], high: [f32; 3]) -> Bounds {
        Bounds { low: low.into(), high: high.into() }
    }

    #[test]
    fn bits_say_what_single_boxes_say() {
        let all: Vec<Bounds> = (0..7)
            .map(|i| bounds([i as f32, 0.0, -(i as f32)], [i as f32 + 1.0, 1.0, 2.0]))
            .chain([Bounds::ALL])
            .collect();
        let group = Group::of(all.iter().copied());
        assert_eq!(group.around(), Bounds::ALL);
        for own in [bounds([2.5, 0.5, -3.0], [4.0, 3.0, -1.5]), bounds([9.0; 3], [9.0; 3])] {
            for (i, other) in all.iter().enumerate() {
                assert_eq!(group.get(i), *other);
                assert_eq!(group.overlapping(&own) >> i & 1 == 1, other.overlaps(&own), "{i}");
            }
        }
        // Boxes 1 to 4 share a point with the image, 2 to 4 begin in front.
        assert_eq!(group.hiding(&bounds([2.0, 0.5, -2.0], [4.0, 1.0, -2.0])), 0b1001_1100);
    }

    #[test]
    fn nothing_overlaps_places_without_a_box() {
        let group = Group::of([Bounds::EMPTY, Bounds::ALL].into_iter());
        assert_eq!(group.around(), Bounds::ALL);
        assert_eq!(group.overlapping(&Bounds::ALL), 0b10);
        assert_eq!(group.hiding(&Bounds::ALL), 0b10);
    }

    #[test]
    fn a_line_misses_boxes_beside_it() {
        let boxes = (0..8).map(|i| bounds([i as f32 / 8.0, 0.0, 0.0], [i as f32 / 8.0, 0.1, 0.0]));
        let group = Group::of(boxes);
        let probe = SegmentProbe::new(Bounds::ALL, [0.0, 0.0], [1.0, 0.4]);
        // The line is 0.1 high at 0.25.
        assert_eq!(group.meeting_line(&probe), 0b0000_0111);
        let nowhere = SegmentProbe::new(Bounds::ALL, [f32::NAN; 2], [f32::NAN; 2]);
        assert_eq!(group.meeting_line(&nowhere), 0xff);
    }

    #[test]
    fn places_are_the_bits_that_are_set() {
        assert!(places(0b1000_0101).eq([0, 2, 7]));
        assert_eq!(places(0).next(), None);
    }
}
