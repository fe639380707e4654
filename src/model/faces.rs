//! From the faces of a file to triangles.
//!
//! Algorithms work on triangles that know their face. A polygon becomes
//! the triangles of its triangulation; their inner edges are no lines of
//! the model. What encloses no area is set aside, and of faces with the
//! same vertices in any order only the first is kept; both are counted.

use super::Soup;
use super::mesh::MeshReport;
use crate::kernel::predicates::are_collinear;
use crate::polygon::{TriangulationError, triangulate};
use crate::run::{map_chunks, map_small};
use glam::DVec3;
use rustc_hash::FxHashSet;

/// Triangles of all objects with the face of each.
#[derive(Debug, Default)]
pub(super) struct Triangles {
    pub(super) corners: Vec<[u32; 3]>,
    /// Global face number of each triangle; absent if triangle `i` is face `i`.
    pub(super) faces: Option<Vec<u32>>,
    /// Whether a face has more than one triangle.
    pub(super) polygonal: bool,
}

/// Triangles whose corners are checked in one go.
const PART: usize = 1 << 16;

/// Triangulates the faces of all soups. `first_vertex` is the first old
/// vertex of each soup, `new_of_old` the welding, `vertices` the new positions.
pub(super) fn triangles_of(
    soups: &[Soup],
    first_vertex: &[u32],
    new_of_old: &[u32],
    vertices: &[DVec3],
    report: &mut MeshReport,
) -> Triangles {
    if soups.iter().all(|soup| soup.faces.as_triangles().is_some()) {
        return plain_triangles(soups, first_vertex, new_of_old, vertices, report);
    }
    let mut triangles =
        Triangles { faces: Some(Vec::new()), polygonal: true, ..Default::default() };
    let mut face_number = 0;
    for (soup, &first) in soups.iter().zip(first_vertex) {
        let mut seen = FxHashSet::default();
        for face in 0..soup.faces.len() {
            let corner = |&old: &u32| new_of_old[(first + old) as usize];
            let rings = soup.faces.rings(face).map(|ring| ring.iter().map(corner).collect());
            add_face(&mut triangles, rings.collect(), face_number, vertices, &mut seen, report);
            face_number += 1;
        }
    }
    triangles
}

/// The common case: nothing but triangles. Duplicates are left to
/// [`super::mesh`], which finds them in the adjacency.
fn plain_triangles(
    soups: &[Soup],
    first_vertex: &[u32],
    new_of_old: &[u32],
    vertices: &[DVec3],
    report: &mut MeshReport,
) -> Triangles {
    let mut corners: Vec<[u32; 3]> = Vec::new();
    let mut faces: Option<Vec<u32>> = None;
    let mut face_number = 0;
    for (soup, &first) in soups.iter().zip(first_vertex) {
        let list = soup.faces.as_triangles().unwrap_or(&[]);
        let corner = |i: usize| new_of_old[(first + list[i]) as usize];
        let all: Vec<[u32; 3]> =
            map_small(list.len() / 3, |i| [corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)]);
        let flat = map_chunks(all.len(), PART, |part| {
            part.filter(|&i| is_flat(all[i], vertices)).collect::<Vec<_>>()
        });
        let flat = flat.concat();
        report.zero_area_faces += flat.len();
        if !flat.is_empty() && faces.is_none() {
            faces = Some((0..corners.len() as u32).collect());
        }
        let count = all.len() as u32;
        match &mut faces {
            None if corners.is_empty() => corners = all,
            None => corners.extend_from_slice(&all),
            Some(faces) => {
                let mut flat = flat.into_iter().peekable();
                for (i, &triangle) in all.iter().enumerate() {
                    if flat.next_if_eq(&i).is_none() {
                        corners.push(triangle);
                        faces.push(face_number + i as u32);
                    }
                }
            }
        }
        face_number += count;
    }
    Triangles { corners, faces, polygonal: false }
}

/// Whether a triangle encloses no area.
fn is_flat([a, b, c]: [u32; 3], vertices: &[DVec3]) -> bool {
    let [p, q, r] = [a, b, c].map(|i| vertices[i as usize]);
    a == b || b == c || c == a || are_collinear(p, q, r)
}

/// Adds the triangles of one face given by its rings of new vertices.
fn add_face(
    triangles: &mut Triangles,
    mut rings: Vec<Vec<u32>>,
    number: u32,
    vertices: &[DVec3],
    seen: &mut FxHashSet<Vec<u32>>,
    report: &mut MeshReport,
) {
    for ring in &mut rings {
        ring.dedup();
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
    }
    // A hole without area takes nothing away.
    let mut rings: Vec<Vec<u32>> = rings
        .into_iter()
        .enumerate()
        .filter(|(i, ring)| *i == 0 || ring.len() > 2)
        .map(|(_, ring)| ring)
        .collect();
    let outer = &rings[0];
    if outer.len() < 3 || (outer.len() == 3 && is_flat([outer[0], outer[1], outer[2]], vertices)) {
        report.zero_area_faces += 1;
        return;
    }
    let mut key = rings.concat();
    key.sort_unstable();
    if !seen.insert(key) {
        report.duplicate_faces += 1;
        return;
    }
    let mut push = |triangle| {
        triangles.corners.push(triangle);
        if let Some(faces) = &mut triangles.faces {
            faces.push(number);
        }
    };
    if rings.len() == 1 && rings[0].len() == 3 {
        push([rings[0][0], rings[0][1], rings[0][2]]);
        return;
    }
    // The same triangles wherever the outline begins.
    if let [ring] = &mut rings[..] {
        let place = |corner: &usize| vertices[ring[*corner] as usize].to_array();
        let least = (0..ring.len())
            .min_by(|a, b| place(a).partial_cmp(&place(b)).unwrap_or(std::cmp::Ordering::Equal));
        ring.rotate_left(least.unwrap_or(0));
    }
    let positions: Vec<Vec<DVec3>> = rings
        .iter()
        .map(|ring| ring.iter().map(|&vertex| vertices[vertex as usize]).collect())
        .collect();
    match triangulate(&positions) {
        Ok(result) => {
            report.nonplanar_faces += usize::from(!result.is_planar);
            let corners = rings.concat();
            result.corners.iter().for_each(|t| push(t.map(|i| corners[i as usize])));
        }
        Err(TriangulationError::ZeroArea) => report.zero_area_faces += 1,
        Err(_) => {
            // No simple polygon: a fan at least draws its edges.
            report.crossed_faces += 1;
            let outer = rings.swap_remove(0);
            for i in 1..outer.len() - 1 {
                let triangle = [outer[0], outer[i], outer[i + 1]];
                if !is_flat(triangle, vertices) {
                    push(triangle);
                }
            }
        }
    }
}
