//! Which edges are lines.
//!
//! Small shapes whose classes of edges are known by counting, closed
//! surfaces whose contours must close, and creases exactly at the threshold,
//! where a rounded angle would decide by accident.

use super::scenes::{Random, cuboid, orthographic, polygons, rounds};
use glam::{DVec3, dvec3};
use proptest::prelude::*;
use std::collections::HashMap;
use umriss::kernel::numbers::Sign;
use umriss::kernel::predicates::Exact;
use umriss::model::{FeatureOptions, LineClass, LineOrigin, Mesh, Soup, View};
use umriss::run::Run;
use umriss::view::PreparedView;
use umriss::visibility::visible_lines;

fn mesh(soups: Vec<Soup>) -> Mesh {
    Mesh::new(soups, None).expect("a mesh")
}

fn options(classes: &[LineClass]) -> FeatureOptions {
    FeatureOptions::default().with_classes(classes)
}

/// The lines that are edges: their ends, the lesser first, and their class.
fn classes(mesh: &Mesh, view: &View, options: &FeatureOptions) -> Vec<([[f64; 3]; 2], LineClass)> {
    let run = Run::default();
    let prepared = PreparedView::new::<Exact>(mesh, view, options, &run).expect("a view");
    let question = prepared.question(true);
    let mut found: Vec<_> = question
        .lines
        .iter()
        .filter_map(|line| {
            let LineOrigin::Edge(edge) = line.origin else {
                return None;
            };
            let ends = mesh.edges().ends(edge).map(|i| mesh.vertices()[i as usize].to_array());
            Some((if ends[0] <= ends[1] { ends } else { [ends[1], ends[0]] }, line.class))
        })
        .collect();
    found.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
    found
}

fn count(list: &[([[f64; 3]; 2], LineClass)], class: LineClass) -> usize {
    list.iter().filter(|line| line.1 == class).count()
}

fn square(z: f64) -> Vec<DVec3> {
    vec![dvec3(0.0, 0.0, z), dvec3(1.0, 0.0, z), dvec3(1.0, 1.0, z), dvec3(0.0, 1.0, z)]
}

const ASKEW: DVec3 = DVec3::new(-3.0, -2.0, -1.0);

#[test]
fn a_cube_shows_three_faces_nine_edges_and_six_contours() {
    let cube = mesh(vec![polygons(&cuboid(DVec3::splat(-1.0), DVec3::ONE), &[])]);
    let view = orthographic(ASKEW);
    let run = Run::default();
    let all = FeatureOptions::default();
    let prepared = PreparedView::new::<Exact>(&cube, &view, &all, &run).expect("a view");
    let facing = prepared.question(true).facing;
    // Two triangles each; the box is wound counter-clockwise from outside.
    assert_eq!(facing.iter().filter(|&&sign| sign == Sign::Positive).count(), 6);
    assert_eq!(facing.iter().filter(|&&sign| sign == Sign::Negative).count(), 6);
    let lines = classes(&cube, &view, &all);
    assert_eq!(count(&lines, LineClass::Contour), 6);
    assert_eq!(count(&lines, LineClass::Crease), 6);
    let drawn = visible_lines(&cube, &view, &all, true, &run).expect("lines");
    assert_eq!(drawn.pieces.iter().filter(|piece| piece.is_visible()).count(), 9);
    assert_eq!(drawn.pieces.iter().filter(|piece| piece.invisibility == 2).count(), 0);
    assert_eq!(drawn.pieces.iter().filter(|piece| piece.invisibility == 1).count(), 3);
}

/// A ring of tubes: `long` times `short` quadrilaterals, rounded.
fn torus(long: usize, short: usize) -> Vec<Vec<DVec3>> {
    let corner = |i: usize, j: usize| {
        let a = (i % long) as f64 * std::f64::consts::TAU / long as f64;
        let b = (j % short) as f64 * std::f64::consts::TAU / short as f64;
        let radius = 3.0 + b.cos();
        dvec3(radius * a.cos(), radius * a.sin(), b.sin())
    };
    let cells = (0..long).flat_map(|i| (0..short).map(move |j| (i, j)));
    cells
        .map(|(i, j)| vec![corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)])
        .collect()
}

#[test]
fn contours_of_closed_surfaces_close() {
    let cube = cuboid(DVec3::ZERO, dvec3(3.0, 2.0, 1.0));
    let tips = [dvec3(1.0, 2.0, 3.0), dvec3(-4.0, 0.0, 1.0), dvec3(2.0, -3.0, 0.0)];
    let tetrahedron: Vec<Vec<DVec3>> = vec![
        vec![tips[0], tips[1], tips[2]],
        vec![DVec3::ZERO, tips[0], tips[1]],
        vec![DVec3::ZERO, tips[1], tips[2]],
        vec![DVec3::ZERO, tips[2], tips[0]],
    ];
    let shapes = [cube, tetrahedron, torus(12, 7)].map(|faces| mesh(vec![polygons(&faces, &[])]));
    let only = options(&[LineClass::Contour]);
    let mut random = Random(1);
    let (mut seen, run) = (0, Run::default());
    for round in 0..rounds(1000) {
        let shape = &shapes[round as usize % shapes.len()];
        let view = orthographic(random.point());
        let prepared = PreparedView::new::<Exact>(shape, &view, &only, &run).expect("a view");
        let question = prepared.question(true);
        if question.facing.contains(&Sign::Zero) {
            continue;
        }
        let mut degrees: HashMap<u32, u32> = HashMap::new();
        for line in question.lines {
            let LineOrigin::Edge(edge) = line.origin else { panic!("{line:?}") };
            for end in shape.edges().ends(edge) {
                *degrees.entry(end).or_default() += 1;
            }
        }
        assert!(!degrees.is_empty());
        assert!(degrees.values().all(|degree| degree % 2 == 0), "round {round}: {degrees:?}");
        seen += 1;
    }
    assert!(seen > 900, "{seen}");
}

/// Two triangles at an edge, in every order of faces and corners; whether
/// the edge is a crease at these degrees.
fn is_crease(ends: [DVec3; 2], thirds: [DVec3; 2], degrees: f64) -> bool {
    let wanted = options(&[LineClass::Crease]).with_crease_degrees(degrees);
    let view = orthographic(dvec3(0.3, 0.5, -0.7));
    let answers: Vec<bool> = (0..24)
        .map(|order| {
            let mut faces = thirds.map(|third| vec![ends[0], ends[1], third]);
            faces[0].rotate_left(order % 3);
            if order & 4 != 0 {
                faces[1].reverse();
            }
            if order & 8 != 0 {
                faces.reverse();
            }
            if order & 1 != 0 {
                faces[0].reverse();
            }
            !classes(&mesh(vec![polygons(&faces, &[])]), &view, &wanted).is_empty()
        })
        .collect();
    assert!(answers.iter().all(|&answer| answer == answers[0]), "{answers:?}");
    answers[0]
}

#[test]
fn a_fold_at_the_threshold_is_no_crease() {
    let axis = [DVec3::ZERO, DVec3::Z * 7.0];
    // Not even for lengths that have no exact squares.
    for scale in [1.0, 0.1, 1e-9, 1e9] {
        let right = [dvec3(3.0, 0.0, 1.0) * scale, dvec3(0.0, 0.7, 2.0) * scale];
        assert!(!is_crease(axis.map(|end| end * scale), right, 90.0));
        assert!(is_crease(axis.map(|end| end * scale), right, 89.999_999_999));
    }
    // Less than a right angle between the faces is a sharper fold.
    assert!(is_crease(axis, [dvec3(3.0, 1e-15, 0.0), dvec3(0.0, 0.7, 2.0)], 90.0));
    assert!(!is_crease(axis, [dvec3(3.0, -1e-15, 0.0), dvec3(0.0, 0.7, 2.0)], 90.0));
    // Faces at exactly 60 and 120 degrees in whole numbers.
    let slanted = [DVec3::ZERO, dvec3(1.0, -1.0, -1.0)];
    let (u, w) = (dvec3(1.0, -1.0, 2.0), dvec3(-1.0, -2.0, 1.0));
    assert!(!is_crease(slanted, [u, w], 120.0));
    assert!(is_crease(slanted, [u, w], 119.999_999_999));
    assert!(!is_crease(slanted, [u, -w], 60.0));
    assert!(is_crease(slanted, [u, -w], 59.999_999_999));
}

#[test]
fn flat_is_no_crease_and_folded_back_is_one() {
    let axis = [DVec3::ZERO, DVec3::X];
    assert!(!is_crease(axis, [dvec3(0.3, 1.0, 0.0), dvec3(0.9, -2.0, 0.0)], 0.0));
    assert!(is_crease(axis, [dvec3(0.3, 1.0, 0.0), dvec3(0.9, -2.0, 1e-300)], 0.0));
    // A fold of 180 degrees exceeds all that is less, and not itself.
    assert!(is_crease(axis, [dvec3(0.3, 1.0, 0.0), dvec3(0.9, 2.0, 0.0)], 179.0));
    assert!(!is_crease(axis, [dvec3(0.3, 1.0, 0.0), dvec3(0.9, 2.0, 0.0)], 180.0));
}

#[test]
fn borders_and_fans_have_their_classes() {
    let view = orthographic(ASKEW);
    let all = options(&LineClass::ALL);
    let open = mesh(vec![polygons(&[square(0.0)], &[])]);
    let lines = classes(&open, &view, &all);
    // The diagonal is not even a mesh line.
    assert_eq!((lines.len(), count(&lines, LineClass::Boundary)), (4, 4));
    let spine = [DVec3::ZERO, DVec3::Z];
    let pages = [DVec3::X, DVec3::Y, dvec3(-1.0, -1.0, 0.0)];
    let book = pages.map(|page| vec![spine[0], spine[1], page]);
    let lines = classes(&mesh(vec![polygons(&book, &[])]), &view, &all);
    assert_eq!(count(&lines, LineClass::NonManifold), 1);
    assert_eq!(count(&lines, LineClass::Boundary), 6);
}

#[test]
fn faces_of_different_objects_share_no_vertex() {
    let [a, b] = [1.0, -1.0].map(|y| vec![DVec3::ZERO, DVec3::X, dvec3(0.0, y, 0.0)]);
    let apart = mesh(vec![polygons(&[a], &[]), polygons(&[b], &[])]);
    assert_eq!(apart.vertices().len(), 6);
    // But what lies on both sides of their seam says whether it is a line.
    let lines = classes(&apart, &orthographic(-DVec3::Z), &options(&LineClass::ALL));
    assert_eq!(count(&lines, LineClass::Boundary), 4);
    let seams = options(&LineClass::ALL).with_seams(true);
    let view = orthographic(-DVec3::Z);
    let prepared = PreparedView::new::<Exact>(&apart, &view, &seams, &Run::default());
    let prepared = prepared.expect("a view");
    let lines = prepared.question(true).lines;
    assert_eq!(lines.iter().filter(|line| line.class == LineClass::Boundary).count(), 6);
}

#[test]
fn duplicates_and_faces_without_area_are_no_neighbours() {
    let face = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
    let turned = vec![DVec3::Y, DVec3::X, DVec3::ZERO];
    let sliver = vec![DVec3::ZERO, DVec3::X * 0.5, DVec3::X];
    let doubled = mesh(vec![polygons(&[face, turned, sliver], &[])]);
    assert_eq!(doubled.report().duplicate_faces, 1);
    assert_eq!(doubled.report().zero_area_faces, 1);
    let lines = classes(&doubled, &orthographic(-DVec3::Z), &options(&LineClass::ALL));
    assert_eq!((lines.len(), count(&lines, LineClass::Boundary)), (3, 3));
}

#[test]
fn a_bent_quadrilateral_shows_its_fold_only_as_a_contour() {
    let bent = vec![DVec3::ZERO, DVec3::X, dvec3(1.0, 1.0, 1.0), DVec3::Y];
    let bent = mesh(vec![polygons(&[bent], &[])]);
    assert_eq!(bent.report().nonplanar_faces, 1);
    let creases = options(&LineClass::ALL).with_crease_degrees(1.0);
    // From above both triangles turn the same way; along x + y one of them
    // is seen from below.
    let above = classes(&bent, &orthographic(-DVec3::Z), &creases);
    assert_eq!((above.len(), count(&above, LineClass::Contour)), (4, 0));
    let level = classes(&bent, &orthographic(dvec3(1.0, 1.0, 0.1)), &creases);
    let level_more = classes(&bent, &orthographic(dvec3(1.0, -1.0, 0.1)), &creases);
    let contours = count(&level, LineClass::Contour) + count(&level_more, LineClass::Contour);
    assert!(contours > 0, "{level:?} {level_more:?}");
}

#[test]
fn a_smooth_flat_seam_is_drawn_only_as_a_mesh_line() {
    let halves =
        [vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![DVec3::X, dvec3(1.0, 1.0, 0.0), DVec3::Y]];
    let flat = mesh(vec![polygons(&halves, &[])]);
    let view = orthographic(ASKEW);
    assert_eq!(classes(&flat, &view, &FeatureOptions::default()).len(), 4);
    let lines = classes(&flat, &view, &options(&LineClass::ALL));
    assert_eq!((lines.len(), count(&lines, LineClass::Mesh)), (5, 1));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn winding_and_order_do_not_matter(seed in any::<u64>()) {
        let mut random = Random(seed);
        let mut faces: Vec<Vec<DVec3>> =
            (0..8).map(|_| (0..3).map(|_| random.grid_point(3)).collect()).collect();
        let view = orthographic(random.grid_point(3) - dvec3(1.0, 1.0, 3.0));
        let before = classes_of_soup(&faces, &view);
        random.shuffle(&mut faces);
        for face in &mut faces {
            face.rotate_left(random.below(3) as usize);
            if random.one_in(2) {
                face.reverse();
            }
        }
        prop_assert_eq!(before, classes_of_soup(&faces, &view));
    }
}

fn classes_of_soup(faces: &[Vec<DVec3>], view: &View) -> Vec<([[f64; 3]; 2], LineClass)> {
    match Mesh::new(vec![polygons(faces, &[])], None) {
        Ok(mesh) => classes(&mesh, view, &options(&LineClass::ALL)),
        Err(_) => Vec::new(),
    }
}
