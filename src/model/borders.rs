//! Borders that lie on one another: T-junctions, and the seams of objects.
//!
//! Welded faces have their common edges in common. Where one long side lies
//! along two short ones they have not: each is the edge of a single face, a
//! *border*, though nothing ends there. So borders are matched piece by piece.
//! A *stretch* is a part of a border between two vertices on it, and knows
//! all faces that end along it; for what is a line, it is an edge like others.
//!
//! Within an object any number of borders may lie on one another. Across
//! objects two do, and only where nothing else does: a surface that is cut into
//! groups has no border there, but things that touch keep theirs.
//!
//! Sides of one line are brought together by fingerprints of their lines, and
//! are held to be so when exact signs say it. Along a line vertices are
//! ordered by a coordinate, as it is; a sweep over the ends of the borders
//! then finds the stretches. Nothing is rounded. O(n) for n edges, and
//! O(b log b) for b borders.

use super::Mesh;
use crate::kernel::predicates::{are_collinear, line_fingerprints};
use crate::run::{map_chunks, sort_by};
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// A part of a border between two vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stretch {
    /// The vertices, the smaller number first. They may be of another object,
    /// whose border ends there.
    pub ends: [u32; 2],
    /// An edge that the stretch is all or a part of.
    pub edge: u32,
    /// Its faces in the list of all; the object's own come first.
    first_side: u32,
    own_sides: u32,
    all_sides: u32,
}

/// A face that ends along a stretch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BorderSide {
    /// The edge of which it is the only face.
    pub edge: u32,
    /// The triangle at that edge.
    pub triangle: u32,
    /// Its corner off the edge.
    pub third: u32,
    /// Whether it runs along the stretch from the first end to the second in
    /// its own winding.
    pub runs_along: bool,
}

/// The borders of a mesh that lie on one another.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Borders {
    stretches: Vec<Stretch>,
    sides: Vec<BorderSide>,
    /// Edges that are divided and stretches of their object that are part of
    /// them, sorted.
    parts: Vec<[u32; 2]>,
    /// Borders on which nothing lies, sorted.
    open: Vec<u32>,
}

/// Edges that one task looks at.
const PART: usize = 1 << 14;

impl Borders {
    /// Matches the borders of a mesh.
    pub(super) fn find(mesh: &Mesh) -> Self {
        let mut borders = Borders::default();
        let segments = border_segments(mesh);
        for group in groups_by_line(&segments) {
            borders.match_along_line(mesh, &segments, group);
        }
        borders.sort();
        let edges = segments.iter().map(|segment| segment.edge);
        borders.open = edges.filter(|&edge| !borders.divide(edge)).collect();
        borders
    }

    /// The edges of a single face on which no other border lies, in order.
    pub fn open(&self) -> &[u32] {
        &self.open
    }

    /// All stretches, in the order of their edges.
    pub fn stretches(&self) -> &[Stretch] {
        &self.stretches
    }

    /// The faces of a stretch; those of another object only `across` its seam.
    pub fn sides(&self, stretch: u32, across: bool) -> &[BorderSide] {
        let Stretch { first_side, own_sides, all_sides, .. } = self.stretches[stretch as usize];
        let count = if across { all_sides } else { own_sides };
        &self.sides[first_side as usize..][..count as usize]
    }

    /// Whether a stretch is the seam of two objects.
    pub fn is_seam(&self, stretch: u32) -> bool {
        let Stretch { own_sides, all_sides, .. } = self.stretches[stretch as usize];
        own_sides < all_sides
    }

    /// The stretches that an edge is divided into, or none if it is whole.
    /// O(log n).
    #[inline]
    pub fn of_edge(&self, edge: u32) -> impl Iterator<Item = u32> + '_ {
        let start = self.parts.partition_point(|part| part[0] < edge);
        self.parts[start..].iter().take_while(move |part| part[0] == edge).map(|part| part[1])
    }

    /// Whether an edge is divided into stretches. O(log n).
    #[inline]
    pub fn divide(&self, edge: u32) -> bool {
        self.of_edge(edge).next().is_some()
    }

    /// Adds the stretches of segments that are likely to lie on one line.
    fn match_along_line(&mut self, mesh: &Mesh, segments: &[Segment], mut group: Vec<u32>) {
        while 1 < group.len() {
            let axis = segments[group[0] as usize].axis();
            group.sort_unstable_by(|&a, &b| {
                let key = |i: u32| segments[i as usize].along(axis)[0].0;
                key(a).total_cmp(&key(b)).then(a.cmp(&b))
            });
            let mut rest = Vec::new();
            let mut start = 0;
            while start < group.len() {
                let end = overlapping(segments, &group[start..], axis);
                let (on_line, others): (Vec<u32>, Vec<u32>) = group[start..start + end]
                    .iter()
                    .partition(|&&i| lie_on_one_line(segments, [group[start], i]));
                let [low, high] = segments[on_line[0] as usize].along(axis);
                if on_line.len() < 2 {
                    // Alone on its line.
                } else if low.0 < high.0 {
                    Sweep::new(mesh, segments, axis).along(&on_line, self);
                } else {
                    // Another line, across the axis.
                    self.match_along_line(mesh, segments, on_line);
                }
                rest.extend(others);
                start += end;
            }
            group = rest;
        }
    }

    /// Brings the stretches into the order of their edges.
    fn sort(&mut self) {
        self.stretches.sort_unstable_by_key(|stretch| (stretch.edge, stretch.ends));
        for stretch in 0..self.stretches.len() as u32 {
            for side in 0..self.stretches[stretch as usize].own_sides {
                let place = self.stretches[stretch as usize].first_side + side;
                self.parts.push([self.sides[place as usize].edge, stretch]);
            }
        }
        self.parts.sort_unstable();
    }
}

/// A border edge.
#[derive(Debug, Clone, Copy)]
struct Segment {
    edge: u32,
    object: u32,
    triangle: u32,
    vertices: [u32; 2],
    positions: [DVec3; 2],
}

impl Segment {
    /// The axis along which it is longest.
    fn axis(&self) -> usize {
        let [x, y, z] = (self.positions[1] - self.positions[0]).abs().to_array();
        if x >= y && x >= z { 0 } else { 1 + usize::from(z > y) }
    }

    /// Its ends, coordinate and vertex, in their order along an axis.
    fn along(&self, axis: usize) -> [(f64, u32); 2] {
        let [a, b] = [0, 1].map(|end| (self.positions[end][axis], self.vertices[end]));
        if b.0 < a.0 { [b, a] } else { [a, b] }
    }
}

/// All edges at which one face ends.
fn border_segments(mesh: &Mesh) -> Vec<Segment> {
    let parts = map_chunks(mesh.edges().len(), PART, |part| {
        let segment = |edge: usize| {
            let edge = edge as u32;
            let mut faces = match mesh.edges().triangles(edge) {
                [_, _] => return None,
                _ => mesh.bordering(edge),
            };
            let (Some(triangle), None) = (faces.next(), faces.next()) else { return None };
            let vertices = mesh.edges().ends(edge);
            Some(Segment {
                edge,
                object: mesh.object_of_vertex(vertices[0]),
                triangle,
                vertices,
                positions: vertices.map(|vertex| mesh.vertices()[vertex as usize]),
            })
        };
        part.filter_map(segment).collect::<Vec<_>>()
    });
    parts.concat()
}

/// Groups of two segments or more that may lie on one line.
fn groups_by_line(segments: &[Segment]) -> Vec<Vec<u32>> {
    let prints = map_chunks(segments.len(), PART, |part| {
        let positions: Vec<_> = segments[part].iter().map(|segment| segment.positions).collect();
        line_fingerprints(&positions)
    });
    let prints = prints.concat();
    let numbers = || (0..).zip(&prints);
    let with_print = |(i, &print): (u32, &Option<u64>)| Some((print?, i));
    let mut keyed: Vec<(u64, u32)> = numbers().filter_map(with_print).collect();
    for (i, _) in numbers().filter(|(_, print)| print.is_none()) {
        // Only coordinates that were chosen for it have no fingerprint; such a
        // segment is compared with all.
        let alike = keyed.iter().find(|&&(_, other)| lie_on_one_line(segments, [other, i]));
        keyed.push((alike.map_or(u64::MAX, |&(print, _)| print), i));
    }
    sort_by(&mut keyed, Ord::cmp);
    let groups = keyed.chunk_by(|a, b| a.0 == b.0).filter(|group| 1 < group.len());
    groups.map(|group| group.iter().map(|&(_, i)| i).collect()).collect()
}

/// How many of the first segments, sorted along an axis, overlap one another
/// or are connected by others that do.
fn overlapping(segments: &[Segment], sorted: &[u32], axis: usize) -> usize {
    let mut reach = f64::NEG_INFINITY;
    let beyond = |&i: &u32| {
        let [low, high] = segments[i as usize].along(axis).map(|(at, _)| at);
        let is_beyond = reach.is_finite() && reach <= low;
        reach = reach.max(high);
        is_beyond
    };
    sorted.iter().position(beyond).unwrap_or(sorted.len())
}

/// Whether two segments lie on one line, exactly.
fn lie_on_one_line(segments: &[Segment], pair: [u32; 2]) -> bool {
    let [[a, b], other] = pair.map(|i| segments[i as usize].positions);
    other.into_iter().all(|p| p == a || p == b || are_collinear(a, b, p))
}

/// What lies along a stretch for one object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Faces {
    /// One segment of the object.
    One(u32),
    /// One, and one of another object.
    Seam(u32, u32),
    /// Two of the object.
    Two(u32, u32),
    /// More; which ones may change along the stretch.
    Many,
}

/// A stretch that has begun.
struct Open {
    faces: Faces,
    start: u32,
    /// All segments of the object that are part of it.
    own: Vec<u32>,
}

/// Walks along the borders on one line.
struct Sweep<'a> {
    mesh: &'a Mesh,
    segments: &'a [Segment],
    axis: usize,
    /// Objects and segments at the place of the sweep.
    active: BTreeSet<(u32, u32)>,
    /// The vertex of each object that is there.
    vertex_of: BTreeMap<u32, u32>,
    open: BTreeMap<u32, Open>,
    found: Vec<(Open, u32)>,
}

impl<'a> Sweep<'a> {
    fn new(mesh: &'a Mesh, segments: &'a [Segment], axis: usize) -> Self {
        let (active, vertex_of, open, found) = Default::default();
        Sweep { mesh, segments, axis, active, vertex_of, open, found }
    }

    /// Adds the stretches of segments on one line.
    fn along(mut self, segments: &[u32], borders: &mut Borders) {
        let mut stops: Vec<(f64, u32, u32)> = Vec::with_capacity(2 * segments.len());
        for &i in segments {
            let ends = self.segments[i as usize].along(self.axis);
            stops.extend(ends.map(|(at, vertex)| (at, vertex, i)));
        }
        stops.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        for place in stops.chunk_by(|a, b| a.0 == b.0) {
            self.stop_at(place);
        }
        self.add_to(borders);
    }

    /// Takes the ends at one place in, and looks at the objects for which
    /// something changes there.
    fn stop_at(&mut self, place: &[(f64, u32, u32)]) {
        let mut objects: Vec<u32> = self.neighbours();
        let mut begun = Vec::new();
        for &(_, vertex, i) in place {
            let entry = (self.segments[i as usize].object, i);
            if !self.active.remove(&entry) {
                self.active.insert(entry);
                begun.push(entry);
            }
            objects.push(entry.0);
            self.vertex_of.insert(entry.0, vertex);
        }
        objects.extend(self.neighbours());
        objects.sort_unstable();
        objects.dedup();
        begun.sort_unstable();
        for object in objects {
            let vertex = self.vertex_of.remove(&object).unwrap_or(place[0].1);
            let first = begun.partition_point(|entry| entry.0 < object);
            let own = begun[first..].iter().take_while(|entry| entry.0 == object);
            self.turn(object, vertex, own.map(|&(_, i)| i));
        }
    }

    /// The objects of two segments that are alone.
    fn neighbours(&self) -> Vec<u32> {
        let two = self.active.len() == 2;
        self.active.iter().filter(|_| two).map(|&(object, _)| object).collect()
    }

    /// Ends the stretch of an object at a vertex and begins the next, if there
    /// is another set of faces from there on. `begun` are segments of the object
    /// that begin there.
    fn turn(&mut self, object: u32, vertex: u32, begun: impl Iterator<Item = u32>) {
        let own = self.active.range((object, 0)..=(object, u32::MAX)).map(|&(_, i)| i);
        let few: Vec<u32> = own.clone().take(3).collect();
        let other = || self.active.iter().find(|entry| entry.0 != object);
        let faces = match few[..] {
            [] => None,
            [one] if self.active.len() == 2 => other().map(|&(_, other)| Faces::Seam(one, other)),
            [one] => Some(Faces::One(one)),
            [one, other] => Some(Faces::Two(one, other)),
            _ => Some(Faces::Many),
        };
        if let Some(open) = self.open.get_mut(&object) {
            if Some(open.faces) == faces {
                // Which ones are many changes on the way.
                open.own.extend(begun);
                return;
            }
            self.found.extend(self.open.remove(&object).map(|open| (open, vertex)));
        }
        if let Some(faces) = faces {
            self.open.insert(object, Open { faces, start: vertex, own: own.collect() });
        }
    }

    /// Adds what was found, but for edges along which nothing else lies.
    fn add_to(self, borders: &mut Borders) {
        let divided: BTreeSet<u32> = self
            .found
            .iter()
            .filter(|(open, _)| !matches!(open.faces, Faces::One(_)))
            .flat_map(|(open, _)| open.own.iter().copied())
            .collect();
        for (open, end) in &self.found {
            if open.own.iter().all(|i| divided.contains(i)) {
                self.add_stretch(open, *end, borders);
            }
        }
    }

    fn add_stretch(&self, open: &Open, end: u32, borders: &mut Borders) {
        let ends = [open.start.min(end), open.start.max(end)];
        let mut own = open.own.clone();
        // By their places along the line, whatever their numbers.
        own.sort_unstable_by(|&a, &b| {
            let [[a, b], [c, d]] = [a, b].map(|i| self.segments[i as usize].along(self.axis));
            a.0.total_cmp(&c.0).then(b.0.total_cmp(&d.0))
        });
        own.dedup();
        let own_sides = own.len() as u32;
        if let Faces::Seam(_, other) = open.faces {
            own.push(other);
        }
        let first_side = borders.sides.len() as u32;
        borders.sides.extend(own.iter().map(|&i| self.side(i, ends)));
        let of_own = &borders.sides[first_side as usize..][..own_sides as usize];
        // The name that says most is that of an edge which is all of it.
        let is_whole = |side: &&BorderSide| self.mesh.edges().ends(side.edge) == ends;
        let edge = of_own.iter().find(is_whole).unwrap_or(&of_own[0]).edge;
        let all_sides = own.len() as u32;
        borders.stretches.push(Stretch { ends, edge, first_side, own_sides, all_sides });
    }

    fn side(&self, segment: u32, ends: [u32; 2]) -> BorderSide {
        let Segment { edge, triangle, vertices, .. } = self.segments[segment as usize];
        let at = |vertex: u32| self.mesh.vertices()[vertex as usize][self.axis];
        let goes_up = |[from, to]: [u32; 2]| at(from) < at(to);
        let same_sense = goes_up(vertices) == goes_up(ends);
        BorderSide {
            edge,
            triangle,
            third: self.mesh.third(triangle, vertices),
            runs_along: self.mesh.runs_along(triangle, vertices) == same_sense,
        }
    }
}

#[cfg(test)]
mod tests;
