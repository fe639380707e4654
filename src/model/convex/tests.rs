use super::*;
use crate::kernel::predicates::Exact;
use crate::model::{Camera, Faces, Soup, facing};
use glam::dvec3;
use proptest::prelude::*;

fn mesh(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Mesh {
    let mut faces = Faces::default();
    triangles.iter().for_each(|triangle| faces.push(triangle, []));
    Mesh::new(vec![Soup { vertices: vertices.to_vec(), faces, ..Soup::default() }], None).unwrap()
}

fn found(mesh: &Mesh, camera: &Camera) -> (Vec<Sign>, Option<ConvexParts>) {
    let view = camera.view(mesh.bounds()).unwrap();
    let points = Points::new(mesh.vertices(), view.eye, view.near);
    let run = Run::default();
    let facing = facing::<Exact>(mesh, &points, &run);
    let parts = ConvexParts::find::<Exact>(mesh, &points, &view, &facing, &run).unwrap();
    (facing, parts)
}

fn from_above() -> Camera {
    Camera::Orthographic { forward: dvec3(0.1, 0.2, -1.0), target: None, up: DVec3::Y }
}

/// How many triangles belong to how many convex parts.
fn counts(mesh: &Mesh) -> (usize, usize) {
    let (_, parts) = found(mesh, &from_above());
    parts.map_or((0, 0), |parts| {
        (parts.part_of.iter().filter(|&&part| part != NONE).count(), parts.parts.len())
    })
}

/// Corners of a box, and its triangles, outward.
fn cuboid(at: DVec3, size: DVec3) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let bit = |corner: u32, axis: u32| f64::from(corner >> axis & 1);
    let corner = |i| at + size * dvec3(bit(i, 0), bit(i, 1), bit(i, 2));
    const QUADS: [[u32; 4]; 6] =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = QUADS.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    ((0..8).map(corner).collect(), halves.collect())
}

/// A tip above and one below a closed polygon.
fn double_pyramid(ring: &[[f64; 2]], tips: [f64; 2]) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let count = ring.len() as u32;
    let mut vertices: Vec<DVec3> = ring.iter().map(|&[x, y]| dvec3(x, y, 0.0)).collect();
    vertices.extend(tips.map(|z| dvec3(0.0, 0.0, z)));
    let sides = (0..count).flat_map(|i| {
        let next = (i + 1) % count;
        [[i, next, count], [next, i, count + 1]]
    });
    (vertices, sides.collect())
}

/// `count` points on a circle, `turns` times around, every one at its place.
fn star(count: usize, turns: f64) -> Vec<[f64; 2]> {
    let angle = |i| std::f64::consts::TAU * turns * i as f64 / count as f64;
    (0..count).map(|i| [angle(i).cos(), angle(i).sin()]).collect()
}

/// Several meshes in one.
fn together(parts: &[(Vec<DVec3>, Vec<[u32; 3]>)]) -> Mesh {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for (own, corners) in parts {
        let first = vertices.len() as u32;
        vertices.extend(own);
        triangles.extend(corners.iter().map(|corners| corners.map(|corner| first + corner)));
    }
    mesh(&vertices, &triangles)
}

#[test]
fn a_box_is_convex_whichever_way_it_is_wound() {
    let (vertices, mut triangles) = cuboid(DVec3::ZERO, DVec3::ONE);
    assert_eq!(counts(&mesh(&vertices, &triangles)), (12, 1));
    triangles.iter_mut().for_each(|corners| corners.reverse());
    assert_eq!(counts(&mesh(&vertices, &triangles)), (12, 1));
    // One face the other way round.
    triangles[3].reverse();
    assert_eq!(counts(&mesh(&vertices, &triangles)), (0, 0));
    // A face is missing.
    assert_eq!(counts(&mesh(&vertices, &triangles[..11])), (0, 0));
}

#[test]
fn a_flat_face_may_have_corners_inside() {
    let (mut vertices, mut triangles) = cuboid(DVec3::ZERO, DVec3::ONE);
    // The first face, of two triangles, becomes four.
    triangles.drain(..2);
    vertices.push(dvec3(0.25, 0.5, 0.0));
    triangles.extend([[0, 2, 8], [2, 3, 8], [3, 1, 8], [1, 0, 8]]);
    assert_eq!(counts(&mesh(&vertices, &triangles)), (14, 1));
    vertices[8].z = 0.001;
    assert_eq!(counts(&mesh(&vertices, &triangles)), (0, 0));
    vertices[8].z = -0.001;
    assert_eq!(counts(&mesh(&vertices, &triangles)), (14, 1));
}

#[test]
fn what_goes_around_twice_is_not_convex() {
    // All folds bulge, and the middle is inside of all planes.
    let (vertices, triangles) = double_pyramid(&star(5, 2.0), [1.0, -1.0]);
    assert_eq!(counts(&mesh(&vertices, &triangles)), (0, 0));
    let (vertices, triangles) = double_pyramid(&star(5, 1.0), [1.0, -1.0]);
    assert_eq!(counts(&mesh(&vertices, &triangles)), (10, 1));
}

#[test]
fn a_dented_part_and_a_part_without_volume_are_not_convex() {
    let (vertices, triangles) = double_pyramid(&star(5, 1.0), [1.0, 0.5]);
    assert_eq!(counts(&mesh(&vertices, &triangles)), (0, 0));
    let (vertices, triangles) = double_pyramid(&star(5, 1.0), [0.0, 1.0]);
    assert_eq!(counts(&mesh(&vertices, &triangles)), (10, 1));
    let flat = [DVec3::ZERO, DVec3::X, DVec3::Y, dvec3(1.0, 1.0, 0.0)];
    assert_eq!(counts(&mesh(&flat, &[[0, 1, 2], [1, 3, 2], [0, 2, 1], [1, 2, 3]])), (0, 0));
}

#[test]
fn parts_are_told_apart() {
    let boxes = [
        cuboid(DVec3::ZERO, DVec3::ONE),
        cuboid(dvec3(0.5, 0.5, 0.5), DVec3::ONE),
        cuboid(dvec3(5.0, 0.0, 0.0), dvec3(1.0, 2.0, 3.0)),
    ];
    let mesh = together(&boxes);
    let (_, parts) = found(&mesh, &from_above());
    let parts = parts.unwrap();
    for s in 0..36 {
        for t in 0..36 {
            assert_eq!(parts.are_together([s, t]), s / 12 == t / 12);
        }
    }
    // With a corner in common, none of the two is taken for convex.
    let touching = [boxes[0].clone(), cuboid(DVec3::ONE, DVec3::ONE), boxes[2].clone()];
    assert_eq!(counts(&together(&touching)), (12, 1));
}

#[test]
fn edges_at_the_back_are_hidden_where_the_eye_is_outside() {
    let (vertices, triangles) = cuboid(DVec3::ZERO, DVec3::splat(2.0));
    let mesh = mesh(&vertices, &triangles);
    let hidden = |camera: &Camera| {
        let (facing, parts) = found(&mesh, camera);
        let parts = parts.unwrap();
        let edges = 0..mesh.edges().len() as u32;
        edges.filter(|&edge| parts.hide_own_edge(&mesh, &facing, edge)).count()
    };
    // Three edges of the corner that is farthest, and three diagonals.
    assert_eq!(hidden(&from_above()), 6);
    let from = |eye: DVec3, near: f64| Camera::Perspective {
        eye,
        target: Some(DVec3::splat(50.0)),
        up: DVec3::Z,
        near: Some(near),
        fov_y_degrees: 60.0,
    };
    assert_eq!(hidden(&from(DVec3::splat(-5.0), 0.1)), 6);
    // The nearest corner is cut off.
    assert_eq!(hidden(&from(DVec3::splat(-5.0), 9.0)), 0);
    assert_eq!(hidden(&from(DVec3::ONE, 0.1)), 0);
}

/// Whether all vertices lie on the inner side of all triangles' planes.
fn is_convex_by_force(mesh: &Mesh) -> bool {
    let eye = from_above().view(mesh.bounds()).unwrap().eye;
    let points = Points::new(mesh.vertices(), eye, None);
    let predicates = Predicates::<Exact>::new(&points);
    let vertices = 0..mesh.vertices().len() as u32;
    let signs: Vec<Sign> = (mesh.triangles().iter())
        .flat_map(|&corners| vertices.clone().map(move |vertex| (corners, vertex)))
        .map(|(corners, vertex)| predicates.plane(corners, vertex))
        .collect();
    [Sign::Positive, Sign::Negative].into_iter().any(|sign| !signs.contains(&sign))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    #[test]
    fn parts_are_convex_as_by_force(moves in prop::collection::vec(-2..3_i32, 24), far in any::<bool>()) {
        let (mut vertices, triangles) = cuboid(DVec3::ZERO, DVec3::splat(6.0));
        for (vertex, moved) in vertices.iter_mut().zip(moves.chunks(3)) {
            *vertex += dvec3(moved[0].into(), moved[1].into(), moved[2].into());
            // An offset that floats do not hold well.
            *vertex += if far { DVec3::splat(1e15) } else { DVec3::ZERO };
        }
        let mesh = mesh(&vertices, &triangles);
        let is_convex = counts(&mesh) == (12, 1);
        // So little moved, nothing of it goes around twice.
        prop_assert_eq!(is_convex, is_convex_by_force(&mesh));
    }
}
