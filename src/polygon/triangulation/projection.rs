//! How a polygon in space is looked at, to be cut in the plane.

use super::axis::{canonical_axes_of, canonical_ring};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{are_coplanar, orientation, turn_of_ring};
use glam::{DVec2, DVec3};

/// A polygon's corners as they show along one direction.
#[derive(Debug, Clone)]
pub(crate) struct Projection {
    /// Where each corner is.
    pub(super) positions: Vec<DVec2>,
    /// Which way the outer ring turns; counterclockwise if neither way.
    pub(super) turn: Sign,
    /// Three corners that are not collinear.
    triangle: [usize; 3],
}

/// Three points that are not collinear.
fn triangle_of(points: &[DVec2]) -> Option<[usize; 3]> {
    let first = *points.first()?;
    let second = points.iter().position(|&p| p != first)?;
    let is_beside = |&p: &DVec2| !orientation(first, points[second], p).is_zero();
    Some([0, second, points.iter().position(is_beside)?])
}

impl Projection {
    fn new(positions: Vec<DVec2>, outer: usize) -> Option<Self> {
        let triangle = triangle_of(&positions)?;
        let turn = turn_of_ring(&positions[..outer]).or(Sign::Positive);
        Some(Projection { positions, turn, triangle })
    }

    /// What is seen from the positive end of an axis; nothing if all corners
    /// are collinear there. Coordinates stay as they are, but that there is
    /// one zero.
    pub(crate) fn along_axis(corners: &[DVec3], outer: usize, axis: usize) -> Option<Self> {
        let (x, y) = ((axis + 1) % 3, (axis + 2) % 3);
        let flatten = |p: &DVec3| DVec2::new(p[x], p[y]) + DVec2::ZERO;
        Self::new(corners.iter().map(flatten).collect(), outer)
    }

    /// Along the first of the axes in which the outer ring is large, and that
    /// axis; nothing if all corners are collinear in space.
    pub(crate) fn along_best_axis(corners: &[DVec3], outer: usize) -> Option<(Self, usize)> {
        let axes = canonical_axes_of(&corners[..outer]);
        axes.into_iter().find_map(|axis| Self::along_axis(corners, outer, axis).zip(Some(axis)))
    }

    /// Along the normal of the outer ring: for a polygon that is not planar,
    /// so that it is a choice and may be rounded. Nothing if there is none.
    pub(super) fn along_normal(corners: &[DVec3], outer: usize) -> Option<Self> {
        let largest = corners.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        // Newell's; Sutherland, Sproull and Schumacker 1974.
        let ring: Vec<DVec3> =
            canonical_ring(&corners[..outer]).into_iter().map(|p| p / largest).collect();
        let spokes = ring.windows(2).map(|pair| (pair[0] - ring[0]).cross(pair[1] - ring[0]));
        let normal = spokes.sum::<DVec3>().try_normalize()?;
        let right = normal.any_orthonormal_vector();
        let up = normal.cross(right);
        let flatten = |p: &DVec3| {
            let p = *p / largest;
            DVec2::new(p.dot(right), p.dot(up)) + DVec2::ZERO
        };
        Self::new(corners.iter().map(flatten).collect(), outer)
    }

    /// Whether all corners lie in one plane.
    pub(super) fn is_planar(&self, corners: &[DVec3]) -> bool {
        are_coplanar(corners, self.triangle)
    }
}
