//! Outlines that touch themselves: bridges, spikes, corners visited twice,
//! holes that touch. What they enclose is known by cells of a mosaic.

use super::mosaic::{Chance, Mosaic, edges_of, lift, rectangles, triangles, wild};
use glam::DVec3;
use proptest::prelude::*;
use std::collections::BTreeSet;
use umriss::polygon::{TriangulationError, triangulate};

/// Triangulates rings of points of a mosaic in a plane of space; gives the
/// corners of triangles as points.
fn cut(
    mosaic: &Mosaic,
    rings: &[Vec<usize>],
    [axis, third]: [usize; 2],
) -> Result<Vec<[usize; 3]>, TriangulationError> {
    let place = |&point: &usize| lift(mosaic.points[point], axis, third);
    let in_space: Vec<Vec<DVec3>> =
        rings.iter().map(|ring| ring.iter().map(place).collect()).collect();
    let result = triangulate(&in_space)?;
    assert!(result.is_planar);
    let corners = rings.concat();
    Ok(result.corners.iter().map(|t| t.map(|corner| corners[corner as usize])).collect())
}

/// The same triangles, whichever way they are written.
fn as_set(triangles: &[[usize; 3]]) -> BTreeSet<[usize; 3]> {
    let sorted = |mut triangle: [usize; 3]| {
        triangle.sort_unstable();
        triangle
    };
    triangles.iter().copied().map(sorted).collect()
}

fn some_cells(mosaic: &Mosaic, chance: &mut Chance) -> BTreeSet<usize> {
    (0..mosaic.cells.len()).filter(|_| chance.below(3) > 0).collect()
}

/// Outlines of some cells in three ways of writing: all are cut into the
/// same triangles, and these are the cells.
fn check(mosaic: &Mosaic, mut chance: Chance, plane: [usize; 2]) -> Result<(), TestCaseError> {
    let cells = some_cells(mosaic, &mut chance);
    prop_assume!(!cells.is_empty());
    let border = mosaic.border(&cells);
    let walk = mosaic.walk(&border, &mut chance);
    let walk = mosaic.without_some_straight(&walk, &mut chance);
    let found = cut(mosaic, std::slice::from_ref(&walk), plane);
    let found = found.map_err(|error| TestCaseError::fail(format!("{error}: {walk:?}")))?;
    mosaic.judge(&found, &border).map_err(TestCaseError::fail)?;
    let mut other = walk.clone();
    other.rotate_left(chance.below(walk.len()));
    if chance.below(2) == 0 {
        other.reverse();
    }
    let again =
        cut(mosaic, &[other], plane).map_err(|error| TestCaseError::fail(error.to_string()))?;
    prop_assert_eq!(as_set(&found), as_set(&again));
    Ok(())
}

proptest! {

    #[test]
    fn walks_around_triangles_enclose_them(
        side in 1..5_usize,
        chance in any::<u64>().prop_map(Chance),
        plane in [0..3_usize, 0..3_usize],
    ) {
        let mut chance = chance;
        let mosaic = triangles(side, &mut chance);
        check(&mosaic, chance, plane)?;
    }

    #[test]
    fn walks_around_rectangles_of_any_exponents_enclose_them(
        xs in prop::collection::vec(wild(), 2..6),
        ys in prop::collection::vec(wild(), 2..6),
        chance in any::<u64>().prop_map(Chance),
        plane in [0..3_usize, 0..3_usize],
    ) {
        let mosaic = rectangles(xs, ys);
        prop_assume!(!mosaic.cells.is_empty());
        check(&mosaic, chance, plane)?;
    }

    #[test]
    fn holes_take_away_what_they_have_in_common_with_the_shell(
        mut chance in any::<u64>().prop_map(Chance),
        exponent in -400..400_i32,
        count in 1..5_usize,
        all_corners: bool,
    ) {
        // One coordinate may be far too small for the others.
        let mut xs: Vec<f64> = (0..6).map(f64::from).collect();
        xs[2] = f64::powi(2.0, exponent.min(0)) * 1.5;
        let mosaic = rectangles(xs, (0..6).map(f64::from).collect());
        let mut rings = Vec::new();
        let mut inside: BTreeSet<usize> = BTreeSet::new();
        for number in 0..=count {
            let (ring, cells) = block(&mosaic, &mut chance, all_corners, number == 0);
            if number == 0 {
                inside = cells;
            } else {
                inside.retain(|cell| !cells.contains(cell));
            }
            rings.push(ring);
        }
        let border = mosaic.border(&inside);
        match cut(&mosaic, &rings, [2, 0]) {
            Ok(found) => {
                mosaic.judge(&found, &border).map_err(TestCaseError::fail)?;
                rings[1..].reverse();
                let again = cut(&mosaic, &rings, [2, 0]).map(|again| as_set(&again));
                prop_assert_eq!(again, Ok(as_set(&found)));
            }
            Err(TriangulationError::ZeroArea) => prop_assert!(inside.is_empty()),
            Err(error) => {
                let is_crossing = matches!(error, TriangulationError::Crossing(_));
                prop_assert!(is_crossing && !all_corners && some_cross(&mosaic, &rings), "{}", error);
            }
        }
    }
}

/// A rectangle of cells and the ring around it: all points on the way or its
/// four corners; of the shell more than of a hole, so that holes may be inside,
/// outside and across.
fn block(
    mosaic: &Mosaic,
    chance: &mut Chance,
    all_corners: bool,
    is_shell: bool,
) -> (Vec<usize>, BTreeSet<usize>) {
    let mut range = || {
        let length = if is_shell { 3 + chance.below(3) } else { 1 + chance.below(3) };
        let start = chance.below(6 - length);
        start..start + length
    };
    let (columns, rows) = (range(), range());
    let cells = (0..25).filter(|i| columns.contains(&(i % 5)) && rows.contains(&(i / 5)));
    let cells: BTreeSet<usize> = cells.collect();
    let border = mosaic.border(&cells);
    let mut ring = mosaic.walk(&border, &mut Chance(0));
    let corners = [rows.start, rows.end].map(|j| [columns.start, columns.end].map(|i| 6 * j + i));
    if !all_corners {
        ring.retain(|point| corners.as_flattened().contains(point));
    }
    if chance.below(2) == 0 {
        ring.reverse();
    }
    (ring, cells)
}

/// Whether two edges cross inside of both.
fn some_cross(mosaic: &Mosaic, rings: &[Vec<usize>]) -> bool {
    let edges: Vec<_> = rings.iter().flat_map(|ring| edges_of(ring)).collect();
    let turn = |a: usize, b: usize, c: usize| {
        super::mosaic::turn([a, b, c].map(|point| mosaic.points[point]))
    };
    edges.iter().any(|&[a, b]| {
        edges.iter().any(|&[c, d]| {
            turn(a, b, c).is_opposite(turn(a, b, d)) && turn(c, d, a).is_opposite(turn(c, d, b))
        })
    })
}
