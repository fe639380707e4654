//! `geo` as a second opinion: on areas where it is good enough, and on
//! whether what is returned is valid.

use super::draw::pair;
use geo::{Area, BooleanOps, Validation};
use umriss::polygon::clipping::{FillRule, Operation, PlaneShape};

#[test]
fn areas_are_those_of_geo_up_to_its_grid() {
    for seed in 0..1_000 {
        let [first, second] = pair(seed);
        let valid = |polygons: &[super::draw::Rings]| {
            let shape = PlaneShape::new(polygons, FillRule::EvenOdd).unwrap();
            shape.rounded().unwrap().to_geo()
        };
        let (a, b) = (valid(&first), valid(&second));
        let shapes = [&a, &b].map(|polygons| PlaneShape::from_geo(polygons).unwrap());
        for op in Operation::ALL {
            let theirs = match op {
                Operation::Intersection => a.intersection(&b),
                Operation::Union => a.union(&b),
                Operation::Difference => a.difference(&b),
                Operation::Xor => a.xor(&b),
            };
            let own = PlaneShape::operation(op, &[&shapes[0], &shapes[1]]).unwrap();
            let difference = (theirs.unsigned_area() - own.area().to_f64()).abs();
            assert!(difference < 1e-5, "pair {seed}, {op:?}: off by {difference}");
            let rounded = own.rounded().unwrap().to_geo();
            assert!(rounded.is_valid(), "pair {seed}, {op:?}: {:?}", rounded.check_validation());
        }
    }
}
