//! From what was healed back to objects: vertices and faces keep their places
//! in the arrays, so that all that is said of them by number still holds.

use super::net::{FaceName, Net, Rings};
use super::{HealReport, distance};
use crate::model::{Faces, Soup};
use crate::run::{map_chunks, map_small};
use glam::DVec3;
use rustc_hash::FxHashMap;

/// What is to be put into the objects.
pub(super) struct Healed {
    /// Of all vertices of all objects.
    positions: Vec<DVec3>,
    /// The first vertex of each object.
    starts: Vec<u32>,
    /// Objects with faces that are changed.
    faces: Vec<NewFaces>,
    /// What moved, and how far.
    pub(super) report: HealReport,
}

/// The faces of an object, and the vertices that it has for them now.
struct NewFaces {
    object: usize,
    faces: Faces,
    /// Positions of vertices that other objects had, and their numbers in the
    /// file.
    vertices: Vec<(DVec3, u32)>,
}

/// Vertices that one task looks at.
const PART: usize = 1 << 14;

impl Healed {
    pub(super) fn of(net: Net<'_>) -> Self {
        let report = report(&net);
        let mut changed: Vec<u32> = net.changed.keys().map(|name| name.object).collect();
        changed.sort_unstable();
        changed.dedup();
        let faces = changed.into_iter().map(|object| new_faces(&net, object)).collect();
        let Net { places, starts, now, .. } = net;
        let positions = if report.moved == 0 {
            places
        } else {
            map_small(places.len(), |vertex| {
                let (old, new) = (places[vertex], places[now[vertex] as usize]);
                // Of two zeros that are equal each vertex keeps its own.
                if old == new { old } else { new }
            })
        };
        Healed { positions, starts, faces, report }
    }

    /// Gives the objects their vertices back.
    pub(super) fn put_back(self, soups: &mut [Soup]) {
        let Healed { mut positions, starts, faces, .. } = self;
        for (soup, &start) in soups.iter_mut().zip(&starts).rev() {
            soup.vertices = positions.split_off(start as usize);
        }
        for NewFaces { object, faces, vertices } in faces {
            let soup = &mut soups[object];
            soup.faces = faces;
            if vertices.is_empty() {
                continue;
            }
            let count = soup.vertices.len() as u32;
            let numbers = soup.vertex_numbers.get_or_insert_with(|| (0..count).collect());
            numbers.extend(vertices.iter().map(|(_, number)| *number));
            soup.vertices.extend(vertices.iter().map(|(position, _)| *position));
        }
    }
}

/// How many places moved, and how far at most.
fn report(net: &Net<'_>) -> HealReport {
    let parts = map_chunks(net.first.len(), PART, |part| {
        let mut report = HealReport::default();
        for place in
            part.map(|vertex| vertex as u32).filter(|&vertex| net.first[vertex as usize] == vertex)
        {
            let way = distance(net.was_at(place), net.at(net.now[place as usize]));
            report.moved += usize::from(way > 0.0);
            report.farthest = report.farthest.max(way);
        }
        report
    });
    parts.into_iter().fold(HealReport::default(), |sum, part| HealReport {
        moved: sum.moved + part.moved,
        farthest: sum.farthest.max(part.farthest),
        ..sum
    })
}

/// All faces of an object as they are now.
fn new_faces(net: &Net<'_>, object: u32) -> NewFaces {
    let soup = &net.soups[object as usize];
    let mut names = VertexNames::of(net, object);
    let mut faces = Faces::default();
    for face in 0..soup.faces.len() {
        let mut old = soup.faces.rings(face);
        let Some(rings) = net.changed.get(&FaceName { object, face: face as u32 }) else {
            faces.push(old.next().unwrap_or_default(), old);
            continue;
        };
        let corners: Vec<u32> = old.flatten().copied().collect();
        let rings = names.rings(net, &corners, rings);
        let mut rings = rings.iter().map(Vec::as_slice);
        match rings.next() {
            Some(outer) => faces.push(outer, rings),
            // There and back: no face, but one that is counted.
            None => faces.push(&[corners[0], corners[1], corners[0]], []),
        }
    }
    NewFaces { object: object as usize, faces, vertices: names.added }
}

/// How an object calls places.
struct VertexNames {
    object: u32,
    /// The first vertex at each place that is new to some face.
    known: FxHashMap<u32, u32>,
    added: Vec<(DVec3, u32)>,
}

impl VertexNames {
    fn of(net: &Net<'_>, object: u32) -> Self {
        let mut wanted: FxHashMap<u32, Option<u32>> = FxHashMap::default();
        for (name, rings) in &net.changed {
            if name.object == object {
                wanted.extend(rings.corners.iter().map(|&corner| (corner, None)));
            }
        }
        let vertices = net.vertices_of(object as usize);
        for (own, vertex) in vertices.enumerate() {
            if let Some(known) = wanted.get_mut(&net.now[vertex as usize]) {
                known.get_or_insert(own as u32);
            }
        }
        let known = wanted.into_iter().filter_map(|(place, own)| Some((place, own?))).collect();
        VertexNames { object, known, added: Vec::new() }
    }

    /// Rings by the vertices of the object, those of the face's corners where
    /// it has them.
    fn rings(&mut self, net: &Net<'_>, corners: &[u32], rings: &Rings) -> Vec<Vec<u32>> {
        let start = net.starts[self.object as usize];
        let own = |place: u32| {
            let here = |corner: &&u32| net.now[(start + **corner) as usize] == place;
            corners.iter().find(here).copied()
        };
        let mut name = |&place: &u32| match own(place) {
            Some(corner) => corner,
            None => self.name(net, place),
        };
        rings.iter().map(|ring| ring.iter().map(&mut name).collect()).collect()
    }

    fn name(&mut self, net: &Net<'_>, place: u32) -> u32 {
        let next = net.vertices_of(self.object as usize).len() + self.added.len();
        let added = &mut self.added;
        *self.known.entry(place).or_insert_with(|| {
            added.push((net.at(place), number_in_file(net, place)));
            next as u32
        })
    }
}

/// The number of a vertex in its file.
fn number_in_file(net: &Net<'_>, vertex: u32) -> u32 {
    let object = net.starts.partition_point(|&start| start <= vertex) - 1;
    let own = vertex - net.starts[object];
    let numbers = net.soups[object].vertex_numbers.as_ref();
    numbers.map_or(own, |numbers| numbers[own as usize])
}
