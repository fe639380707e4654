//! Binary space partition: one tree of polygons, in painter's order for any
//! eye.
//!
//! The plane of one polygon parts space in two; polygons that straddle it are
//! cut; both halves are treated alike until nothing is left. Seen from
//! anywhere, what lies on the other side of the plane cannot hide what lies on
//! the eye's side, so a walk through the tree that visits the far side first
//! meets all polygons from back to front. The tree knows nothing of the eye
//! and serves all of them. (Fuchs, Kedem and Naylor 1980.)
//!
//! 1. *Choose a plane* ([`choose`]): of some polygons, evenly chosen from the
//!    list, the one that cuts the fewest others, and of those the one that
//!    parts them most evenly. Here the tree deviates: a large set that no plane
//!    of its own parts well (all of a convex body lies behind each of its
//!    faces) is parted across an axis at a median vertex, which is a plane of
//!    the input too. Without that a sphere would take n^2 steps.
//! 2. *Part*: polygons in the plane stay at the node, in the order of their
//!    numbers; others go below or above, or are cut.
//! 3. *Repeat* with both halves.
//!
//! All is exact, as polygons are bounded by planes of the input
//! ([`PlanePolygon`]): interpenetration and cycles are no special case, and
//! pieces of pieces decide as surely as their originals. Between n triangles
//! there may be n^2 pieces at worst. Expected O(n log n) for meshes.

mod choose;
mod walk;

use super::plane_polygon::{Cut, PlanePolygon};
use crate::kernel::predicates::{InputPlane, Policy, Predicates};
use crate::run::{Cancelled, Run};
use std::ops::Range;

/// A polygon of the tree, or a piece of one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fragment {
    /// The polygon.
    pub polygon: PlanePolygon,
    /// The number of the polygon it is, or is a piece of. Of polygons in one
    /// plane the one with the least number is nearest.
    pub source: u32,
}

impl Fragment {
    /// What it takes in memory, about.
    fn bytes(&self) -> u64 {
        (size_of::<Self>() + self.polygon.heap_bytes()) as u64
    }
}

/// The tree.
#[derive(Debug, Clone, Default)]
pub struct Bsp {
    /// The root comes first.
    nodes: Vec<Node>,
    /// Node by node, ascending by number within each.
    fragments: Vec<Fragment>,
    cuts: usize,
}

#[derive(Debug, Clone)]
struct Node {
    plane: InputPlane,
    fragments: Range<u32>,
    below: Option<u32>,
    above: Option<u32>,
}

/// Polygons that still have to be parted, and where the tree of them hangs.
struct Open {
    set: Vec<Fragment>,
    parent: Option<(u32, bool)>,
}

/// A set parted by a plane.
#[derive(Default)]
struct Parted {
    within: Vec<Fragment>,
    below: Vec<Fragment>,
    above: Vec<Fragment>,
    cuts: usize,
    /// What the run was told that its cuts take.
    taken: u64,
}

impl Bsp {
    /// Builds the tree of polygons, numbered as they come. The same list makes
    /// the same tree. No plane of theirs may be one through the eye, or the
    /// near plane.
    ///
    /// # Errors
    ///
    /// If the run is cancelled, or may not hold all pieces.
    pub fn new<P: Policy>(
        predicates: &Predicates<'_, P>,
        polygons: impl IntoIterator<Item = PlanePolygon>,
        run: &Run<'_>,
    ) -> Result<Self, Cancelled> {
        Ok(Self::within(predicates, polygons, usize::MAX, run)?.unwrap_or_default())
    }

    /// The same; nothing if that takes more than `most_cuts` cuts.
    ///
    /// # Errors
    ///
    /// As [`Bsp::new`].
    pub fn within<P: Policy>(
        predicates: &Predicates<'_, P>,
        polygons: impl IntoIterator<Item = PlanePolygon>,
        most_cuts: usize,
        run: &Run<'_>,
    ) -> Result<Option<Self>, Cancelled> {
        let numbered = polygons.into_iter().zip(0..);
        let set: Vec<Fragment> =
            numbered.map(|(polygon, source)| Fragment { polygon, source }).collect();
        run.take(set.iter().map(Fragment::bytes).sum())?;
        let mut tree = Bsp::default();
        let mut open = vec![Open { set, parent: None }];
        while let Some(Open { set, parent }) = open.pop() {
            if set.is_empty() {
                continue;
            }
            let (plane, parted) = part_well(predicates, set, run);
            run.check()?;
            run.advance(parted.within.len() as u64);
            let node = tree.add(plane, parted.within, parent);
            tree.cuts += parted.cuts;
            if most_cuts < tree.cuts {
                return Ok(None);
            }
            open.push(Open { set: parted.above, parent: Some((node, true)) });
            open.push(Open { set: parted.below, parent: Some((node, false)) });
        }
        Ok(Some(tree))
    }

    /// Polygons and pieces of polygons, as they stand in the tree.
    pub fn fragments(&self) -> &[Fragment] {
        &self.fragments
    }

    /// How many cuts were made; each made one more piece.
    pub fn cuts(&self) -> usize {
        self.cuts
    }

    /// The number of planes.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    fn add(
        &mut self,
        plane: InputPlane,
        within: Vec<Fragment>,
        parent: Option<(u32, bool)>,
    ) -> u32 {
        let node = self.nodes.len() as u32;
        let first = self.fragments.len() as u32;
        self.fragments.extend(within);
        let fragments = first..self.fragments.len() as u32;
        self.nodes.push(Node { plane, fragments, below: None, above: None });
        if let Some((parent, above)) = parent {
            let parent = &mut self.nodes[parent as usize];
            *(if above { &mut parent.above } else { &mut parent.below }) = Some(node);
        }
        node
    }
}

/// Parts a set by a plane across an axis if it is large and that pays, else
/// by the plane of one of its polygons, of which there must be one.
fn part_well<P: Policy>(
    predicates: &Predicates<'_, P>,
    set: Vec<Fragment>,
    run: &Run<'_>,
) -> (InputPlane, Parted) {
    let choice = choose::choose(predicates, &set);
    let most = set.len() - set.len() / 4;
    if let Some(plane) = choice.across {
        let parted = part(predicates, plane, set.iter().cloned(), run);
        if parted.below.len().max(parted.above.len()) <= most {
            return (plane, parted);
        }
        run.give_back(parted.taken);
    }
    (choice.face, part(predicates, choice.face, set.into_iter(), run))
}

/// Parts a set by a plane. Both halves keep the order; once the run is stopped,
/// polygons are left out.
fn part<P: Policy>(
    predicates: &Predicates<'_, P>,
    plane: InputPlane,
    set: impl Iterator<Item = Fragment>,
    run: &Run<'_>,
) -> Parted {
    let mut parted = Parted::default();
    for fragment in set.take_while(|_| !run.is_stopped()) {
        match fragment.polygon.cut(predicates, plane.into()) {
            Cut::Within => parted.within.push(fragment),
            Cut::Below => parted.below.push(fragment),
            Cut::Above => parted.above.push(fragment),
            Cut::Parted([below, above]) => {
                parted.cuts += 1;
                let source = fragment.source;
                let more = fragment.bytes();
                parted.taken += more;
                // Whether it was too much is asked before the next one.
                let _ = run.take(more);
                parted.below.push(Fragment { polygon: below, source });
                parted.above.push(Fragment { polygon: above, source });
            }
        }
    }
    parted
}

#[cfg(test)]
mod tests;
