//! Faces whose outlines cross themselves.
//!
//! Their crossings become vertices of the object before anything is decided
//! about it, and the mesh is made again. An outline that stays crossed however
//! often its crossings are rounded keeps its edges, as loose lines, and has no
//! surface.

use super::{Faces, Soup};
use crate::polygon::Uncrossed;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// A face whose outline crosses itself.
#[derive(Debug)]
pub(super) struct CrossedFace {
    /// The object, and the number of the face within it.
    pub(super) soup: usize,
    pub(super) face: usize,
    /// The vertices of its rings, numbered within the object.
    pub(super) rings: Vec<Vec<u32>>,
    /// Its rings with corners where they crossed.
    pub(super) uncrossed: Option<Uncrossed>,
}

/// How faces that crossed themselves are taken now.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Taken {
    /// As the triangles that they show along this axis.
    Along(usize),
    /// As their edges.
    AsLines,
}

/// The crossed faces of a scene, by object and face.
#[derive(Debug, Default)]
pub(super) struct CrossedFaces(FxHashMap<(usize, usize), Taken>);

impl CrossedFaces {
    /// How a face is taken, if it crossed itself.
    pub(super) fn get(&self, soup: usize, face: usize) -> Option<Taken> {
        if self.0.is_empty() { None } else { self.0.get(&(soup, face)).copied() }
    }

    /// Leads the faces through their crossings. `positions` are the vertices
    /// of all objects, `first_vertex` the first of each.
    pub(super) fn mend(
        &mut self,
        soups: &mut [Soup],
        positions: &mut Vec<DVec3>,
        first_vertex: &mut [u32],
        found: Vec<CrossedFace>,
    ) {
        let mut of_soup: Vec<Vec<CrossedFace>> = soups.iter().map(|_| Vec::new()).collect();
        for face in found {
            of_soup[face.soup].push(face);
        }
        let mut numbers = soups.iter().filter_map(|soup| soup.vertex_numbers.as_ref()).flatten();
        let mut next_number = numbers.by_ref().max().map_or(0, |&last| last.saturating_add(1));
        let old = std::mem::take(positions);
        for (i, found) in of_soup.into_iter().enumerate() {
            let end = first_vertex.get(i + 1).map_or(old.len(), |&end| end as usize);
            let own = &old[first_vertex[i] as usize..end];
            let start = positions.len();
            positions.extend_from_slice(own);
            self.mend_soup(i, &mut soups[i], found, start, positions);
            if let Some(numbers) = &mut soups[i].vertex_numbers {
                let added = positions.len() - start - own.len();
                numbers.extend((next_number..).take(added));
                next_number = next_number.saturating_add(added as u32);
            }
            first_vertex[i] = start as u32;
        }
    }

    fn mend_soup(
        &mut self,
        number: usize,
        soup: &mut Soup,
        found: Vec<CrossedFace>,
        start: usize,
        positions: &mut Vec<DVec3>,
    ) {
        let mut mended: FxHashMap<usize, Vec<Vec<u32>>> = FxHashMap::default();
        for CrossedFace { face, rings, uncrossed, .. } in found {
            let Some(uncrossed) = uncrossed else {
                self.0.insert((number, face), Taken::AsLines);
                soup.lines.extend(rings.iter().flat_map(|ring| edges_of(ring)));
                continue;
            };
            self.0.insert((number, face), Taken::Along(uncrossed.axis));
            let mut vertices = rings.concat();
            let first = (positions.len() - start) as u32;
            vertices.extend((first..).take(uncrossed.added.len()));
            positions.extend(uncrossed.added);
            let vertex = |&corner: &u32| vertices[corner as usize];
            let rings = uncrossed.rings.iter().map(|ring| ring.iter().map(vertex).collect());
            mended.insert(face, rings.collect());
        }
        if mended.is_empty() {
            return;
        }
        let mut faces = Faces::default();
        for face in 0..soup.faces.len() {
            let old: Vec<&[u32]> = soup.faces.rings(face).collect();
            let rings = match mended.get(&face) {
                Some(rings) => rings.iter().map(Vec::as_slice).collect(),
                None => old,
            };
            faces.push(rings[0], rings[1..].iter().copied());
        }
        soup.faces = faces;
    }
}

/// The edges of a ring.
fn edges_of(ring: &[u32]) -> impl Iterator<Item = [u32; 2]> + '_ {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&a, &b)| [a, b])
}
