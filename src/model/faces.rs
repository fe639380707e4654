//! From the faces of a file to triangles.
//!
//! Algorithms work on triangles that know their face. A polygon becomes
//! the triangles of its triangulation; their inner edges are no lines of
//! the model. What encloses no area is set aside and counted. Of faces that
//! are the same, up to where their rings begin and which way they run, only the
//! first is kept; they are known by their triangles, which depend on nothing
//! else. Outlines that cross themselves are handed back, to be mended.

use super::crossed::{CrossedFace, CrossedFaces, Taken};
use super::mesh::MeshReport;
use super::{Edges, Soup};
use crate::kernel::predicates::are_collinear;
use crate::polygon::{TriangulationError, triangulate, triangulate_along, uncross};
use crate::run::{Run, map_chunks, map_small};
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use std::ops::Range;

/// Triangles of all objects with the face of each.
#[derive(Debug, Default)]
pub(super) struct Triangles {
    pub(super) corners: Vec<[u32; 3]>,
    /// Global face number of each triangle; absent if triangle `i` is face `i`.
    pub(super) faces: Option<Vec<u32>>,
    /// Whether a face has more than one triangle.
    pub(super) polygonal: bool,
    /// Faces without area.
    zero_area: usize,
    /// Faces that do not lie in one plane, ascending.
    nonplanar: Vec<u32>,
    /// Faces that crossed themselves, and are taken some way, ascending.
    pub(super) crossed: Vec<u32>,
    /// Faces that cross themselves.
    pub(super) crossing: Vec<CrossedFace>,
}

/// All that faces are made of.
pub(super) struct Source<'a> {
    pub(super) soups: &'a [Soup],
    /// The first old vertex of each soup.
    pub(super) first_vertex: &'a [u32],
    /// The welding.
    pub(super) new_of_old: &'a [u32],
    /// The new positions.
    pub(super) vertices: &'a [DVec3],
    /// What is known of faces that cross themselves.
    pub(super) crossed: &'a CrossedFaces,
}

/// Triangles whose corners are checked in one go.
const PART: usize = 1 << 16;

/// Faces that are cut in one go.
const FACES: usize = 1 << 11;

/// Whether there are polygons other than triangles.
pub(super) fn are_polygonal(soups: &[Soup]) -> bool {
    soups.iter().any(|soup| soup.faces.as_triangles().is_none())
}

impl Triangles {
    /// Cuts the faces of all soups into triangles.
    pub(super) fn of(source: &Source<'_>, run: &Run<'_>) -> Self {
        if !are_polygonal(source.soups) {
            return Self::of_plain_triangles(source);
        }
        let mut triangles = Triangles { polygonal: true, ..Default::default() };
        let mut first = 0;
        for (number, soup) in source.soups.iter().enumerate() {
            let parts = map_chunks(soup.faces.len(), FACES, |part| {
                let mut cutter = Cutter::new(source, number, first);
                for face in part {
                    if run.is_stopped() {
                        break;
                    }
                    cutter.add(face, run);
                }
                cutter.triangles
            });
            parts.into_iter().for_each(|part| triangles.append(part));
            first += soup.faces.len() as u32;
        }
        triangles
    }

    /// The common case. O(n).
    fn of_plain_triangles(source: &Source<'_>) -> Self {
        let mut found = Triangles::default();
        let mut face_number = 0;
        for (soup, &first) in source.soups.iter().zip(source.first_vertex) {
            let list = soup.faces.as_triangles().unwrap_or(&[]);
            let corner = |i: usize| source.new_of_old[(first + list[i]) as usize];
            let all: Vec<[u32; 3]> = map_small(list.len() / 3, |i| {
                [corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)]
            });
            let flat = map_chunks(all.len(), PART, |part| {
                part.filter(|&i| is_flat(all[i], source.vertices)).collect::<Vec<_>>()
            });
            let flat = flat.concat();
            found.zero_area += flat.len();
            if !flat.is_empty() && found.faces.is_none() {
                found.faces = Some((0..found.corners.len() as u32).collect());
            }
            let count = all.len() as u32;
            match &mut found.faces {
                None if found.corners.is_empty() => found.corners = all,
                None => found.corners.extend_from_slice(&all),
                Some(faces) => {
                    let mut flat = flat.into_iter().peekable();
                    for (i, &triangle) in all.iter().enumerate() {
                        if flat.next_if_eq(&i).is_none() {
                            found.corners.push(triangle);
                            faces.push(face_number + i as u32);
                        }
                    }
                }
            }
            face_number += count;
        }
        found
    }

    fn append(&mut self, other: Self) {
        self.corners.extend(other.corners);
        self.faces.get_or_insert_default().extend(other.faces.into_iter().flatten());
        self.zero_area += other.zero_area;
        self.nonplanar.extend(other.nonplanar);
        self.crossed.extend(other.crossed);
        self.crossing.extend(other.crossing);
    }

    fn face_of(&self, triangle: u32) -> u32 {
        self.faces.as_ref().map_or(triangle, |faces| faces[triangle as usize])
    }

    /// The triangles of a face, which follow one another.
    fn of_face(&self, face: u32) -> Range<usize> {
        match &self.faces {
            None => face as usize..face as usize + 1,
            Some(faces) => {
                let start = faces.partition_point(|&other| other < face);
                start..start + faces[start..].partition_point(|&other| other == face)
            }
        }
    }

    /// Drops faces that have the triangles of an earlier one and no others.
    /// Returns how many there were. O(n), but for edges of many triangles.
    pub(super) fn drop_duplicates(&mut self, edges: &Edges) -> usize {
        // The first of all triangles with the same corners, for those that have twins.
        let twins = self.twins(edges);
        let first_of: FxHashMap<u32, u32> =
            twins.iter().map(|&[twin, first]| (twin, first)).collect();
        let mut faces: Vec<u32> = twins.as_flattened().iter().map(|&t| self.face_of(t)).collect();
        faces.sort_unstable();
        faces.dedup();
        let mut seen = FxHashSet::default();
        let is_repeated = |&face: &u32| {
            let first = |triangle| first_of.get(&triangle).copied().unwrap_or(triangle);
            let mut triangles: Vec<u32> = self.of_face(face).map(|t| first(t as u32)).collect();
            triangles.sort_unstable();
            !seen.insert(triangles)
        };
        let dropped: Vec<u32> = faces.into_iter().filter(is_repeated).collect();
        if dropped.is_empty() {
            return 0;
        }
        let is_kept = |face: u32| dropped.binary_search(&face).is_err();
        let all = 0..self.corners.len() as u32;
        let kept: Vec<u32> = all.filter(|&triangle| is_kept(self.face_of(triangle))).collect();
        let faces = kept.iter().map(|&triangle| self.face_of(triangle)).collect();
        self.corners = kept.iter().map(|&triangle| self.corners[triangle as usize]).collect();
        self.faces = Some(faces);
        self.nonplanar.retain(|&face| is_kept(face));
        self.crossed.retain(|&face| is_kept(face));
        dropped.len()
    }

    /// Triangles with the corners of an earlier one, each with the first that
    /// has them. Such twins share edges on which they have the same third corner.
    fn twins(&self, edges: &Edges) -> Vec<[u32; 2]> {
        let third = |triangle: u32, [a, b]: [u32; 2]| {
            self.corners[triangle as usize].iter().copied().find(|&x| x != a && x != b).unwrap_or(a)
        };
        let parts = map_chunks(edges.len(), 1 << 14, |part| {
            let mut twins = Vec::new();
            for edge in part {
                let (ends, list) = (edges.ends(edge as u32), edges.triangles(edge as u32));
                for (i, &later) in list.iter().enumerate().skip(1) {
                    let own = third(later, ends);
                    let first = list[..i].iter().find(|&&earlier| third(earlier, ends) == own);
                    twins.extend(first.map(|&first| [later, first]));
                }
            }
            twins
        });
        let mut twins = parts.concat();
        twins.sort_unstable();
        twins.dedup();
        twins
    }

    /// Notes what was set aside.
    pub(super) fn report(&self, report: &mut MeshReport) {
        report.zero_area_faces = self.zero_area;
        report.nonplanar_faces = self.nonplanar.len();
        report.crossed_faces = self.crossed.len();
    }
}

/// Whether a triangle encloses no area.
fn is_flat([a, b, c]: [u32; 3], vertices: &[DVec3]) -> bool {
    let [p, q, r] = [a, b, c].map(|i| vertices[i as usize]);
    a == b || b == c || c == a || are_collinear(p, q, r)
}

/// Cuts faces of one soup, one after the other.
struct Cutter<'a> {
    source: &'a Source<'a>,
    soup: usize,
    /// The number of its first face in the scene.
    first_face: u32,
    triangles: Triangles,
    /// The rings at hand, one after the other: old and new vertices, places.
    old: Vec<u32>,
    new: Vec<u32>,
    places: Vec<DVec3>,
    /// Where each of them ends.
    ends: Vec<usize>,
}

impl<'a> Cutter<'a> {
    fn new(source: &'a Source<'a>, soup: usize, first_face: u32) -> Self {
        let triangles = Triangles { faces: Some(Vec::new()), ..Default::default() };
        let (old, new, places, ends) = Default::default();
        Cutter { source, soup, first_face, triangles, old, new, places, ends }
    }

    /// Adds the triangles of a face.
    fn add(&mut self, face: usize, run: &Run<'_>) {
        let number = self.first_face + face as u32;
        let taken = self.source.crossed.get(self.soup, face);
        if taken.is_some() {
            self.triangles.crossed.push(number);
        }
        if taken == Some(Taken::AsLines) {
            return;
        }
        self.read(face);
        let outer = self.ends[0];
        if outer < 3 {
            self.triangles.zero_area += 1;
            return;
        }
        if let [a, b, c] = self.new[..] {
            if is_flat([a, b, c], self.source.vertices) {
                self.triangles.zero_area += 1;
            } else {
                self.push(number, [[a, b, c]]);
            }
            return;
        }
        let result = if self.ends.len() == 1 {
            cut(&[&*self.places], taken)
        } else {
            cut(&self.rings(), taken)
        };
        match result {
            Ok(result) => {
                if !result.is_planar {
                    self.triangles.nonplanar.push(number);
                }
                let corners = result.corners.iter().map(|t| t.map(|i| self.new[i as usize]));
                let corners: Vec<_> = corners.collect();
                self.push(number, corners);
            }
            Err(TriangulationError::ZeroArea) => self.triangles.zero_area += 1,
            Err(_) if taken.is_some() => {}
            Err(_) => {
                let starts = std::iter::once(&0).chain(&self.ends);
                let rings = starts.zip(&self.ends).map(|(&from, &to)| self.old[from..to].to_vec());
                self.triangles.crossing.push(CrossedFace {
                    soup: self.soup,
                    face,
                    rings: rings.collect(),
                    uncrossed: uncross(&self.rings(), run),
                });
            }
        }
    }

    /// Reads the rings of a face, without repeated corners; holes without
    /// area take nothing away and are left out.
    fn read(&mut self, face: usize) {
        let Source { soups, first_vertex, new_of_old, vertices, .. } = *self.source;
        let first = first_vertex[self.soup];
        self.old.clear();
        self.new.clear();
        self.places.clear();
        self.ends.clear();
        for ring in soups[self.soup].faces.rings(face) {
            let start = self.new.len();
            for &old in ring {
                let new = new_of_old[(first + old) as usize];
                if self.new.len() == start || self.new.last() != Some(&new) {
                    self.old.push(old);
                    self.new.push(new);
                }
            }
            while self.new.len() > start + 1 && self.new[start] == self.new[self.new.len() - 1] {
                self.old.pop();
                self.new.pop();
            }
            if !self.ends.is_empty() && self.new.len() < start + 3 {
                self.old.truncate(start);
                self.new.truncate(start);
                continue;
            }
            self.ends.push(self.new.len());
        }
        self.places.extend(self.new.iter().map(|&new| vertices[new as usize]));
    }

    fn rings(&self) -> Vec<&[DVec3]> {
        let starts = std::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).map(|(&from, &to)| &self.places[from..to]).collect()
    }

    fn push(&mut self, face: u32, corners: impl IntoIterator<Item = [u32; 3]>) {
        let before = self.triangles.corners.len();
        self.triangles.corners.extend(corners);
        let count = self.triangles.corners.len() - before;
        let faces = self.triangles.faces.get_or_insert_default();
        faces.extend(std::iter::repeat_n(face, count));
    }
}

fn cut(
    rings: &[&[DVec3]],
    taken: Option<Taken>,
) -> Result<crate::polygon::Triangles, TriangulationError> {
    match taken {
        Some(Taken::Along(axis)) => triangulate_along(axis, rings),
        _ => triangulate(rings),
    }
}
