//! `geo` as a second opinion: on areas, where it is good enough.

use super::draw::pair;
use super::validity::fault;
use geo::{Area, BooleanOps, MultiPolygon};
use umriss::polygon::clipping::{FillRule, Operation, PlaneShape};

#[test]
fn areas_are_those_of_geo_up_to_its_grid() {
    let mut contradictions = 0;
    for seed in 0..200 {
        let [first, second] = pair(seed);
        let valid = |polygons: &[super::draw::Rings]| {
            let shape = PlaneShape::new(polygons, FillRule::EvenOdd).unwrap();
            shape.rounded().unwrap().to_geo()
        };
        let (a, b) = (valid(&first), valid(&second));
        let shapes = [&a, &b].map(|polygons| PlaneShape::from_geo(polygons).unwrap());
        let whole = [shapes[0].area(), shapes[1].area()];
        let own =
            Operation::ALL.map(|op| PlaneShape::operation(op, &[&shapes[0], &shapes[1]]).unwrap());
        let [intersection, union, difference, xor] = own.each_ref().map(PlaneShape::area);
        assert_eq!(
            whole[0].clone() + whole[1].clone(),
            intersection.clone() + union.clone(),
            "pair {seed}"
        );
        assert_eq!(whole[0], intersection.clone() + difference, "pair {seed}");
        assert_eq!(union, intersection + xor, "pair {seed}");
        for (op, own) in Operation::ALL.iter().zip(&own) {
            // The check is exact and our own: `geo` takes gaps of one unit in
            // the last place for contacts, and on some of them panics.
            assert_eq!(fault(&own.rounded().unwrap()), None, "pair {seed}, {op:?}");
        }
        // `geo` sometimes loses a whole part. Then its own areas contradict
        // each other, which tells who is wrong.
        let theirs = Operation::ALL.map(|op| area_by_geo(op, &a, &b));
        let off = |(own, theirs): (&PlaneShape, &f64)| (own.area().to_f64() - theirs).abs() > 1e-5;
        if own.iter().zip(&theirs).any(off) {
            assert!(
                contradicts_itself(whole.map(|area| area.to_f64()), theirs),
                "pair {seed}: {theirs:?}"
            );
            contradictions += 1;
        }
    }
    assert!(contradictions <= 4, "{contradictions}");
}

fn area_by_geo(op: Operation, a: &MultiPolygon, b: &MultiPolygon) -> f64 {
    let result = match op {
        Operation::Intersection => a.intersection(b),
        Operation::Union => a.union(b),
        Operation::Difference => a.difference(b),
        Operation::Xor => a.xor(b),
    };
    result.unsigned_area()
}

/// Whether four areas (in the order of `Operation::ALL`) cannot all be right,
/// given those of the two operands.
fn contradicts_itself(whole: [f64; 2], areas: [f64; 4]) -> bool {
    let [intersection, union, difference, xor] = areas;
    let gaps = [
        whole[0] + whole[1] - intersection - union,
        whole[0] - intersection - difference,
        union - intersection - xor,
    ];
    gaps.iter().any(|gap| gap.abs() > 1e-5)
}
