//! Questions about a point strictly inside a carrier, a [`Probe`].
//!
//! Whatever is linear in a point is known at a probe by linearity: the sum of
//! what it is at two points of the carrier, each times a positive weight.
//! So nothing here is a new formula, only the formulas of rays and of image
//! lines applied to such a sum.

use super::formula::{
    Located, apply, axis_side, orientation, side, weight as weight_of, weight_degree,
};
use super::{Carrier, Formula, Place, Points, Policy, Predicate, Predicates, Probe};
use crate::kernel::numbers::{Ring, Sign};
use std::cmp::Ordering;

/// Bits of two weights of a probe, and of their sum.
const WEIGHT_BITS: u32 = 130;

/// A probe with what it takes to make weights positive.
#[derive(Clone, Copy)]
enum Inner {
    Weights(Carrier, [f64; 2]),
    Between([Located; 2]),
}

impl Inner {
    fn degree(&self) -> u32 {
        match self {
            Inner::Weights(carrier, _) => carrier.ends.map(weight_degree).iter().sum(),
            Inner::Between(places) => places[0].degree().max(places[1].degree()),
        }
    }

    /// The functional `f` at the point, times a positive weight.
    fn apply<R: Ring>(&self, points: &Points, f: &dyn Fn(u32) -> R) -> R {
        match *self {
            Inner::Weights(Carrier { ends: [start, end] }, weights) => {
                // The ends' own weights must be equal before adding up.
                let [at_start, at_end] = [(start, end), (end, start)].map(|(point, other)| {
                    weight_of::<R>(points, other) * apply::<R>(points, point, f)
                });
                R::read(weights[0], 0) * at_start + R::read(weights[1], 0) * at_end
            }
            Inner::Between([first, second]) => first.apply(points, f) + second.apply(points, f),
        }
    }
}

/// `S1(x) F2 - S2(x) F1` with the planes S of two triangles and their facings
/// F: see `ray`, where x is a vertex.
struct NearerAt {
    triangles: [[u32; 3]; 2],
    through: Inner,
}

impl Formula for NearerAt {
    const PREDICATE: Predicate = Predicate::Ray;

    fn degree(&self) -> u32 {
        6 + self.through.degree()
    }

    fn bits(&self, spread: u32) -> u32 {
        self.degree() * (spread + 2) + 2 + WEIGHT_BITS
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let plane = |[a, b, c]: [u32; 3]| {
            self.through.apply(points, &|x| orientation::<R>(points, a, b, c, x))
        };
        let facing = |[a, b, c]: [u32; 3]| side::<R>(points, a, b, c);
        let [first, second] = self.triangles;
        plane(first) * facing(second) - plane(second) * facing(first)
    }
}

/// `[E, x, y, k]` of a probe x, a place y and an axis direction `k`.
struct AlongImageAt {
    probe: Inner,
    place: Located,
    axis: u8,
}

impl Formula for AlongImageAt {
    const PREDICATE: Predicate = Predicate::AlongImage;

    fn degree(&self) -> u32 {
        3 + self.probe.degree() + self.place.degree()
    }

    fn bits(&self, spread: u32) -> u32 {
        self.degree() * (spread + 2) + 2 + WEIGHT_BITS
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        self.probe.apply(points, &|x| {
            // [E, x, y, k] = -[E, x, k, y].
            -self.place.apply(points, &|y| axis_side(points, x, self.axis, y))
        })
    }
}

impl<P: Policy> Predicates<'_, P> {
    /// As [`Predicates::nearer`], on the ray through a probe of a carrier:
    /// positive if the first triangle's plane is met nearer to the eye. Where
    /// the planes meet there, just after the probe.
    pub fn nearer_at(
        &self,
        (carrier, probe): (Carrier, Probe),
        first: ([u32; 3], Sign),
        second: ([u32; 3], Sign),
    ) -> Sign {
        let triangles = [first.0, second.0];
        let at = |through| self.decide(&NearerAt { triangles, through });
        let here = at(self.inner(carrier, probe));
        let sign = match here {
            Sign::Zero => at(Inner::Weights(carrier, [0.0, 1.0])),
            _ => here,
        };
        sign * first.1 * second.1
    }

    /// Whether a probe of a carrier comes before or after a place on another
    /// one whose image lies on the same line, along the image of the first.
    /// Images run across `axis`: see [`Predicates::axis_across`].
    pub fn order_at(
        &self,
        axis: u8,
        (carrier, probe): (Carrier, Probe),
        (other, place): (Carrier, Place),
    ) -> Ordering {
        let probe = self.inner(carrier, probe);
        let compare = |place| self.decide(&AlongImageAt { probe, place, axis });
        // The end of the carrier comes after the probe, whatever the sense.
        let sense = compare(self.locate(carrier, Place::End));
        (-(compare(self.locate(other, place)) * sense)).into()
    }

    fn inner(&self, carrier: Carrier, probe: Probe) -> Inner {
        match probe {
            Probe::Weights(weights) => Inner::Weights(carrier, weights),
            Probe::Between(places) => {
                Inner::Between(places.map(|place| self.locate(carrier, place)))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Cut, Exact, Eye};
    use super::*;
    use glam::DVec3;

    /// A point on the x-axis of the image half way along an edge, in front of
    /// it two planes that change places at x = 2.
    fn scene() -> Vec<DVec3> {
        vec![
            DVec3::new(0.0, 9.0, 0.0),
            DVec3::new(4.0, 9.0, 0.0),
            // y = 1 + x
            DVec3::new(-8.0, -7.0, -9.0),
            DVec3::new(8.0, 9.0, -9.0),
            DVec3::new(-8.0, -7.0, 9.0),
            // y = 5 - x
            DVec3::new(-8.0, 13.0, -9.0),
            DVec3::new(8.0, -3.0, -9.0),
            DVec3::new(-8.0, 13.0, 9.0),
            // Another edge with the same image, from x = 3 to x = 1.
            DVec3::new(3.0, 4.0, 0.0),
            DVec3::new(1.0, 7.0, 0.0),
        ]
    }

    #[test]
    fn the_nearer_plane_changes_where_the_planes_meet() {
        let points = Points::new(&scene(), Eye::Towards(-DVec3::Y), None);
        let predicates = Predicates::<Exact>::new(&points);
        let edge = Carrier::edge(0, 1);
        let with = |t: [u32; 3]| (t, predicates.facing(t));
        let nearer = |probe| {
            let signs = [([2, 3, 4], [5, 6, 7]), ([5, 6, 7], [2, 3, 4]), ([2, 4, 3], [5, 6, 7])];
            signs.map(|(s, t)| predicates.nearer_at((edge, probe), with(s), with(t)))
        };
        let (yes, no) = (Sign::Positive, Sign::Negative);
        assert_eq!(nearer(Probe::Weights([5.0, 3.0])), [yes, no, yes]);
        assert_eq!(nearer(Probe::Weights([3.0, 5.0])), [no, yes, no]);
        // Just after the place where they meet.
        assert_eq!(nearer(Probe::Weights([1.0, 1.0])), [no, yes, no]);
        assert_eq!(nearer(Probe::Between([Place::Start, Place::End])), [no, yes, no]);
        let middle = Place::Cut(Cut::Vertex(8, 2));
        assert_eq!(nearer(Probe::Between([middle, Place::End])), [no, yes, no]);
        let first = Place::Cut(Cut::Vertex(9, 2));
        assert_eq!(nearer(Probe::Between([Place::Start, first])), [yes, no, yes]);
    }

    #[test]
    fn a_probe_lies_before_and_after_places_of_another_line() {
        let points = Points::new(&scene(), Eye::Towards(-DVec3::Y), None);
        let predicates = Predicates::<Exact>::new(&points);
        let other = Carrier::edge(8, 9);
        for (edge, [start, end]) in [
            (Carrier::edge(0, 1), [Ordering::Less, Ordering::Greater]),
            (Carrier::edge(1, 0), [Ordering::Greater, Ordering::Less]),
        ] {
            let axis = predicates.axis_across(edge).expect("an image");
            let order = |probe, place| predicates.order_at(axis, (edge, probe), (other, place));
            let inside = Probe::Weights([1.0, 1.0]);
            assert_eq!(order(inside, Place::Start), start);
            assert_eq!(order(inside, Place::End), end);
            let between = Probe::Between([Place::Start, Place::End]);
            assert_eq!(order(between, Place::Start), start);
        }
        let axis = predicates.axis_across(other).expect("an image");
        let edge = Carrier::edge(0, 1);
        let at = |weights| {
            predicates.order_at(axis, (edge, Probe::Weights(weights)), (other, Place::Start))
        };
        assert_eq!(at([1.0, 3.0]), Ordering::Equal);
        assert_eq!(at([1.0, 4.0]), Ordering::Greater);
    }
}
