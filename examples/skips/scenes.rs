//! Scenes in which most is hidden, and scenes in which nothing much is.

use super::Outcome;
use glam::{DQuat, DVec3, dvec3};
use std::f64::consts::TAU;
use umriss::model::{Camera, Mesh, Soup, View};

/// A mesh and how it is seen.
pub(crate) struct Scene {
    pub(crate) name: &'static str,
    pub(crate) mesh: Mesh,
    pub(crate) view: View,
}

impl Scene {
    fn new(name: &'static str, soup: Soup, forward: DVec3) -> Outcome<Self> {
        let mesh = Mesh::new(vec![soup], None)?;
        let up = if forward.x == 0.0 { DVec3::Y } else { DVec3::Z };
        let view = Camera::Orthographic { forward, target: None, up }.view(mesh.bounds())?;
        Ok(Scene { name, mesh, view })
    }
}

const DOWN: DVec3 = DVec3::NEG_Z;
const ASKEW: DVec3 = dvec3(-1.0, -0.8, -0.6);

/// The largest scene, against which the cubes are held.
pub(crate) fn surface(scale: usize) -> Outcome<Scene> {
    Scene::new("a torus", torus(1_000_000 / scale, DVec3::ZERO), ASKEW)
}

/// Cubes of random places and attitudes in a box of side 2.
pub(crate) fn cubes(scale: usize) -> Outcome<Scene> {
    Scene::new("random cubes", random_cubes(80_000 / scale), ASKEW)
}

/// So many sheets, one behind another, of together 100 000 triangles.
pub(crate) fn sheets(count: usize, scale: usize) -> Outcome<Scene> {
    let name = match count {
        4 => "4 sheets",
        256 => "256 sheets",
        _ => "sheets",
    };
    Scene::new(name, stacked_sheets(count, 100_000 / scale), DOWN)
}

/// A fine torus.
pub(crate) fn fine(scale: usize) -> Outcome<Scene> {
    Scene::new("a fine model", torus(100_000 / scale, DVec3::ZERO), ASKEW)
}

/// The same with huge triangles behind it, in front of half of it, and
/// through it.
pub(crate) fn fine_in_huge(scale: usize) -> Outcome<Scene> {
    let mut soup = torus(100_000 / scale, DVec3::ZERO);
    for [a, b, c] in [
        [dvec3(-9e3, -9e3, -20.0), dvec3(9e3, -8e3, -30.0), dvec3(0.0, 9e3, -25.0)],
        [dvec3(30.0, -9e3, -9e3), dvec3(40.0, 0.3, 9e3), dvec3(30.0, 0.1, -9e3)],
        [dvec3(-9e3, -9e3, 0.2), dvec3(9e3, -8e3, 0.3), dvec3(0.0, 9e3, -0.1)],
    ] {
        let first = soup.vertices.len() as u32;
        soup.vertices.extend([a, b, c]);
        soup.faces.push(&[first, first + 1, first + 2], []);
    }
    Scene::new("the same among huge triangles", soup, ASKEW)
}

/// Boxes of a town behind one long wall.
pub(crate) fn town_behind_a_wall(scale: usize) -> Outcome<Scene> {
    let side = (8000.0 / scale as f64).sqrt() as usize;
    let mut random = random_numbers();
    let mut soup = Soup::default();
    for i in 0..side * side {
        let at = dvec3((i % side) as f64, (i / side) as f64, 0.0);
        let size = dvec3(0.7, 0.7, 0.5 + 4.0 * random());
        push_box(&mut soup, at, size, DQuat::IDENTITY);
    }
    let length = side as f64 + 20.0;
    push_box(
        &mut soup,
        dvec3(length - 5.0, -10.0, -1.0),
        dvec3(0.5, length, 40.0),
        DQuat::IDENTITY,
    );
    Scene::new("a town behind a wall", soup, dvec3(-1.0, 0.02, -0.15))
}

/// Numbers from 0 to 1, the same in every run (Knuth's multiplier).
fn random_numbers() -> impl FnMut() -> f64 {
    let mut state = 1967_u64;
    move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn torus(triangles: usize, middle: DVec3) -> Soup {
    let tube = ((triangles / 2) as f64 / 2.5).sqrt() as usize;
    let around = triangles / 2 / tube;
    let mut soup = Soup::default();
    for i in 0..around {
        for j in 0..tube {
            let (u, v) = (TAU * i as f64 / around as f64, TAU * j as f64 / tube as f64);
            let radius = 1.0 + 0.4 * v.cos();
            soup.vertices.push(middle + dvec3(radius * u.cos(), radius * u.sin(), 0.4 * v.sin()));
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

/// Squares over one another, corners of their meshes moved a little.
fn stacked_sheets(count: usize, triangles: usize) -> Soup {
    let side = (triangles as f64 / (2.0 * count as f64)).sqrt().round() as usize;
    let mut random = random_numbers();
    let mut soup = Soup::default();
    for sheet in 0..count {
        let first = soup.vertices.len() as u32;
        for i in 0..=side {
            for j in 0..=side {
                let mut jitter = || (random() - 0.5) * 0.5;
                let [x, y] = [i, j].map(|k| (k as f64 + jitter()) / side as f64);
                let z = (sheet as f64 + 0.8 * jitter()) / count as f64;
                soup.vertices.push(dvec3(x, y, z));
            }
        }
        for i in 0..side {
            for j in 0..side {
                let at = |i: usize, j: usize| first + (i * (side + 1) + j) as u32;
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                soup.faces.push(&[a, b, c], []);
                soup.faces.push(&[a, c, d], []);
            }
        }
    }
    soup
}

fn random_cubes(count: usize) -> Soup {
    let edge = 1.0 / (count as f64).cbrt();
    let mut random = random_numbers();
    let mut soup = Soup::default();
    for _ in 0..count {
        let mut signed = || 2.0 * random() - 1.0;
        let at = dvec3(signed(), signed(), signed());
        let attitude = loop {
            // From the ball, so that no direction is preferred.
            let [x, y, z, w] = [signed(), signed(), signed(), signed()];
            let square = x * x + y * y + z * z + w * w;
            if 0.01 < square && square < 1.0 {
                break DQuat::from_xyzw(x, y, z, w).normalize();
            }
        };
        push_box(&mut soup, at, DVec3::splat(edge), attitude);
    }
    soup
}

/// A box from a corner on, turned around it.
fn push_box(soup: &mut Soup, at: DVec3, size: DVec3, attitude: DQuat) {
    const FACES: [[u32; 4]; 6] =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let first = soup.vertices.len() as u32;
    for corner in 0..8_u32 {
        let bit = |axis: u32| f64::from(corner >> axis & 1);
        soup.vertices.push(at + attitude * (size * dvec3(bit(0), bit(1), bit(2))));
    }
    for face in FACES {
        soup.faces.push(&face.map(|corner| first + corner), []);
    }
}
