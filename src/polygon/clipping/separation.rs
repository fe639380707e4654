//! Whether rounding can have changed how rings lie.
//!
//! Rounding moves every corner a short way. If nowhere on the way an edge
//! meets another one, but where both end in one corner, rings stay simple
//! and which of them lies in which stays the same: the plane is deformed, and
//! nothing in it is torn (an isotopy). Nearly always edges are so far apart
//! that floats with some slack can tell. Where they cannot, this says no, and
//! an exact look has to follow.

use super::Corner;
use crate::run::Run;
use crate::spatial::{Hierarchy, Rounding};
use glam::{DVec2, Vec3A};
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether rings whose corners were moved to `places`, each coordinate by
/// less than one unit in its last place, are surely as they were, and have
/// no straight corners. They are disjoint before but for common corners.
/// O(n log n).
pub(super) fn surely_undisturbed<'r>(
    rings: impl Iterator<Item = (&'r [Corner], &'r [DVec2])>,
) -> bool {
    let mut edges = Vec::new();
    for (corners, places) in rings {
        edges.extend((0..corners.len()).map(|i| {
            let j = (i + 1) % corners.len();
            Edge { corners: [&corners[i], &corners[j]], places: [places[i], places[j]] }
        }));
    }
    let largest = edges.iter().fold(0.0_f64, |all, e| all.max(e.places[0].abs().max_element()));
    // Far from the ends of the range of floats, so that products have no
    // errors but those of rounding.
    if !(1e-100..1e100).contains(&largest) {
        return edges.is_empty();
    }
    let unit = largest.next_up() - largest;
    let hierarchy = boxes(&edges, largest, unit);
    let doubtful = AtomicBool::new(false);
    hierarchy.overlapping_pairs(
        &Run::default(),
        || (),
        |(), a, b| {
            if !doubtful.load(Ordering::Relaxed)
                && !edges[a as usize].is_clear_of(&edges[b as usize], unit)
            {
                doubtful.store(true, Ordering::Relaxed);
            }
        },
    );
    !doubtful.into_inner()
}

/// Boxes of the edges, with room for how far they and others have moved.
fn boxes(edges: &[Edge<'_>], largest: f64, unit: f64) -> Hierarchy {
    let range = -largest..largest;
    let rounding = Rounding::for_ranges([range.clone(), range, 0.0..0.0]);
    let slack = DVec2::splat(4.0 * unit);
    let place = |i: usize| {
        let start = edges[i].places[0];
        Vec3A::new(rounding.nearest(0, start.x), rounding.nearest(1, start.y), 0.0)
    };
    Hierarchy::of(edges.len(), place, |i| {
        let [a, b] = edges[i].places;
        rounding.around((a.min(b) - slack).extend(0.0), (a.max(b) + slack).extend(0.0))
    })
}

/// An edge where it was moved to.
struct Edge<'r> {
    corners: [&'r Corner; 2],
    places: [DVec2; 2],
}

impl Edge<'_> {
    /// Whether this edge and another one, wherever their ends are within one
    /// `unit` in each coordinate, have nothing in common but a common corner.
    fn is_clear_of(&self, other: &Self, unit: f64) -> bool {
        for (i, corner) in self.corners.into_iter().enumerate() {
            for (j, against) in other.corners.into_iter().enumerate() {
                if self.places[i] == other.places[j] && corner.point == against.point {
                    let common = self.places[i];
                    let ends = [self.places[1 - i] - common, other.places[1 - j] - common];
                    return turn(ends, unit) != 0.0;
                }
            }
        }
        is_beside(self.places, other.places, unit) || is_beside(other.places, self.places, unit)
    }
}

/// Whether an edge lies wholly on one side of the line of the other.
fn is_beside([a, b]: [DVec2; 2], edge: [DVec2; 2], unit: f64) -> bool {
    let [from, to] = edge.map(|point| turn([b - a, point - a], unit));
    from * to > 0.0
}

/// The sign of the turn from one vector to another, if it is the same
/// wherever the ends of both are within one `unit` in each coordinate, which
/// is one in the last place of the largest one; else zero.
///
/// Moved ends change each component of a vector by at most two units, and its
/// rounding by one more; so the two products change by three units times the
/// components, and by nine square units each, which are less if the vectors
/// are longer than that; rounding products of vectors shorter than twice the
/// largest coordinate costs another four units times the components.
fn turn([u, v]: [DVec2; 2], unit: f64) -> f64 {
    let value = u.perp_dot(v);
    let reach = u.abs().element_sum() + v.abs().element_sum();
    if value.abs() > 32.0 * unit * (reach + unit) { value.signum() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::{is_beside, turn};
    use glam::dvec2;

    const UNIT: f64 = f64::EPSILON;

    #[test]
    fn turns_are_doubtful_when_nearly_straight() {
        assert_eq!(turn([dvec2(1.0, 0.0), dvec2(1.0, 1e-9)], UNIT), 1.0);
        assert_eq!(turn([dvec2(1.0, 0.0), dvec2(-1.0, -1e-9)], UNIT), -1.0);
        assert_eq!(turn([dvec2(1.0, 0.0), dvec2(1.0, 4.0 * UNIT)], UNIT), 0.0);
        assert_eq!(turn([dvec2(1.0, 0.0), dvec2(f64::NAN, 1.0)], UNIT), 0.0);
        // Vectors so short that their ends may change places.
        assert_eq!(turn([dvec2(2.0 * UNIT, 0.0), dvec2(0.0, 2.0 * UNIT)], UNIT), 0.0);
    }

    #[test]
    fn an_edge_is_beside_a_line_or_not() {
        let line = [dvec2(0.0, 0.0), dvec2(1.0, 0.0)];
        assert!(is_beside(line, [dvec2(0.2, 1e-12), dvec2(0.3, 0.5)], UNIT));
        assert!(!is_beside(line, [dvec2(0.2, UNIT), dvec2(0.3, 0.5)], UNIT));
        assert!(!is_beside(line, [dvec2(0.2, -0.1), dvec2(0.3, 0.5)], UNIT));
    }
}
