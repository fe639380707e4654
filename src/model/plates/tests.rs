use super::*;
use crate::kernel::predicates::{Exact, Eye, Points};
use crate::model::{Faces, Soup};
use glam::{DVec3, dvec3};

fn mesh(points: &[DVec3], triangles: &[[u32; 3]]) -> Mesh {
    let mut faces = Faces::default();
    triangles.iter().for_each(|triangle| faces.push(triangle, []));
    Mesh::new(vec![Soup { vertices: points.to_vec(), faces, ..Soup::default() }], None).unwrap()
}

/// Numbers of triangles of the plates.
fn plates(mesh: &Mesh) -> Vec<usize> {
    let points = Points::new(mesh.vertices(), Eye::Towards(DVec3::Z), None);
    let all: Vec<u32> = (0..mesh.triangles().len() as u32).collect();
    let run = Run::default();
    let found = Plates::find(mesh, &Predicates::<Exact>::new(&points), &all, &run);
    found.map_or(Vec::new(), |found| found.all().iter().map(|it| it.triangles.len()).collect())
}

/// Whole numbers near a circle, in the plane x + y = z.
fn rim(count: u32, turns: f64, widening: f64) -> Vec<DVec3> {
    let corner = |i: u32| {
        let angle = turns * std::f64::consts::TAU * f64::from(i) / f64::from(count);
        let radius = 1e6 * (1.0 + widening * (turns - 1.0) * f64::from(i) / f64::from(count));
        let (x, y) = ((radius * angle.cos()).round(), (radius * angle.sin()).round());
        dvec3(x, y, x + y)
    };
    (0..count).map(corner).collect()
}

fn fan(count: u32) -> Vec<[u32; 3]> {
    (1..count - 1).map(|i| [0, i, i + 1]).collect()
}

#[test]
fn a_fan_and_a_strip_are_plates_however_they_are_wound() {
    let count = 1000;
    let mut triangles = fan(count);
    assert_eq!(plates(&mesh(&rim(count, 1.0, 0.0), &triangles)), [998]);
    triangles.iter_mut().step_by(3).for_each(|triangle| triangle.reverse());
    assert_eq!(plates(&mesh(&rim(count, 1.0, 0.0), &triangles)), [998]);
    // From the ends of the rim towards its middle.
    let (mut low, mut high) = (0, count - 1);
    let mut strip = Vec::new();
    while low + 1 < high {
        strip.push([low, low + 1, high]);
        low += 1;
        if low + 1 < high {
            strip.push([low, high - 1, high]);
            high -= 1;
        }
    }
    assert_eq!(plates(&mesh(&rim(count, 1.0, 0.0), &strip)), [998]);
}

#[test]
fn compact_triangles_and_few_thin_ones_are_none() {
    assert_eq!(plates(&mesh(&rim(40, 1.0, 0.0), &fan(40))), [0; 0]);
    let side = 30;
    let points: Vec<DVec3> =
        (0..side * side).map(|i| dvec3(f64::from(i % side), f64::from(i / side), 0.0)).collect();
    let cells = (0..side - 1).flat_map(|x| (0..side - 1).map(move |y| x + side * y));
    let triangles: Vec<[u32; 3]> =
        cells.flat_map(|i| [[i, i + 1, i + side], [i + 1, i + side + 1, i + side]]).collect();
    assert_eq!(plates(&mesh(&points, &triangles)), [0; 0]);
}

/// Two rims, one after the other, and a ring of triangles between them.
fn ring(count: u32, turns: f64, widening: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let outer = rim(count, turns, widening);
    let mut points: Vec<DVec3> = outer.iter().map(|&p| (p * 0.9).round()).collect();
    points.iter_mut().for_each(|p| p.z = p.x + p.y);
    points.extend(outer);
    let closed = turns == 1.0;
    let steps = if closed { count } else { count - 1 };
    let quad = |i: u32| {
        let j = (i + 1) % count;
        [[i, count + i, count + j], [i, count + j, j]]
    };
    (points, (0..steps).flat_map(quad).collect())
}

#[test]
fn a_ring_has_a_hole_and_a_spiral_that_overlaps_itself_is_none() {
    let (points, triangles) = ring(20_000, 1.0, 0.0);
    assert_eq!(plates(&mesh(&points, &triangles)), [40_000]);
    // One turn and a half. Where it widens too little it lies on itself, though
    // all its triangles are turned alike.
    let (points, triangles) = ring(20_000, 1.5, 0.5);
    assert_eq!(plates(&mesh(&points, &triangles)), [39_998]);
    let (points, triangles) = ring(20_000, 1.5, 0.1);
    assert_eq!(plates(&mesh(&points, &triangles)), [0; 0]);
}

#[test]
fn a_fan_folded_back_onto_itself_is_none() {
    let count = 1000;
    let mut points = rim(count, 1.0, 0.0);
    // The second half comes back over the first.
    let back: Vec<DVec3> =
        points[1..500].iter().rev().map(|&p| p - dvec3(8.0, 3.0, 11.0)).collect();
    points.truncate(500);
    points.extend(back);
    let triangles: Vec<[u32; 3]> = (1..points.len() as u32 - 1).map(|i| [0, i, i + 1]).collect();
    assert_eq!(plates(&mesh(&points, &triangles)), [0; 0]);
}
