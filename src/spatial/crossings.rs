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

use super::{Bounds, Group, Hierarchy, SegmentProbe};

/// With more groups of edges than this around, segments had better search
/// for themselves.
const MOST_GROUPS: usize = 12;

/// What may pass in front of some segments that lie close together: most
/// often little, and to look through that for each of them is faster than to
/// ask all edges.
#[derive(Debug, Clone)]
pub struct Nearby(Option<Vec<u32>>);

impl Nearby {
    /// All edges.
    pub const EVERYTHING: Nearby = Nearby(None);
}

#[inline(always)]
fn candidates(probe: &SegmentProbe) -> impl Fn(&Group) -> u8 + '_ {
    |group| group.hiding(probe.bounds()) & group.meeting_line(probe)
}

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
        self.hierarchy.visit(candidates(probe), found);
    }

    /// The edges that may pass in front of something in a box.
    pub fn look_around(&self, bounds: &Bounds) -> Nearby {
        Nearby(self.hierarchy.lowest_groups(|group| group.hiding(bounds), MOST_GROUPS))
    }

    /// The same as [`Crossings::candidates`], perhaps in another order, for a
    /// segment in the box of `nearby`.
    #[inline]
    pub fn candidates_among(
        &self,
        nearby: &Nearby,
        probe: &SegmentProbe,
        mut found: impl FnMut(u32),
    ) {
        match &nearby.0 {
            None => self.candidates(probe, found),
            Some(groups) => {
                for &group in groups {
                    self.hierarchy.visit_group(group, candidates(probe), &mut found);
                }
            }
        }
    }
}
