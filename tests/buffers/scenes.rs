//! Scenes, views, and one method after the other on them.

use glam::DVec3;
use umriss::kernel::predicates::Exact;
use umriss::model::{Camera, FeatureOptions, Mesh, Soup, StandardView, View};
use umriss::raster::{ItemBuffer, Samples, ray_cast};
use umriss::run::Run;
use umriss::view::{LineQuestion, PreparedView};

pub(crate) type Triangle = [DVec3; 3];

/// Triangles as a mesh, each with corners of its own.
pub(crate) fn mesh(triangles: &[Triangle]) -> Mesh {
    let mut soup = Soup::default();
    for triangle in triangles {
        let first = soup.vertices.len() as u32;
        soup.vertices.extend(triangle);
        soup.faces.push(&[first, first + 1, first + 2], []);
    }
    Mesh::new(vec![soup], None).unwrap()
}

/// Numbers from 0 to 1.
pub(crate) fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Triangles with random corners, on a grid of `cells` if one is given.
pub(crate) fn soup(seed: u64, count: usize, cells: Option<f64>) -> Vec<Triangle> {
    let mut next = random(seed);
    let mut number = || {
        let x = next();
        cells.map_or(x, |cells| (x * cells).floor())
    };
    let mut point = || DVec3::new(number(), number(), number());
    (0..count).map(|_| [point(), point(), point()]).collect()
}

/// The twelve triangles of a box.
pub(crate) fn cuboid(low: DVec3, high: DVec3) -> Vec<Triangle> {
    let corner = |i: usize| {
        let pick = |axis: usize| if i >> axis & 1 == 1 { high[axis] } else { low[axis] };
        DVec3::new(pick(0), pick(1), pick(2))
    };
    let quads =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let halves = |[a, b, c, d]: [usize; 4]| [[a, b, c], [a, c, d]];
    quads.into_iter().flat_map(halves).map(|corners| corners.map(corner)).collect()
}

/// Two edge-on triangles that make the picture from the front eight units
/// wide and high. With 34 pixels a pixel is a quarter, and samples lie at odd
/// multiples of an eighth, exactly.
pub(crate) fn margin() -> Vec<Triangle> {
    let corner = |x: f64, y: f64| DVec3::new(x, y, x);
    vec![[corner(0.0, 9.0), corner(8.0, 9.0), corner(8.0, 9.5)]]
}

/// The pixels along a picture with vertices on samples.
pub(crate) const ON_SAMPLES: u32 = 34;

/// Slices of a disc whose corners lie on samples, see [`margin`].
pub(crate) fn fan(count: u32) -> Vec<Triangle> {
    let snap = |x: f64| (x * 14.0).round() / 4.0 + 4.125;
    let corner = |i: u32| {
        let angle = f64::from(i % count) / f64::from(count) * std::f64::consts::TAU;
        DVec3::new(snap(angle.cos()), 2.0, snap(angle.sin()))
    };
    let middle = DVec3::new(4.125, 2.0, 4.125);
    (0..count).map(|i| [middle, corner(i), corner(i + 1)]).chain(margin()).collect()
}

/// Named scenes, hard ones among them.
pub(crate) fn scenes() -> Vec<(&'static str, Vec<Triangle>)> {
    let unit = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let mut boxes = cuboid(DVec3::ZERO, DVec3::splat(4.0));
    boxes.extend(cuboid(DVec3::splat(1.0), unit(7.0, 3.0, 3.0)));
    let mut touching = cuboid(DVec3::ZERO, DVec3::splat(2.0));
    touching.extend(cuboid(unit(2.0, 0.0, 0.0), unit(4.0, 2.0, 3.0)));
    touching.extend(cuboid(unit(1.0, 0.0, 1.0), unit(3.0, 2.0, 2.0)));
    let crossing = vec![
        [unit(0.0, 0.0, 0.0), unit(8.0, 4.0, 0.0), unit(4.0, 2.0, 8.0)],
        [unit(0.0, 4.0, 0.0), unit(8.0, 0.0, 0.0), unit(4.0, 2.0, 8.0)],
    ];
    let slivers: Vec<Triangle> = (0..40)
        .map(|i| {
            let z = f64::from(i) * 0.21;
            [unit(0.0, 1.0, z), unit(9.0, 2.0, z + 0.01), unit(9.0, 1.5, z + 0.02)]
        })
        .collect();
    vec![
        ("cubes through one another", boxes),
        ("boxes with common planes", touching),
        ("crossing triangles with a common vertex", crossing),
        ("a fan", fan(24)),
        ("slivers", slivers),
        ("a soup", soup(11, 60, None)),
        ("a soup on a grid", soup(5, 60, Some(5.0))),
        ("a soup with vertices on samples", {
            let shift = DVec3::splat(0.125);
            let soup = soup(8, 60, Some(8.0)).into_iter();
            soup.map(|triangle| triangle.map(|p| p + shift)).chain(margin()).collect()
        }),
        ("a soup in one plane", {
            let flat = |point: DVec3| DVec3::new(point.x, 3.0, point.z);
            soup(3, 20, Some(7.0)).into_iter().map(|triangle| triangle.map(flat)).collect()
        }),
    ]
}

/// Views along axes, from corners, oblique, from outside and from within.
pub(crate) fn cameras() -> Vec<Camera> {
    let perspective = |eye: DVec3, target: DVec3| Camera::Perspective {
        eye,
        target: Some(target),
        up: DVec3::Z,
        near: Some(0.25),
        fov_y_degrees: 60.0,
    };
    vec![
        Camera::Orthographic { forward: DVec3::Y, target: None, up: DVec3::Z },
        Camera::Standard(StandardView::from_name("iso").unwrap()),
        Camera::Standard(StandardView::from_name("cavalier").unwrap()),
        Camera::Orthographic { forward: DVec3::new(0.3, 1.0, -0.2), target: None, up: DVec3::Z },
        perspective(DVec3::new(12.0, -15.0, 9.0), DVec3::splat(2.0)),
        perspective(DVec3::new(2.5, 0.5, 1.75), DVec3::new(2.0, 4.0, 2.0)),
    ]
}

/// Calls `check` with the question of a mesh in a view.
pub(crate) fn ask<T>(
    mesh: &Mesh,
    camera: &Camera,
    size: u32,
    check: impl FnOnce(&View, &LineQuestion, &Samples) -> T,
) -> Option<T> {
    let run = Run::default();
    let view = camera.view(mesh.bounds()).unwrap();
    let prepared =
        PreparedView::new::<Exact>(mesh, &view, &FeatureOptions::default(), &run).unwrap();
    let question = prepared.question(false);
    let count = mesh.vertices().len() as u32;
    let samples = Samples::around(&view.frame, question.coordinates, count, size)?;
    Some(check(&view, &question, &samples))
}

/// What rays see.
pub(crate) fn rays(view: &View, question: &LineQuestion, samples: &Samples) -> ItemBuffer {
    ray_cast::<Exact>(view, question, samples, &Run::default()).unwrap()
}

/// Samples at which two buffers differ.
pub(crate) fn differences(a: &ItemBuffer, b: &ItemBuffer) -> usize {
    assert_eq!([a.width(), a.height()], [b.width(), b.height()]);
    samples_of(a)
        .filter(|&(column, row)| {
            a.item(column, row) != b.item(column, row)
                || a.depth(column, row).to_bits() != b.depth(column, row).to_bits()
        })
        .count()
}

/// All columns and rows of a buffer.
pub(crate) fn samples_of(buffer: &ItemBuffer) -> impl Iterator<Item = (u32, u32)> + use<> {
    let (width, height) = (buffer.width(), buffer.height());
    (0..height).flat_map(move |row| (0..width).map(move |column| (column, row)))
}
