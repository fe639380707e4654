//! `geo` as a second opinion: on areas where it is good enough, and on
//! whether what is returned is valid.

use super::draw::pair;
use super::validity::fault;
use geo::{Area, BooleanOps, Validation};
use umriss::polygon::clipping::{FillRule, Operation, PlaneShape};

#[test]
fn areas_are_those_of_geo_up_to_its_grid() {
    let (mut valid_for_geo, mut asked) = (0, 0);
    for seed in 0..200 {
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
            // `geo` takes gaps of one unit in the last place for contacts, so
            // that its check can only be asked where there are none.
            let rounded = own.rounded().unwrap();
            assert_eq!(fault(&rounded), None, "pair {seed}, {op:?}");
            valid_for_geo += u32::from(rounded.to_geo().is_valid());
            asked += 1;
        }
    }
    assert!(valid_for_geo * 100 >= asked * 98, "{valid_for_geo} of {asked}");
}
