//! What of a polygon's rings bounds something, in a projection.
//!
//! Corners at one position become one point, and points are numbered by their
//! positions. Edges between the same two points become one, which knows how
//! insideness changes across it; where it does not change, nothing is bounded
//! and the edge is left out: the bridge of a keyhole, a spike, a side that a
//! hole has in common with the shell. What remains is the same for every
//! way of writing the polygon down.

use super::{Projection, TriangulationError};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::turn_of_ring;
use glam::{DVec2, DVec3};
use std::cmp::Ordering;

/// How often the rings go around a place, or how that changes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Insideness {
    /// Whether the outer ring goes around it an odd number of times.
    in_shell: bool,
    /// How often holes go around it, each as if it ran counterclockwise.
    holes: i32,
}

impl Insideness {
    /// Whether the place belongs to the polygon.
    pub(super) fn is_inside(self) -> bool {
        self.in_shell && self.holes == 0
    }

    /// On the left of an edge, given what is on its right and the change.
    pub(super) fn plus(self, change: Self) -> Self {
        Insideness { in_shell: self.in_shell != change.in_shell, holes: self.holes + change.holes }
    }

    /// The change for one who comes from the left.
    pub(super) fn reversed(self) -> Self {
        Insideness { holes: -self.holes, ..self }
    }
}

/// An edge that bounds something.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Edge {
    /// Its points, the smaller number first.
    pub(crate) ends: [u32; 2],
    /// What changes for one who crosses it from its right to its left.
    pub(super) change: Insideness,
    /// A ring that has it.
    pub(super) ring: u32,
}

/// The points and edges that bound a polygon.
#[derive(Debug)]
pub(crate) struct Outline {
    /// The points from left to right, and upwards where they lie above one
    /// another. All of them are ends of edges.
    pub(crate) points: Vec<DVec2>,
    /// The least number of the corners at each point.
    pub(crate) corners: Vec<u32>,
    /// The edges, by their ends.
    pub(crate) edges: Vec<Edge>,
}

/// From left to right, and upwards.
fn compare(a: DVec2, b: DVec2) -> Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
}

impl Outline {
    /// Gathers the rings with these corners. O(n log n).
    ///
    /// # Errors
    ///
    /// If corners in different places of space are one in the projection.
    pub(crate) fn new<R: AsRef<[DVec3]>>(
        rings: &[R],
        corners: &[DVec3],
        projection: &Projection,
    ) -> Result<Self, TriangulationError> {
        let flat = &projection.positions;
        let mut order: Vec<u32> = (0..corners.len() as u32).collect();
        order
            .sort_unstable_by(|&a, &b| compare(flat[a as usize], flat[b as usize]).then(a.cmp(&b)));
        let mut outline = Outline { points: Vec::new(), corners: Vec::new(), edges: Vec::new() };
        let mut point_of = vec![0; corners.len()];
        for corner in order {
            let position = flat[corner as usize];
            if outline.points.last() != Some(&position) {
                outline.points.push(position);
                outline.corners.push(corner);
            }
            let point = outline.points.len() - 1;
            if corners[outline.corners[point] as usize] != corners[corner as usize] {
                return Err(TriangulationError::Coincident);
            }
            point_of[corner as usize] = point as u32;
        }
        outline.add_edges(rings, flat, &point_of);
        outline.leave_out_what_bounds_nothing();
        Ok(outline)
    }

    fn add_edges<R: AsRef<[DVec3]>>(&mut self, rings: &[R], flat: &[DVec2], point_of: &[u32]) {
        let mut first = 0;
        for (number, ring) in (0..).zip(rings) {
            let end = first + ring.as_ref().len();
            let runs_backward = number > 0 && turn_of_ring(&flat[first..end]) == Sign::Negative;
            let points = &point_of[first..end];
            let next = points.iter().cycle().skip(1);
            for (&from, &to) in points.iter().zip(next) {
                if from == to {
                    continue;
                }
                let change = match number {
                    0 => Insideness { in_shell: true, holes: 0 },
                    _ if (from < to) != runs_backward => Insideness { in_shell: false, holes: 1 },
                    _ => Insideness { in_shell: false, holes: -1 },
                };
                self.edges.push(Edge { ends: [from.min(to), from.max(to)], change, ring: number });
            }
            first = end;
        }
    }

    /// Makes one edge of those with the same ends, drops those across which
    /// nothing changes, and the points that have none then.
    fn leave_out_what_bounds_nothing(&mut self) {
        self.edges.sort_unstable_by_key(|edge| (edge.ends, edge.ring));
        self.edges.dedup_by(|next, edge| {
            let is_same = next.ends == edge.ends;
            if is_same {
                edge.change = edge.change.plus(next.change);
            }
            is_same
        });
        self.edges.retain(|edge| edge.change != Insideness::default());
        const UNUSED: u32 = u32::MAX;
        let mut numbers = vec![UNUSED; self.points.len()];
        for edge in &self.edges {
            edge.ends.iter().for_each(|&point| numbers[point as usize] = 0);
        }
        let mut count = 0;
        for (point, number) in numbers.iter_mut().enumerate().filter(|(_, n)| **n != UNUSED) {
            *number = count as u32;
            self.points[count] = self.points[point];
            self.corners[count] = self.corners[point];
            count += 1;
        }
        self.points.truncate(count);
        self.corners.truncate(count);
        for edge in &mut self.edges {
            edge.ends = edge.ends.map(|point| numbers[point as usize]);
        }
    }
}
