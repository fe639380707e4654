//! Flat faces that boxes cannot take apart.
//!
//! A round plate comes as a fan of long thin triangles, or as a strip of them
//! from rim to rim. All their boxes overlap, as no hierarchy can help, so every
//! pair of them would be looked at. But triangles of one plane that lie side
//! by side have nothing in common beyond what they share, and against another
//! plane all of them can be looked at together. A *plate* is a connected set
//! of triangles in one plane, many of them thin, that lie side by side.
//!
//! That they do is proved: at each inner edge two triangles lie on different
//! sides; the outline, which is all other edges, does not touch itself; and
//! just one of its rings runs around the plate, the others around holes.
//! How often a place is covered is how often the outline goes around it, for
//! triangles turned alike, so it is once or not at all. Where the proof fails
//! triangles are looked at pair by pair as everywhere else. All signs are exact.

use super::Mesh;
use super::components::{join, root};
use super::world_boxes::WorldBoxes;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Policy, Predicates};
use crate::run::{Run, map_chunks};
use crate::spatial::{Bounds, Hierarchy};
use rustc_hash::{FxHashMap, FxHashSet};

/// So many triangles are worth being a plate.
const LEAST: usize = 64;

/// Triangles are thin if their boxes have so many times twice their area.
const THIN: f64 = 32.0;

/// Triangles that one task looks at.
const PART: usize = 1 << 14;

/// No plate has this number.
const NONE: u32 = u32::MAX;

/// Triangles in one plane that lie side by side.
#[derive(Debug, Clone)]
pub(super) struct Plate {
    /// Its triangles, ascending.
    pub(super) triangles: Vec<u32>,
    /// Their vertices, ascending.
    pub(super) vertices: Vec<u32>,
    /// The corners of one of them.
    pub(super) face: [u32; 3],
    /// A box around it, in world axes.
    pub(super) bounds: Bounds,
}

impl Plate {
    pub(super) fn has_vertex(&self, vertex: u32) -> bool {
        self.vertices.binary_search(&vertex).is_ok()
    }
}

/// The plates of a mesh.
#[derive(Debug, Clone)]
pub(super) struct Plates<'m> {
    boxes: WorldBoxes<'m>,
    all: Vec<Plate>,
    /// The plate of each triangle, if it is part of one.
    plate_of: Vec<u32>,
}

impl<'m> Plates<'m> {
    /// Finds them among some triangles. Nothing, and in one look at these,
    /// where few are thin. O(n log n).
    pub(super) fn find<P: Policy>(
        mesh: &'m Mesh,
        predicates: &Predicates<'_, P>,
        triangles: &[u32],
        run: &Run<'_>,
    ) -> Option<Self> {
        let thin = map_chunks(triangles.len(), PART, |part| {
            let thin = |&&triangle: &&u32| is_thin(mesh, triangle);
            triangles[part].iter().filter(thin).copied().collect::<Vec<_>>()
        });
        let thin = thin.concat();
        if thin.len() < LEAST {
            return None;
        }
        let plate_of = vec![NONE; mesh.triangles().len()];
        let mut plates = Plates { boxes: WorldBoxes::new(mesh), all: Vec::new(), plate_of };
        let mut is_known = vec![false; mesh.triangles().len()];
        triangles.iter().for_each(|&triangle| is_known[triangle as usize] = true);
        for triangles in flat_sets(mesh, predicates, &thin, &is_known) {
            let outline = Outline::of(mesh, predicates, &triangles);
            if outline.is_some_and(|outline| outline.is_simple(&plates.boxes, run)) {
                plates.add(mesh, triangles);
            }
        }
        (!plates.all.is_empty()).then_some(plates)
    }

    fn add(&mut self, mesh: &Mesh, triangles: Vec<u32>) {
        let corners = |&triangle: &u32| mesh.triangles()[triangle as usize];
        for &triangle in &triangles {
            self.plate_of[triangle as usize] = self.all.len() as u32;
        }
        let mut vertices: Vec<u32> = triangles.iter().flat_map(corners).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let (face, bounds) = (corners(&triangles[0]), self.boxes.around(&vertices));
        self.all.push(Plate { triangles, vertices, face, bounds });
    }

    pub(super) fn all(&self) -> &[Plate] {
        &self.all
    }

    pub(super) fn boxes(&self) -> &WorldBoxes<'m> {
        &self.boxes
    }

    /// Whether a triangle is part of a plate.
    pub(super) fn has(&self, triangle: u32) -> bool {
        self.plate_of[triangle as usize] != NONE
    }

    /// Whether there is an edge between two vertices at which a triangle of a
    /// plate ends.
    pub(super) fn has_edge(&self, mesh: &Mesh, plate: usize, [a, b]: [u32; 2]) -> bool {
        let own = |triangle: &u32| self.plate_of[*triangle as usize] == plate as u32;
        mesh.edges().find(a, b).is_some_and(|edge| mesh.edges().triangles(edge).iter().any(own))
    }
}

/// Whether the box of a triangle says little about where it is.
fn is_thin(mesh: &Mesh, triangle: u32) -> bool {
    let [a, b, c] = mesh.triangles()[triangle as usize].map(|i| mesh.vertices()[i as usize]);
    let size = a.max(b).max(c) - a.min(b).min(c);
    let around = size.x * size.y + size.y * size.z + size.z * size.x;
    let twice = (b - a).cross(c - a);
    THIN * THIN * twice.length_squared() < around * around
}

/// Sets of triangles in one plane that hang together by edges of two, each
/// with many thin ones.
fn flat_sets<P: Policy>(
    mesh: &Mesh,
    predicates: &Predicates<'_, P>,
    thin: &[u32],
    is_known: &[bool],
) -> Vec<Vec<u32>> {
    let mut parents: Vec<u32> = (0..mesh.triangles().len() as u32).collect();
    for &triangle in thin {
        for other in flat_neighbours(mesh, predicates, triangle) {
            join(&mut parents, [triangle, other]);
        }
    }
    let mut thin_in: FxHashMap<u32, usize> = FxHashMap::default();
    for &triangle in thin {
        *thin_in.entry(root(&mut parents, triangle)).or_default() += 1;
    }
    // From the thin ones to all that lie in their plane.
    let mut is_taken = vec![false; parents.len()];
    let mut sets = Vec::new();
    for &first in thin {
        if is_taken[first as usize] || thin_in[&root(&mut parents, first)] < LEAST {
            continue;
        }
        let mut set = vec![first];
        is_taken[first as usize] = true;
        let mut next = 0;
        while next < set.len() {
            for other in flat_neighbours(mesh, predicates, set[next]) {
                if is_known[other as usize]
                    && !std::mem::replace(&mut is_taken[other as usize], true)
                {
                    set.push(other);
                }
            }
            next += 1;
        }
        set.sort_unstable();
        sets.push(set);
    }
    sets
}

/// Triangles that share an edge of two with a triangle, and its plane.
fn flat_neighbours<P: Policy>(
    mesh: &Mesh,
    predicates: &Predicates<'_, P>,
    triangle: u32,
) -> Vec<u32> {
    let corners @ [a, b, c] = mesh.triangles()[triangle as usize];
    let mut found = Vec::with_capacity(3);
    for [x, y] in [[a, b], [b, c], [c, a]] {
        let Some(edge) = mesh.edges().find(x, y) else { continue };
        if let &[s, t] = mesh.edges().triangles(edge) {
            let other = if s == triangle { t } else { s };
            let third = mesh.third(other, [x, y]);
            if predicates.plane(corners, third).is_zero() {
                found.push(other);
            }
        }
    }
    found
}

/// The edges at which a flat set of triangles ends, its inside to their left
/// for an eye far up an axis.
struct Outline<'a, 'p, P: Policy> {
    mesh: &'a Mesh,
    predicates: &'a Predicates<'p, P>,
    axis: u8,
    edges: Vec<[u32; 2]>,
}

impl<'a, 'p, P: Policy> Outline<'a, 'p, P> {
    /// The outline of triangles in one plane, unless two of them lie on one
    /// side of a common edge.
    fn of(mesh: &'a Mesh, predicates: &'a Predicates<'p, P>, triangles: &[u32]) -> Option<Self> {
        let first = mesh.triangles()[triangles[0] as usize];
        let axis = (0..3).find(|&axis| !predicates.turn_along(first, axis).is_zero())?;
        let mut open: FxHashSet<[u32; 2]> = FxHashSet::default();
        for &triangle in triangles {
            let [a, b, c] = mesh.triangles()[triangle as usize];
            let [a, b, c] = match predicates.turn_along([a, b, c], axis) {
                Sign::Negative => [a, c, b],
                _ => [a, b, c],
            };
            for [x, y] in [[a, b], [b, c], [c, a]] {
                if !open.remove(&[y, x]) && !open.insert([x, y]) {
                    return None;
                }
            }
        }
        let mut edges: Vec<[u32; 2]> = open.into_iter().collect();
        edges.sort_unstable();
        Some(Outline { mesh, predicates, axis, edges })
    }

    /// Whether the outline goes around each place once or not at all.
    fn is_simple(&self, boxes: &WorldBoxes<'_>, run: &Run<'_>) -> bool {
        self.rings_around() == Some(1) && !self.touches_itself(boxes, run)
    }

    /// How many rings have their inside to the left; nothing where rings share
    /// a vertex.
    fn rings_around(&self) -> Option<usize> {
        let mut next: FxHashMap<u32, u32> = FxHashMap::default();
        for &[from, to] in &self.edges {
            if next.insert(from, to).is_some() {
                return None;
            }
        }
        let mut count = 0;
        for &[first, _] in &self.edges {
            let (mut ring, mut at) = (Vec::new(), first);
            while let Some(to) = next.remove(&at) {
                ring.push(at);
                at = to;
            }
            let least = (0..ring.len()).min_by(|&i, &j| self.compare(ring[i], ring[j]));
            // The least corner of a ring shows which way it turns.
            if let Some(i) = least {
                let corners = [ring.len() - 1, 0, 1].map(|step| ring[(i + step) % ring.len()]);
                count += usize::from(self.turn(corners) == Sign::Positive);
            }
        }
        Some(count)
    }

    fn turn(&self, corners: [u32; 3]) -> Sign {
        self.predicates.turn_along(corners, self.axis)
    }

    /// The order of two vertices as a line moves over the plane.
    fn compare(&self, a: u32, b: u32) -> std::cmp::Ordering {
        let place = |vertex: u32| self.mesh.vertices()[vertex as usize];
        let along = |axis: u8| {
            let axis = usize::from((self.axis + axis) % 3);
            place(a)[axis].total_cmp(&place(b)[axis])
        };
        along(1).then(along(2))
    }

    /// Whether two edges have more in common than a vertex that ends both.
    fn touches_itself(&self, boxes: &WorldBoxes<'_>, run: &Run<'_>) -> bool {
        let bounds: Vec<Bounds> = self.edges.iter().map(|edge| boxes.around(edge)).collect();
        // Predicates count without locks, so each worker has its own.
        let (mesh, axis, edges, points) =
            (self.mesh, self.axis, &self.edges, self.predicates.points());
        let found = Hierarchy::new(&bounds).overlapping_pairs(
            run,
            || (Predicates::<P>::new(points), false),
            |(predicates, found), i, j| {
                let outline = Outline { mesh, predicates, axis, edges: Vec::new() };
                let pair = [i, j].map(|edge| edges[edge as usize]);
                *found = *found || outline.meet(pair);
            },
        );
        // A stopped run leaves pairs out, and its answer is thrown away.
        found.iter().any(|(_, found)| *found)
    }

    /// Whether two edges meet, but for a common end.
    fn meet(&self, [[a, b], [c, d]]: [[u32; 2]; 2]) -> bool {
        let shared = [a, b].into_iter().find(|end| [c, d].contains(end));
        if let Some(shared) = shared {
            let [x, y] = [[a, b], [c, d]].map(|[p, q]| if p == shared { q } else { p });
            // On one line and to one side.
            return self.turn([shared, x, y]).is_zero()
                && self.compare(shared, x) == self.compare(shared, y);
        }
        let sides = [self.turn([a, b, c]), self.turn([a, b, d])];
        if sides == [Sign::Zero; 2] {
            let sorted = |p: u32, q: u32| if self.compare(p, q).is_lt() { [p, q] } else { [q, p] };
            let ([a, b], [c, d]) = (sorted(a, b), sorted(c, d));
            return self.compare(c, b).is_le() && self.compare(a, d).is_le();
        }
        sides[0] != sides[1] && self.turn([c, d, a]) != self.turn([c, d, b])
    }
}

#[cfg(test)]
mod tests;
