//! What is healed: the faces of all objects over one list of places.
//!
//! A place is named by the first vertex of all files that was there. Merging
//! places gives their vertices the name of one of them, moving a place moves
//! all its vertices, and a face whose sides are split has rings of its own
//! from then on. Objects share places and nothing else: sides of two objects
//! are never one edge.

use super::Tolerance;
use super::near::{Near, near};
use crate::model::Soup;
use crate::run::{map_chunks, map_indexed, map_small, sort_by};
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::ops::Range;

/// A face by its object and its number there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct FaceName {
    pub(super) object: u32,
    pub(super) face: u32,
}

/// The rings of a face, outer ring first, by places.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Rings {
    pub(super) corners: Vec<u32>,
    /// End of each ring in `corners`.
    pub(super) ends: Vec<u32>,
}

impl Rings {
    pub(super) fn clear(&mut self) {
        self.corners.clear();
        self.ends.clear();
    }

    pub(super) fn push(&mut self, ring: impl IntoIterator<Item = u32>) {
        self.corners.extend(ring);
        self.ends.push(self.corners.len() as u32);
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &[u32]> + Clone {
        let start = |ring: usize| if ring == 0 { 0 } else { self.ends[ring - 1] as usize };
        (0..self.ends.len()).map(move |ring| &self.corners[start(ring)..self.ends[ring] as usize])
    }

    /// The sides of all rings, in their direction.
    pub(super) fn sides(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.iter().flat_map(|ring| {
            let next = ring.iter().cycle().skip(1);
            ring.iter().zip(next).map(|(&a, &b)| [a, b])
        })
    }
}

/// All objects.
pub(super) struct Net<'s> {
    pub(super) soups: &'s [Soup],
    /// The first vertex of each object.
    pub(super) starts: Vec<u32>,
    /// Where each vertex is: for the name of a place, where it is now; for
    /// others, where they were in the file.
    pub(super) places: Vec<DVec3>,
    /// The place of each vertex in the file, and now.
    pub(super) first: Vec<u32>,
    pub(super) now: Vec<u32>,
    /// Where places were before they were moved.
    before: FxHashMap<u32, DVec3>,
    /// Places of the file that have become others: those that they have
    /// become, and they.
    joined: Vec<[u32; 2]>,
    /// Faces that are no longer as in the file. One without a ring is
    /// collapsed.
    pub(super) changed: FxHashMap<FaceName, Rings>,
}

/// Faces that one task looks at.
const PART: usize = 1 << 14;

impl<'s> Net<'s> {
    /// The objects as they are, all vertices apart.
    pub(super) fn new(soups: &'s [Soup], starts: Vec<u32>, positions: Vec<DVec3>) -> Self {
        let names: Vec<u32> = (0..positions.len() as u32).collect();
        Net {
            soups,
            starts,
            places: positions,
            now: names.clone(),
            first: names,
            before: FxHashMap::default(),
            joined: Vec::new(),
            changed: FxHashMap::default(),
        }
    }

    /// Links between places that are near now.
    pub(super) fn links(&self, tolerance: Tolerance) -> Vec<[u32; 2]> {
        let moved = |vertex: usize| self.at(self.now[vertex]);
        let positions: Vec<DVec3> = map_small(self.now.len(), moved);
        let none = vec![0b111; positions.len()];
        let Near { first, links, .. } = near(&positions, &none, tolerance);
        // Places that have come to the same position are still two.
        let name = |vertex: u32| self.now[vertex as usize];
        let named = links.into_iter().map(|link| link.map(name));
        let same = first.into_iter().zip(&self.now).map(|(first, &now)| [name(first), now]);
        named.chain(same).filter(|[a, b]| a != b).collect()
    }

    /// Whether a vertex gives its name to a place.
    pub(super) fn is_place(&self, vertex: u32) -> bool {
        self.now[vertex as usize] == vertex
    }

    /// Where a place is.
    #[inline]
    pub(super) fn at(&self, place: u32) -> DVec3 {
        self.places[place as usize]
    }

    /// Where a place of the file was there.
    pub(super) fn was_at(&self, place: u32) -> DVec3 {
        self.before.get(&place).copied().unwrap_or(self.places[place as usize])
    }

    /// Whether a place, and all that have become it, may be there.
    pub(super) fn allows(&self, place: u32, position: DVec3, tolerance: Tolerance) -> bool {
        let start = self.joined.partition_point(|joined| joined[0] < place);
        let joined = self.joined[start..].iter().take_while(|joined| joined[0] == place);
        let mut all = [place].into_iter().chain(joined.map(|joined| joined[1]));
        all.all(|place| tolerance.allows(self.was_at(place), position))
    }

    /// Moves a place.
    pub(super) fn put(&mut self, place: u32, position: DVec3) {
        let slot = &mut self.places[place as usize];
        self.before.entry(place).or_insert(*slot);
        *slot = position;
    }

    /// Gives places the names of others, as `target` says.
    pub(super) fn join(&mut self, target: &[u32]) {
        self.now = map_small(self.now.len(), |vertex| target[self.now[vertex] as usize]);
    }

    /// Whether any place has become another.
    pub(super) fn is_merged(&self) -> bool {
        let parts =
            map_chunks(self.now.len(), PART, |part| self.now[part.clone()] == self.first[part]);
        parts.into_iter().any(|same| !same)
    }

    /// Notes which places have become others, before any of them is moved.
    pub(super) fn note_joined(&mut self) {
        let joined = map_chunks(self.now.len(), PART, |part| {
            let pair = |vertex: usize| [self.now[vertex], self.first[vertex]];
            let is_own = |vertex: &usize| self.first[*vertex] as usize == *vertex;
            let places = part.filter(is_own).map(pair);
            places.filter(|[now, before]| now != before).collect::<Vec<_>>()
        });
        self.joined = joined.concat();
        sort_by(&mut self.joined, Ord::cmp);
    }

    /// The vertices of an object.
    pub(super) fn vertices_of(&self, object: usize) -> Range<u32> {
        let end = self.starts.get(object + 1).copied().unwrap_or(self.first.len() as u32);
        self.starts[object]..end
    }

    /// The rings of a face.
    pub(super) fn rings(&self, name: FaceName, rings: &mut Rings) {
        if let Some(changed) = self.changed.get(&name) {
            rings.clone_from(changed);
            return;
        }
        self.rings_by(&self.now, name, rings);
    }

    /// The rings of a face in its file, by the places of then.
    pub(super) fn old_rings(&self, name: FaceName, rings: &mut Rings) {
        self.rings_by(&self.first, name, rings);
    }

    /// The rings of a face in its file, its vertices by these names.
    fn rings_by(&self, names: &[u32], name: FaceName, rings: &mut Rings) {
        rings.clear();
        let start = self.starts[name.object as usize];
        let named = |&corner: &u32| names[(start + corner) as usize];
        for ring in self.soups[name.object as usize].faces.rings(name.face as usize) {
            rings.push(ring.iter().map(named));
        }
    }

    /// Looks at all faces, in parts; results in the order of the faces.
    pub(super) fn map_faces<T: Send>(
        &self,
        start: impl Fn() -> T + Sync + Send,
        each: impl Fn(&mut T, FaceName, &Rings) + Sync + Send,
    ) -> Vec<T> {
        let parts: Vec<(u32, Range<usize>)> = (0..)
            .zip(self.soups)
            .flat_map(|(object, soup)| {
                let count = soup.faces.len();
                (0..count).step_by(PART).map(move |from| (object, from..(from + PART).min(count)))
            })
            .collect();
        map_indexed(parts.len(), |part| {
            let (object, faces) = parts[part].clone();
            let (mut result, mut rings) = (start(), Rings::default());
            let plain = self.soups[object as usize].faces.as_triangles();
            if let Some(corners) = plain.filter(|_| self.changed.is_empty()) {
                let start = self.starts[object as usize];
                let now = |&corner: &u32| self.now[(start + corner) as usize];
                rings.ends.push(3);
                for face in faces {
                    rings.corners.clear();
                    rings.corners.extend(corners[3 * face..3 * face + 3].iter().map(now));
                    each(&mut result, FaceName { object, face: face as u32 }, &rings);
                }
                return result;
            }
            for face in faces {
                let name = FaceName { object, face: face as u32 };
                self.rings(name, &mut rings);
                each(&mut result, name, &rings);
            }
            result
        })
    }
}
