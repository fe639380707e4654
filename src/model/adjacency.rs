//! Edges and their triangles, for any soup: an edge has a list of incident
//! triangles of any length.
//!
//! Half-edges are dealt into ranges of their smaller vertex, sorted within
//! each range by counting, and equal ones are neighbours then. Ranges are
//! independent and run in parallel; edges come out ordered by their
//! vertices, whatever the order of the triangles. O(n).

use crate::run::{concat_map, map_chunks, map_indexed};

/// All edges of a mesh, each with its incident triangles.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Edges {
    ends: Vec<[u32; 2]>,
    /// End of each edge's incident triangles in `triangles`.
    incident: Vec<u32>,
    triangles: Vec<u32>,
}

impl Edges {
    /// The number of edges.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is no edge.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The vertices of an edge, the smaller number first.
    #[inline(always)]
    pub fn ends(&self, edge: u32) -> [u32; 2] {
        self.ends[edge as usize]
    }

    /// The triangles at an edge, in ascending order.
    #[inline(always)]
    pub fn triangles(&self, edge: u32) -> &[u32] {
        let start = if edge == 0 { 0 } else { self.incident[edge as usize - 1] as usize };
        &self.triangles[start..self.incident[edge as usize] as usize]
    }

    /// The edge between two vertices, if there is one. O(log n).
    pub fn find(&self, a: u32, b: u32) -> Option<u32> {
        let ends = [a.min(b), a.max(b)];
        self.ends.binary_search(&ends).ok().map(|edge| edge as u32)
    }
}

/// One side of one triangle.
#[derive(Debug, Clone, Copy, Default)]
struct HalfEdge {
    low: u32,
    high: u32,
    triangle: u32,
}

/// Vertices per range: the counters of a range stay in the cache.
const RANGE_BITS: u32 = 12;

/// Triangles of one part of the dealing.
const PART: usize = 1 << 18;

/// The half-edges of one part of the triangles, ordered by range.
struct Dealt {
    half_edges: Vec<HalfEdge>,
    ends: Vec<u32>,
}

fn half_edges(triangles: &[[u32; 3]], triangle: usize) -> [HalfEdge; 3] {
    let [a, b, c] = triangles[triangle];
    let half_edge =
        |x: u32, y: u32| HalfEdge { low: x.min(y), high: x.max(y), triangle: triangle as u32 };
    [half_edge(a, b), half_edge(b, c), half_edge(c, a)]
}

fn deal(triangles: &[[u32; 3]], part: std::ops::Range<usize>, ranges: usize) -> Dealt {
    let mut ends = vec![0_u32; ranges];
    for triangle in part.clone() {
        for half_edge in half_edges(triangles, triangle) {
            ends[(half_edge.low >> RANGE_BITS) as usize] += 1;
        }
    }
    let mut next = Vec::with_capacity(ranges);
    let mut sum = 0;
    for end in &mut ends {
        next.push(sum);
        sum += *end;
        *end = sum;
    }
    let mut dealt = vec![HalfEdge::default(); 3 * part.len()];
    for triangle in part {
        for half_edge in half_edges(triangles, triangle) {
            let slot = &mut next[(half_edge.low >> RANGE_BITS) as usize];
            dealt[*slot as usize] = half_edge;
            *slot += 1;
        }
    }
    Dealt { half_edges: dealt, ends }
}

/// Finds the edges of triangles over `vertices` vertices.
pub(super) fn edges_of(triangles: &[[u32; 3]], vertices: usize) -> Edges {
    let ranges = (vertices >> RANGE_BITS) + 1;
    let parts = map_chunks(triangles.len(), PART, |part| deal(triangles, part, ranges));
    let found = map_indexed(ranges, |range| {
        let half_edges = parts.iter().flat_map(|part| {
            let start = if range == 0 { 0 } else { part.ends[range - 1] as usize };
            &part.half_edges[start..part.ends[range] as usize]
        });
        edges_of_range(half_edges.copied(), (range as u32) << RANGE_BITS)
    });
    drop(parts);
    concatenate(&found)
}

/// The edges whose smaller vertex lies in the range that begins at `first`.
/// `half_edges` come in ascending order of their triangles.
fn edges_of_range(half_edges: impl Iterator<Item = HalfEdge> + Clone, first: u32) -> Edges {
    let mut ends = vec![0_u32; 1 << RANGE_BITS];
    half_edges.clone().for_each(|half_edge| ends[(half_edge.low - first) as usize] += 1);
    let mut next = Vec::with_capacity(ends.len());
    let mut sum = 0;
    for end in &mut ends {
        next.push(sum);
        sum += *end;
        *end = sum;
    }
    let mut sorted = vec![(0, 0); sum as usize];
    for half_edge in half_edges {
        let slot = &mut next[(half_edge.low - first) as usize];
        sorted[*slot as usize] = (half_edge.high, half_edge.triangle);
        *slot += 1;
    }
    let mut edges = Edges::default();
    let mut start = 0;
    for (offset, &end) in ends.iter().enumerate() {
        let spokes = &mut sorted[start as usize..end as usize];
        spokes.sort_unstable();
        for spokes in spokes.chunk_by(|a, b| a.0 == b.0) {
            edges.ends.push([first + offset as u32, spokes[0].0]);
            edges.triangles.extend(spokes.iter().map(|spoke| spoke.1));
            edges.incident.push(edges.triangles.len() as u32);
        }
        start = end;
    }
    edges
}

fn concatenate(found: &[Edges]) -> Edges {
    let mut offsets = Vec::with_capacity(found.len());
    let mut sum = 0;
    for part in found {
        offsets.push(sum);
        sum += part.triangles.len() as u32;
    }
    let ends: Vec<&[[u32; 2]]> = found.iter().map(|part| &part.ends[..]).collect();
    let incident: Vec<&[u32]> = found.iter().map(|part| &part.incident[..]).collect();
    let triangles: Vec<&[u32]> = found.iter().map(|part| &part.triangles[..]).collect();
    Edges {
        ends: concat_map(&ends, |_, ends| *ends),
        incident: concat_map(&incident, |part, end| end + offsets[part]),
        triangles: concat_map(&triangles, |_, triangle| *triangle),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fan_around_an_edge_lists_all_its_triangles() {
        let edges = edges_of(&[[0, 1, 2], [1, 0, 3], [4, 1, 0]], 5);
        assert_eq!(edges.len(), 7);
        let shared = edges.find(1, 0);
        assert_eq!(shared.map(|edge| edges.triangles(edge).to_vec()), Some(vec![0, 1, 2]));
        assert_eq!(edges.find(2, 3), None);
    }

    #[test]
    fn edges_across_ranges_are_found_once() {
        let far = 3 << RANGE_BITS;
        let edges = edges_of(&[[0, far, far + 1], [far + 1, far, 7]], far as usize + 2);
        let all: Vec<_> = (0..edges.len() as u32).map(|edge| edges.ends(edge)).collect();
        assert_eq!(all, [[0, far], [0, far + 1], [7, far], [7, far + 1], [far, far + 1]]);
    }
}
