//! Results in doubles: always valid, and where they should be.

use super::draw::{Draw, pair, ring};
use super::validity::fault;
use glam::{DVec2, dvec2};
use umriss::kernel::numbers::Fraction;
use umriss::polygon::clipping::{FillRule, Operation, PlaneShape, Rounded};

/// The area of what is in one of two shapes, in floats.
fn difference(exact: &PlaneShape, rounded: &Rounded) -> f64 {
    let rounded = PlaneShape::new(&rounded.polygons, FillRule::Positive).unwrap();
    let wrong = PlaneShape::operation(Operation::Xor, &[exact, &rounded]).unwrap();
    wrong.areas().iter().map(|area| area.to_f64()).sum()
}

/// The length of all borders, nearly.
pub(crate) fn perimeter(exact: &PlaneShape) -> f64 {
    let length = |ring: Vec<[Fraction; 2]>| {
        let ring: Vec<_> = ring.iter().map(|[x, y]| dvec2(x.to_f64(), y.to_f64())).collect();
        (0..ring.len()).map(|i| ring[i].distance(ring[(i + 1) % ring.len()])).sum::<f64>()
    };
    exact.positions().into_iter().flatten().map(length).sum()
}

#[test]
fn rounded_results_are_valid_and_near() {
    for seed in 0..3_000 {
        let [first, second] = pair(seed);
        let a = PlaneShape::new(&first, FillRule::ALL[seed as usize % 5]).unwrap();
        let b = PlaneShape::new(&second, FillRule::EvenOdd).unwrap();
        let op = Operation::ALL[seed as usize % 4];
        let exact = PlaneShape::operation(op, &[&a, &b]).unwrap();
        let rounded = exact.rounded().unwrap();
        assert_eq!(fault(&rounded), None, "pair {seed}");
        let bound = 4.0 * perimeter(&exact) * f64::EPSILON / 2.0 * 8.0;
        assert!(difference(&exact, &rounded) <= bound, "pair {seed}");
    }
}

/// Needles that cross at tiny angles, far from the origin and on top of one
/// another: rounding moves crossings across edges.
#[test]
fn bundles_of_needles_stay_valid() {
    let mut repeated = 0;
    for seed in 0..300 {
        let mut draw = Draw::new(seed);
        let far = [0.0, 1.0, 1e6, 1e12][draw.below(4)];
        let width = [1e-15, 1e-14, 1e-9][draw.below(3)] * f64::max(far, 1.0);
        let mut needle = || {
            let mut end = |x: f64| dvec2(x + far, far / 3.0 + width * (draw.float() * 4.0 - 2.0));
            vec![vec![end(0.0), end(1.0), end(1.1), end(-0.1)]]
        };
        let needles: Vec<_> = (0..12).map(|_| needle()).collect();
        let shape = PlaneShape::new(&needles, FillRule::EvenOdd).unwrap();
        let rounded = shape.rounded().unwrap();
        repeated += u32::from(rounded.rounds > 1);
        assert_eq!(fault(&rounded), None, "bundle {seed}");
    }
    assert!(repeated > 10, "only {repeated} bundles were rounded twice");
}

#[test]
fn input_that_is_valid_comes_back_bit_by_bit() {
    for seed in 0..100 {
        let mut draw = Draw::new(seed);
        let triangle = ring(&mut draw, 3, None);
        let shape = PlaneShape::new(&[vec![triangle.clone()]], FillRule::NonZero).unwrap();
        let rounded = shape.rounded().unwrap();
        assert_eq!(rounded.rounds, 0);
        let mut corners = rounded.polygons[0][0].clone();
        let key = |corner: &DVec2| (corner.x.to_bits(), corner.y.to_bits());
        let mut expected = triangle;
        corners.sort_by_key(key);
        expected.sort_by_key(key);
        assert_eq!(corners, expected);
    }
}

#[test]
fn extreme_coordinates_are_clipped_like_others() {
    for scale in [1e-300, 1e-160, 1.0, 1e150, 1e300] {
        let square = |low: f64, high: f64| {
            let ring = vec![dvec2(low, low), dvec2(high, low), dvec2(high, high), dvec2(low, high)];
            let ring = ring.into_iter().map(|corner| corner * scale).collect();
            PlaneShape::new(&[vec![ring]], FillRule::EvenOdd).unwrap()
        };
        let both =
            PlaneShape::operation(Operation::Intersection, &[&square(0.0, 2.0), &square(0.7, 3.0)]);
        let rounded = both.unwrap().rounded().unwrap();
        assert_eq!(fault(&rounded), None);
        let corners = &rounded.polygons[0][0];
        assert_eq!(corners[0], dvec2(0.7, 0.7) * scale);
        assert_eq!(corners[2], dvec2(2.0, 2.0) * scale);
    }
    // 1e-300 beside 1e300.
    let triangle = vec![dvec2(-1e300, 0.0), dvec2(1e300, -1e-300), dvec2(0.0, 1e300)];
    let strip = vec![dvec2(-1e-300, -1.0), dvec2(1e-300, -1.0), dvec2(1e-300, 1.0)];
    let [a, b] =
        [triangle, strip].map(|ring| PlaneShape::new(&[vec![ring]], FillRule::NonZero).unwrap());
    let [inside, outside] = b.split(&a).unwrap();
    assert_eq!(inside.area() + outside.area(), b.area());
    assert!(inside.rounded().is_ok() && outside.rounded().is_ok());
}
