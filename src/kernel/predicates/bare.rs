//! Decisions about bare positions, asked where there is no view.
//!
//! Polygons are cut into triangles before anybody looks at them, one by one
//! and most of them small: scaling each to integers would cost more than all
//! that is asked about it. So plain coordinates go through the filter first.
//! They are no integers, and two things differ from a view's: only the bound
//! may be used, never that small integers are exact, and products may
//! underflow, which is covered by adding the least normal float. Where that
//! settles nothing, the positions of the question are scaled on their own and
//! climb the ladder. Right for all finite doubles.

use super::{Carrier, Cut, Exact, Eye, Formula, Point, Points, Predicate, Predicates};
use crate::kernel::numbers::{Filtered, Ring, Sign, determinant3, difference, dot};
use glam::{DVec2, DVec3};
use std::cmp::Ordering;

/// The sign of a value, if its bound and `slack` leave no doubt.
fn clear_sign(value: Filtered, slack: f64) -> Option<Sign> {
    (value.value().abs() > value.bound() + slack).then(|| Sign::of(value.value()))
}

fn read(p: DVec3) -> [Filtered; 3] {
    p.to_array().map(|x| Filtered::read(x, 0))
}

/// Points of the plane `z = 0`, seen from above.
fn in_the_plane<const N: usize>(points: [DVec2; N]) -> Points {
    Points::new(&points.map(|p| p.extend(0.0)), Eye::Towards(DVec3::Z), None)
}

/// Which way three points of the plane turn: positive is counterclockwise.
#[inline]
pub fn orientation(a: DVec2, b: DVec2, c: DVec2) -> Sign {
    let minus = |x: f64, y: f64| Filtered::read(x, 0) - Filtered::read(y, 0);
    let [ux, uy, vx, vy] = [minus(b.x, a.x), minus(b.y, a.y), minus(c.x, a.x), minus(c.y, a.y)];
    if let Some(sign) = clear_sign(ux * vy - uy * vx, f64::MIN_POSITIVE) {
        return sign;
    }
    // A difference is zero only if it is exactly so.
    let vanishes = |x: Filtered, y: Filtered| x.value() == 0.0 || y.value() == 0.0;
    if vanishes(ux, vy) && vanishes(uy, vx) {
        return Sign::Zero;
    }
    exact_orientation(a, b, c)
}

#[cold]
fn exact_orientation(a: DVec2, b: DVec2, c: DVec2) -> Sign {
    Predicates::<Exact>::new(&in_the_plane([a, b, c])).side(0, 1, 2)
}

/// Whether all points lie in the plane of three of them, given by their
/// numbers, which must not be collinear. O(n).
pub fn are_coplanar(points: &[DVec3], face: [usize; 3]) -> bool {
    let level = |axis: usize| points.iter().all(|p| p[axis] == points[0][axis]);
    if (0..3).any(level) {
        return true;
    }
    let [a, b, c] = face.map(|i| read(points[i]));
    let (u, v) = (difference(b, &a), difference(c, &a));
    let is_clearly_off = |&p: &DVec3| {
        let w = difference(read(p), &a);
        // What an underflow takes from a product is multiplied once more.
        let largest = [u, v, w].as_flattened().iter().fold(1.0, |m: f64, x| m.max(x.value().abs()));
        clear_sign(determinant3(u, v, w), f64::MIN_POSITIVE * largest).is_some()
    };
    if points.iter().any(is_clearly_off) {
        return false;
    }
    let all = Points::new(points, Eye::Towards(DVec3::Z), None);
    let predicates = Predicates::<Exact>::new(&all);
    let face = face.map(|i| i as u32);
    (0..points.len() as u32).all(|point| predicates.plane(face, point).is_zero())
}

/// `|a - b|^2 - |c - d|^2` of the first four vertices.
struct LengthDifference;

/// The square of a length.
fn square<R: Ring>(from: &[R; 3], to: [R; 3]) -> R {
    let way = difference(to, from);
    dot(way.clone(), way)
}

impl Formula for LengthDifference {
    const PREDICATE: Predicate = Predicate::Order;

    fn degree(&self) -> u32 {
        2
    }

    fn bits(&self, spread: u32) -> u32 {
        // Six squares of differences.
        2 * (spread + 1) + 3
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| points.vertex::<R>(i));
        square(&a, b) - square(&c, d)
    }
}

/// Which of two segments is longer.
pub fn compare_lengths([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> Ordering {
    let value = square(&read(a), read(b)) - square(&read(c), read(d));
    let sign = clear_sign(value, f64::MIN_POSITIVE).unwrap_or_else(|| {
        let points = Points::new(&[a, b, c, d], Eye::Towards(DVec3::Z), None);
        Predicates::<Exact>::new(&points).decide(&LengthDifference)
    });
    sign.to_i32().cmp(&0)
}

/// Where the segment `ab` crosses the line `cd`, from 0 at `a` to 1 at `b`,
/// correct to 2^-52. The ends of `ab` must lie on different sides.
pub fn crossing_parameter([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> f64 {
    let points = in_the_plane([a, b, c, d]);
    let predicates = Predicates::<Exact>::new(&points);
    let cut = Cut::Silhouette([2, 3]);
    let values = [0, 1].map(|end| predicates.value(cut, Point::Vertex(end)));
    predicates.parameter(Carrier::edge(0, 1), cut, &values)
}
