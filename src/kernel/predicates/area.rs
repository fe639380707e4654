//! Which way a ring of bare positions turns, by its signed area.

use super::{Exact, Eye, Points, Predicates};
use crate::kernel::numbers::Sign;
use glam::{DVec2, DVec3};

/// Which way a ring of points of the plane turns: positive is
/// counterclockwise. The ring need not be simple. O(n).
pub fn turn_of_ring(ring: &[DVec2]) -> Sign {
    let Some(&first) = ring.first() else {
        return Sign::Zero;
    };
    let (mut area, mut magnitude) = (0.0, 0.0);
    for pair in ring.windows(2) {
        let (u, v) = (pair[0] - first, pair[1] - first);
        area += u.perp_dot(v);
        magnitude += (u.x * v.y).abs() + (u.y * v.x).abs();
    }
    // Two differences, a product, the difference of two products, and a sum
    // of n of those: n + 4 roundings, and what products lose by underflow.
    let count = ring.len() as f64;
    let bound = magnitude * ((count + 8.0) * f64::EPSILON) + f64::MIN_POSITIVE * count;
    if area.abs() > bound {
        return Sign::of(area);
    }
    let ring: Vec<DVec3> = ring.iter().map(|p| p.extend(0.0)).collect();
    let points = Points::new(&ring, Eye::Towards(DVec3::Z), None);
    Predicates::<Exact>::new(&points).turn(0..ring.len() as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_eight_turns_neither_way_unless_a_corner_moves_by_an_ulp() {
        for size in [1.0, 1e-300, 1e300] {
            let mut eight =
                [[0.1, 0.1], [0.7, 0.7], [0.7, 0.1], [0.1, 0.7]].map(|p| DVec2::from(p) * size);
            assert_eq!(turn_of_ring(&eight), Sign::Zero);
            eight[2].y = eight[2].y.next_up();
            assert_eq!(turn_of_ring(&eight), Sign::Positive);
            eight.reverse();
            assert_eq!(turn_of_ring(&eight), Sign::Negative);
        }
        assert_eq!(turn_of_ring(&[]), Sign::Zero);
    }
}
