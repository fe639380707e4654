//! Models and eyes.

use glam::DVec3;
use std::path::Path;
use umriss::model::{Camera, Mesh, Scene, SceneOptions, StandardView, View, import};

/// A model of the repository.
pub(crate) fn model(name: &str) -> Mesh {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name);
    let soups = import::read_file(&file, None).unwrap().objects;
    Scene::new(soups, &SceneOptions::default()).unwrap().mesh
}

/// A model written out.
pub(crate) fn obj(text: &str) -> Mesh {
    let soups = import::read_bytes("scene.obj", text.as_bytes(), None).unwrap().objects;
    Scene::new(soups, &SceneOptions::default()).unwrap().mesh
}

pub(crate) fn named(name: &str, mesh: &Mesh) -> View {
    Camera::Standard(StandardView::from_name(name).unwrap()).view(mesh.bounds()).unwrap()
}

pub(crate) fn perspective(eye: DVec3, target: DVec3, mesh: &Mesh) -> View {
    let (target, up) = (Some(target), DVec3::Z);
    let camera = Camera::Perspective { eye, target, up, near: None, fov_y_degrees: 60.0 };
    camera.view(mesh.bounds()).unwrap()
}

/// Parallel rays, along planes of models and not, an eye outside and an eye
/// within the model, so that the near plane cuts it.
pub(crate) fn views(mesh: &Mesh) -> Vec<(&'static str, View)> {
    let (low, high) = mesh.bounds();
    let (size, centre) = ((high - low).max_element(), (low + high) * 0.5);
    let forward = DVec3::new(0.37, 0.71, -0.43);
    let generic = Camera::Orthographic { forward, target: None, up: DVec3::Z };
    let outside = high + DVec3::new(0.75, -1.5, 0.25) * size;
    let inside = low + (high - low) * DVec3::new(0.375, 0.25, 0.625);
    vec![
        ("front", named("front", mesh)),
        ("top", named("top", mesh)),
        ("iso", named("iso", mesh)),
        ("cabinet", named("cabinet", mesh)),
        ("generic", generic.view(mesh.bounds()).unwrap()),
        ("outside", perspective(outside, centre, mesh)),
        ("inside", perspective(inside, inside + DVec3::new(1.0, 0.5, -0.25) * size, mesh)),
    ]
}
