//! All methods on scenes that are hard for one or the other.

use super::{agreed, around, front, looking_from, mesh, picture, random_triangles};
use crate::model::Camera;
use glam::DVec3;

/// Parallel, from outside, and from within a scene in the unit cube.
fn cameras() -> [(&'static str, Camera); 4] {
    let (up, target) = (DVec3::Z, None);
    [
        ("front", front()),
        ("general", Camera::Orthographic { forward: DVec3::new(0.3, 1.0, -0.7), target, up }),
        ("outside", looking_from(DVec3::new(0.5, -2.0, 0.7), DVec3::new(0.0, 1.0, -0.1))),
        // Triangles behind the eye, and across the near plane.
        ("inside", looking_from(DVec3::new(0.4, 0.3, 0.6), DVec3::Y)),
    ]
}

#[test]
fn triangles_through_one_another_agree() {
    for seed in 0..12 {
        for (name, camera) in cameras() {
            let mesh = mesh(&random_triangles(seed, 30, None));
            for size in [40, 23] {
                agreed(&mesh, &camera, &format!("seed {seed} {name} {size}"), around(size));
            }
        }
    }
}

#[test]
fn coplanar_and_coincident_triangles_agree() {
    for seed in 0..12 {
        for (name, camera) in cameras() {
            // Corners on few places: shared edges, common planes, copies.
            let mut triangles = random_triangles(seed, 25, Some(3.0));
            triangles.iter_mut().flatten().for_each(|corner| *corner /= 3.0);
            let mesh = mesh(&triangles);
            for size in [40, 23] {
                agreed(&mesh, &camera, &format!("seed {seed} {name} {size}"), around(size));
            }
        }
    }
}

#[test]
fn triangles_in_another_order_make_the_same_picture() {
    for seed in 0..6 {
        for (name, camera) in cameras() {
            let mut triangles = random_triangles(seed, 20, Some(4.0));
            triangles.iter_mut().flatten().for_each(|corner| *corner /= 4.0);
            let one = mesh(&triangles);
            triangles.rotate_left(7);
            triangles.reverse();
            triangles.iter_mut().for_each(|triangle| triangle.swap(0, 2));
            let other = mesh(&triangles);
            let what = format!("seed {seed} {name}");
            let first = agreed(&one, &camera, &what, around(31));
            let second = agreed(&other, &camera, &what, around(31));
            assert_eq!(picture(&one, &first), picture(&other, &second), "{what}");
        }
    }
}

#[test]
fn scenes_that_floats_cannot_hold_agree() {
    for (small, large) in [(1e-150, 1e150), (1e-30, 1.0)] {
        let mut triangles = random_triangles(5, 8, None);
        for (i, triangle) in triangles.iter_mut().enumerate() {
            triangle.iter_mut().for_each(|corner| {
                *corner *= if i % 2 == 0 { large } else { small };
            });
        }
        let image = agreed(&mesh(&triangles), &front(), "wide", around(9));
        let hits = (0..81).filter(|i| image.item(i % 9, i / 9).is_some());
        assert!(hits.count() > 10);
    }
}

#[test]
fn crossing_planes_are_cut_between_the_same_samples() {
    // Two squares through one another, and a third through both.
    let square = |a: DVec3, b: DVec3| {
        let corners = [-a - b, a - b, a + b, b - a];
        [[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]]
    };
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    let squares = [square(x, z), square(x + y * 0.3, z), square(x, z + y * 0.7)];
    let mesh = mesh(&squares.concat());
    agreed(&mesh, &looking_from(DVec3::new(0.1, -3.0, 0.2), DVec3::Y), "near", around(65));
    let image = agreed(&mesh, &front(), "front", around(65));
    for row in 1..64 {
        for column in 1..64 {
            let at = |index: u32| (f64::from(index) - 32.0) * 2.0 / 63.0;
            let nearest = (0.3 * at(column)).min(-0.7 * at(row)).min(0.0);
            let depth = image.depth(column, row);
            assert!((depth - nearest).abs() < 1e-9, "{column} {row}: {depth} not {nearest}");
        }
    }
}
