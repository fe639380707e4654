//! Is a point inside of rings? By winding number and by even-odd.
//!
//! A ray goes down from the point, tilted so little that it meets no corner:
//! a corner counts as left or right of it by [`Predicates::sweep`], which
//! tells corners straight below from those straight above. An edge is met if
//! its ends are not on one side of the ray and it lies below, which is the
//! exact side of the point. (Shimrat 1962 for even-odd; Alexander 1971 for
//! winding numbers.) For points and rings known by name, in the image of any
//! eye. O(n).

use super::clipping::Corner;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Chart, ImagePoint, Policy, Predicates};
use std::cmp::Ordering;

/// Where a point lies in respect to rings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Membership {
    /// On an edge.
    Border,
    /// On no edge.
    Away {
        /// How often the rings wind around it, counterclockwise.
        winding: i32,
        /// How many edges a ray from it to infinity crosses.
        crossings: u32,
    },
}

impl Membership {
    /// Whether it is inside by even-odd; not where it is on the border.
    pub fn is_inside_by_even_odd(self) -> bool {
        matches!(self, Membership::Away { crossings, .. } if crossings % 2 == 1)
    }

    /// Whether it is inside by winding number; not where it is on the border.
    pub fn is_inside_by_winding(self) -> bool {
        matches!(self, Membership::Away { winding, .. } if winding != 0)
    }
}

/// Finds where a point of the image lies in respect to rings, which may
/// cross themselves and each other.
pub fn membership<'r, P: Policy>(
    predicates: &Predicates<'_, P>,
    chart: &Chart,
    rings: impl IntoIterator<Item = &'r [Corner]>,
    point: ImagePoint,
) -> Membership {
    let (mut winding, mut crossings) = (0, 0);
    let is_after = |corner: &Corner| predicates.sweep(chart, corner.point, point) != Ordering::Less;
    let is_at = |corner: &Corner| predicates.sweep(chart, corner.point, point).is_eq();
    for ring in rings {
        let next = ring.iter().cycle().skip(1);
        for (from, to) in ring.iter().zip(next) {
            if is_at(from) {
                return Membership::Border;
            }
            let (start, end) = (is_after(from), is_after(to));
            if start == end {
                continue;
            }
            let beside = predicates.beside(chart, from.line, point);
            if beside.is_zero() {
                return Membership::Border;
            }
            // Left of an edge that runs to the right is above it.
            if (beside == Sign::Positive) == end {
                winding += if end { 1 } else { -1 };
                crossings += 1;
            }
        }
    }
    Membership::Away { winding, crossings }
}

#[cfg(test)]
mod tests {
    use super::super::clipping::Polygon;
    use super::*;
    use crate::kernel::predicates::{Exact, Eye, Points};
    use glam::{DVec3, dvec3};

    fn at(corners: &[(f64, f64)], (x, y): (f64, f64)) -> Membership {
        let mut vertices: Vec<DVec3> = corners.iter().map(|&(x, y)| dvec3(x, y, 0.0)).collect();
        vertices.push(dvec3(x, y, 0.0));
        let count = corners.len() as u32;
        let points = Points::new(&vertices, Eye::Towards(DVec3::Z), None);
        let predicates = Predicates::<Exact>::new(&points);
        let chart = Chart::new(&points).unwrap();
        let polygon = Polygon::of_vertices([(0..count).collect::<Vec<_>>()]);
        let rings = polygon.rings.iter().map(Vec::as_slice);
        membership(&predicates, &chart, rings, ImagePoint::Vertex(count))
    }

    const PENTAGRAM: [(f64, f64); 5] =
        [(0.0, 10.0), (-6.0, -8.0), (9.0, 3.0), (-9.0, 3.0), (6.0, -8.0)];

    #[test]
    fn the_middle_of_a_pentagram_is_inside_by_winding_only() {
        let middle = at(&PENTAGRAM, (0.0, 0.0));
        assert_eq!(middle, Membership::Away { winding: 2, crossings: 2 });
        assert!(middle.is_inside_by_winding() && !middle.is_inside_by_even_odd());
        let tip = at(&PENTAGRAM, (0.0, 8.0));
        assert!(tip.is_inside_by_winding() && tip.is_inside_by_even_odd());
        // A ray from outside may cross edges, but as often one way as the other.
        let beside = at(&PENTAGRAM, (8.0, 9.0));
        assert!(matches!(beside, Membership::Away { winding: 0, .. }));
        assert!(!beside.is_inside_by_even_odd());
    }

    #[test]
    fn corners_above_and_below_the_point_count_once() {
        let diamond = [(0.0, -2.0), (2.0, 0.0), (0.0, 2.0), (-2.0, 0.0)];
        assert!(at(&diamond, (0.0, 0.0)).is_inside_by_even_odd());
        assert!(!at(&diamond, (0.0, 3.0)).is_inside_by_even_odd());
        assert!(!at(&diamond, (0.0, -3.0)).is_inside_by_even_odd());
        let comb = [(-2.0, 0.0), (-1.0, 1.0), (0.0, 0.0), (1.0, 1.0), (2.0, 0.0), (0.0, 4.0)];
        assert!(at(&comb, (0.0, 1.0)).is_inside_by_even_odd());
        assert!(!at(&comb, (0.0, -1.0)).is_inside_by_even_odd());
        let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
        for border in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (2.0, 1.0), (2.0, 2.0), (0.0, 2.0)] {
            assert_eq!(at(&square, border), Membership::Border, "{border:?}");
        }
        for outside in [(0.0, -1.0), (0.0, 3.0), (2.0, 3.0), (-1.0, 0.0), (3.0, 2.0)] {
            assert!(!at(&square, outside).is_inside_by_winding(), "{outside:?}");
        }
    }
}
