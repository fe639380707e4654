//! Edges and their triangles, for any soup: an edge has a list of incident
//! triangles of any length.
//!
//! Half-edges are dealt into ranges of their smaller vertex, sorted within
//! each range by counting, and equal ones are neighbours then. Ranges are
//! independent and run in parallel; edges come out ordered by their
//! vertices, whatever the order of the triangles. O(n).

use crate::run::{join_lists, map_chunks, map_parts};

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

/// Bits of a vertex within its range: the counters of a range stay in the
/// cache.
const RANGE_BITS: u32 = 12;

/// Bits of a triangle within its part of the dealing.
const PART_BITS: u32 = 18;

/// One side of one triangle, in one word: the larger vertex, the smaller one
/// within its range, the triangle within its part.
#[derive(Debug, Clone, Copy)]
struct HalfEdge(u64);

impl HalfEdge {
    #[inline(always)]
    fn new(x: u32, y: u32, triangle: usize) -> Self {
        let low = x.min(y) & ((1 << RANGE_BITS) - 1);
        let high = u64::from(x.max(y)) << RANGE_BITS | u64::from(low);
        HalfEdge(high << PART_BITS | triangle as u64 & ((1 << PART_BITS) - 1))
    }

    #[inline(always)]
    fn low(self) -> usize {
        (self.0 >> PART_BITS) as usize & ((1 << RANGE_BITS) - 1)
    }

    #[inline(always)]
    fn high(self) -> u32 {
        (self.0 >> (PART_BITS + RANGE_BITS)) as u32
    }

    #[inline(always)]
    fn triangle(self) -> u32 {
        self.0 as u32 & ((1 << PART_BITS) - 1)
    }
}

/// The half-edges of one part of the triangles, ordered by range.
struct Dealt {
    /// As words: memory for these comes as zeros.
    half_edges: Vec<u64>,
    ends: Vec<u32>,
}

impl Dealt {
    fn range(&self, range: usize) -> impl ExactSizeIterator<Item = HalfEdge> + Clone + '_ {
        let start = if range == 0 { 0 } else { self.ends[range - 1] as usize };
        self.half_edges[start..self.ends[range] as usize].iter().map(|&word| HalfEdge(word))
    }
}

/// Turns numbers of items into the places where they begin, one list after
/// the other; leaves where they end.
fn places(ends: &mut [u32]) -> Vec<u32> {
    let mut sum = 0;
    let place = |end: &mut u32| {
        let start = sum;
        sum += *end;
        *end = sum;
        start
    };
    ends.iter_mut().map(place).collect()
}

fn deal(triangles: &[[u32; 3]], part: std::ops::Range<usize>, ranges: usize) -> Dealt {
    let mut ends = vec![0_u32; ranges];
    let range = |x: u32, y: u32| (x.min(y) >> RANGE_BITS) as usize;
    for &[a, b, c] in &triangles[part.clone()] {
        [[a, b], [b, c], [c, a]].into_iter().for_each(|[x, y]| ends[range(x, y)] += 1);
    }
    let mut next = places(&mut ends);
    let mut half_edges = vec![0; 3 * part.len()];
    for (triangle, &[a, b, c]) in triangles[part].iter().enumerate() {
        for [x, y] in [[a, b], [b, c], [c, a]] {
            let slot = &mut next[range(x, y)];
            half_edges[*slot as usize] = HalfEdge::new(x, y, triangle).0;
            *slot += 1;
        }
    }
    Dealt { half_edges, ends }
}

/// Finds the edges of triangles over `vertices` vertices.
pub(super) fn edges_of(triangles: &[[u32; 3]], vertices: usize) -> Edges {
    let ranges = (vertices >> RANGE_BITS) + 1;
    let parts = map_chunks(triangles.len(), 1 << PART_BITS, |part| deal(triangles, part, ranges));
    let mut incident = vec![0; 3 * triangles.len()];
    let mut ends = Vec::with_capacity(ranges);
    let mut sum = 0;
    for range in 0..ranges {
        sum += parts.iter().map(|part| part.range(range).len()).sum::<usize>();
        ends.push(sum);
    }
    let found = map_parts(&mut incident, &ends, |range, incident| {
        let before = if range == 0 { 0 } else { ends[range - 1] };
        let half_edges = parts.iter().map(|part| part.range(range)).collect::<Vec<_>>();
        edges_of_range(&half_edges, (range as u32) << RANGE_BITS, before as u32, incident)
    });
    // Its memory is of use for the lists below.
    drop(parts);
    let (ends, incident_ends) = found.into_iter().map(|edges| (edges.ends, edges.incident)).unzip();
    Edges {
        ends: join_lists(ends, |_, ends| *ends),
        incident: join_lists(incident_ends, |_, end| *end),
        triangles: incident,
    }
}

/// The edges whose smaller vertex lies in the range that begins at `first`,
/// without their triangles, which go to `triangles`, behind `before` others.
/// `half_edges` are those of each part.
fn edges_of_range(
    half_edges: &[impl Iterator<Item = HalfEdge> + Clone],
    first: u32,
    before: u32,
    triangles: &mut [u32],
) -> Edges {
    let mut ends = [0_u32; 1 << RANGE_BITS];
    half_edges.iter().cloned().flatten().for_each(|half_edge| ends[half_edge.low()] += 1);
    let mut next = places(&mut ends);
    // The larger vertex and the triangle, in one word for the sake of sorting.
    let mut spokes = vec![0_u64; triangles.len()];
    for (part, half_edges) in half_edges.iter().enumerate() {
        for half_edge in half_edges.clone() {
            let triangle = (part as u32) << PART_BITS | half_edge.triangle();
            let slot = &mut next[half_edge.low()];
            spokes[*slot as usize] = u64::from(half_edge.high()) << 32 | u64::from(triangle);
            *slot += 1;
        }
    }
    let same_edge = |a: &u64, b: &u64| a >> 32 == b >> 32;
    let (mut start, mut count) = (0, 0);
    for &end in &ends {
        let around = &mut spokes[start..end as usize];
        around.sort_unstable();
        count += around.chunk_by(same_edge).count();
        start = end as usize;
    }
    let mut edges = Edges::default();
    edges.ends.reserve_exact(count);
    edges.incident.reserve_exact(count);
    let (mut start, mut place) = (0, 0);
    for (low, &end) in (first..).zip(&ends) {
        for edge in spokes[start..end as usize].chunk_by(same_edge) {
            edges.ends.push([low, (edge[0] >> 32) as u32]);
            for spoke in edge {
                triangles[place] = *spoke as u32;
                place += 1;
            }
            edges.incident.push(before + place as u32);
        }
        start = end as usize;
    }
    edges
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
