//! Ray casting against what must not matter, and against plain floats
//! where floats are good enough.

use super::{around, front, images, looking_from, mesh, picture, random_triangles};
use crate::kernel::predicates::Exact;
use crate::model::{Camera, Mesh};
use crate::raster::{ItemBuffer, Samples, ray_cast};
use glam::DVec3;
use std::cell::Cell;

fn cast(mesh: &Mesh, camera: &Camera, size: u32) -> (ItemBuffer, Samples) {
    let samples = Cell::new(None);
    let mut images = images(mesh, camera, &[("ray-cast", ray_cast::<Exact>)], |question| {
        let grid = around(size)(question);
        samples.set(Some(grid));
        grid
    });
    (images.remove(0).1, samples.get().expect("a grid"))
}

#[test]
fn the_order_of_the_file_does_not_matter() {
    for seed in 0..20 {
        let mut triangles = random_triangles(seed, 12, Some(4.0));
        let one = mesh(&triangles);
        triangles.reverse();
        triangles.iter_mut().for_each(|triangle| triangle.swap(0, 2));
        let other = mesh(&triangles);
        for camera in [front(), looking_from(DVec3::new(1.0, -7.0, 2.0), DVec3::Y)] {
            let (first, _) = cast(&one, &camera, 24);
            let (second, _) = cast(&other, &camera, 24);
            assert_eq!(picture(&one, &first), picture(&other, &second), "seed {seed}");
        }
    }
}

#[test]
fn floats_agree_where_nothing_is_degenerate() {
    let eye = DVec3::new(0.4, 0.3, 0.6);
    for (seed, camera) in [
        (1, front()),
        (2, looking_from(DVec3::new(0.5, -2.0, 0.5), DVec3::Y)),
        // Inside the soup: triangles behind the eye and across the near plane.
        (3, looking_from(eye, DVec3::Y)),
    ] {
        let triangles = random_triangles(seed, 40, None);
        let mesh = mesh(&triangles);
        let (buffer, samples) = cast(&mesh, &camera, 64);
        let mut hits = 0;
        for row in 0..buffer.height() {
            for column in 0..buffer.width() {
                let x = samples.point(column, row);
                let (origin, ray, least) = match camera {
                    Camera::Perspective { eye, .. } => (eye, x - eye, 0.25),
                    _ => (x - 100.0 * DVec3::Y, DVec3::Y, 0.0),
                };
                let nearest = (0..mesh.triangles().len() as u32)
                    .filter_map(|triangle| {
                        let [a, b, c] = mesh.triangles()[triangle as usize]
                            .map(|v| mesh.vertices()[v as usize]);
                        let distance = hit(origin, ray, [a, b, c])?;
                        let depth = (ray * distance).y;
                        (depth > least).then_some((triangle, depth + origin.y))
                    })
                    .min_by(|a, b| a.1.total_cmp(&b.1));
                assert_eq!(buffer.item(column, row), nearest.map(|n| n.0), "{column} {row}");
                hits += usize::from(nearest.is_some());
            }
        }
        assert!(hits > 500);
    }
}

/// Where a ray hits a triangle, in multiples of its direction (Moeller and
/// Trumbore 1997).
fn hit(origin: DVec3, ray: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (e, f) = (b - a, c - a);
    let p = ray.cross(f);
    let determinant = e.dot(p);
    let t = origin - a;
    let u = t.dot(p) / determinant;
    let q = t.cross(e);
    let v = ray.dot(q) / determinant;
    let distance = f.dot(q) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0).then_some(distance)
}

#[test]
fn depths_are_those_of_the_nearest_triangle() {
    let wall =
        |y: f64| [[-1., -1.], [9., -1.], [-1., 9.]].map(|[x, z]: [f64; 2]| DVec3::new(x, y, z));
    let mesh = mesh(&[wall(5.0), wall(2.0), wall(3.0)]);
    let (buffer, samples) = cast(&mesh, &looking_from(DVec3::new(0.0, -1.0, 0.0), DVec3::Y), 16);
    let point = samples.pixel_of(glam::DVec2::ZERO).expect("the middle");
    assert_eq!(buffer.item(point[0], point[1]), Some(1));
    assert!((buffer.depth(point[0], point[1]) - 3.0).abs() < 1e-9);
    assert_eq!(buffer.item(buffer.width(), 0), None);
    assert_eq!(buffer.depth(0, buffer.height()), f64::INFINITY);
}
