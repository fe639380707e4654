//! Who owns a sample on an edge or a corner: each sample of a union exactly
//! one triangle, told by integers.

use super::{agreed, front, mesh};
use crate::raster::Samples;
use glam::{DVec2, DVec3};

/// A triangle in the plane y = 0 with integer corners.
type Flat = [[i64; 2]; 3];

/// Half the columns, and rows, of the grid, the middle one not counted.
const HALF: i64 = 30;

/// Checks all methods against integers: samples lie at multiples of `step`.
fn check(what: &str, triangles: &[Flat], step: i64) {
    let positions: Vec<[DVec3; 3]> = triangles
        .iter()
        .map(|corners| corners.map(|[x, z]| DVec3::new(x as f64, 0.0, z as f64)))
        .collect();
    let mesh = mesh(&positions);
    let middle = (mesh.bounds().0 + mesh.bounds().1) * 0.5;
    let size = 2 * HALF as u32 + 1;
    let image = agreed(&mesh, &front(), what, |question| {
        // The frame's origin is the middle of the box.
        let origin = -DVec2::new(middle.x, middle.z);
        Samples::about(question.frame, origin, step as f64, [size, size], 1.0)
    });
    let mut owned = 0;
    for row in 0..size {
        for column in 0..size {
            let at = [(i64::from(column) - HALF) * step, (HALF - i64::from(row)) * step];
            let owner = triangles.iter().filter(|t| contains(t, at)).map(sorted).min();
            let item = image.item(column, row).map(|triangle| {
                let corners = mesh.triangles()[triangle as usize];
                sorted(&corners.map(|v| {
                    let corner = mesh.vertices()[v as usize];
                    [corner.x as i64, corner.z as i64]
                }))
            });
            assert_eq!(item, owner, "{what}: at {at:?}");
            owned += i64::from(owner.is_some());
        }
    }
    assert!(owned > HALF, "{what}: {owned} samples are owned");
}

/// What the tie rule compares: corners in order, smaller ones first.
fn sorted(triangle: &Flat) -> Flat {
    let mut corners = *triangle;
    corners.sort_unstable();
    corners
}

/// Whether a triangle that is none on a line has a point, borders included.
fn contains([a, b, c]: &Flat, point: [i64; 2]) -> bool {
    let side = |p: &[i64; 2], q: &[i64; 2]| {
        ((q[0] - p[0]) * (point[1] - p[1]) - (q[1] - p[1]) * (point[0] - p[0])).signum()
    };
    let sides = [side(a, b), side(b, c), side(c, a)];
    sides.iter().all(|&s| s >= 0) || sides.iter().all(|&s| s <= 0)
}

/// The points of the border of a square with this half side, all around.
fn border(half: i64) -> Vec<[i64; 2]> {
    let side = (-half..half).map(|t| [t, -half]);
    let turn = |[x, z]: [i64; 2]| [-z, x];
    let sides = (0..4).flat_map(|turns| {
        side.clone().map(move |point| (0..turns).fold(point, |point, _| turn(point)))
    });
    sides.collect()
}

#[test]
fn a_fan_of_a_thousand_triangles_owns_each_sample_once() {
    let rim = border(125);
    assert_eq!(rim.len(), 1000);
    for centre in [[0, 0], [5, -15], [7, 3]] {
        let next = rim.iter().cycle().skip(1);
        let fan: Vec<Flat> = rim.iter().zip(next).map(|(&a, &b)| [centre, a, b]).collect();
        check(&format!("fan around {centre:?}"), &fan, 5);
    }
}

#[test]
fn slivers_between_samples_and_through_them_own_each_sample_once() {
    // A rectangle cut into triangles that all reach from left to right.
    let ends: Vec<i64> = (-24..=24).collect();
    let slivers: Vec<Flat> = ends
        .windows(2)
        .flat_map(|z| {
            let [low, high] = [z[0], z[1]];
            [[[-90, low], [90, low], [90, high]], [[-90, low], [90, high], [-90, high]]]
        })
        .collect();
    check("level slivers", &slivers, 3);
    let slanted: Vec<Flat> = slivers.iter().map(|t| t.map(|[x, z]| [x - z, z * 3 + x])).collect();
    check("slanted slivers", &slanted, 3);
}

#[test]
fn corners_on_samples_and_level_edges_own_each_sample_once() {
    // Squares of a chessboard, each cut along one or the other diagonal.
    let mut triangles = Vec::new();
    for column in -5..5 {
        for row in -5..5 {
            let corner = |x: i64, z: i64| [(column + x) * 4, (row + z) * 4];
            let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            let halves = if (column + row) % 2 == 0 {
                [[a, b, c], [a, c, d]]
            } else {
                [[b, c, d], [b, d, a]]
            };
            triangles.extend(halves);
        }
    }
    check("chessboard on samples", &triangles, 1);
    check("chessboard beside samples", &triangles, 3);
}
