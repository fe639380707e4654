//! Columns of the image: planes through the eye and the vertical, z.
//!
//! A column is what a surface over the ground is cut into by an eye that
//! does not look straight down. Which of two vertices has its column further
//! to the left is the sign of `[E, p, k, q]` with the direction k = (0, 0, 1)
//! at infinity, and does not depend on heights:
//!
//! ```text
//!   column(p, q) = (E - q) x (p - q)   on the ground; E itself, if a direction
//! ```
//!
//! From a point that is a comparison of angles, and orders only vertices in
//! one half-plane of the ground whose border goes through the eye's foot.

use super::{Formula, Points, Policy, Predicate, Predicates};
use crate::kernel::numbers::{Ring, Sign};

struct Column(u32, u32);

impl Formula for Column {
    const PREDICATE: Predicate = Predicate::Column;

    #[inline(always)]
    fn degree(&self) -> u32 {
        2
    }

    #[inline(always)]
    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let [px, py, _] = points.vertex::<R>(self.0);
        let [qx, qy, _] = points.vertex::<R>(self.1);
        let [ex, ey, _] = points.eye::<R>();
        let (dx, dy) = (px - qx.clone(), py - qy.clone());
        if points.is_perspective() { (ex - qx) * dy - (ey - qy) * dx } else { ex * dy - ey * dx }
    }
}

impl<P: Policy> Predicates<'_, P> {
    /// On which side of the column of vertex `p` does vertex `q` lie?
    /// Positive is left. The sign of `Cut::Vertex(p, 2)` at `q`, at degree 2.
    #[inline]
    pub fn column(&self, p: u32, q: u32) -> Sign {
        if p == q { Sign::Zero } else { self.decide(&Column(p, q)) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Cut, Eye, Point, Thorough};
    use super::*;
    use glam::{DVec3, dvec3};

    #[test]
    fn is_the_side_of_the_vertical_line_through_a_vertex() {
        let mut vertices = Vec::new();
        for i in 0..24 {
            let at = |step: i32| f64::from((i * step) % 7);
            vertices.push(dvec3(at(3), at(5), at(2)) * 0.1);
        }
        for eye in [
            Eye::Towards(dvec3(0.0, -1.0, 0.5)),
            Eye::Towards(dvec3(-0.3, 0.7, -2.0)),
            Eye::At(dvec3(0.2, -1.0, 0.4)),
        ] {
            let points = Points::new(&vertices, eye, None);
            let predicates = Predicates::<Thorough>::new(&points);
            for p in 0..24 {
                for q in 0..24 {
                    let cut = predicates.value_sign(Cut::Vertex(p, 2), Point::Vertex(q));
                    assert_eq!(predicates.column(p, q), cut, "{p} {q} {eye:?}");
                }
            }
            assert_eq!(predicates.counters().get("ladder-disagreements"), 0);
        }
    }

    #[test]
    fn left_is_left_in_the_front_view_at_any_height() {
        let vertices = [DVec3::ZERO, dvec3(1.0, 5.0, -70.0), dvec3(0.0, 9.0, 3.0)];
        let points = Points::new(&vertices, Eye::Towards(dvec3(0.0, -1.0, 1.0)), None);
        let predicates = Predicates::<Thorough>::new(&points);
        assert_eq!(predicates.column(1, 0), Sign::Positive);
        assert_eq!(predicates.column(0, 1), Sign::Negative);
        assert_eq!(predicates.column(0, 2), Sign::Zero);
    }
}
