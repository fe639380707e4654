//! The tests between two sheets, each exact and each counted.

use super::sheets::Sheet;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Policy, Predicates};
use crate::polygon::PlanePolygon;
use crate::run::Run;
use std::cell::Cell;

/// The tests by the names of the method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(usize)]
pub(super) enum Test {
    /// 1: depths.
    Depth,
    /// 2a: boxes around images.
    Extents,
    /// 2b: on the viewer's side of the other's plane.
    ViewerSide,
    /// 2c: on the far side of the other's plane.
    FarSide,
    /// 2d: images.
    Images,
    /// 2b with the roles exchanged.
    ViewerSideExchanged,
    /// 2c with the roles exchanged.
    FarSideExchanged,
    /// Depths on the common area.
    CommonArea,
}

/// Counters of tests that were made.
const COUNTERS: [&str; 8] = [
    "painter-tests-1-depth",
    "painter-tests-2a-extents",
    "painter-tests-2b-viewer-side",
    "painter-tests-2c-far-side",
    "painter-tests-2d-images",
    "painter-tests-2b-exchanged",
    "painter-tests-2c-exchanged",
    "painter-tests-common-area",
];

/// Which of two sheets must be painted first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Relation {
    /// Either: the images have no area in common.
    Free,
    /// The first.
    Before,
    /// The second.
    After,
    /// Both: they pass through one another.
    Both,
}

impl Relation {
    /// The relation of the second to the first.
    pub(super) fn exchanged(self) -> Self {
        match self {
            Relation::Before => Relation::After,
            Relation::After => Relation::Before,
            same => same,
        }
    }
}

/// Predicates, and the count of the tests.
#[derive(Debug)]
pub(super) struct Judge<'p, P: Policy> {
    pub(super) predicates: Predicates<'p, P>,
    counts: [Cell<u64>; 8],
}

impl<'p, P: Policy> Judge<'p, P> {
    pub(super) fn new(predicates: Predicates<'p, P>) -> Self {
        Judge { predicates, counts: Default::default() }
    }

    /// Adds what was counted to a run.
    pub(super) fn report(&self, run: &Run<'_>) {
        for (name, count) in COUNTERS.iter().zip(&self.counts) {
            if 0 < count.get() {
                run.count(name, count.get());
            }
        }
        run.merge(&self.predicates.counters());
    }

    fn count(&self, test: Test) {
        let count = &self.counts[test as usize];
        count.set(count.get() + 1);
    }

    /// 1: whether all of `p` is deeper than all of `q`.
    pub(super) fn is_deeper(&self, p: &Sheet, q: &Sheet) -> bool {
        self.count(Test::Depth);
        self.predicates.deeper(p.nearest, q.farthest) == Sign::Positive
    }

    /// 2a: whether the boxes around the images do not overlap.
    pub(super) fn extents_are_apart(&self, p: &Sheet, q: &Sheet) -> bool {
        self.count(Test::Extents);
        !p.bounds.overlaps(&q.bounds)
    }

    /// 2b, 2c: whether nothing of `q` lies beyond the plane of `p`, or
    /// nothing of `p` on the viewer's side of that of `q`. Counted as `tests`.
    pub(super) fn planes_part(&self, p: &Sheet, q: &Sheet, tests: [Test; 2]) -> bool {
        self.count(tests[0]);
        // Beyond a plane its functional has the sign of the facing.
        if !self.has(q, p, p.facing) {
            return true;
        }
        self.count(tests[1]);
        !self.has(p, q, -q.facing)
    }

    /// Whether some corner of a sheet has this sign at the plane of another.
    fn has(&self, sheet: &Sheet, other: &Sheet, sign: Sign) -> bool {
        let plane = other.polygon.plane().into();
        let corners = &sheet.polygon.corners;
        corners.iter().any(|corner| self.predicates.above(plane, corner.point) == sign)
    }

    /// Whether two sheets lie in one plane.
    pub(super) fn are_coplanar(&self, p: &Sheet, q: &Sheet) -> bool {
        q.polygon.sides_of(&self.predicates, p.polygon.plane().into()) == [false; 2]
    }

    /// 2d: whether the images have no area in common.
    pub(super) fn images_are_apart(&self, p: &Sheet, q: &Sheet) -> bool {
        self.count(Test::Images);
        let pair = [&p.polygon, &q.polygon];
        PlanePolygon::are_apart(&self.predicates, pair, p.shadow(), q.shadow())
    }

    /// Which of two sheets must be painted first, whose boxes overlap.
    pub(super) fn relation(&self, p: &Sheet, q: &Sheet) -> Relation {
        // Edges of the graph need a common area, so 2d comes first.
        if self.images_are_apart(p, q) {
            return Relation::Free;
        }
        if self.is_deeper(p, q) {
            return Relation::Before;
        }
        if self.is_deeper(q, p) {
            return Relation::After;
        }
        if self.are_coplanar(p, q) {
            return if p.face > q.face { Relation::Before } else { Relation::After };
        }
        if self.planes_part(p, q, [Test::ViewerSide, Test::FarSide]) {
            return Relation::Before;
        }
        if self.planes_part(q, p, [Test::ViewerSideExchanged, Test::FarSideExchanged]) {
            return Relation::After;
        }
        self.on_common_area(p, q)
    }

    /// Where sheets that reach through the planes of one another stand on
    /// what their images have in common.
    fn on_common_area(&self, p: &Sheet, q: &Sheet) -> Relation {
        self.count(Test::CommonArea);
        let Some(common) = p.polygon.within(&self.predicates, q.shadow()) else {
            return Relation::Free;
        };
        let found = common.sides_of(&self.predicates, q.polygon.plane().into());
        let [near, far] = if q.facing == Sign::Positive { found } else { [found[1], found[0]] };
        match (near, far) {
            (true, true) => Relation::Both,
            (true, false) => Relation::After,
            _ => Relation::Before,
        }
    }
}
