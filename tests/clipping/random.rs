//! Ten thousand pairs of polygons with shared corners and edges.

use super::draw::{Draw, pair};
use super::naive::{exact, exact_rings, is_inside, winding_of_result};
use glam::dvec2;
use umriss::polygon::clipping::{FillRule, Operation, PlaneShape};

fn operation(operation: Operation, shapes: &[&PlaneShape]) -> PlaneShape {
    PlaneShape::operation(operation, shapes).unwrap()
}

fn rules(seed: u64) -> [FillRule; 2] {
    [seed, seed / 5].map(|choice| FillRule::ALL[choice as usize % 5])
}

#[test]
fn parts_have_the_area_of_the_whole_on_ten_thousand_pairs() {
    for seed in 0..10_000 {
        let [first, second] = pair(seed);
        let rules = rules(seed);
        let a = PlaneShape::new(&first, rules[0]).unwrap();
        let b = PlaneShape::new(&second, rules[1]).unwrap();
        let [inside, outside] = a.split(&b).unwrap();
        assert_eq!(inside.area() + outside.area(), a.area(), "pair {seed}");
    }
}

#[test]
fn operations_keep_the_laws_of_sets() {
    for seed in 0..2_000 {
        let [first, second] = pair(seed);
        let rules = rules(seed);
        let a = PlaneShape::new(&first, rules[0]).unwrap();
        let b = PlaneShape::new(&second, rules[1]).unwrap();
        let none = PlaneShape::new(&[], FillRule::EvenOdd).unwrap();
        let own = exact_rings(&a.normalized(false).unwrap());
        for op in [Operation::Intersection, Operation::Union] {
            assert_eq!(exact_rings(&operation(op, &[&a, &a])), own, "pair {seed}, {op:?}");
        }
        for op in [Operation::Difference, Operation::Xor] {
            assert!(operation(op, &[&a, &a]).polygons().is_empty(), "pair {seed}, {op:?}");
            assert_eq!(exact_rings(&operation(op, &[&a, &none])), own, "pair {seed}, {op:?}");
        }
        assert!(operation(Operation::Intersection, &[&a, &none]).polygons().is_empty());
        for op in [Operation::Intersection, Operation::Union, Operation::Xor] {
            let [there, back] = [[&a, &b], [&b, &a]].map(|pair| exact_rings(&operation(op, &pair)));
            assert_eq!(there, back, "pair {seed}, {op:?}");
        }
        let [inside, outside] = a.split(&b).unwrap();
        let again = operation(Operation::Union, &[&inside, &outside]);
        assert_eq!(exact_rings(&again), own, "pair {seed}: parts put together");
        let three = operation(Operation::Xor, &[&a, &b, &a]);
        assert_eq!(exact_rings(&three), exact_rings(&b.normalized(false).unwrap()), "pair {seed}");
    }
}

#[test]
fn results_hold_the_points_they_should() {
    for seed in 0..1_000 {
        let [first, second] = pair(seed);
        let rules = rules(seed);
        let a = PlaneShape::new(&first, rules[0]).unwrap();
        let b = PlaneShape::new(&second, rules[1]).unwrap();
        let mut draw = Draw::new(seed ^ 0xabcd);
        let results = Operation::ALL.map(|op| (op, exact_rings(&operation(op, &[&a, &b]))));
        for _ in 0..12 {
            let probe = exact(dvec2(draw.float() * 10.0 - 5.0, draw.float() * 10.0 - 5.0));
            let inside =
                [is_inside(&first, rules[0], &probe), is_inside(&second, rules[1], &probe)];
            for (op, rings) in &results {
                let expected = i32::from(op.accepts(&inside));
                assert_eq!(winding_of_result(rings, &probe), expected, "pair {seed}, {op:?}");
            }
        }
    }
}

#[test]
fn the_order_of_rings_and_their_turn_do_not_matter() {
    for seed in 0..1_000 {
        let [first, second] = pair(seed);
        let turned = |polygons: &[super::draw::Rings]| -> Vec<super::draw::Rings> {
            let mut polygons = polygons.to_vec();
            polygons.reverse();
            for ring in polygons.iter_mut().flatten() {
                ring.reverse();
                ring.rotate_left(seed as usize % 3);
            }
            polygons
        };
        let shape =
            |polygons: &[super::draw::Rings]| PlaneShape::new(polygons, FillRule::EvenOdd).unwrap();
        for op in Operation::ALL {
            let one = operation(op, &[&shape(&first), &shape(&second)]);
            let other = operation(op, &[&shape(&turned(&first)), &shape(&turned(&second))]);
            assert_eq!(exact_rings(&one), exact_rings(&other), "pair {seed}, {op:?}");
        }
    }
}
