//! Are three bare positions collinear? Asked before there is a view.
//!
//! They are if all three 2 x 2 minors of `(b - a, c - a)` vanish. One minor
//! that is clearly not zero in floats settles the usual case; otherwise the
//! three positions are scaled on their own and climb the ladder.

use super::{Exact, Eye, Formula, Points, Predicate, Predicates};
use crate::kernel::numbers::{Filtered, Ring, difference};
use glam::DVec3;

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

#[cfg(test)]
mod tests {
    use super::*;

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
