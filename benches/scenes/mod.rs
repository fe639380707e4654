//! Scenes of any size.

use glam::{DVec3, dvec3};
use std::f64::consts::TAU;
use umriss::model::Soup;

/// A torus of about this many triangles.
pub(crate) fn torus(triangles: usize) -> Soup {
    let tube = ((triangles / 2) as f64 / 2.5).sqrt() as usize;
    let around = triangles / 2 / tube;
    let mut soup = Soup::default();
    for i in 0..around {
        for j in 0..tube {
            let (u, v) = (TAU * i as f64 / around as f64, TAU * j as f64 / tube as f64);
            let radius = 3.0 + v.cos();
            soup.vertices.push(dvec3(radius * u.cos(), radius * u.sin(), v.sin()));
        }
    }
    for i in 0..around {
        for j in 0..tube {
            let at = |i: usize, j: usize| ((i % around) * tube + j % tube) as u32;
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            soup.faces.push(&[a, b, c], []);
            soup.faces.push(&[a, c, d], []);
        }
    }
    soup
}

/// Tetrahedra that stand apart.
pub(crate) fn apart(triangles: usize) -> Soup {
    let side = ((triangles / 4) as f64).sqrt().ceil() as usize;
    let mut soup = Soup::default();
    for i in 0..triangles / 4 {
        let at = dvec3((i % side) as f64 * 2.0, (i / side) as f64 * 2.0, 0.0);
        let first = soup.vertices.len() as u32;
        soup.vertices.extend([DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z].map(|p| at + p));
        for [a, b, c] in [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] {
            soup.faces.push(&[first + a, first + b, first + c], []);
        }
    }
    soup
}
