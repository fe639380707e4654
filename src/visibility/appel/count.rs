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

use super::Fault;
use super::walker::{Sides, Walk, Walker};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Cut, Policy};

impl<P: Policy> Walker<'_, P> {
    /// The counts just after the start of the walk.
    pub(super) fn first_count(&mut self, walk: &Walk) -> Sides {
        self.counted += 1;
        if self.fault == Some(Fault::StartVisible) {
            return Sides::default();
        }
        let mut sum = Sides::default();
        let start = walk.start;
        self.question.hierarchy.visit(
            |node| node.may_hide(&start),
            |triangle| {
                let covers = self.covers_start(walk, triangle);
                sum.left += covers.left;
                sum.right += covers.right;
            },
        );
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
            let [x, y, z] = [0, 1, 2].map(|j| corners[(i + j) % 3]);
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
