use super::*;
use crate::model::{Faces as SoupFaces, Soup};
use glam::dvec3;

fn object(points: &[[f64; 3]], faces: &[&[u32]]) -> Soup {
    let mut list = SoupFaces::default();
    faces.iter().for_each(|face| list.push(face, []));
    let vertices = points.iter().map(|&p| DVec3::from(p)).collect();
    Soup { vertices, faces: list, ..Soup::default() }
}

/// Each stretch: object, ends as positions along x, numbers of own and of all
/// sides.
fn stretches(soups: Vec<Soup>) -> Vec<(u32, [f64; 2], usize, usize)> {
    let mesh = Mesh::new(soups, None).unwrap();
    let mut found: Vec<_> = (0..)
        .zip(mesh.borders().stretches())
        .map(|(i, stretch)| {
            let [a, b] = stretch.ends.map(|vertex| mesh.vertices()[vertex as usize].x);
            let object = mesh.object_of_vertex(mesh.edges().ends(stretch.edge)[0]);
            let [own, all] = [false, true].map(|all| mesh.borders().sides(i, all).len());
            (object, [a.min(b), a.max(b)], own, all)
        })
        .collect();
    found.sort_by(|a, b| a.partial_cmp(b).unwrap());
    found
}

/// A triangle on the x axis with its apex aside.
fn on_axis([from, to]: [f64; 2], apex: [f64; 2]) -> [[f64; 3]; 3] {
    [[from, 0.0, 0.0], [to, 0.0, 0.0], [0.5 * (from + to), apex[0], apex[1]]]
}

fn triangles(sides: &[([f64; 2], [f64; 2])]) -> Soup {
    let points: Vec<_> = sides.iter().flat_map(|&(ends, apex)| on_axis(ends, apex)).collect();
    let faces: Vec<[u32; 3]> =
        (0..sides.len() as u32).map(|i| [0, 1, 2].map(|k| 3 * i + k)).collect();
    object(&points, &faces.iter().map(|face| &face[..]).collect::<Vec<_>>())
}

const UP: [f64; 2] = [1.0, 0.0];
const DOWN: [f64; 2] = [-1.0, 0.0];
const ALOFT: [f64; 2] = [0.0, 1.0];

#[test]
fn one_long_side_against_two_short_ones() {
    let soup = triangles(&[([0.0, 2.0], UP), ([0.0, 1.0], DOWN), ([1.0, 2.0], DOWN)]);
    assert_eq!(stretches(vec![soup]), [(0, [0.0, 1.0], 2, 2), (0, [1.0, 2.0], 2, 2)]);
}

#[test]
fn what_nothing_lies_on_is_a_stretch_of_one_face() {
    let soup = triangles(&[([0.0, 4.0], UP), ([1.0, 2.0], DOWN), ([2.5, 9.0], DOWN)]);
    let expected = [
        (0, [0.0, 1.0], 1, 1),
        (0, [1.0, 2.0], 2, 2),
        (0, [2.0, 2.5], 1, 1),
        (0, [2.5, 4.0], 2, 2),
        (0, [4.0, 9.0], 1, 1),
    ];
    assert_eq!(stretches(vec![soup]), expected);
}

#[test]
fn three_faces_or_more_are_one_stretch_however_they_change() {
    let sides = [([0.0, 4.0], UP), ([0.0, 2.0], DOWN), ([0.0, 3.0], ALOFT), ([2.0, 4.0], DOWN)];
    let expected = [(0, [0.0, 3.0], 4, 4), (0, [3.0, 4.0], 2, 2)];
    assert_eq!(stretches(vec![triangles(&sides)]), expected);
}

#[test]
fn sides_end_to_end_or_apart_are_whole() {
    let soup = triangles(&[([0.0, 1.0], UP), ([1.0, 2.0], DOWN), ([3.0, 4.0], DOWN)]);
    assert_eq!(stretches(vec![soup]), []);
    // Equal sides are one edge, which is no border.
    assert_eq!(stretches(vec![triangles(&[([0.0, 1.0], UP), ([0.0, 1.0], DOWN)])]), []);
}

#[test]
fn two_objects_have_a_seam_where_nothing_else_lies() {
    let one = || triangles(&[([0.0, 2.0], UP)]);
    let other = |to: f64| triangles(&[([0.0, to], DOWN)]);
    let whole = [(0, [0.0, 2.0], 1, 2), (1, [0.0, 2.0], 1, 2)];
    assert_eq!(stretches(vec![one(), other(2.0)]), whole);
    let part = [(0, [0.0, 1.0], 1, 2), (0, [1.0, 2.0], 1, 1), (1, [0.0, 1.0], 1, 2)];
    assert_eq!(stretches(vec![one(), other(1.0)]), part);
    // A third one, or two of one object: things that touch.
    assert_eq!(stretches(vec![one(), other(2.0), triangles(&[([0.0, 2.0], ALOFT)])]), []);
    let folded = triangles(&[([0.0, 2.0], DOWN), ([0.0, 1.0], ALOFT), ([1.0, 2.0], ALOFT)]);
    let own = [(1, [0.0, 1.0], 2, 2), (1, [1.0, 2.0], 2, 2)];
    assert_eq!(stretches(vec![one(), folded]), own);
}

#[test]
fn boxes_that_touch_have_no_borders() {
    let cube = |x: f64| {
        let corner = |i: u32| [x + f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)];
        let points: Vec<_> = (0..8).map(corner).collect();
        let faces: [&[u32]; 6] = [
            &[0, 2, 3, 1],
            &[4, 5, 7, 6],
            &[0, 1, 5, 4],
            &[2, 6, 7, 3],
            &[0, 4, 6, 2],
            &[1, 3, 7, 5],
        ];
        object(&points, &faces)
    };
    assert_eq!(stretches(vec![cube(0.0), cube(1.0)]), []);
}

#[test]
fn lines_that_are_one_in_rounded_numbers_only_are_apart() {
    let third = 1.0_f64 / 3.0;
    let soup = object(
        &[
            [0.0, 0.0, 0.0],
            [3.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
            [1.0, third, 0.0],
            [2.0, 2.0 * third, 0.0],
            [2.0, 0.0, 0.0],
        ],
        &[&[0, 1, 2], &[3, 4, 5]],
    );
    assert_eq!(stretches(vec![soup]), []);
}

#[test]
fn directions_without_a_fingerprint_are_compared_with_all() {
    // The prime of the residues, in steps of it.
    let far = f64::powi(2.0, 61);
    let place = |i: f64| i * (far - 1.0) + i;
    let sides = [([1.0, far], UP), ([0.0, 2.0], DOWN), ([3.0, 7.0], DOWN)];
    let found = stretches(vec![triangles(&sides)]);
    assert_eq!(place(1.0), far);
    assert_eq!(found.iter().filter(|stretch| stretch.2 == 2).count(), 2);
}

#[test]
fn names_are_of_edges_of_the_object() {
    let soups = vec![triangles(&[([0.0, 2.0], UP)]), triangles(&[([1.0, 3.0], DOWN)])];
    let mesh = Mesh::new(soups, None).unwrap();
    let borders = mesh.borders();
    for (i, stretch) in (0..).zip(borders.stretches()) {
        let own = borders.sides(i, false);
        assert_eq!(own.len(), 1);
        assert_eq!(own[0].edge, stretch.edge);
        assert!(borders.of_edge(stretch.edge).any(|part| part == i));
        assert_eq!(borders.is_seam(i), borders.sides(i, true).len() == 2);
        for side in borders.sides(i, true) {
            let [a, b] = stretch.ends.map(|v| mesh.vertices()[v as usize]);
            let [p, q, r] = mesh.triangles()[side.triangle as usize];
            let third = mesh.vertices()[side.third as usize];
            assert!([p, q, r].contains(&side.third));
            // It runs along from the left of its third corner.
            let turn = (b - a).cross(third - a).z > 0.0;
            let [p, q, r] = [p, q, r].map(|v| mesh.vertices()[v as usize]);
            assert_eq!(side.runs_along, turn == ((q - p).cross(r - p).z > 0.0));
            assert_eq!(dvec3(third.x, third.y.abs(), third.z).y, 1.0);
        }
    }
    assert_eq!(borders.stretches().len(), 4);
}
