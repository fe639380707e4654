//! Random and chosen polygons against winding numbers counted naively.

use super::*;
use crate::kernel::numbers::Fraction;
use glam::{DVec2, dvec2};
use proptest::prelude::*;

type Rings = Vec<Vec<DVec2>>;

/// Rings on a coarse grid, so that vertices and edges coincide and edges
/// run through vertices all the time.
fn rings(size: i32) -> impl Strategy<Value = Vec<Rings>> {
    let corner = (-size..=size, -size..=size).prop_map(|(x, y)| dvec2(x.into(), y.into()));
    let ring = prop::collection::vec(corner, 3..9);
    let polygon = prop::collection::vec(ring, 1..3);
    prop::collection::vec(polygon, 1..3)
}

fn rule() -> impl Strategy<Value = FillRule> {
    prop::sample::select(FillRule::ALL.to_vec())
}

/// How often a ring winds around a point that is on none of its edges.
fn winding(ring: &[[Fraction; 2]], [x, y]: &[Fraction; 2]) -> i32 {
    let mut sum = 0;
    for (i, a) in ring.iter().enumerate() {
        let b = &ring[(i + 1) % ring.len()];
        let (up, down) = (a[1] <= *y && b[1] > *y, b[1] <= *y && a[1] > *y);
        if up || down {
            let left = (b[0].clone() - a[0].clone()) * (y.clone() - a[1].clone())
                - (b[1].clone() - a[1].clone()) * (x.clone() - a[0].clone());
            match left.sign() {
                crate::kernel::numbers::Sign::Positive if up => sum += 1,
                crate::kernel::numbers::Sign::Negative if down => sum -= 1,
                _ => {}
            }
        }
    }
    sum
}

fn exact(point: DVec2) -> [Fraction; 2] {
    [Fraction::of_float(point.x), Fraction::of_float(point.y)]
}

/// Whether a point is inside by the rule, as its definition says.
fn is_inside(polygons: &[Rings], rule: FillRule, point: &[Fraction; 2]) -> bool {
    let of = |ring: &Vec<DVec2>| {
        let ring: Vec<_> = ring.iter().map(|&corner| exact(corner)).collect();
        winding(&ring, point)
    };
    let total: i32 = polygons.iter().flatten().map(of).sum();
    match rule {
        FillRule::EvenOdd => total % 2 != 0,
        FillRule::NonZero => total != 0,
        FillRule::Positive => total > 0,
        FillRule::Negative => total < 0,
        FillRule::Polygons => polygons
            .iter()
            .any(|rings| of(&rings[0]) % 2 != 0 && rings[1..].iter().all(|hole| of(hole) % 2 == 0)),
    }
}

/// The rings of a result with exact coordinates.
fn exact_rings(shape: &PlaneShape) -> Vec<Vec<Vec<[Fraction; 2]>>> {
    let ring = |ring: &Ring| ring.iter().map(|corner| shape.position(corner.point)).collect();
    let polygon = |polygon: &Polygon| polygon.rings.iter().map(ring).collect();
    shape.polygons().iter().map(polygon).collect()
}

/// How often the rings of a result wind around a point: 0 or 1.
fn winding_of_result(rings: &[Vec<Vec<[Fraction; 2]>>], point: &[Fraction; 2]) -> i32 {
    rings.iter().flatten().map(|ring| winding(ring, point)).sum()
}

fn operation(operation: Operation, shapes: &[&PlaneShape]) -> PlaneShape {
    PlaneShape::operation(operation, shapes).unwrap()
}

/// Points on no edge between grid points of small size.
fn probes() -> Vec<[Fraction; 2]> {
    let mut seed = 1_u64;
    let mut draw = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 40) as f64 / 16_777_216.0 * 9.0 - 4.5
    };
    (0..24).map(|_| exact(dvec2(draw(), draw()))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn results_hold_the_points_they_should(
        a in rings(4), b in rings(4), rule_a in rule(), rule_b in rule(),
    ) {
        let shapes = [
            PlaneShape::new(&a, rule_a).unwrap(),
            PlaneShape::new(&b, rule_b).unwrap(),
        ];
        let results: Vec<_> = Operation::ALL
            .iter()
            .map(|&op| (op, exact_rings(&operation(op, &[&shapes[0], &shapes[1]]))))
            .collect();
        for probe in probes() {
            let inside = [is_inside(&a, rule_a, &probe), is_inside(&b, rule_b, &probe)];
            for (op, rings) in &results {
                let expected = i32::from(op.accepts(&inside));
                prop_assert_eq!(winding_of_result(rings, &probe), expected, "{:?}", op);
            }
        }
    }

    #[test]
    fn parts_have_the_area_of_the_whole(
        a in rings(3), b in rings(3), rule_a in rule(), rule_b in rule(),
    ) {
        let a = PlaneShape::new(&a, rule_a).unwrap();
        let b = PlaneShape::new(&b, rule_b).unwrap();
        let [inside, outside] = a.split(&b).unwrap();
        prop_assert_eq!(inside.area() + outside.area(), a.area());
        prop_assert_eq!(
            exact_rings(&inside),
            exact_rings(&operation(Operation::Intersection, &[&b, &a]))
        );
        prop_assert_eq!(
            exact_rings(&outside), exact_rings(&operation(Operation::Difference, &[&a, &b]))
        );
        let both = operation(Operation::Union, &[&a, &b]);
        prop_assert_eq!(outside.area() + b.area(), both.area());
        // Results of results.
        let other = operation(Operation::Difference, &[&b, &a]);
        let xor = operation(Operation::Xor, &[&a, &b]);
        let again = operation(Operation::Union, &[&outside, &other]);
        prop_assert_eq!(exact_rings(&again), exact_rings(&xor));
        let none = operation(Operation::Intersection, &[&xor, &inside]);
        prop_assert!(none.polygons().is_empty());
        let whole = operation(Operation::Union, &[&xor, &inside]);
        prop_assert_eq!(exact_rings(&whole), exact_rings(&both));
    }
}
