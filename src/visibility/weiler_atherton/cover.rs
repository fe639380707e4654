//! Everything in front of one face, as one operand of a clip.
//!
//! Images of triangles are counterclockwise rings, so a place is covered if
//! they wind around it at all. An edge between two of them that lie on its
//! two sides is used in both directions and may as well be left out: of a
//! sheet of many triangles only the border is left.

use crate::kernel::predicates::{ImageLine, ImagePoint};
use crate::polygon::clipping::{Corner, Polygon, Ring};
use rustc_hash::FxHashMap;

/// What covers a face, collected.
#[derive(Debug, Default)]
pub(super) struct Cover {
    /// Edges of whole images, directed.
    edges: Vec<[u32; 2]>,
    /// Images that have been cut.
    rings: Vec<Ring>,
}

impl Cover {
    pub(super) fn clear(&mut self) {
        self.edges.clear();
        self.rings.clear();
    }

    pub(super) fn is_empty(&self) -> bool {
        self.edges.is_empty() && self.rings.is_empty()
    }

    /// Adds a convex ring.
    pub(super) fn push(&mut self, ring: Ring) {
        let edge = |corner: &Corner| match (corner.point, corner.line) {
            (ImagePoint::Vertex(from), ImageLine::Edge([a, b])) if from == a => Some([a, b]),
            _ => None,
        };
        let whole: Option<Vec<[u32; 2]>> = ring.iter().map(edge).collect();
        match whole {
            Some(edges)
                if (0..edges.len()).all(|i| edges[i][1] == edges[(i + 1) % edges.len()][0]) =>
            {
                self.edges.extend(edges);
            }
            _ => self.rings.push(ring),
        }
    }

    /// The rings of what was collected.
    pub(super) fn polygon(&mut self) -> Polygon {
        self.cancel();
        let mut rings = std::mem::take(&mut self.rings);
        let mut next: FxHashMap<u32, usize> = FxHashMap::default();
        for (i, [from, _]) in self.edges.iter().enumerate().rev() {
            next.insert(*from, i);
        }
        // As many edges arrive at a vertex as leave it, so a walk ends where
        // it began.
        for first in 0..self.edges.len() {
            let start = self.edges[first][0];
            if next.get(&start) != Some(&first) {
                continue;
            }
            let (mut ring, mut at) = (Vec::new(), start);
            while let Some(index) = next.get_mut(&at) {
                let Some(&[from, to]) = self.edges.get(*index).filter(|edge| edge[0] == at) else {
                    break;
                };
                *index += 1;
                let line = ImageLine::Edge([from, to]);
                ring.push(Corner { point: ImagePoint::Vertex(from), line });
                at = to;
                if at == start {
                    break;
                }
            }
            rings.push(ring);
        }
        Polygon { rings }
    }

    /// Leaves out edges that are used in both directions, each as often;
    /// sorts the others.
    fn cancel(&mut self) {
        let key = |edge: &[u32; 2]| [edge[0].min(edge[1]), edge[0].max(edge[1])];
        self.edges.sort_unstable_by_key(key);
        let mut kept = Vec::with_capacity(self.edges.len());
        for same in self.edges.chunk_by(|a, b| key(a) == key(b)) {
            let [low, high] = key(&same[0]);
            let ahead = same.iter().filter(|edge| edge[0] == low).count();
            let back = same.len() - ahead;
            kept.extend(std::iter::repeat_n([low, high], ahead.saturating_sub(back)));
            kept.extend(std::iter::repeat_n([high, low], back.saturating_sub(ahead)));
        }
        kept.sort_unstable();
        self.edges = kept;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(corners: [u32; 3]) -> Ring {
        Polygon::of_vertices([corners]).rings.remove(0)
    }

    #[test]
    fn a_fan_is_its_border_and_a_fold_counts_twice() {
        let mut cover = Cover::default();
        for i in 1..=5 {
            cover.push(triangle([0, i, i % 5 + 1]));
        }
        let fan = cover.polygon();
        assert_eq!(fan.rings.len(), 1);
        assert_eq!(fan.rings[0].len(), 5);
        cover.clear();
        cover.push(triangle([0, 1, 2]));
        cover.push(triangle([0, 1, 3]));
        let fold = cover.polygon();
        assert_eq!(fold.rings.iter().map(Vec::len).sum::<usize>(), 6);
    }

    #[test]
    fn rings_that_meet_in_a_vertex_close() {
        let mut cover = Cover::default();
        cover.push(triangle([0, 1, 2]));
        cover.push(triangle([0, 3, 4]));
        assert!(!cover.is_empty());
        let lengths: Vec<usize> = cover.polygon().rings.iter().map(Vec::len).collect();
        assert_eq!(lengths, [3, 3]);
    }
}
