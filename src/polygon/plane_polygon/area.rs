//! Areas, exactly: that pieces are all of what was cut can be proved.

use super::PlanePolygon;
use crate::kernel::numbers::Fraction;
use crate::kernel::predicates::{Policy, Predicates};

impl PlanePolygon {
    /// Twice the area vector: the sum of the cross products of corners that
    /// follow one another. In units of the square of two to the power of
    /// [`Predicates::ratio_exponent`]. For checks: rationals grow large.
    pub fn doubled_area<P: Policy>(&self, predicates: &Predicates<'_, P>) -> [Fraction; 3] {
        let place = |i: usize| {
            let (parts, weight) = predicates.position_ratio(self.corners[i].point);
            // The weight is positive, so there is a quotient.
            parts.map(|part| Fraction::new(part, weight.clone()).unwrap_or_else(Fraction::zero))
        };
        let places: Vec<[Fraction; 3]> = (0..self.corners.len()).map(place).collect();
        let next = places.iter().cycle().skip(1);
        places.iter().zip(next).fold(std::array::from_fn(|_| Fraction::zero()), |sum, (a, b)| {
            let minor =
                |i: usize, j: usize| a[i].clone() * b[j].clone() - a[j].clone() * b[i].clone();
            let [x, y, z] = sum;
            [x + minor(1, 2), y + minor(2, 0), z + minor(0, 1)]
        })
    }
}
