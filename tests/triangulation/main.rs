//! Triangulations against areas in integers, Euler's count and the
//! orientation test of another crate.

#![allow(clippy::unwrap_used)]

mod mosaic;
#[path = "../support/split_mix.rs"]
mod split_mix;
mod weakly_simple;

use glam::{DVec3, dvec3};
use proptest::prelude::*;
use std::collections::BTreeSet;
use umriss::polygon::{TriangulationError, rings_of, triangulate};

type Corner = [i64; 2];

/// Twice the signed area.
fn doubled_area(ring: &[Corner]) -> i128 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| wide(a[0]) * wide(b[1]) - wide(b[0]) * wide(a[1])).sum()
}

fn wide(value: i64) -> i128 {
    i128::from(value)
}

/// How the plane of a polygon lies in space.
#[derive(Debug, Clone, Copy)]
struct Lift {
    /// The coordinate that the plane's own x becomes; the others follow.
    axis: usize,
    slope: [i64; 2],
}

const FLAT: Lift = Lift { axis: 0, slope: [0, 0] };

fn lift(ring: &[Corner], Lift { axis, slope }: Lift) -> Vec<DVec3> {
    ring.iter()
        .map(|&[x, y]| {
            let mut corner = [0.0; 3];
            corner[axis] = x as f64;
            corner[(axis + 1) % 3] = y as f64;
            corner[(axis + 2) % 3] = (slope[0] * x + slope[1] * y) as f64;
            DVec3::from(corner)
        })
        .collect()
}

/// Triangulates and checks areas, orientation, counts and T-junctions.
/// `cuts` is how many triangles more than n - 2 + 2h there are.
fn check(rings: &[Vec<Corner>], lifted: Lift, touching: usize) {
    let in_space: Vec<_> = rings.iter().map(|ring| lift(ring, lifted)).collect();
    let result = triangulate(&in_space).expect("a polygon");
    let all: Vec<Corner> = rings.iter().flatten().copied().collect();
    assert!(result.is_planar);

    let turn = doubled_area(&rings[0]).signum();
    let mut area = 0;
    let mut used = BTreeSet::new();
    let mut edges = BTreeSet::new();
    for triangle in &result.corners {
        let corners = triangle.map(|corner| all[corner as usize]);
        area += doubled_area(&corners);
        let [a, b, c] = corners.map(|[x, y]| robust::Coord { x: x as f64, y: y as f64 });
        assert_eq!(robust::orient2d(a, b, c).signum() as i128, turn, "{corners:?}");
        used.extend(corners);
        for i in 0..3 {
            let edge = [corners[i], corners[(i + 1) % 3]];
            assert!(edges.insert(edge), "{edge:?} bounds two triangles on one side");
        }
    }
    let holes: i128 = rings[1..].iter().map(|ring| doubled_area(ring).abs()).sum();
    assert_eq!(area, turn * (doubled_area(&rings[0]).abs() - holes));
    assert_eq!(result.corners.len(), all.len() + 2 * (rings.len() - 1) - 2 - touching);
    assert_eq!(used, all.iter().copied().collect());

    // Every edge of a ring bounds a triangle, whole: no T-junctions.
    for ring in rings {
        for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            assert!(edges.contains(&[*a, *b]) || edges.contains(&[*b, *a]), "{a:?} {b:?}");
        }
    }
}

/// A ring around a centre with the given radii, at equal angles.
fn gear(centre: Corner, radii: &[i64], clockwise: bool) -> Vec<Corner> {
    let step = std::f64::consts::TAU / radii.len() as f64;
    let mut ring: Vec<Corner> = radii
        .iter()
        .enumerate()
        .map(|(i, &radius)| {
            let (sine, cosine) = (step * i as f64).sin_cos();
            let length = radius as f64;
            [
                centre[0] + (length * cosine).round() as i64,
                centre[1] + (length * sine).round() as i64,
            ]
        })
        .collect();
    if clockwise {
        ring.reverse();
    }
    ring
}

/// Puts `count` more corners on every edge whose vector divides so.
fn with_collinear(ring: &[Corner], count: i64) -> Vec<Corner> {
    let mut finer = Vec::new();
    for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
        for i in 0..=count {
            finer.push([0, 1].map(|k| a[k] * (count + 1) + (b[k] - a[k]) * i));
        }
    }
    finer
}

prop_compose! {
    fn plane()(axis in 0..3_usize, slope in prop::array::uniform2(-3..=3_i64)) -> Lift {
        Lift { axis, slope }
    }
}

proptest! {
    #[test]
    fn gears_with_holes_are_covered_exactly_once(
        radii in prop::collection::vec(600_000..2_000_000_i64, 3..60),
        holes in prop::collection::vec(
            (prop::collection::vec(5_000..40_000_i64, 3..9), any::<bool>()), 0..9),
        clockwise: bool,
        lifted in plane(),
    ) {
        prop_assume!(radii.len() > 6 || holes.is_empty());
        let mut rings = vec![gear([0, 0], &radii, clockwise)];
        for (i, (radii, clockwise)) in holes.iter().enumerate() {
            let centre = [i as i64 % 3 - 1, i as i64 / 3 - 1].map(|k| k * 100_000);
            rings.push(gear(centre, radii, *clockwise));
        }
        check(&rings, lifted, 0);
    }

    #[test]
    fn corners_on_edges_become_corners_of_triangles(
        radii in prop::collection::vec(1_000..2_000_i64, 3..20),
        count in 1..4_i64,
        lifted in plane(),
    ) {
        check(&[with_collinear(&gear([7, -9], &radii, false), count)], lifted, 0);
    }

    #[test]
    fn arbitrary_corners_on_a_small_grid_do_not_panic(
        rings in prop::collection::vec(
            prop::collection::vec(prop::array::uniform3(-2..=2_i8), 0..9), 0..4),
        exponent in prop::sample::select(vec![-1074, -400, -30, 0, 30, 400, 1021]),
    ) {
        let scale = |k: i8| f64::from(k) * f64::powi(2.0, exponent / 2)
            * f64::powi(2.0, exponent - exponent / 2);
        let rings: Vec<Vec<DVec3>> = rings
            .iter()
            .map(|ring| ring.iter().map(|corner| DVec3::from(corner.map(scale))).collect())
            .collect();
        let corners: usize = rings.iter().map(Vec::len).sum();
        if let Ok(result) = triangulate(&rings) {
            prop_assert!(!result.corners.is_empty());
            prop_assert!(result.corners.iter().flatten().all(|&k| (k as usize) < corners));
        }
    }
}

#[test]
fn hole_touches_the_outer_ring_in_a_corner_of_both() {
    let outer = vec![[0, 0], [10, 0], [10, 10], [0, 10]];
    check(&[outer, vec![[0, 0], [3, 6], [6, 3]]], FLAT, 2);
}

#[test]
fn two_holes_touch_in_a_corner() {
    let outer = vec![[0, 0], [10, 0], [10, 10], [0, 10]];
    check(&[outer, vec![[5, 5], [2, 7], [2, 3]], vec![[5, 5], [8, 3], [8, 7]]], FLAT, 2);
}

#[test]
fn corner_of_a_hole_lies_on_an_outer_edge() {
    let outer = [[0, 0], [10, 0], [10, 10], [0, 10]].map(|[x, y]| dvec3(x as f64, y as f64, 0.0));
    let hole = vec![dvec3(5.0, 0.0, 0.0), dvec3(7.0, 5.0, 0.0), dvec3(3.0, 5.0, 0.0)];
    let result = triangulate(&[outer.to_vec(), hole]).expect("a polygon");
    assert_eq!(result.corners.iter().flatten().collect::<BTreeSet<_>>().len(), 7);
    assert_eq!(result.corners.len(), 6);
}

#[test]
fn comb_with_collinear_tips() {
    let mut ring = vec![[0, 0], [80, 0]];
    for tooth in (0..8).rev() {
        ring.extend([[tooth * 10 + 10, 50], [tooth * 10 + 5, 5 + tooth]]);
    }
    ring.push([0, 50]);
    check(&[ring], FLAT, 0);
}

#[test]
fn star_shaped_ring_that_turns_around_its_first_corner_twice_is_no_fan() {
    // Every triangle with the first corner is counterclockwise.
    let turns = [[10, 0], [0, 10], [-10, 0], [0, -10], [11, 1], [1, 12], [-12, 1], [-1, -13]];
    let ring: Vec<_> = std::iter::once([0, 0]).chain(turns).collect();
    let result = triangulate(&[lift(&ring, FLAT)]);
    assert_eq!(result, Err(TriangulationError::Crossing(0)));
}

#[test]
fn bent_quadrilateral_is_not_planar() {
    let mut ring = lift(&[[0, 0], [1, 0], [1, 1], [0, 1]], FLAT);
    ring[2].z = f64::MIN_POSITIVE;
    let result = triangulate(&[ring]).expect("a polygon");
    assert_eq!((result.corners.len(), result.is_planar), (2, false));
}

#[test]
fn what_is_no_polygon_is_refused() {
    let refuse = |rings: &[Vec<Corner>]| {
        let in_space: Vec<_> = rings.iter().map(|ring| lift(ring, FLAT)).collect();
        triangulate(&in_space).expect_err("no polygon")
    };
    let square = vec![[0, 0], [10, 0], [10, 10], [0, 10]];
    assert_eq!(refuse(&[]), TriangulationError::TooFewCorners(0));
    assert_eq!(
        refuse(&[square.clone(), vec![[1, 1], [2, 2]]]),
        TriangulationError::TooFewCorners(1)
    );
    assert_eq!(refuse(&[vec![[0, 0], [1, 1], [3, 3], [2, 2]]]), TriangulationError::ZeroArea);
    assert_eq!(refuse(&[vec![[0, 0], [5, 0], [5, 5], [5, 0]]]), TriangulationError::ZeroArea);
    assert_eq!(refuse(&[vec![[0, 0], [9, 9], [9, 0], [0, 9]]]), TriangulationError::Crossing(0));
    assert_eq!(refuse(&[vec![[0, 0], [9, 9], [9, 0], [0, 5]]]), TriangulationError::Crossing(0));
    assert_eq!(refuse(&[square, vec![[5, 5], [15, 5], [5, 6]]]), TriangulationError::Crossing(1));
    let far = vec![vec![dvec3(0.0, 0.0, 0.0), dvec3(f64::NAN, 1.0, 0.0), dvec3(1.0, 1.0, 0.0)]];
    assert_eq!(triangulate(&far), Err(TriangulationError::NotFinite(0)));
}

/// The triangles of a ring as sets of corners.
fn cut(ring: &[Corner]) -> Vec<[u32; 3]> {
    let result = triangulate(&[lift(ring, FLAT)]).expect("a polygon");
    let mut corners = result.corners;
    corners.iter_mut().for_each(|triangle| triangle.sort_unstable());
    corners
}

#[test]
fn spikes_and_corners_visited_twice_are_no_lines() {
    // Back along an edge; out and back into the inside; out and back outside.
    assert_eq!(cut(&[[0, 0], [9, 0], [5, 0], [5, 9]]), [[0, 2, 3]]);
    assert_eq!(cut(&[[0, 0], [9, 0], [5, 4], [9, 0], [9, 9]]), [[0, 1, 4]]);
    assert_eq!(cut(&[[0, 0], [9, 0], [19, 4], [9, 0], [9, 9]]), [[0, 1, 4]]);
    // A notch that ends in the middle of an edge, and one in a corner.
    let notched = [[0, 0], [8, 0], [8, 8], [5, 8], [4, 0], [3, 8], [0, 8]];
    assert_eq!(cut(&notched).len(), 4);
    assert_eq!(cut(&[[0, 0], [4, 0], [4, 4], [6, 4], [4, 0], [9, 0], [5, 9]]).len(), 5);
}

#[test]
fn an_eight_through_a_corner_has_both_its_halves() {
    assert_eq!(cut(&[[0, 0], [4, 4], [8, 0], [8, 8], [4, 4], [0, 8]]), [[0, 1, 5], [1, 2, 3]]);
}

#[test]
fn polygons_of_any_size_and_of_all_sizes_are_cut() {
    for exponent in [-1070, -500, 0, 500, 1018] {
        let unit = f64::powi(2.0, exponent / 2) * f64::powi(2.0, exponent - exponent / 2);
        let ring = lift(&[[0, 0], [8, 4], [0, 8], [2, 4]], FLAT);
        let ring: Vec<_> = [0, 1, 2, 3].map(|i| ring[i] * unit).to_vec();
        let result = triangulate(&[ring]).expect("a polygon");
        assert_eq!(result.corners, [[1, 2, 3], [3, 0, 1]]);
    }
    let ring =
        [[0.0, 0.0], [1e300, 1e-300], [0.0, 1e300], [1e-300, 1.0]].map(|[x, y]| dvec3(x, y, 0.0));
    let result = triangulate(&[ring]).expect("a polygon");
    assert_eq!(result.corners, [[1, 2, 3], [3, 0, 1]]);
}

#[test]
fn rings_of_a_plane_polygon_lose_their_closing_corner() {
    let polygon = geo::Polygon::new(
        geo::LineString::from(vec![(0.0, 0.0), (9.0, 0.0), (0.0, 9.0)]),
        vec![geo::LineString::from(vec![(1.0, 1.0), (2.0, 1.0), (1.0, 2.0)])],
    );
    let rings = rings_of(&polygon);
    assert_eq!(rings.iter().map(Vec::len).collect::<Vec<_>>(), [3, 3]);
    assert_eq!(triangulate(&rings).expect("a polygon").corners.len(), 6);
}
