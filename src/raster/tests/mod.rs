//! Scenes and images for the tests of this room.

mod agreement;
mod ownership;
mod ray_cast;

use super::{ItemBuffer, Method, Samples, methods};
use crate::kernel::predicates::Exact;
use crate::model::{Camera, FeatureOptions, Mesh, Soup};
use crate::run::Run;
use crate::view::{LineQuestion, PreparedView};
use glam::DVec3;

/// The images that methods make of a mesh on a grid.
fn images(
    mesh: &Mesh,
    camera: &Camera,
    methods: &[(&'static str, Method)],
    grid: impl Fn(&LineQuestion) -> Samples,
) -> Vec<(&'static str, ItemBuffer)> {
    let run = Run::default();
    let view = camera.view(mesh.bounds()).expect("a view");
    let options = FeatureOptions::default();
    let prepared = PreparedView::new::<Exact>(mesh, &view, &options, &run).expect("a view");
    let question = prepared.question(true);
    let samples = grid(&question);
    let image = |method: &Method| method(&view, &question, &samples, &run).expect("an image");
    methods.iter().map(|(name, method)| (*name, image(method))).collect()
}

/// A grid around all vertices.
fn around(size: u32) -> impl Fn(&LineQuestion) -> Samples {
    move |question| {
        let count = question.mesh.vertices().len() as u32;
        Samples::around(question.frame, question.coordinates, count, size).expect("a grid")
    }
}

/// The image that all methods make, after making sure that it is one.
fn agreed(
    mesh: &Mesh,
    camera: &Camera,
    what: &str,
    grid: impl Fn(&LineQuestion) -> Samples,
) -> ItemBuffer {
    let mut images = images(mesh, camera, &methods::<Exact>(), grid);
    let (reference, first) = images.remove(0);
    for (name, image) in images {
        for row in 0..first.height() {
            for column in 0..first.width() {
                let [a, b] =
                    [&first, &image].map(|i| (i.item(column, row), i.depth(column, row).to_bits()));
                assert_eq!(a, b, "{what}: {reference} and {name} at {column} {row}");
            }
        }
    }
    first
}

fn front() -> Camera {
    Camera::Orthographic { forward: DVec3::Y, target: None, up: DVec3::Z }
}

/// Triangles of a soup from positions.
fn mesh(triangles: &[[DVec3; 3]]) -> Mesh {
    let mut soup = Soup::default();
    for triangle in triangles {
        let first = soup.vertices.len() as u32;
        soup.vertices.extend(triangle);
        soup.faces.push(&[first, first + 1, first + 2], []);
    }
    Mesh::new(vec![soup], None).expect("a mesh")
}

/// A generator of positions with full mantissas or on a grid.
fn random_triangles(seed: u64, count: usize, grid: Option<f64>) -> Vec<[DVec3; 3]> {
    let mut state = seed;
    let mut next = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let x = (state >> 11) as f64 / (1_u64 << 53) as f64;
        grid.map_or(x, |cells| (x * cells).floor())
    };
    let mut point = || DVec3::new(next(), next(), next());
    (0..count).map(|_| [point(), point(), point()]).collect()
}

/// Positions of the triangle at each sample.
fn picture(mesh: &Mesh, buffer: &ItemBuffer) -> Vec<Option<Vec<[u64; 3]>>> {
    let pixels = (0..buffer.height()).flat_map(|row| (0..buffer.width()).map(move |c| (c, row)));
    pixels
        .map(|(column, row)| {
            buffer.item(column, row).map(|triangle| {
                let corners = mesh.triangles()[triangle as usize];
                let bits = |v: u32| mesh.vertices()[v as usize].to_array().map(f64::to_bits);
                let mut corners = corners.map(bits).to_vec();
                corners.sort_unstable();
                corners
            })
        })
        .collect()
}

fn looking_from(eye: DVec3, forward: DVec3) -> Camera {
    Camera::Perspective {
        eye,
        target: Some(eye + forward),
        up: DVec3::Z,
        near: Some(0.25),
        fov_y_degrees: 60.0,
    }
}
