//! Concave polygons cut into convex ones by extending edges.
//!
//! At a reflex corner the edge that arrives there is extended into the
//! inside until it meets the border, and the polygon is cut there. The corner
//! is none any more in one part and has a smaller angle in the other; both
//! are treated alike until all are convex (Sutherland and Hodgman 1974).
//! Cuts lie on lines of the input, so that all new corners are crossings of
//! two such lines and decided exactly, in the image of any eye. O(r n) for n
//! corners of which r are reflex, times the number of cuts that cut others.

use super::clipping::{Corner, Ring};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Chart, ImageLine, ImagePoint, Policy, Predicates};
use std::cmp::Ordering;

/// Cuts a simple ring that runs counterclockwise into convex rings. They
/// do so too, share no inside, and cover it; corners between collinear edges
/// are left out.
pub fn convex_parts<P: Policy>(
    predicates: &Predicates<'_, P>,
    chart: &Chart,
    ring: &[Corner],
) -> Vec<Ring> {
    let splitter = Splitter { predicates, chart };
    let (mut open, mut parts) = (vec![ring.to_vec()], Vec::new());
    while let Some(ring) = open.pop() {
        let ring = splitter.without_collinear(ring);
        match splitter.cut(&ring) {
            Some(halves) => open.extend(halves),
            None => parts.push(ring),
        }
    }
    parts
}

struct Splitter<'a, 'p, P: Policy> {
    predicates: &'a Predicates<'p, P>,
    chart: &'a Chart,
}

/// Where an extended edge meets the border.
struct Hit {
    point: ImagePoint,
    /// The edge it meets: the corner at which that starts.
    edge: usize,
}

impl<P: Policy> Splitter<'_, '_, P> {
    fn bend(&self, first: ImageLine, second: ImageLine) -> Sign {
        self.predicates.bend(self.chart, first, second)
    }

    fn without_collinear(&self, ring: Ring) -> Ring {
        let Some(mut before) = ring.last().map(|corner| corner.line) else {
            return ring;
        };
        let is_corner = |corner: &Corner| {
            let bends = !self.bend(before, corner.line).is_zero();
            before = corner.line;
            bends
        };
        ring.into_iter().filter(is_corner).collect()
    }

    /// Cuts at the first reflex corner, if there is one.
    fn cut(&self, ring: &[Corner]) -> Option<[Ring; 2]> {
        let count = ring.len();
        let line_before = |i: usize| ring[(i + count - 1) % count].line;
        let reflex = |&i: &usize| self.bend(line_before(i), ring[i].line) == Sign::Negative;
        let corner = (0..count).find(reflex)?;
        let line = line_before(corner);
        let hit = self.first_hit(ring, corner, line)?;
        // From the corner on to the hit, and back along the cut.
        let mut near: Ring = (0..count).map(|i| ring[(corner + i) % count]).collect();
        let steps = (hit.edge + count - corner) % count;
        let mut far = near.split_off(steps + 1);
        if near[steps].point == hit.point {
            near.pop();
        }
        near.push(Corner { point: hit.point, line: line.reversed() });
        // From the hit on to the corner, which is none any more here.
        far.insert(0, Corner { point: hit.point, line: ring[hit.edge].line });
        Some([near, far])
    }

    /// The place nearest to a corner at which a line through it, ahead of
    /// the corner, meets the ring.
    fn first_hit(&self, ring: &[Corner], corner: usize, line: ImageLine) -> Option<Hit> {
        let sides: Vec<Sign> = ring
            .iter()
            .map(|other| self.predicates.beside(self.chart, line, other.point))
            .collect();
        let ahead = match self.predicates.runs_forward(self.chart, line) {
            true => Ordering::Less,
            false => Ordering::Greater,
        };
        let before =
            |a: ImagePoint, b: ImagePoint| self.predicates.sweep(self.chart, a, b) == ahead;
        let mut nearest: Option<Hit> = None;
        for (edge, other) in ring.iter().enumerate() {
            let next = if edge + 1 == ring.len() { 0 } else { edge + 1 };
            let point = if edge != corner && sides[edge].is_zero() {
                other.point
            } else if sides[edge].is_opposite(sides[next]) {
                let pair = match self.bend(line, other.line) {
                    Sign::Positive => [line, other.line],
                    _ => [other.line, line],
                };
                ImagePoint::Crossing(pair)
            } else {
                continue;
            };
            let is_nearer = nearest.as_ref().is_none_or(|hit| before(point, hit.point));
            if before(ring[corner].point, point) && is_nearer {
                nearest = Some(Hit { point, edge });
            }
        }
        nearest
    }
}
