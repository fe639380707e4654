//! What is drawn: models, degenerate scenes, random soups.

use super::measure::Outcome;
use glam::{DVec3, dvec3};
use std::path::Path;
use umriss::model::{Camera, Mesh, Scene as ModelScene, SceneOptions, Soup, View, import};

/// A mesh and how it is seen.
pub(crate) struct Scene {
    pub(crate) name: &'static str,
    pub(crate) mesh: Mesh,
    pub(crate) view: View,
}

const MODELS: [(&str, [f64; 3], DVec3); 9] = [
    ("teapot", [-0.35, -0.45, -0.8], DVec3::Y),
    ("spot", [0.8, -0.35, 0.75], DVec3::Y),
    ("assimp_wuson", [-0.6, -0.2, -0.9], DVec3::Y),
    ("voxel_city", [0.5, 0.7, -0.8], DVec3::Z),
    ("menger_2", [-1.0, 1.0, -1.0], DVec3::Z),
    ("gear24_off1e6", [-1.0, 1.0, -1.0], DVec3::Z),
    ("bar_heap", [-1.0, 1.0, -1.0], DVec3::Z),
    ("stair_boxes_touching", [0.0, 1.0, 0.0], DVec3::Z),
    ("bad_soup", [-1.0, 1.0, -1.0], DVec3::Z),
];

/// All scenes.
pub(crate) fn scenes(root: &Path) -> Outcome<Vec<Scene>> {
    let mut scenes = Vec::new();
    for (name, forward, up) in MODELS {
        let file = root.join("examples/models").join(name).with_extension("obj");
        let model = import::read_file(&file, None)?;
        let mesh = ModelScene::new(model.objects, &SceneOptions::default())?.mesh;
        scenes.push(scene(name, mesh, DVec3::from_array(forward), up)?);
    }
    let mesh = Mesh::new(vec![soup(1000)], None)?;
    scenes.push(scene("random soup", mesh, dvec3(0.31, 0.83, -0.47), DVec3::Z)?);
    let mesh = Mesh::new(vec![turned_cubes()], None)?;
    // Along the diagonal of the faces, where most is in doubt.
    scenes.push(scene("turned cubes", mesh, turned(dvec3(1.0, 1.0, 0.0)), DVec3::Z)?);
    Ok(scenes)
}

fn scene(name: &'static str, mesh: Mesh, forward: DVec3, up: DVec3) -> Outcome<Scene> {
    let camera = Camera::Orthographic { forward, target: None, up };
    let view = camera.view(mesh.bounds())?;
    Ok(Scene { name, mesh, view })
}

/// Triangles with corners in a cube, the same in every run.
fn soup(triangles: u32) -> Soup {
    let mut state = 1967_u64;
    let mut random = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut soup = Soup::default();
    for first in (0..3 * triangles).step_by(3) {
        let middle = dvec3(random(), random(), random());
        for _ in 0..3 {
            soup.vertices.push(middle + dvec3(random(), random(), random()) * 0.2);
        }
        soup.faces.push(&[first, first + 1, first + 2], []);
    }
    soup
}

/// Eight times a rational rotation whose denominator is multiplied away, so
/// that integers stay integers.
fn turned(p: DVec3) -> DVec3 {
    // Columns of a rotation times 9.
    let [x, y, z] = [dvec3(1.0, 8.0, 4.0), dvec3(-4.0, 4.0, -7.0), dvec3(-8.0, -1.0, 4.0)];
    (0..8).fold(p, |p, _| x * p.x + y * p.y + z * p.z)
}

/// Cubes side by side in a block, all touching, turned: every contact is
/// exact, and no plane is parallel to an axis.
fn turned_cubes() -> Soup {
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut soup = Soup::default();
    let places = (0..6).flat_map(|i| (0..6).flat_map(move |j| (0..6).map(move |k| [i, j, k])));
    for [i, j, k] in places.filter(|[i, j, k]| (i + 2 * j + 3 * k) % 5 < 3) {
        let first = soup.vertices.len() as u32;
        for corner in 0..8 {
            let bit = |axis: i32| f64::from(corner >> axis & 1);
            let at = [f64::from(i) + bit(0), f64::from(j) + bit(1), f64::from(k) + bit(2)];
            soup.vertices.push(turned(DVec3::from(at)));
        }
        for face in faces {
            soup.faces.push(&face.map(|corner| first + corner), []);
        }
    }
    soup
}
