//! The oracle of points: how many sheets hide a point of a line?
//!
//! The point is chosen strictly inside a piece and stays a combination of
//! the line's ends, so the functionals of planes at it are exact. A
//! triangle hides it if it is behind the triangle's plane and inside its
//! three silhouette planes. Where a functional is zero at the point but
//! not along the line, its sign just after the point counts (germ rule);
//! where a silhouette plane holds the whole line, the triangle covers one
//! side of the line only, that of its third corner (side rule). A triangle
//! in whose plane the line lies does not hide it.
//!
//! This is a count, with no events, no order and no sweep: nothing that
//! another method could have got wrong in the same way.

use super::BoxTree;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{
    Carrier, Cut, Place, Point, Policy, Predicates, Probe, sort_by_predicates,
};
use crate::model::{FeatureLine, LineOrigin};
use crate::run::Counters;
use crate::spatial::Bounds;
use crate::view::LineQuestion;
use std::cmp::Ordering;

/// Binary places of a probe's parameter.
const WEIGHT: f64 = 9_007_199_254_740_992.0;

/// Counts sheets in front of points of a question's lines. One per worker.
#[derive(Debug)]
pub struct SheetCounter<'a, 'q, P: Policy> {
    question: &'a LineQuestion<'q>,
    tree: &'a BoxTree,
    predicates: Predicates<'q, P>,
}

impl<'a, 'q, P: Policy> SheetCounter<'a, 'q, P> {
    /// A counter that searches `tree`, see [`Self::tree`].
    pub fn new(question: &'a LineQuestion<'q>, tree: &'a BoxTree) -> Self {
        SheetCounter { question, tree, predicates: Predicates::new(question.points) }
    }

    /// The tree that counters of this question search. O(n log n).
    pub fn tree(question: &LineQuestion) -> BoxTree {
        BoxTree::of_triangles(question, question.coordinates)
    }

    /// What the predicates counted so far.
    pub fn counters(&self) -> Counters {
        self.predicates.counters()
    }

    /// A point strictly inside the piece between two places, about the
    /// share `share` of its length after its beginning.
    pub fn probe(&self, carrier: Carrier, places: [Place; 2], share: f64) -> Probe {
        let [from, to] = places.map(|place| self.parameter(carrier, place));
        let middle = ((from + (to - from) * share) * WEIGHT).round();
        let weights = [WEIGHT - middle, middle];
        let inside = weights.iter().all(|&weight| weight > 0.0)
            && self.is_towards(carrier, weights, places[0], 1)
            && self.is_towards(carrier, weights, places[1], 0);
        if inside { Probe::Weights(weights) } else { Probe::Between(places) }
    }

    /// About where a place lies, from 0 at the carrier's start to 1.
    pub fn parameter(&self, carrier: Carrier, place: Place) -> f64 {
        match place {
            Place::Start => 0.0,
            Place::End => 1.0,
            Place::Cut(cut) => {
                let values = carrier.ends.map(|end| self.predicates.value(cut, end));
                self.predicates.parameter(carrier, cut, &values)
            }
        }
    }

    /// Whether the combination lies strictly between a place and the end
    /// `end` of the carrier: then the cut has one sign at both.
    fn is_towards(&self, carrier: Carrier, weights: [f64; 2], place: Place, end: usize) -> bool {
        let Place::Cut(cut) = place else {
            return true;
        };
        let here = self.predicates.combination(carrier, weights, cut);
        here != Sign::Zero && here == self.predicates.value_sign(cut, carrier.ends[end])
    }

    /// Triangles that hide a point of a line: on the line's left side and
    /// on its right side.
    pub fn count(&self, line: &FeatureLine, probe: Probe) -> [u32; 2] {
        let mut sheets = [0; 2];
        self.each(line, probe, |_, hides| {
            sheets[0] += u32::from(hides[0]);
            sheets[1] += u32::from(hides[1]);
        });
        sheets
    }

    /// The triangles that [`Self::count`] counts, with the sides on which
    /// they hide, nearest to the eye first: by the exact order of their
    /// planes on the ray of the point. Of planes that are one plane there,
    /// the triangle that comes first in the mesh.
    pub fn hiding(&self, line: &FeatureLine, probe: Probe) -> Vec<(u32, [bool; 2])> {
        let mut found = Vec::new();
        self.each(line, probe, |triangle, hides| found.push((triangle, hides)));
        let point = (self.question.carrier(line), probe);
        let plane = |triangle: u32| {
            let corners = self.question.mesh.triangles()[triangle as usize];
            (corners, self.question.facing[triangle as usize])
        };
        sort_by_predicates::<P, _>(&mut found, |&(a, _), &(b, _)| {
            let nearer = self.predicates.nearer_at(point, plane(a), plane(b));
            Ordering::from(-nearer).then(a.cmp(&b))
        });
        found
    }

    /// Calls `found` with all triangles that hide a point, and on which sides.
    fn each(&self, line: &FeatureLine, probe: Probe, mut found: impl FnMut(u32, [bool; 2])) {
        let carrier = self.question.carrier(line);
        let own = match line.origin {
            LineOrigin::Intersection(i) => self.question.intersections[i as usize].triangles,
            _ => [u32::MAX; 2],
        };
        self.tree.in_front(&self.area(line), |triangle| {
            if !own.contains(&triangle) {
                let hides = self.hides(carrier, probe, triangle);
                if hides != [false; 2] {
                    found(triangle, hides);
                }
            }
        });
    }

    /// Whether a triangle hides a point on its line's left and right side.
    pub fn hides(&self, carrier: Carrier, probe: Probe, triangle: u32) -> [bool; 2] {
        let facing = self.question.facing[triangle as usize];
        let corners = self.question.mesh.triangles()[triangle as usize];
        let mut sides = self.covers(carrier, probe, triangle);
        if sides != [false; 2] && self.germ(carrier, probe, Cut::Face(corners)) != facing {
            sides = [false; 2];
        }
        sides
    }

    /// Whether a triangle's image covers a point, however deep, on its
    /// line's left and right side.
    pub fn covers(&self, carrier: Carrier, probe: Probe, triangle: u32) -> [bool; 2] {
        let facing = self.question.facing[triangle as usize];
        if facing.is_zero() {
            return [false; 2];
        }
        let [a, b, c] = self.question.mesh.triangles()[triangle as usize];
        let mut sides = [true; 2];
        for (p, q, third) in [(a, b, c), (b, c, a), (c, a, b)] {
            match self.germ(carrier, probe, Cut::Silhouette([p, q])) {
                Sign::Zero => {
                    let covered = self.predicates.image_side(carrier, third);
                    sides[0] &= covered == Sign::Positive;
                    sides[1] &= covered == Sign::Negative;
                }
                sign if sign != facing => return [false; 2],
                _ => {}
            }
        }
        sides
    }

    /// The sign of a functional at the point, or just after it.
    fn germ(&self, carrier: Carrier, probe: Probe, cut: Cut) -> Sign {
        let [start, end] = carrier.ends.map(|end| {
            if is_corner(cut, end) { Sign::Zero } else { self.predicates.value_sign(cut, end) }
        });
        if !start.is_opposite(end) {
            // Linear, and the point lies strictly between the ends.
            return start.or(end);
        }
        let here = match probe {
            Probe::Weights(weights) => self.predicates.combination(carrier, weights, cut),
            Probe::Between(places) => self.predicates.between(carrier, places, cut),
        };
        here.or(end)
    }

    /// A box around a line.
    fn area(&self, line: &FeatureLine) -> Bounds {
        let coordinates = self.question.coordinates;
        if let LineOrigin::Intersection(index) = line.origin {
            let [s, t] = self.question.intersections[index as usize].triangles;
            let bounds = |triangle: u32| {
                coordinates.bounds(self.question.mesh.triangles()[triangle as usize])
            };
            // It lies in both triangles, so the box of one will do.
            let (s, t) = (bounds(s), bounds(t));
            let width = |bounds: &Bounds| bounds.high[0] - bounds.low[0];
            return if width(&s) <= width(&t) { s } else { t };
        }
        let vertices = self.question.carrier(line).as_edge();
        vertices.map_or(Bounds::ALL, |vertices| coordinates.bounds(vertices))
    }
}

/// Whether the plane of a cut goes through a vertex because the vertex is
/// one of those that define it.
fn is_corner(cut: Cut, end: Point) -> bool {
    match (cut, end) {
        (Cut::Face(corners), Point::Vertex(vertex)) => corners.contains(&vertex),
        (Cut::Silhouette(corners), Point::Vertex(vertex)) => corners.contains(&vertex),
        _ => false,
    }
}
