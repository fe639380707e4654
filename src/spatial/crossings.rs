//! Which edges may pass in front of a line, their images crossing its own.
//!
//! Edges come with view boxes, rounded outward, in a packed hierarchy; a
//! line asks with a [`SegmentProbe`], whose strip is far narrower than its
//! box where it runs askew. What comes back are candidates: every edge that
//! crosses is among them, and whether one does is for predicates to decide.
//! (Franklin 1989 finds crossings with a uniform grid; a hierarchy needs no
//! cell size and suffers no edge that is much longer than the others. Grid,
//! plane sweep and brute force are its twins in the tests.)
//!
//! O(n log n) to build, expected O(log n + answers) to ask.

use super::{Bounds, Hierarchy, SegmentProbe};

/// Edges by their view boxes.
#[derive(Debug, Clone)]
pub struct Crossings {
    hierarchy: Hierarchy,
}

impl Crossings {
    /// Takes the edges with these boxes; those with empty boxes have no
    /// image and are never found.
    pub fn new(boxes: &[Bounds]) -> Self {
        Crossings { hierarchy: Hierarchy::new(boxes) }
    }

    /// Calls `found` with every edge whose image may meet that of the probed
    /// segment and of which something may lie in front of something of the
    /// segment. In a fixed order, each edge once.
    #[inline]
    pub fn candidates(&self, probe: &SegmentProbe, found: impl FnMut(u32)) {
        self.hierarchy
            .visit(|group| group.hiding(probe.bounds()) & group.meeting_line(probe), found);
    }
}
