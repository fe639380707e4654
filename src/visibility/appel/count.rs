//! The first count: how many sheets lie in front of the beginning of a line?
//!
//! A triangle that is not edge-on hides a point iff the point is behind its
//! plane and, in the image, on the inner side of its three edges: four
//! signs. They are taken just after the start of the line on the way to its
//! end (the germ rule: the sign at the start, or the one at the end where
//! that is zero). Where an edge's image runs along the line's image both
//! are zero; then the triangle covers just the side of the line on which
//! its third corner lies (the side rule). So an edge between two triangles
//! never counts twice and never falls through, and no ray is shot.
//!
//! Lines from one vertex differ only in the triangles for which the vertex
//! itself is a border case, its own star above all. The rest is counted
//! once for a vertex; edges are numbered by their first vertex, so lines
//! from one vertex follow one another.

use super::Fault;
use super::walker::{Sides, Walk, Walker};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Cut, Policy};
use crate::spatial::Bounds;
use std::cell::Cell;

/// Counts in front of a vertex.
#[derive(Debug, Clone, Default)]
pub(super) struct FromVertex {
    /// The vertex, if all triangles in front of it were counted.
    counted: Option<u32>,
    /// How many triangles hide the vertex strictly, and so the beginning of
    /// every line from it.
    sure: i32,
    /// Triangles that hide the beginnings of some lines from it, perhaps.
    unsure: Vec<u32>,
    /// The vertex, counted or not.
    vertex: Option<u32>,
    /// The first of the triangles that hide it strictly.
    hiding: Vec<u32>,
}

/// So many triangles in front of a vertex are asked whether they hide a whole
/// line from it.
const ASKED: usize = 16;

impl<P: Policy> Walker<'_, P> {
    /// The counts just after the start of the walk.
    pub(super) fn first_count(&mut self, walk: &Walk) -> Sides {
        self.counted += 1;
        if self.fault == Some(Fault::StartVisible) {
            return Sides::default();
        }
        let [start, _] = walk.probed.ends;
        let mut sum = Sides::default();
        let Some(vertex) = walk.vertices[0] else {
            self.triangles.visit(
                |group| group.hiding(&start),
                |triangle| sum.add(self.covers_start(walk, triangle)),
            );
            return sum;
        };
        if self.from_vertex.counted != Some(vertex) {
            self.count_from(vertex, &start, None);
        }
        sum.add(Sides::both(self.from_vertex.sure));
        for &triangle in &self.from_vertex.unsure {
            sum.add(self.covers_start(walk, triangle));
        }
        sum
    }

    /// Whether a single triangle is found that hides both ends of the walk
    /// strictly, and so all of it: what lies behind a triangle is convex.
    /// Where layers are many, one of the first does, and the others need not
    /// be counted.
    pub(super) fn one_triangle_hides(&mut self, walk: &Walk) -> bool {
        let ([Some(start), Some(end)], false) = (walk.vertices, walk.cut) else { return false };
        if self.from_vertex.vertex == Some(start) {
            return self.one_hides(&self.from_vertex.hiding, end);
        }
        self.count_from(start, &walk.probed.ends[0], Some(end));
        self.from_vertex.counted.is_none() || self.one_hides(&self.from_vertex.hiding, end)
    }

    /// Whether one of some triangles hides a vertex strictly.
    fn one_hides(&self, triangles: &[u32], vertex: u32) -> bool {
        triangles.iter().any(|&triangle| self.covers_vertex(vertex, triangle) == Sign::Positive)
    }

    /// Counts the triangles in front of a vertex, apart from border cases; or
    /// leaves off as soon as so many are found as are to be asked, and one of
    /// them hides the vertex `end` too.
    fn count_from(&mut self, vertex: u32, start: &Bounds, end: Option<u32>) {
        let mut from = std::mem::take(&mut self.from_vertex);
        from.unsure.clear();
        from.hiding.clear();
        from.sure = 0;
        let hidden = Cell::new(false);
        self.triangles.visit(
            |group| if hidden.get() { 0 } else { group.hiding(start) },
            |triangle| match self.covers_vertex(vertex, triangle) {
                Sign::Positive => {
                    from.sure += 1;
                    if from.hiding.len() < ASKED {
                        from.hiding.push(triangle);
                        let enough = from.hiding.len() == ASKED;
                        hidden.set(
                            enough && end.is_some_and(|end| self.one_hides(&from.hiding, end)),
                        );
                    }
                }
                Sign::Zero => from.unsure.push(triangle),
                Sign::Negative => {}
            },
        );
        from.vertex = Some(vertex);
        from.counted = (!hidden.get()).then_some(vertex);
        self.from_vertex = from;
        self.vertices_counted += 1;
    }

    /// Positive if a triangle hides a vertex strictly, negative if it does
    /// not and the vertex is on none of the four planes that matter.
    #[inline]
    fn covers_vertex(&self, vertex: u32, triangle: u32) -> Sign {
        let facing = self.question.facing[triangle as usize];
        if facing.is_zero() {
            return Sign::Negative;
        }
        let corners @ [a, b, c] = self.question.mesh.triangles()[triangle as usize];
        if corners.contains(&vertex) {
            return Sign::Zero;
        }
        let mut covers = Sign::Positive;
        for [x, y] in [[a, b], [b, c], [c, a]] {
            let sign = self.predicates.side(x, y, vertex);
            if sign.is_opposite(facing) {
                return Sign::Negative;
            }
            if sign.is_zero() {
                covers = Sign::Zero;
            }
        }
        match self.predicates.plane(corners, vertex) {
            Sign::Zero => Sign::Zero,
            sign if sign == facing => covers,
            _ => Sign::Negative,
        }
    }

    /// How many of the vertex's own triangles hide the beginning of a walk
    /// from it, if it is no fan: from a fan none does.
    pub(super) fn star_count(&self, walk: &Walk, star: &[u32]) -> Sides {
        let mut sum = Sides::default();
        star.iter().for_each(|&triangle| sum.add(self.covers_start(walk, triangle)));
        sum
    }

    /// Whether a triangle hides the beginning of the walk: 0 or 1 per side.
    #[inline]
    fn covers_start(&self, walk: &Walk, triangle: u32) -> Sides {
        let facing = self.question.facing[triangle as usize];
        if facing.is_zero() || self.is_own(walk, triangle) {
            return Sides::default();
        }
        let corners = self.question.mesh.triangles()[triangle as usize];
        let mut covers = Sides::both(1);
        for i in 0..3 {
            let (x, y, z) = (corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]);
            // A corner of the triangle lies on the inner side of the
            // opposite edge.
            if walk.vertices[0] == Some(z) {
                continue;
            }
            let side = Cut::Silhouette([x, y]);
            let sign = self.sign_at(walk, 0, side);
            let sign = if sign.is_zero() { self.sign_at(walk, 1, side) } else { sign };
            if sign.is_zero() {
                covers = self.on_side_of(walk, z, covers);
            } else if sign != facing {
                return Sides::default();
            }
        }
        let plane = Cut::Face(corners);
        let sign = self.sign_at(walk, 0, plane);
        let sign = if sign.is_zero() { self.sign_at(walk, 1, plane) } else { sign };
        if sign == facing { covers } else { Sides::default() }
    }

    /// `covers` on the side of the walk on which vertex `third` lies, and
    /// nothing on the other.
    pub(super) fn on_side_of(&self, walk: &Walk, third: u32, covers: Sides) -> Sides {
        match self.predicates.image_side(walk.carrier, third) {
            Sign::Positive => Sides { right: 0, ..covers },
            Sign::Negative => Sides { left: 0, ..covers },
            // Only an edge-on triangle has all corners on one image line.
            Sign::Zero => Sides::default(),
        }
    }
}
