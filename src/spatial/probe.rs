//! A segment that asks a hierarchy which boxes its image may meet.

use super::Bounds;

/// A segment in narrow view coordinates, for asking which boxes its image
/// may meet: tighter than its box where it runs askew.
#[derive(Debug, Clone, Copy)]
pub struct SegmentProbe {
    bounds: Bounds,
    pub(super) start: [f32; 2],
    pub(super) normal: [f32; 2],
    pub(super) slack: f32,
}

impl SegmentProbe {
    /// The probe of a segment with outward-rounded `bounds` and ends near
    /// `start` and `end`.
    pub fn new(bounds: Bounds, start: [f32; 2], end: [f32; 2]) -> Self {
        let normal = [end[1] - start[1], start[0] - end[0]];
        // Coordinates lie within [-1, 1] up to rounding, where a narrow
        // float is off by at most 2^-24: the ends' errors enter through the
        // normal (times a distance below 4) and the start (times the
        // normal), each product and sum rounds once more. Unbounded
        // segments make this infinite or NaN, and then only the box counts.
        let slack = (normal[0].abs() + normal[1].abs()) * 4e-6 + 2e-6;
        SegmentProbe { bounds, start, normal, slack }
    }

    /// The same segment as if it were at any depth: whatever its image meets
    /// is in front of it.
    #[must_use]
    pub fn of_any_depth(self) -> Self {
        SegmentProbe { bounds: self.bounds.of_any_depth(), ..self }
    }

    /// The outward-rounded box of the segment.
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }
}
