//! Models in many views, against ray casting.

use crate::oracle::Topmost;
use crate::whole_check;
use crate::{painted, with_question};
use glam::DVec3;
use std::path::Path;
use umriss::kernel::predicates::{Exact, PlanePoint, Points, Predicates};
use umriss::model::{Camera, Mesh, View, import};
use umriss::raster::{Samples, ray_cast};
use umriss::run::Run;
use umriss::view::{LineQuestion, PaintOrder};
use umriss::visibility::{PaintTree, Painter};

fn model(name: &str) -> Mesh {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name);
    Mesh::new(import::read_file(&path, None).unwrap().objects, None).unwrap()
}

/// Holds what is painted last at each sample against what a ray meets first.
/// Samples on the image of an edge are left out; returns how many were asked.
fn compare(
    question: &LineQuestion<'_>,
    view: &View,
    order: &PaintOrder,
    size: u32,
    name: &str,
) -> usize {
    let mesh = question.mesh;
    let count = mesh.vertices().len() as u32;
    let samples = Samples::around(&view.frame, question.coordinates, count, size).unwrap();
    let buffer = ray_cast::<Exact>(view, question, &samples, &Run::default()).unwrap();
    let cells = (0..samples.height()).flat_map(|row| (0..samples.width()).map(move |c| (c, row)));
    let cells: Vec<(u32, u32)> = cells.collect();
    let places: Vec<DVec3> = cells.iter().map(|&(c, row)| samples.point(c, row)).collect();
    let topmost = Topmost::new(mesh, view, &places);
    let edges = Edges::new(mesh, view, &places);
    let mut asked = 0;
    for (i, &(column, row)) in cells.iter().enumerate() {
        if edges.meet(mesh, i) {
            continue;
        }
        asked += 1;
        let seen = buffer.item(column, row).map(|triangle| mesh.face_of(triangle));
        assert_eq!(topmost.face(order, i), seen, "{name} at column {column}, row {row}");
    }
    asked
}

/// Which samples lie on the image of an edge.
struct Edges {
    points: Points,
    first: u32,
}

impl Edges {
    fn new(mesh: &Mesh, view: &View, places: &[DVec3]) -> Self {
        let vertices = [mesh.vertices(), places].concat();
        let first = mesh.vertices().len() as u32;
        Edges { points: Points::new(&vertices, view.eye, view.near), first }
    }

    fn meet(&self, mesh: &Mesh, sample: usize) -> bool {
        let predicates = Predicates::<Exact>::new(&self.points);
        let x = self.first + sample as u32;
        mesh.triangles().iter().any(|&[a, b, c]| {
            let signs = [(a, b), (b, c), (c, a)].map(|(p, q)| predicates.side(p, q, x).to_i32());
            signs.contains(&0) && !(signs.contains(&1) && signs.contains(&-1))
        })
    }
}

fn parallel(forward: DVec3) -> Camera {
    Camera::Orthographic { forward, target: None, up: DVec3::Z }
}

fn central(mesh: &Mesh, from: DVec3) -> Camera {
    let (low, high) = mesh.bounds();
    let (centre, size) = ((low + high) * 0.5, (high - low).length());
    Camera::Perspective {
        eye: centre + from.normalize() * size * 1.3,
        target: Some(centre),
        up: DVec3::Z,
        near: Some(size * 0.1),
        fov_y_degrees: 60.0,
    }
}

const DEGENERATE: [&str; 18] = [
    "bad_soup.obj",
    "bar_heap.obj",
    "coplanar_quads.obj",
    "cube_hole.obj",
    "cube_1e-9.obj",
    "cube_1e9.obj",
    "cube_row_touching.obj",
    "cylinder_on_plate.obj",
    "house_groups.obj",
    "needle_cone.obj",
    "nested_cubes.obj",
    "ngon_L.obj",
    "plate_hole.json",
    "slab_tjunction.obj",
    "stair_boxes_touching.obj",
    "two_cubes_interpenetrating.obj",
    "two_tris_cross.obj",
    "woven.obj",
];

#[test]
fn degenerate_models_are_painted_as_rays_see_them() {
    for name in DEGENERATE {
        let mesh = model(name);
        let cameras = [
            parallel(DVec3::Y),
            parallel(DVec3::new(-1.0, 1.0, -1.0)),
            central(&mesh, DVec3::new(1.0, -2.0, 1.5)),
        ];
        for camera in cameras {
            let view = camera.view(mesh.bounds()).unwrap();
            with_question(&mesh, &camera, |question| {
                for painter in Painter::ALL {
                    let (order, _) = painted(question, painter);
                    compare(question, &view, &order, 24, name);
                    if order.pieces.len() < 100 {
                        whole_check::check(question, &order);
                    }
                }
            });
        }
    }
}

#[test]
fn one_tree_serves_a_hundred_views() {
    let mesh = model("two_cubes_interpenetrating.obj");
    let run = Run::default();
    let tree = with_question(&mesh, &parallel(DVec3::Y), |question| {
        PaintTree::new::<Exact>(question, &run).unwrap()
    });
    let mut asked = 0;
    for i in 0..100 {
        let angle = f64::from(i) * std::f64::consts::TAU / 100.0;
        let from = DVec3::new(angle.cos(), angle.sin(), (angle * 3.0).sin());
        let camera = if i % 2 == 0 { parallel(-from) } else { central(&mesh, from) };
        let view = camera.view(mesh.bounds()).unwrap();
        asked += with_question(&mesh, &camera, |question| {
            let order = tree.order::<Exact>(question, &run).unwrap();
            assert_eq!(order.cuts, tree.cuts());
            whole_check::check(question, &order);
            compare(question, &view, &order, 16, "two cubes")
        });
    }
    assert!(asked > 5_000, "{asked}");
}

#[test]
fn order_of_faces_and_winding_do_not_matter() {
    let mut soups = import::read_file(
        &Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("examples/models/two_cubes_interpenetrating.obj"),
        None,
    )
    .unwrap()
    .objects;
    let camera = parallel(DVec3::new(-1.0, 2.0, -3.0));
    let corners = |mesh: &Mesh, painter: Painter| -> Vec<Vec<[u64; 3]>> {
        with_question(mesh, &camera, |question| {
            let predicates = Predicates::<Exact>::new(question.points);
            let (order, _) = painted(question, painter);
            let place = |point: PlanePoint| predicates.position(point).to_array().map(f64::to_bits);
            let pieces = order.pieces.iter().map(|piece| {
                let mut places: Vec<_> =
                    piece.polygon.corners.iter().map(|corner| place(corner.point)).collect();
                places.sort_unstable();
                places
            });
            pieces.collect()
        })
    };
    let before = Mesh::new(soups.clone(), None).unwrap();
    for soup in &mut soups {
        let mut faces = umriss::model::Faces::default();
        for face in (0..soup.faces.len()).rev() {
            let ring: Vec<u32> =
                soup.faces.rings(face).next().unwrap().iter().rev().copied().collect();
            faces.push(&ring, []);
        }
        soup.faces = faces;
    }
    let after = Mesh::new(soups, None).unwrap();
    for painter in Painter::ALL {
        assert_eq!(corners(&before, painter), corners(&after, painter), "{painter:?}");
    }
}
