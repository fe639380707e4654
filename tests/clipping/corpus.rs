//! Small cases, each named by what is hard about it, with answers that can
//! be worked out by hand.

use glam::dvec2;
use umriss::polygon::clipping::{FillRule, Operation, PlaneShape};

type Ring = &'static [(f64, f64)];

/// A case: for intersection, union, difference and xor the area, the number
/// of polygons and that of their holes.
struct Case {
    name: &'static str,
    rule: FillRule,
    operands: [&'static [Ring]; 2],
    expected: [(f64, usize, usize); 4],
}

const UNIT: Ring = &[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];

const fn case(
    name: &'static str,
    rule: FillRule,
    operands: [&'static [Ring]; 2],
    expected: [(f64, usize, usize); 4],
) -> Case {
    Case { name, rule, operands, expected }
}

const NONE: (f64, usize, usize) = (0.0, 0, 0);
const ULP: f64 = f64::EPSILON;

#[rustfmt::skip]
const CASES: &[Case] = &[
    case("squares that overlap in a corner", FillRule::EvenOdd,
        [&[UNIT], &[&[(1.0, 1.0), (3.0, 1.0), (3.0, 3.0), (1.0, 3.0)]]],
        [(1.0, 1, 0), (7.0, 1, 0), (3.0, 1, 0), (6.0, 2, 0)]),
    case("squares that touch in a corner", FillRule::EvenOdd,
        [&[UNIT], &[&[(2.0, 2.0), (3.0, 2.0), (3.0, 3.0), (2.0, 3.0)]]],
        [NONE, (5.0, 2, 0), (4.0, 1, 0), (5.0, 2, 0)]),
    case("squares with half an edge in common", FillRule::NonZero,
        [&[UNIT], &[&[(2.0, 1.0), (4.0, 1.0), (4.0, 3.0), (2.0, 3.0)]]],
        [NONE, (8.0, 1, 0), (4.0, 1, 0), (8.0, 1, 0)]),
    case("the same square, turning the other way", FillRule::NonZero,
        [&[UNIT], &[&[(0.0, 0.0), (0.0, 2.0), (2.0, 2.0), (2.0, 0.0)]]],
        [(4.0, 1, 0), (4.0, 1, 0), NONE, NONE]),
    case("a corner on an edge", FillRule::EvenOdd,
        [&[UNIT], &[&[(2.0, 1.0), (4.0, 0.0), (4.0, 2.0)]]],
        [NONE, (6.0, 2, 0), (4.0, 1, 0), (6.0, 2, 0)]),
    case("a square around another is a frame", FillRule::EvenOdd,
        [&[&[(-1.0, -1.0), (3.0, -1.0), (3.0, 3.0), (-1.0, 3.0)]], &[UNIT]],
        [(4.0, 1, 0), (16.0, 1, 0), (12.0, 1, 1), (12.0, 1, 1)]),
    case("a hole that touches its outline in a corner", FillRule::EvenOdd,
        [&[UNIT], &[&[(0.0, 0.0), (1.0, 0.5), (0.5, 1.0)]]],
        [(0.375, 1, 0), (4.0, 1, 0), (3.625, 1, 1), (3.625, 1, 1)]),
    case("a diamond cuts off four corners", FillRule::EvenOdd,
        [&[UNIT], &[&[(1.0, 0.0), (2.0, 1.0), (1.0, 2.0), (0.0, 1.0)]]],
        [(2.0, 1, 0), (4.0, 1, 0), (2.0, 4, 0), (2.0, 4, 0)]),
    case("two holes that meet in a corner", FillRule::EvenOdd,
        [&[&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]],
         &[&[(1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)],
           &[(2.0, 2.0), (3.0, 2.0), (3.0, 3.0), (2.0, 3.0)]]],
        [(2.0, 2, 0), (16.0, 1, 0), (14.0, 1, 2), (14.0, 1, 2)]),
    case("four squares in a ring close in a hole of no polygon", FillRule::EvenOdd,
        [&[&[(1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0)],
           &[(1.0, 2.0), (2.0, 2.0), (2.0, 3.0), (1.0, 3.0)]],
         &[&[(0.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)],
           &[(2.0, 1.0), (3.0, 1.0), (3.0, 2.0), (2.0, 2.0)]]],
        [NONE, (4.0, 4, 0), (2.0, 2, 0), (4.0, 4, 0)]),
    case("a bow tie", FillRule::EvenOdd,
        [&[&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)]], &[UNIT]],
        [(2.0, 2, 0), (4.0, 1, 0), NONE, (2.0, 2, 0)]),
    case("a bow tie, one half of which turns clockwise", FillRule::Positive,
        [&[&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)]], &[UNIT]],
        [(1.0, 1, 0), (4.0, 1, 0), NONE, (3.0, 1, 0)]),
    case("a ring run through twice", FillRule::EvenOdd,
        [&[&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0),
             (0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]], &[UNIT]],
        [NONE, (4.0, 1, 0), NONE, (4.0, 1, 0)]),
    case("a ring run through twice, by winding", FillRule::NonZero,
        [&[&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0),
             (0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]], &[UNIT]],
        [(4.0, 1, 0), (4.0, 1, 0), NONE, NONE]),
    case("a clockwise square, by the negative rule", FillRule::Negative,
        [&[&[(0.0, 0.0), (0.0, 2.0), (2.0, 2.0), (2.0, 0.0)]], &[UNIT]],
        [NONE, (4.0, 1, 0), (4.0, 1, 0), (4.0, 1, 0)]),
    case("a spike there and back encloses nothing", FillRule::EvenOdd,
        [&[&[(0.0, 0.0), (2.0, 0.0), (5.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]], &[UNIT]],
        [(4.0, 1, 0), (4.0, 1, 0), NONE, NONE]),
    case("rings without area", FillRule::NonZero,
        [&[&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)], &[(1.0, 1.0)], &[(0.0, 0.0), (2.0, 1.0)], &[]],
         &[UNIT]],
        [NONE, (4.0, 1, 0), NONE, (4.0, 1, 0)]),
    case("an edge one unit in the last place beside another", FillRule::EvenOdd,
        [&[&[(0.0, 0.0), (1.0 + ULP, 0.0), (1.0 + ULP, 1.0), (0.0, 1.0)]],
         &[&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]]],
        [(1.0, 1, 0), (1.0 + ULP, 1, 0), (ULP, 1, 0), (ULP, 1, 0)]),
    case("polygons that overlap, by their own rule", FillRule::Polygons,
        [&[UNIT, &[(0.5, 0.5), (1.0, 0.5), (1.0, 1.0), (0.5, 1.0)]],
         &[&[(1.0, 0.0), (3.0, 0.0), (3.0, 2.0), (1.0, 2.0)]]],
        [(2.0, 1, 0), (5.75, 1, 1), (1.75, 1, 0), (3.75, 2, 0)]),
    case("a hole with an island in it", FillRule::EvenOdd,
        [&[&[(0.0, 0.0), (6.0, 0.0), (6.0, 6.0), (0.0, 6.0)],
           &[(1.0, 1.0), (5.0, 1.0), (5.0, 5.0), (1.0, 5.0)],
           &[(2.0, 2.0), (4.0, 2.0), (4.0, 4.0), (2.0, 4.0)]],
         &[&[(3.0, -1.0), (7.0, -1.0), (7.0, 7.0), (3.0, 7.0)]]],
        [(12.0, 2, 0), (44.0, 1, 1), (12.0, 2, 0), (32.0, 4, 0)]),
    case("collinear edges that overlap in parts", FillRule::NonZero,
        [&[&[(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (0.0, 1.0)]],
         &[&[(1.0, 1.0), (1.0, 0.0), (2.0, 0.0), (2.0, 1.0)]]],
        [(1.0, 1, 0), (3.0, 1, 0), (2.0, 2, 0), (2.0, 2, 0)]),
    case("many edges through one point", FillRule::EvenOdd,
        [&[&[(-2.0, -2.0), (2.0, 2.0), (2.0, -2.0), (-2.0, 2.0)]],
         &[&[(-2.0, -2.0), (2.0, 2.0), (-2.0, 2.0), (2.0, -2.0)]]],
        [NONE, (16.0, 1, 0), (8.0, 2, 0), (16.0, 1, 0)]),
];

#[test]
fn chosen_cases_have_the_answers_worked_out_by_hand() {
    for case in CASES {
        let shapes = case.operands.map(|rings| {
            let points = |ring: &Ring| ring.iter().map(|&(x, y)| dvec2(x, y)).collect::<Vec<_>>();
            PlaneShape::new(&[rings.iter().map(points).collect()], case.rule).unwrap()
        });
        for (op, expected) in Operation::ALL.into_iter().zip(case.expected) {
            let result = PlaneShape::operation(op, &[&shapes[0], &shapes[1]]).unwrap();
            let holes = result.polygons().iter().map(|polygon| polygon.holes().len()).sum();
            let found = (result.area().to_f64(), result.polygons().len(), holes);
            assert_eq!(found, expected, "{}: {op:?}", case.name);
        }
    }
}

#[test]
fn corners_on_straight_borders_are_kept_if_asked_for() {
    let ring = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
    let ring = ring.iter().map(|&(x, y)| dvec2(x, y)).collect();
    let shape = PlaneShape::new(&[vec![ring]], FillRule::EvenOdd).unwrap();
    let corners = |keep| shape.normalized(keep).unwrap().polygons()[0].outline().len();
    assert_eq!([corners(false), corners(true)], [4, 5]);
}

#[test]
fn coordinates_that_are_no_numbers_are_refused() {
    for bad in [f64::NAN, f64::INFINITY] {
        let ring = vec![dvec2(0.0, 0.0), dvec2(1.0, bad), dvec2(1.0, 1.0)];
        let error = PlaneShape::new(&[vec![], vec![vec![], ring]], FillRule::EvenOdd).unwrap_err();
        let expected = "ring 1 of polygon 1 has a coordinate that is not finite";
        assert_eq!(error.to_string(), expected);
    }
}
