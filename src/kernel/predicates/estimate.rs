//! Floats that stand for exact values, for those who evaluate one
//! functional at many points and want to ask for its sign only where the
//! float does not tell it.
//!
//! The value comes from the same formula as the sign, and the bound from
//! the one rounding analysis there is, that of [`Filtered`].

use super::formula::{Orientation, Side};
use super::ray::InFront;
use super::{Formula, Piercing, Policy, Predicates};
use crate::kernel::numbers::Filtered;

/// A float and how far from it the true value may be, in units that
/// depend on the scene: only ratios and signs mean something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The float.
    pub value: f64,
    /// The greatest distance of the truth; infinite where floats cannot
    /// hold the formula.
    pub bound: f64,
}

impl<P: Policy> Predicates<'_, P> {
    fn estimate<F: Formula>(&self, formula: &F) -> Estimate {
        let points = self.points();
        let more = match points.is_narrow() {
            true => points.floats_hold(formula.bits(points.spread())).then_some(0.0),
            false => points.underflow(formula),
        };
        let Some(more) = more else {
            return Estimate { value: 0.0, bound: f64::INFINITY };
        };
        let value = formula.evaluate::<Filtered>(points);
        Estimate { value: value.value(), bound: value.bound() + more }
    }

    /// The value whose sign is [`Self::side`].
    pub fn side_estimate(&self, p: u32, q: u32, r: u32) -> Estimate {
        self.estimate(&Side(p, q, r))
    }

    /// The value whose sign is [`Self::plane`].
    pub fn plane_estimate(&self, face: [u32; 3], x: u32) -> Estimate {
        self.estimate(&Orientation(face, x))
    }

    /// How far along its edge a piercing lies, from 0 to 1; nothing where
    /// floats cannot tell.
    pub fn share_estimate(&self, piercing: Piercing) -> Option<Estimate> {
        let [a, b] = piercing.edge.map(|end| self.plane_estimate(piercing.face, end));
        let (x, y) = (a.value.abs(), b.value.abs());
        // The values have different signs, so the share is x / (x + y).
        let least = x + y - (a.bound + b.bound);
        let off = (a.bound * (y + b.bound) + b.bound * (x + a.bound)) / (least * least);
        let bound = 1.001 * off + 4.0 * f64::EPSILON;
        (least > 0.0 && bound < 1.0).then(|| Estimate { value: x / (x + y), bound })
    }

    /// The value that is positive, once multiplied with the triangle's
    /// facing, where [`Self::meets_in_front`] holds.
    pub fn in_front_estimate(&self, through: u32, triangle: [u32; 3]) -> Estimate {
        self.estimate(&InFront { triangle, through })
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Exact, Eye, NearPlane, Points};
    use super::*;
    use crate::kernel::numbers::Sign;
    use glam::DVec3;

    #[test]
    fn an_estimate_beyond_its_bound_has_the_sign_of_the_predicate() {
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(11);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let vertices: Vec<_> = (0..40).map(|_| DVec3::new(random(), random(), random())).collect();
        let eye = DVec3::new(0.5, -1.0, 0.5);
        let near = NearPlane { forward: DVec3::Y, distance: 1.3 };
        let points = Points::new(&vertices, Eye::At(eye), Some(near));
        let predicates = Predicates::<Exact>::new(&points);
        let mut told = 0;
        for x in 3..40 {
            let face = [x - 3, x - 2, x - 1];
            let facing = predicates.facing(face);
            let in_front = predicates.in_front_estimate(x, face);
            let pairs = [
                (predicates.side_estimate(x - 2, x - 1, x), predicates.side(x - 2, x - 1, x)),
                (predicates.plane_estimate(face, x), predicates.plane(face, x)),
            ];
            for (estimate, sign) in pairs {
                assert!(estimate.bound < 1e-9 * estimate.value.abs());
                assert_eq!(Sign::of(estimate.value), sign);
                told += 1;
            }
            let front = Sign::of(in_front.value) * facing == Sign::Positive;
            assert_eq!(front, predicates.meets_in_front(x, face, facing));
        }
        assert_eq!(told, 74);
    }

    #[test]
    fn where_floats_cannot_hold_the_value_the_bound_is_infinite() {
        let vertices = [1e-300, 1.0, 1e300, 2.0].map(|x| DVec3::new(x, x * x.min(1.0), 1.0));
        let points = Points::new(&vertices, Eye::Towards(DVec3::Y), None);
        let predicates = Predicates::<Exact>::new(&points);
        assert_eq!(predicates.side_estimate(0, 1, 2).bound, f64::INFINITY);
    }
}
