use super::*;
use crate::model::{Faces, Soup};

/// Vertices and faces.
type Object<'a> = (&'a [[f64; 3]], &'a [&'a [u32]]);

fn mesh(objects: &[Object<'_>]) -> Mesh {
    let soups = objects.iter().map(|(vertices, faces)| {
        let mut list = Faces::default();
        for face in *faces {
            list.push(face, []);
        }
        let vertices = vertices.iter().map(|&p| DVec3::from_array(p)).collect();
        Soup { vertices, faces: list, ..Soup::default() }
    });
    Mesh::new(soups.collect(), None).unwrap()
}

fn topology(mesh: &Mesh) -> Topology {
    Topology::of(mesh, &FeatureOptions::default(), &Run::default()).unwrap()
}

const CUBE: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
    [0.0, 1.0, 1.0],
];

const SIDES: [&[u32]; 6] =
    [&[0, 3, 2, 1], &[4, 5, 6, 7], &[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]];

#[test]
fn a_cube_is_closed_and_has_twelve_creases() {
    let found = topology(&mesh(&[(&CUBE, &SIDES)]));
    let expected = Topology { crease_edges: 12, components: 1, ..Topology::default() };
    assert_eq!(found, expected);
    assert!(found.is_closed());
}

#[test]
fn a_cube_without_its_lid_is_open_at_four_edges() {
    let found = topology(&mesh(&[(&CUBE, &[SIDES[0], SIDES[2], SIDES[3], SIDES[4], SIDES[5]])]));
    assert_eq!((found.boundary_edges, found.odd_edges, found.crease_edges), (4, 4, 8));
    assert!(!found.is_closed());
    assert!(found.t_junctions.is_empty());
}

#[test]
fn a_turned_face_is_inconsistent_at_all_its_edges() {
    let mut sides = SIDES;
    sides[1] = &[7, 6, 5, 4];
    let found = topology(&mesh(&[(&CUBE, &sides)]));
    assert_eq!(found.inconsistent_edges, 4);
    assert!(found.is_closed(), "winding is not what closes a surface");
}

#[test]
fn objects_are_components_of_their_own_even_where_they_touch() {
    let found = topology(&mesh(&[(&CUBE, &SIDES), (&CUBE, &SIDES)]));
    assert_eq!((found.components, found.non_manifold_edges), (2, 0));
}

#[test]
fn triangles_that_share_one_corner_are_two_components() {
    let vertices = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]];
    let found = topology(&mesh(&[(&vertices, &[&[0, 1, 2], &[0, 3, 4]])]));
    assert_eq!((found.components, found.boundary_edges), (2, 6));
}

#[test]
fn three_pages_of_a_book_meet_in_a_non_manifold_edge() {
    let vertices = [[0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]];
    let found = topology(&mesh(&[(&vertices, &[&[0, 1, 2], &[0, 1, 3], &[0, 1, 4]])]));
    assert_eq!((found.non_manifold_edges, found.boundary_edges, found.components), (1, 6, 1));
    assert_eq!(found.odd_edges, 7);
}

/// A triangle above an edge from (0, 0, 0) to (3, 1, 0) and another below
/// that ends at `tip`.
fn against_an_edge(tip: [f64; 3]) -> Vec<TJunction> {
    let vertices =
        [[0.0; 3], [3.0, 1.0, 0.0], [0.0, 5.0, 0.0], tip, [0.0, -5.0, 0.0], [9.0, -5.0, 0.0]];
    topology(&mesh(&[(&vertices, &[&[0, 1, 2], &[3, 4, 5]])])).t_junctions
}

#[test]
fn a_vertex_strictly_inside_a_boundary_edge_is_a_t_junction_to_the_last_bit() {
    assert_eq!(against_an_edge([1.5, 0.5, 0.0]), [TJunction { vertex: 3, edge: 0 }]);
    assert_eq!(against_an_edge([1.5, 0.5_f64.next_down(), 0.0]), []);
    assert_eq!(against_an_edge([1.5, 0.5, f64::MIN_POSITIVE]), []);
    assert_eq!(against_an_edge([3.0, 1.0, 0.0]), [], "ends are common vertices");
    assert_eq!(against_an_edge([6.0, 2.0, 0.0]), [], "beyond the end");
}

#[test]
fn a_vertex_of_another_object_makes_no_t_junction() {
    let upper = [[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    let lower = [[1.0, 0.0, 0.0], [0.0, -2.0, 0.0], [2.0, -2.0, 0.0]];
    let found = topology(&mesh(&[(&upper, &[&[0, 1, 2]]), (&lower, &[&[0, 1, 2]])]));
    assert!(found.t_junctions.is_empty());
}

#[test]
fn faces_that_cross_are_found_and_faces_that_touch_are_not() {
    let flat = [[-1.0, -1.0, 0.0], [2.0, -1.0, 0.0], [-1.0, 2.0, 0.0]];
    let crossing = [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [0.5, 0.0, 1.0]];
    let touching = crossing.map(|[x, y, z]| [x, y, z + 1.0]);
    let pairs = |other: &[[f64; 3]]| {
        let scene = mesh(&[(&flat, &[&[0, 1, 2]]), (other, &[&[0, 1, 2]])]);
        interpenetrations(&scene, &Run::default()).unwrap()
    };
    assert_eq!(pairs(&crossing), [[0, 1]]);
    assert!(pairs(&touching).is_empty());
}
