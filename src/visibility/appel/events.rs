//! Where the number of sheets in front of a line changes.
//!
//! Crossing: an effective edge e = ab in front of the line s = pq, their
//! images crossing. Candidates have a and b on different sides of s, and p
//! and q strictly on different sides of e; an end of e on the image of s
//! counts as lying on the other side than the one s is moved to, for all
//! edges at that vertex alike. Where p or q is on the image of e the crossing
//! is at an end of s and nothing changes inside it. The edge is in front if
//! `[p, q, a, b]` has the sign opposite to `side(a, b, q)`; zero means that
//! they meet in space, which is left to the piercings.
//!
//! ```text
//!            b          left of e | right of e       gain of e =
//!            |                    |                  triangles right of it
//!   p -------+------> q     s passes behind e        minus triangles left
//!            |
//!            a = (bottom), e directed upwards
//! ```
//!
//! Piercing: a triangle whose plane separates p and q strictly and which
//! the line meets in a point of the closed triangle. In the inside the count
//! changes by one. On the border the triangle's status just before and just
//! after is compared: behind its plane, and inside the edges that are met.

use super::Fault;
use super::walker::{Sides, Walk, Walker};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Cut, Measured, Policy};

/// A change of the counts at a cut.
#[derive(Debug, Clone, Copy)]
pub(super) struct Event {
    pub(super) cut: Cut,
    /// The cut's values at the two ends of the carrier.
    pub(super) values: [Measured; 2],
    pub(super) change: Sides,
}

impl<P: Policy> Walker<'_, P> {
    /// Collects the crossings with effective edges in front.
    pub(super) fn find_crossings(&mut self, walk: &Walk) {
        let mut tested = 0;
        let mut events = std::mem::take(&mut self.events);
        let mut met_ends = [false; 2];
        self.effective.candidates_among(&self.nearby, &walk.probed.probe, |index| {
            tested += 1;
            events.extend(self.crossing(walk, index, &mut met_ends));
        });
        self.met_ends = met_ends;
        self.crossings_tested += tested;
        self.crossings += events.len() as u64;
        self.events = events;
    }

    /// The event at an effective edge, if there is one. Notes the ends of the
    /// walk whose images may lie on that of the edge.
    #[inline]
    fn crossing(&self, walk: &Walk, index: u32, met_ends: &mut [bool; 2]) -> Option<Event> {
        let effective = self.question.effective[index as usize];
        let edge @ [a, b] = self.question.mesh.edges().ends(effective.edge);
        let own = walk.vertices.map(|end| end.is_some_and(|vertex| edge.contains(&vertex)));
        let cut = Cut::Silhouette(edge);
        if own != [false; 2] {
            // An edge from one end may still pass behind the other.
            for end in 0..2 {
                met_ends[end] |= !own[end] && self.sign_at(walk, end, cut).is_zero();
            }
            return None;
        }
        let values = walk.carrier.ends.map(|end| self.predicates.value(cut, end));
        let [first, last] = values;
        if first.sign.is_zero() || last.sign.is_zero() {
            met_ends[0] |= first.sign.is_zero();
            met_ends[1] |= last.sign.is_zero();
            return None;
        }
        if first.sign == last.sign {
            return None;
        }
        let side = |vertex| self.predicates.image_side(walk.carrier, vertex);
        let sides = [side(a), side(b)];
        if sides[0] == sides[1] {
            return None;
        }
        if self.fault == Some(Fault::LoseVertexHits) && sides.contains(&Sign::Zero) {
            return None;
        }
        let skew = self.predicates.skew(walk.carrier, edge);
        let in_front = skew.is_opposite(last.sign);
        if skew.is_zero() || !(in_front || self.fault == Some(Fault::IgnoreDepth)) {
            return None;
        }
        let gain = match self.fault {
            Some(Fault::CountFoldsOnce) => effective.gain.signum(),
            _ => effective.gain,
        };
        // Passing from the left of the edge to its right gains.
        let gain = gain * first.sign.to_i32();
        let met = |aside| {
            let [a, b] = sides.map(|side| side.or(aside));
            if a == b { 0 } else { gain }
        };
        let change = Sides { left: met(Sign::Negative), right: met(Sign::Positive) };
        Some(Event { cut, values: [first, last], change })
    }

    /// The values of a cut at the two ends, if its plane parts them strictly.
    #[inline(always)]
    fn parted_by(&self, walk: &Walk, cut: Cut) -> Option<[Measured; 2]> {
        let first = self.predicates.value(cut, walk.carrier.ends[0]);
        if first.sign.is_zero() {
            return None;
        }
        let last = self.predicates.value(cut, walk.carrier.ends[1]);
        first.sign.is_opposite(last.sign).then_some([first, last])
    }

    /// Collects the triangles that the line pierces.
    pub(super) fn find_piercings(&mut self, walk: &Walk) {
        if self.fault == Some(Fault::ForgetPiercings) {
            return;
        }
        let before = self.events.len();
        let mut events = std::mem::take(&mut self.events);
        match (self.question.piercings, walk.edge) {
            (Some(known), Some(edge)) => {
                events.extend(known.of_edge(edge).filter_map(|t| self.piercing(walk, t)));
            }
            _ => {
                let probe = walk.probed.probe;
                self.triangles.visit(
                    |group| group.overlapping(probe.bounds()) & group.meeting_line(&probe),
                    |triangle| events.extend(self.piercing(walk, triangle)),
                );
            }
        }
        self.piercings += (events.len() - before) as u64;
        self.events = events;
    }

    /// The event where the line pierces a triangle, if it does.
    #[inline]
    fn piercing(&self, walk: &Walk, triangle: u32) -> Option<Event> {
        let corners @ [a, b, c] = self.question.mesh.triangles()[triangle as usize];
        // A line that ends at a corner does not cross the plane there.
        if walk.vertices.iter().flatten().any(|vertex| corners.contains(vertex)) {
            return None;
        }
        let facing = self.question.facing[triangle as usize];
        if facing.is_zero() || self.is_own(walk, triangle) {
            return None;
        }
        let cut = Cut::Face(corners);
        let [first, last] = self.parted_by(walk, cut)?;
        let edges = [[a, b], [b, c], [c, a]];
        let pass = |edge| self.predicates.skew(walk.carrier, edge);
        let passes = [pass(edges[0]), pass(edges[1]), pass(edges[2])];
        if passes.contains(&Sign::Positive) && passes.contains(&Sign::Negative) {
            return None;
        }
        let mut inside = [Sides::both(1); 2];
        for (i, edge) in edges.into_iter().enumerate() {
            if passes[i].is_zero() {
                let third = corners[(i + 2) % 3];
                inside = self.inside_met_edge(walk, edge, third, facing, inside);
            }
        }
        let hides = [first.sign == facing, last.sign == facing].map(i32::from);
        let change = Sides {
            left: hides[1] * inside[1].left - hides[0] * inside[0].left,
            right: hides[1] * inside[1].right - hides[0] * inside[0].right,
        };
        Some(Event { cut, values: [first, last], change })
    }

    /// Narrows down where the line is inside the triangle's image just
    /// before and just after it meets one of its edges in space.
    fn inside_met_edge(
        &self,
        walk: &Walk,
        edge: [u32; 2],
        third: u32,
        facing: Sign,
        mut inside: [Sides; 2],
    ) -> [Sides; 2] {
        let signs = [0, 1].map(|end| self.sign_at(walk, end, Cut::Silhouette(edge)));
        if signs == [Sign::Zero; 2] {
            return inside.map(|sides| self.on_side_of(walk, third, sides));
        }
        for end in 0..2 {
            // The functional vanishes where they meet, so its sign on one
            // side of that place is the sign at the end on that side.
            if signs[end] != facing {
                inside[end] = Sides::default();
            }
        }
        inside
    }
}
