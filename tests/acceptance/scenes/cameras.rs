//! Cameras, most of them where no draughtsman would put them.

use super::Random;
use glam::DVec3;
use umriss::model::{Camera, Soup, View};

/// An up vector for any direction.
fn up_for(forward: DVec3) -> DVec3 {
    if forward.x == 0.0 && forward.y == 0.0 { DVec3::Y } else { DVec3::Z }
}

/// Parallel rays along `forward`.
pub(crate) fn orthographic(forward: DVec3) -> View {
    let camera = Camera::Orthographic { forward, target: Some(DVec3::ZERO), up: up_for(forward) };
    camera.view((DVec3::ZERO, DVec3::ONE)).expect("a view")
}

/// A viewer at `eye` who looks along `forward`.
pub(crate) fn perspective(eye: DVec3, forward: DVec3, near: f64) -> View {
    let camera = Camera::Perspective {
        eye,
        target: Some(eye + forward),
        up: up_for(forward),
        near: Some(near),
        fov_y_degrees: 90.0,
    };
    camera.view((DVec3::ZERO, DVec3::ONE)).expect("a view")
}

/// A camera for these objects: parallel along an axis, along small integers
/// or in general, or an eye outside, inside, in the plane of a face, on an
/// edge or at a vertex, with near planes that may pass through vertices.
pub(crate) fn random_camera(random: &mut Random, soups: &[Soup]) -> View {
    let soup = &soups[random.below(soups.len() as u64) as usize];
    let forward = random_direction(random);
    let vertex = |random: &mut Random| random.choose(&soup.vertices);
    let near = random.choose(&[1.0, 0.5, 0.125, 1e-3, 2.0]);
    match random.below(9) {
        0..3 => return orthographic(forward),
        // Along an edge: its image is a point.
        3 => {
            let along = vertex(random) - vertex(random);
            return orthographic(if along == DVec3::ZERO { forward } else { along });
        }
        _ => {}
    }
    let eye = match random.below(6) {
        0 => vertex(random),
        1 => (vertex(random) + vertex(random)) / 2.0,
        2 => {
            let [a, b, c] = [0; 3].map(|_| vertex(random));
            a + (b - a) * 2.0 - (c - a) * 0.5
        }
        3 => random.grid_point(4) + DVec3::splat(0.5),
        4 => random.point() * 3.0,
        _ => DVec3::splat(1.5) - forward * 4.0,
    };
    perspective(eye, forward, near)
}

fn random_direction(random: &mut Random) -> DVec3 {
    loop {
        let forward = match random.below(3) {
            0 => random.choose(&[DVec3::X, DVec3::Y, DVec3::Z]) * random.choose(&[1.0, -1.0]),
            1 => random.grid_point(4) - DVec3::splat(1.0),
            _ => random.point(),
        };
        if forward != DVec3::ZERO {
            return forward;
        }
    }
}
