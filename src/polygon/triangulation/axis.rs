//! The axis along which a polygon is looked at.
//!
//! Its ring and a corner of it span triangles. The areas that these show
//! along an axis, all taken as positive, are for a planar ring in proportion to
//! the normal of its plane, however often the ring crosses itself; their signed
//! sum, Newell's normal, vanishes for an eight, and then says nothing but how
//! coordinates were rounded. The axis with the largest sum is a choice and not
//! a decision: where a ring is planar, all but those that see it edge-on are
//! as right. It has to be the same for all ways of writing the ring down, so
//! where floats leave doubt, they are added in the one order that is.

use crate::polygon::canonical_cycle;
use glam::{DVec3, swizzles::Vec3Swizzles as _};
use std::cmp::Ordering;

/// The axes by the area that a ring shows along them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Axes {
    /// The axis of the largest area first.
    pub(super) order: [usize; 3],
    /// Whether that would be first for all ways of writing the ring down.
    pub(super) is_certain: bool,
}

/// The corner with the least coordinates, x first.
pub(super) fn least_corner(ring: &[DVec3]) -> usize {
    let mut least = 0;
    for (i, p) in ring.iter().enumerate() {
        let q = ring[least];
        let is_less = p.x < q.x || (p.x == q.x && (p.y < q.y || (p.y == q.y && p.z < q.z)));
        if is_less {
            least = i;
        }
    }
    least
}

/// The axes of a ring, as its corners are written. O(n).
pub(super) fn axes_of(ring: &[DVec3], least: usize) -> Axes {
    let (area, bound) = areas(ring, ring[least]);
    if area.is_finite() && area.max_element() > f64::MIN_POSITIVE / f64::EPSILON {
        return ordered(area, bound);
    }
    // Products that are out of range; a power of two brings them back.
    let largest = ring.iter().map(|p| p.abs().max_element()).fold(f64::MIN_POSITIVE, f64::max);
    let [one, other] = [-largest.log2().floor() * 0.5; 2].map(f64::exp2);
    let scaled: Vec<DVec3> = ring.iter().map(|p| *p * one * other).collect();
    let (area, bound) = areas(&scaled, scaled[least]);
    ordered(area, bound)
}

/// The axes of a ring, the same for all its rotations and for its reversal.
/// O(n log n), and O(n) where floats leave no doubt.
pub(super) fn canonical_axes_of(ring: &[DVec3]) -> [usize; 3] {
    let axes = axes_of(ring, least_corner(ring));
    if axes.is_certain {
        return axes.order;
    }
    let canonical = canonical_ring(ring);
    axes_of(&canonical, 0).order
}

/// The corners of a ring in the order that is least, so that it begins with
/// the least. O(n log n).
pub(super) fn canonical_ring(ring: &[DVec3]) -> Vec<DVec3> {
    let compare = |a: &DVec3, b: &DVec3| -> Ordering {
        a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
    };
    // Ranks, for rings of floats have no order.
    let ring: Vec<DVec3> = ring.iter().map(|p| *p + DVec3::ZERO).collect();
    let mut sorted = ring.clone();
    sorted.sort_unstable_by(compare);
    let rank = |p: &DVec3| sorted.partition_point(|other| compare(other, p).is_lt());
    let ranks: Vec<usize> = ring.iter().map(rank).collect();
    canonical_cycle(&ranks).into_iter().map(|rank| sorted[rank]).collect()
}

/// Twice the areas along each axis, and how much of that may be rounding.
fn areas(ring: &[DVec3], origin: DVec3) -> (DVec3, DVec3) {
    let (mut area, mut magnitude) = (DVec3::ZERO, DVec3::ZERO);
    let Some(&last) = ring.last() else {
        return (area, magnitude);
    };
    let mut u = last - origin;
    for &p in ring {
        let v = p - origin;
        let (one, other) = (u.yzx() * v.zxy(), u.zxy() * v.yzx());
        area += (one - other).abs();
        magnitude += one.abs() + other.abs();
        u = v;
    }
    (area, magnitude * ((ring.len() as f64 + 8.0) * f64::EPSILON))
}

/// Of equal areas that of the later axis comes first.
fn ordered(area: DVec3, bound: DVec3) -> Axes {
    let mut order = [2, 1, 0];
    order.sort_by(|&i, &j| area[j].total_cmp(&area[i]));
    let [first, others @ ..] = order;
    let is_less = |&other: &usize| area[first] - bound[first] > area[other] + bound[other];
    Axes { order, is_certain: others.iter().all(is_less) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    #[test]
    fn an_eight_is_looked_at_from_the_front() {
        // In the plane y = 3 x, each lobe the mirror image of the other.
        let eight = [[0.0, 0.0], [8.0, 8.0], [8.0, 0.0], [0.0, 8.0]]
            .map(|[s, t]| dvec3(s * 0.1, s * 0.3, t * 0.7));
        for size in [1.0, 1e-200, 1e-308, 1e300] {
            let ring = eight.map(|p| p * size);
            assert_eq!(canonical_axes_of(&ring), [0, 1, 2]);
        }
    }

    #[test]
    fn of_equal_areas_the_later_axis_is_taken_wherever_a_ring_begins() {
        let mut ring = vec![
            dvec3(0.1, 0.0, 0.1),
            dvec3(0.7, 0.3, 0.7),
            dvec3(0.3, 0.9, 0.3),
            dvec3(0.2, 0.6, 0.2),
            dvec3(0.0, 0.4, 0.0),
        ];
        for _ in 0..2 {
            for _ in 0..ring.len() {
                assert_eq!(canonical_axes_of(&ring)[0], 2);
                ring.rotate_left(1);
            }
            ring.reverse();
        }
    }
}
