//! Boxes in three dimensions with narrow floats, rounded outward.
//!
//! Most of the time spent in hierarchies goes into comparing boxes, so
//! corners are vectors that are compared and joined in one instruction.

use glam::{BVec3A, DVec3, Vec3A};
use std::ops::Range;

/// A box in view coordinates: u, v, depth. Empty where a low bound exceeds
/// its high one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Least coordinates.
    pub low: Vec3A,
    /// Greatest coordinates.
    pub high: Vec3A,
}

impl Bounds {
    /// Contains nothing.
    pub const EMPTY: Bounds = Bounds { low: Vec3A::INFINITY, high: Vec3A::NEG_INFINITY };

    /// Contains everything.
    pub const ALL: Bounds = Bounds { low: Vec3A::NEG_INFINITY, high: Vec3A::INFINITY };

    /// The smallest box around both.
    #[inline(always)]
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        Bounds { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// What lies in both.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Self {
        Bounds { low: self.low.max(other.low), high: self.high.min(other.high) }
    }

    /// The same box, open in depth.
    #[must_use]
    pub fn of_any_depth(&self) -> Self {
        let (mut low, mut high) = (self.low, self.high);
        low.z = f32::NEG_INFINITY;
        high.z = f32::INFINITY;
        Bounds { low, high }
    }

    /// Whether the closed boxes share a point.
    #[inline(always)]
    pub fn overlaps(&self, other: &Self) -> bool {
        (self.low.cmple(other.high) & other.low.cmple(self.high)).all()
    }

    /// Whether the images overlap and something of this box may lie in
    /// front of something of `other`.
    #[inline(always)]
    pub fn may_hide(&self, other: &Self) -> bool {
        let any_depth = BVec3A::new(false, false, true);
        (self.low.cmple(other.high) & (other.low.cmple(self.high) | any_depth)).all()
    }

    /// Whether there is nothing in the box.
    pub fn is_empty(&self) -> bool {
        self.low.cmpgt(self.high).any()
    }
}

/// Maps double coordinates to narrow ones around the middle of a scene, so
/// that scenes far from their origin keep their resolution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rounding {
    centre: [f64; 3],
    scale: [f64; 3],
}

impl Rounding {
    /// A rounding for coordinates in these ranges.
    pub fn for_ranges(ranges: [Range<f64>; 3]) -> Self {
        let centre = ranges.clone().map(|range| range.start * 0.5 + range.end * 0.5);
        let scale = ranges.map(|range| {
            let half = (range.end * 0.5 - range.start * 0.5).abs();
            if half > 0.0 && half.is_finite() { 1.0 / half.max(f64::MIN_POSITIVE) } else { 1.0 }
        });
        // A scale may overflow for subnormal ranges; 1 is as good then.
        Rounding { centre, scale: scale.map(|s| if s.is_finite() { s } else { 1.0 }) }
    }

    /// A narrow float not above `value - slack` along `axis`.
    #[inline(always)]
    pub fn down(&self, axis: usize, value: f64, slack: f64) -> f32 {
        // Moving the origin and scaling round twice in double precision,
        // far less than the step to the next narrow float.
        let moved = (value - slack - self.centre[axis]) * self.scale[axis];
        ((moved - moved.abs() * 1e-12) as f32).next_down()
    }

    /// A narrow float not below `value + slack` along `axis`.
    #[inline(always)]
    pub fn up(&self, axis: usize, value: f64, slack: f64) -> f32 {
        let moved = (value + slack - self.centre[axis]) * self.scale[axis];
        ((moved + moved.abs() * 1e-12) as f32).next_up()
    }

    /// A box around everything from `low` to `high`.
    #[inline(always)]
    pub fn around(&self, low: DVec3, high: DVec3) -> Bounds {
        let down = |axis: usize| self.down(axis, low[axis], 0.0);
        let up = |axis: usize| self.up(axis, high[axis], 0.0);
        Bounds { low: Vec3A::new(down(0), down(1), down(2)), high: Vec3A::new(up(0), up(1), up(2)) }
    }

    /// `value` along `axis`, rounded to nearest.
    #[inline(always)]
    pub fn nearest(&self, axis: usize, value: f64) -> f32 {
        ((value - self.centre[axis]) * self.scale[axis]) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn order_is_never_inverted(a in -1e6..1e6_f64, b in -1e6..1e6_f64, far in -1e9..1e9_f64) {
            let rounding = Rounding::for_ranges([far - 1e6..far + 1e6, -1e6..1e6, 0.0..1.0]);
            let (low, high) = (a.min(b), a.max(b));
            for axis in 0..2 {
                let shift = if axis == 0 { far } else { 0.0 };
                prop_assert!(rounding.down(axis, low + shift, 0.0) <= rounding.up(axis, high + shift, 0.0));
                prop_assert!(rounding.down(axis, low + shift, 0.0) <= rounding.nearest(axis, low + shift));
            }
        }
    }
}
