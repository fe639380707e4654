//! What a ray from the eye through a vertex meets.
//!
//! A point of the ray is `x + k E` up to its weight, and the larger k, the
//! nearer it is to the eye. The plane of a triangle with functional `S(.) =
//! [a, b, c, .]` is met where `S(x) + k S(E) = 0`. As `S(E) = -F` with the
//! facing `F = [E, a, b, c]`, that is at `k = S(x) / F`: so depths along a
//! ray are compared, and held against the near plane, by products of two
//! determinants (Appel 1968 casts such rays, in floats).

use super::formula::{near_at_vertex, orientation, side};
use super::{Formula, Points, Policy, Predicate, Predicates};
use crate::kernel::numbers::{Ring, Sign};

/// `S1(x) F2 - S2(x) F1`.
struct Nearer {
    triangles: [[u32; 3]; 2],
    through: u32,
}

impl Formula for Nearer {
    const PREDICATE: Predicate = Predicate::Ray;

    fn degree(&self) -> u32 {
        6
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let plane = |[a, b, c]: [u32; 3]| orientation::<R>(points, a, b, c, self.through);
        let facing = |[a, b, c]: [u32; 3]| side::<R>(points, a, b, c);
        let [first, second] = self.triangles;
        plane(first) * facing(second) - plane(second) * facing(first)
    }
}

/// `N(x) F + S(x) N(E)` with the near plane's functional N.
pub(super) struct InFront {
    pub(super) triangle: [u32; 3],
    pub(super) through: u32,
}

impl Formula for InFront {
    const PREDICATE: Predicate = Predicate::Ray;

    fn degree(&self) -> u32 {
        5
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let [a, b, c] = self.triangle;
        let facing = side::<R>(points, a, b, c);
        let Some((_, offset)) = points.near::<R>() else {
            return facing;
        };
        // The functional of the near plane is minus its offset at the eye.
        near_at_vertex::<R>(points, self.through) * facing
            - orientation::<R>(points, a, b, c, self.through) * offset
    }
}

impl<P: Policy> Predicates<'_, P> {
    /// Compares where the ray from the eye through vertex `through` meets
    /// the planes of two triangles that are not edge-on, given with their
    /// facings: positive if the first is the nearer one. Degree 6.
    pub fn nearer(&self, through: u32, first: ([u32; 3], Sign), second: ([u32; 3], Sign)) -> Sign {
        let formula = Nearer { triangles: [first.0, second.0], through };
        self.decide(&formula) * first.1 * second.1
    }

    /// Whether the ray from the eye through vertex `through` meets a
    /// triangle, given with its facing, in front of the near plane. It must
    /// meet it in front of the eye.
    pub fn meets_in_front(&self, through: u32, triangle: [u32; 3], facing: Sign) -> bool {
        !self.points().has_near_plane()
            || self.decide(&InFront { triangle, through }) * facing == Sign::Positive
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Exact, Eye, NearPlane};
    use super::*;
    use glam::DVec3;

    #[test]
    fn the_nearer_triangle_wins_whatever_way_it_faces() {
        let corners = |depth: f64| {
            [
                DVec3::new(-9.0, depth, -9.0),
                DVec3::new(9.0, depth, -9.0),
                DVec3::new(0.0, depth, 9.0),
            ]
        };
        for eye in [Eye::At(DVec3::ZERO), Eye::Towards(-DVec3::Y)] {
            for sample_depth in [1.0, 4.0, 10.0] {
                let mut vertices = corners(3.0).to_vec();
                vertices.extend(corners(5.0));
                vertices.push(DVec3::new(0.25, sample_depth, 0.25));
                let near =
                    eye.is_perspective().then_some(NearPlane { forward: DVec3::Y, distance: 4.0 });
                let points = Points::new(&vertices, eye, near);
                let predicates = Predicates::<Exact>::new(&points);
                for first in [[0, 1, 2], [0, 2, 1]] {
                    let second = [3, 4, 5];
                    let with = |t| (t, predicates.facing(t));
                    let nearer = |s, t| predicates.nearer(6, with(s), with(t));
                    assert_eq!(nearer(first, second), Sign::Positive);
                    assert_eq!(nearer(second, first), Sign::Negative);
                    assert_eq!(nearer(first, first), Sign::Zero);
                    let front = |t| predicates.meets_in_front(6, t, predicates.facing(t));
                    assert_eq!(front(first), !eye.is_perspective());
                    assert!(front(second));
                }
            }
        }
    }
}
