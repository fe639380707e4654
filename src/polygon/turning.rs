//! How a ring turns: convexity, and the turning number without which a
//! pentagram would be convex.
//!
//! At each corner the direction turns by less than half a revolution. It
//! passes straight down, from where edges run against the sweep to where
//! they run along it, once in each revolution to the left; so the turning
//! number is a count of signs (Meister 1770 has the number, Whitney 1937 its
//! theory). A ring is convex if it turns to one side only and once in all.

use super::clipping::Corner;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Chart, Policy, Predicates};

/// How a ring turns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Turning {
    /// Corners at which it turns left.
    pub left: u32,
    /// Corners at which it turns right.
    pub right: u32,
    /// Revolutions in all, to the left: 1 for a simple ring that runs
    /// counterclockwise, 2 for a pentagram.
    pub revolutions: i32,
}

impl Turning {
    /// Whether the ring is the border of a convex area. Corners between
    /// collinear edges are allowed.
    pub fn is_convex(self) -> bool {
        (self.left == 0 || self.right == 0) && self.revolutions.abs() == 1
    }
}

/// Measures how a ring turns; nothing where it turns right back at some
/// corner, or has no extent. Edges without an image are passed over. O(n).
pub fn turning<P: Policy>(
    predicates: &Predicates<'_, P>,
    chart: &Chart,
    ring: &[Corner],
) -> Option<Turning> {
    let next = ring.iter().cycle().skip(1);
    let lines: Vec<_> = ring
        .iter()
        .zip(next)
        .filter(|(from, to)| predicates.sweep(chart, from.point, to.point).is_ne())
        .map(|(from, _)| (from.line, predicates.runs_forward(chart, from.line)))
        .collect();
    let mut turning = Turning { left: 0, right: 0, revolutions: 0 };
    let mut before = lines.last()?;
    for line in &lines {
        let change = (before.1, line.1);
        match predicates.bend(chart, before.0, line.0) {
            Sign::Positive => {
                turning.left += 1;
                turning.revolutions += i32::from(change == (false, true));
            }
            Sign::Negative => {
                turning.right += 1;
                turning.revolutions -= i32::from(change == (true, false));
            }
            Sign::Zero if change.0 != change.1 => return None,
            Sign::Zero => {}
        }
        before = line;
    }
    Some(turning)
}

#[cfg(test)]
mod tests {
    use super::super::clipping::Polygon;
    use super::*;
    use crate::kernel::predicates::{Exact, Eye, Points};
    use glam::{DVec3, dvec3};

    fn of(corners: &[(f64, f64)]) -> Option<Turning> {
        let vertices: Vec<DVec3> = corners.iter().map(|&(x, y)| dvec3(x, y, 0.0)).collect();
        let points = Points::new(&vertices, Eye::Towards(DVec3::Z), None);
        let predicates = Predicates::<Exact>::new(&points);
        let chart = Chart::new(&points).unwrap();
        let polygon = Polygon::of_vertices([(0..corners.len() as u32).collect::<Vec<_>>()]);
        turning(&predicates, &chart, polygon.outline())
    }

    #[test]
    fn a_pentagram_turns_left_only_but_twice() {
        let pentagram = [(0.0, 10.0), (-6.0, -8.0), (9.0, 3.0), (-9.0, 3.0), (6.0, -8.0)];
        let turning = of(&pentagram).unwrap();
        assert_eq!(turning, Turning { left: 5, right: 0, revolutions: 2 });
        assert!(!turning.is_convex());
    }

    #[test]
    fn squares_are_convex_either_way_from_any_corner() {
        let mut square =
            vec![(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (2.0, 2.0), (0.0, 2.0)];
        for expected in [1, -1] {
            for _ in 0..square.len() {
                let turning = of(&square).unwrap();
                assert!(turning.is_convex());
                assert_eq!(turning.revolutions, expected);
                square.rotate_left(1);
            }
            square.reverse();
        }
    }

    #[test]
    fn dents_eights_and_spikes_are_not_convex() {
        let dent = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 1.0), (0.0, 4.0)];
        assert_eq!(of(&dent), Some(Turning { left: 4, right: 1, revolutions: 1 }));
        let eight = [(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)];
        let turning = of(&eight).unwrap();
        assert_eq!(turning.revolutions, 0);
        assert!(!turning.is_convex());
        assert_eq!(of(&[(0.0, 0.0), (2.0, 0.0), (1.0, 0.0)]), None);
        assert_eq!(of(&[(1.0, 1.0), (1.0, 1.0)]), None);
    }
}
