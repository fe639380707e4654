//! The convex parts of a face.
//!
//! A face comes as the triangles of its triangulation. Where two parts share
//! an inner edge and their union is convex, the edge is left out (Hertel and
//! Mehlhorn 1983): a convex face becomes one part again, a concave one at most
//! four times as many as the fewest possible. Whether a corner is convex is
//! the exact sign of a turn. O(n) but for the lengths of the rings that are
//! joined.

use super::PlanePolygon;
use crate::kernel::predicates::{Policy, Predicates};
use rustc_hash::FxHashMap;

/// A convex part of a face.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// The polygon.
    pub polygon: PlanePolygon,
    /// Which of the face's triangles it is made of, ascending.
    pub triangles: Vec<u32>,
}

/// How many triangles may become one part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FaceParts {
    /// As many as make a convex polygon.
    Convex,
    /// One: the face does not lie in one plane, or its triangles have to be
    /// told apart.
    Triangles,
}

/// Joins the triangles of a face to convex parts, in the order of their first
/// triangles. Triangles that share an edge run along it in opposite senses.
pub fn convex_parts<P: Policy>(
    predicates: &Predicates<'_, P>,
    triangles: &[[u32; 3]],
    parts: FaceParts,
) -> Vec<Part> {
    let mut joining = Joining::new(triangles);
    if parts == FaceParts::Convex && triangles.len() > 1 {
        joining.join(predicates, triangles);
    }
    let is_inner = |[a, b]: [u32; 2]| joining.at.contains_key(&[b, a]);
    let rings = joining.rings.iter().zip(&joining.members).enumerate();
    rings
        .filter(|(_, (ring, _))| !ring.is_empty())
        .map(|(first, (ring, members))| {
            let mut members = members.clone();
            members.sort_unstable();
            let polygon = PlanePolygon::of_ring(triangles[first], ring, is_inner);
            Part { polygon, triangles: members }
        })
        .collect()
}

/// Rings that are being joined; the one of a triangle that went into another
/// is empty.
struct Joining {
    rings: Vec<Vec<u32>>,
    members: Vec<Vec<u32>>,
    /// The triangle on the left of each directed edge.
    at: FxHashMap<[u32; 2], u32>,
    /// The ring into which that of each triangle went.
    into: Vec<u32>,
}

impl Joining {
    fn new(triangles: &[[u32; 3]]) -> Self {
        let mut at = FxHashMap::default();
        if triangles.len() > 1 {
            for (i, &[a, b, c]) in triangles.iter().enumerate() {
                at.extend([[a, b], [b, c], [c, a]].map(|edge| (edge, i as u32)));
            }
        }
        Joining {
            rings: triangles.iter().map(|triangle| triangle.to_vec()).collect(),
            members: (0..triangles.len() as u32).map(|i| vec![i]).collect(),
            at,
            into: (0..triangles.len() as u32).collect(),
        }
    }

    fn ring_of(&self, mut triangle: u32) -> u32 {
        while self.into[triangle as usize] != triangle {
            triangle = self.into[triangle as usize];
        }
        triangle
    }

    fn join<P: Policy>(&mut self, predicates: &Predicates<'_, P>, triangles: &[[u32; 3]]) {
        let (axis, turn) = PlanePolygon::triangle(triangles[0]).axis(predicates);
        // A face that crosses itself has triangles that turn both ways.
        if triangles.iter().any(|&triangle| predicates.turn_along(triangle, axis) != turn) {
            return;
        }
        let is_convex =
            |p: u32, q: u32, r: u32| p != r && predicates.turn_along([p, q, r], axis) != -turn;
        for (i, &[a, b, c]) in triangles.iter().enumerate() {
            for edge in [[a, b], [b, c], [c, a]] {
                self.join_along(i as u32, edge, &is_convex);
            }
        }
    }

    /// Joins the rings on both sides of an edge of a triangle, if that makes
    /// a convex one.
    fn join_along(
        &mut self,
        triangle: u32,
        [a, b]: [u32; 2],
        is_convex: &impl Fn(u32, u32, u32) -> bool,
    ) {
        let Some(&other) = self.at.get(&[b, a]) else { return };
        let (left, right) = (self.ring_of(triangle), self.ring_of(other));
        if left == right {
            return;
        }
        // From b around the left ring to a, from a around the right one to b.
        let (Some(around), Some(back)) =
            (opened(&self.rings[left as usize], b, a), opened(&self.rings[right as usize], a, b))
        else {
            return;
        };
        let (l, r) = (around.len(), back.len());
        if !is_convex(around[l - 2], a, back[1]) || !is_convex(back[r - 2], b, around[1]) {
            return;
        }
        let joined = [&around[..l - 1], &back[..r - 1]].concat();
        let (into, from) = (left.min(right), left.max(right));
        self.rings[from as usize].clear();
        self.rings[into as usize] = joined;
        let moved = std::mem::take(&mut self.members[from as usize]);
        self.members[into as usize].extend(moved);
        self.into[from as usize] = into;
        self.at.remove(&[a, b]);
        self.at.remove(&[b, a]);
    }
}

/// A ring from one vertex all the way to the one before it.
fn opened(ring: &[u32], first: u32, last: u32) -> Option<Vec<u32>> {
    let places = 0..ring.len();
    let start = places
        .into_iter()
        .find(|&i| ring[i] == first && ring[(i + ring.len() - 1) % ring.len()] == last)?;
    Some([&ring[start..], &ring[..start]].concat())
}
