//! Carrying counts from line to line, so that few are counted afresh.
//!
//! The sheets in front of the beginning of a line at a vertex are of two
//! kinds: triangles that contain the vertex, which hide some of its lines,
//! and all others, which hide either every line's beginning there or none,
//! unless the vertex's image lies on the border of such a triangle, or the
//! vertex on the triangle itself. So a vertex has *one* count of foreign
//! sheets, and a line between two vertices says by how much theirs differ:
//!
//! ```text
//! foreign(last) + own(last, backwards) = foreign(first) + own(first) + changes
//! ```
//!
//! Vertices connected by lines are gathered into sets with differences to a
//! representative (union-find with weights: Tarjan 1979). Only the
//! representative is counted, and the vertices in border cases, which are
//! left out of the sets.
//!
//! Which vertices those are is known from the search for interpenetration
//! (touching) and from the crossings themselves: an effective edge whose
//! image the vertex lies on. At any other edge as many sheets end as begin.
//!
//! Sources: A. Appel, "The notion of quantitative invisibility", 1967, for
//! the idea; P. Loutrel, "A solution to the hidden-line problem for
//! computer-drawn polyhedra", 1970, for the rule at a vertex.

use super::walker::{Sides, Walk, Walker};
use crate::kernel::predicates::Policy;
use crate::model::{FeatureLine, LineOrigin};
use crate::view::Contacts;

/// A line between two vertices, as far as counts are carried along it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Link {
    vertices: [u32; 2],
    /// Sum of all changes along the line.
    changes: Sides,
    /// Sum of all losses along the line.
    losses: Sides,
    /// Own sheets in front of the beginning, from either end.
    own: [Sides; 2],
    /// Ends in border cases.
    met_ends: [bool; 2],
}

impl<P: Policy> Walker<'_, P> {
    /// The link that a walk makes whose events have been found; none where
    /// counts are not carried along it.
    pub(super) fn link(
        &self,
        line: &FeatureLine,
        walk: &Walk,
        contacts: &Contacts<'_>,
    ) -> Option<Link> {
        let (LineOrigin::Edge(_), [Some(first), Some(last)]) = (line.origin, walk.vertices) else {
            return None;
        };
        if walk.cut {
            return None;
        }
        let mut link = Link { met_ends: self.met_ends, ..Link::plain([first, last]) };
        for event in &self.events {
            link.changes.add(event.change);
            link.losses.add(event.change.losses());
        }
        if !contacts.fans.is_fan(first) {
            link.own[0] = self.star_count(walk, contacts.fans.star(first));
        }
        if !contacts.fans.is_fan(last) {
            link.own[1] = self.star_count(&self.turned(walk), contacts.fans.star(last));
        }
        Some(link)
    }

    /// The foreign sheets of a vertex, which is no border case, counted
    /// along a line from it.
    pub(super) fn foreign_count(
        &mut self,
        vertex: u32,
        line: &FeatureLine,
        contacts: &Contacts<'_>,
    ) -> i32 {
        let Some(walk) = self.begin(line) else {
            return 0;
        };
        let walk = if walk.vertices[0] == Some(vertex) { walk } else { self.turned(&walk) };
        let own = self.star_count(&walk, contacts.fans.star(vertex));
        self.first_count(&walk).left - own.left
    }
}

impl Link {
    /// A line along which nothing changes, between two fans.
    pub(super) fn plain(vertices: [u32; 2]) -> Self {
        Link {
            vertices,
            changes: Sides::default(),
            losses: Sides::default(),
            own: [Sides::default(); 2],
            met_ends: [false; 2],
        }
    }

    /// Whether it equals the plain link of its vertices.
    pub(super) fn is_plain(&self) -> bool {
        *self == Link::plain(self.vertices)
    }

    /// Whether the line is hidden all along, whatever the order of events.
    pub(super) fn stays_hidden(&self, mut first: Sides) -> bool {
        first.add(self.losses);
        first.invisibility() > 0
    }

    /// The count at the beginning of the line, from the first vertex's
    /// foreign sheets.
    fn counted_from_first(&self, foreign: i32) -> Sides {
        let mut sides = Sides::both(foreign);
        sides.add(self.own[0]);
        sides
    }

    /// The count at the beginning of the line, from the last vertex's
    /// foreign sheets: left and right change places on the way back.
    fn counted_from_last(&self, foreign: i32) -> Sides {
        let Link { changes, own: [_, own], .. } = *self;
        Sides {
            left: foreign + own.right - changes.left,
            right: foreign + own.left - changes.right,
        }
    }

    /// By how much the last vertex's foreign sheets exceed the first one's.
    fn difference(&self) -> i32 {
        let at_end = self.own[0].left + self.changes.left;
        at_end - self.own[1].right
    }
}

/// Foreign sheets in front of vertices.
#[derive(Debug)]
pub(super) struct Foreign {
    /// Of each vertex; nothing for border cases and vertices without links.
    counts: Vec<Option<i32>>,
}

/// Which vertices are border cases. `links` may leave out plain ones.
pub(super) fn border_cases<'l>(
    vertices: usize,
    links: impl Iterator<Item = &'l Link>,
    contacts: &Contacts<'_>,
) -> Vec<bool> {
    let mut border = vec![false; vertices];
    contacts.touching.iter().for_each(|&vertex| border[vertex as usize] = true);
    for link in links {
        for (vertex, met) in link.vertices.into_iter().zip(link.met_ends) {
            border[vertex as usize] |= met;
        }
    }
    border
}

impl Foreign {
    /// Gathers the linked vertices but for the `border` cases, and counts one of each set with `count`,
    /// given vertices, each with a line from it. `links` come with the
    /// numbers of their lines. Also returns how many links contradict the others: none, unless
    /// decisions are left to floats.
    pub(super) fn gather(
        border: &[bool],
        links: impl Iterator<Item = (u32, Link)>,
        count: impl FnOnce(&[[u32; 2]]) -> Vec<i32>,
    ) -> (Self, u64) {
        /// No line has this number.
        const NONE: u32 = u32::MAX;
        let vertices = border.len();
        let mut sets = Sets::new(vertices);
        let mut contradictions = 0;
        let mut line_at = vec![NONE; vertices];
        for (line, link) in links {
            let [first, last] = link.vertices;
            for vertex in link.vertices {
                if line_at[vertex as usize] == NONE && !border[vertex as usize] {
                    line_at[vertex as usize] = line;
                }
            }
            if !border[first as usize] && !border[last as usize] {
                contradictions += u64::from(!sets.join(first, last, link.difference()));
            }
        }
        let linked = || (0..vertices as u32).filter(|&vertex| line_at[vertex as usize] != NONE);
        let roots: Vec<[u32; 2]> = linked()
            .filter(|&vertex| sets.is_root(vertex))
            .map(|vertex| [vertex, line_at[vertex as usize]])
            .collect();
        let mut counts = vec![None; vertices];
        for ([root, _], counted) in roots.iter().zip(count(&roots)) {
            counts[*root as usize] = Some(counted);
        }
        for vertex in linked() {
            let (root, difference) = sets.find(vertex);
            counts[vertex as usize] = counts[root as usize].map(|counted| counted + difference);
        }
        (Foreign { counts }, contradictions)
    }

    /// The count at the beginning of a line, if one of its ends is known.
    pub(super) fn first_count(&self, link: &Link) -> Option<Sides> {
        let [first, last] = link.vertices.map(|vertex| self.counts[vertex as usize]);
        match (first, last) {
            (Some(foreign), _) => Some(link.counted_from_first(foreign)),
            (None, Some(foreign)) => Some(link.counted_from_last(foreign)),
            (None, None) => None,
        }
    }
}

/// Disjoint sets of vertices with differences to their roots.
struct Sets {
    parents: Vec<u32>,
    /// By how much a vertex's count exceeds its parent's.
    excess: Vec<i32>,
}

impl Sets {
    fn new(vertices: usize) -> Self {
        Sets { parents: (0..vertices as u32).collect(), excess: vec![0; vertices] }
    }

    fn is_root(&self, vertex: u32) -> bool {
        self.parents[vertex as usize] == vertex
    }

    /// The root of a vertex, and by how much the vertex exceeds it. Halves
    /// the path on the way.
    fn find(&mut self, mut vertex: u32) -> (u32, i32) {
        let mut sum = 0;
        while !self.is_root(vertex) {
            let own = vertex as usize;
            let parent = self.parents[own] as usize;
            self.excess[own] += self.excess[parent];
            self.parents[own] = self.parents[parent];
            sum += self.excess[own];
            vertex = self.parents[own];
        }
        (vertex, sum)
    }

    /// Says that `b` exceeds `a` by `difference`. False if it is known to
    /// exceed it by something else. The root is the smaller number.
    fn join(&mut self, a: u32, b: u32, difference: i32) -> bool {
        let ((root_a, excess_a), (root_b, excess_b)) = (self.find(a), self.find(b));
        // b's root exceeds a's by this.
        let apart = difference + excess_a - excess_b;
        if root_a == root_b {
            return apart == 0;
        }
        let (child, parent, excess) =
            if root_a < root_b { (root_b, root_a, apart) } else { (root_a, root_b, -apart) };
        self.parents[child as usize] = parent;
        self.excess[child as usize] = excess;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn differences_are_kept_whatever_the_order_of_joining(
            heights in prop::collection::vec(-50..50_i32, 20),
            joins in prop::collection::vec((0..20_u32, 0..20_u32), 0..60),
        ) {
            let mut sets = Sets::new(20);
            for &(a, b) in &joins {
                let difference = heights[b as usize] - heights[a as usize];
                prop_assert!(sets.join(a, b, difference));
                prop_assert!(a == b || !sets.join(a, b, difference + 1));
            }
            for (a, b) in joins {
                let ((root_a, excess_a), (root_b, excess_b)) = (sets.find(a), sets.find(b));
                prop_assert_eq!(root_a, root_b);
                prop_assert_eq!(excess_b - excess_a, heights[b as usize] - heights[a as usize]);
            }
        }
    }
}
