//! Are three bare positions collinear? Asked before there is a view.
//!
//! They are if all three 2 x 2 minors of `(b - a, c - a)` vanish. One minor
//! that is clearly not zero in floats settles the usual case; otherwise the
//! three positions are scaled on their own and climb the ladder.
//!
//! Of many segments those on one line are found by fingerprints: the Plücker
//! coordinates of a line, divided by the first that is not zero, are the same
//! for any two of its points, and so are their residues.

use super::{Exact, Eye, Formula, Points, Predicate, Predicates};
use crate::kernel::numbers::{Filtered, Residue, Ring, cross, difference};
use glam::DVec3;
use rustc_hash::FxBuildHasher;
use std::hash::BuildHasher;

/// The minor of two differences in which coordinate `axis` is left out.
fn minor<R: Ring>(u: &[R; 3], v: &[R; 3], axis: usize) -> R {
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    u[i].clone() * v[j].clone() - u[j].clone() * v[i].clone()
}

struct Minor(usize);

impl Formula for Minor {
    const PREDICATE: Predicate = Predicate::Orientation;

    fn degree(&self) -> u32 {
        2
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let origin = points.vertex::<R>(0);
        let [u, v] = [1, 2].map(|i| difference(points.vertex(i), &origin));
        minor(&u, &v, self.0)
    }
}

/// Whether three finite positions lie on one line, exactly.
pub fn are_collinear(a: DVec3, b: DVec3, c: DVec3) -> bool {
    let read = |p: DVec3| [Filtered::read(p.x, 0), Filtered::read(p.y, 0), Filtered::read(p.z, 0)];
    let origin = read(a);
    let (u, v) = (difference(read(b), &origin), difference(read(c), &origin));
    // These leaves are no integers, so only the bound may be used, and
    // products that underflow are covered by the least normal float.
    let clear = |axis| {
        let value = minor(&u, &v, axis);
        value.value().abs() > value.bound() + f64::MIN_POSITIVE
    };
    if (0..3).any(clear) {
        return false;
    }
    let points = Points::new(&[a, b, c], Eye::Towards(DVec3::Z), None);
    let predicates = Predicates::<Exact>::new(&points);
    (0..3).all(|axis| predicates.decide(&Minor(axis)).is_zero())
}

/// Fingerprints of the lines through pairs of finite positions: the same for
/// the same line, however its points were chosen; for two lines only by rare
/// chance. There is none where the coordinates of a direction are multiples
/// of the prime that residues are taken by, all three. O(n).
pub fn line_fingerprints(segments: &[[DVec3; 2]]) -> Vec<Option<u64>> {
    let read = |p: DVec3| p.to_array().map(|x| Residue::read(x, 0));
    let lines: Vec<[Residue; 6]> = segments
        .iter()
        .map(|&[a, b]| {
            let start = read(a);
            let [x, y, z] = difference(read(b), &start);
            let [u, v, w] = cross(start, [x, y, z]);
            [x, y, z, u, v, w]
        })
        .collect();
    let lead = |line: &[Residue; 6]| {
        line[..3].iter().copied().find(|&part| part != Residue::ZERO).unwrap_or(Residue::ZERO)
    };
    let inverses = Residue::inverses(&lines.iter().map(lead).collect::<Vec<_>>());
    let print = |(line, inverse): (&[Residue; 6], Residue)| {
        let canonical = line.map(|part| (part * inverse).value());
        (inverse != Residue::ZERO).then(|| FxBuildHasher.hash_one(canonical))
    };
    lines.iter().zip(inverses).map(print).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point([x, y, z]: [i32; 3]) -> DVec3 {
        DVec3::new(x.into(), y.into(), z.into()) * 0.125
    }

    proptest! {
        #[test]
        fn segments_of_one_line_have_one_fingerprint(
            start in prop::array::uniform3(-999..999_i32),
            along in prop::array::uniform3(-99..99_i32),
            places in prop::array::uniform4(-50..50_i32),
            other in prop::array::uniform3(-9..9_i32),
        ) {
            let [a, b, c, d] = places.map(|place| point(start) + point(along) * f64::from(place));
            prop_assume!(a != b && c != d);
            let e = c + point(other);
            let prints = line_fingerprints(&[[a, b], [c, d], [d, c], [e, d]]);
            prop_assert!(prints[0].is_some());
            prop_assert_eq!(prints[0], prints[1]);
            prop_assert_eq!(prints[1], prints[2]);
            // A chance in 2^61 of being wrong.
            let same = e == d || are_collinear(a, b, e);
            prop_assert_eq!(same, e == d || prints[0] == prints[3]);
        }
    }

    #[test]
    fn a_direction_of_multiples_of_the_prime_has_no_fingerprint() {
        let prime = [DVec3::X, DVec3::X * f64::powi(2.0, 61)];
        assert_eq!(line_fingerprints(&[prime]), [None]);
        let turned = [DVec3::X, DVec3::new(f64::powi(2.0, 61), 1.0, 0.0)];
        assert!(line_fingerprints(&[turned])[0].is_some());
    }

    #[test]
    fn one_ulp_off_the_line_is_seen_at_any_size() {
        for size in [1.0, 1e-300, 1e300, 1e-9] {
            let a = DVec3::new(0.1, 0.2, 0.3) * size;
            let d = DVec3::new(1.0, 3.0, 0.5) * size;
            let on = [DVec3::ZERO, d, d * 2.0];
            assert!(are_collinear(on[0], on[1], on[2]));
            let mut off = on[2];
            off.y = off.y.next_up();
            assert!(!are_collinear(on[0], on[1], off));
            assert!(are_collinear(a, a, d));
        }
    }
}
