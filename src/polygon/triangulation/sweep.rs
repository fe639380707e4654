//! The triangulation inside of an outline by a sweep, for any coordinates.
//!
//! A line sweeps the plane from left to right, and upwards along what is
//! straight above (as if tilted a little). The edges that it meets part it into
//! gaps. In each gap that belongs to the polygon, what is left to the left of
//! the line is bounded by a *chain* of points from the gap's lower edge to its
//! upper one, which turns left everywhere or goes straight on; so a point that
//! is met next sees a stretch of the chain, and is joined to that. (Hertel and
//! Mehlhorn 1983; Bentley and Ottmann 1979 for the sweep.) A point inside of a
//! gap is seen by the latest point of the chain, and divides it there; where
//! two gaps become one, so do their chains.
//!
//! A point on an edge divides the edge. Edges that run out from one point in
//! one direction become one up to the nearer end. Two edges that cross are
//! neighbours on the line before they do, and are refused then, unless they
//! cross at a point, which will divide them. Nothing else is asked but the order
//! of two points and the turn of three. O(n log n) of either, for n points and
//! edges; chains are joined the shorter to the longer.

use super::outline::{Edge, Insideness};
use super::{Outline, TriangulationError};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{
    Chart, Exact, Eye, ImageLine, ImagePoint, Points, Predicates, orientation,
};
use glam::DVec3;
use std::cell::OnceCell;
use std::cmp::Ordering;
use std::collections::VecDeque;

/// The triangles inside of an outline, by its points, counterclockwise.
pub(super) fn triangulate(outline: &Outline) -> Result<Vec<[u32; 3]>, TriangulationError> {
    let mut sweep = Sweep {
        outline,
        leaving: vec![Vec::new(); outline.points.len()],
        met: Vec::new(),
        line: Vec::new(),
        triangles: Vec::new(),
        points: OnceCell::new(),
    };
    for edge in &outline.edges {
        sweep.leaving[edge.ends[0] as usize].push(*edge);
    }
    for point in 0..outline.points.len() as u32 {
        sweep.pass(point)?;
    }
    Ok(sweep.triangles)
}

/// An edge on the line, and the gap above it.
struct Met {
    edge: Edge,
    above: Insideness,
    /// The chain of the gap, if it is inside.
    chain: Option<Chain>,
}

/// From the point where a gap's lower edge began to that of its upper edge.
struct Chain {
    points: VecDeque<u32>,
    /// Where the latest of them stands.
    latest: usize,
}

impl Chain {
    fn of(point: u32) -> Self {
        Chain { points: VecDeque::from([point]), latest: 0 }
    }
}

struct Sweep<'a> {
    outline: &'a Outline,
    /// The edges that run on from each point.
    leaving: Vec<Vec<Edge>>,
    /// All edges that have been met.
    met: Vec<Met>,
    /// Which of them the line meets, from below.
    line: Vec<u32>,
    triangles: Vec<[u32; 3]>,
    /// The points of the outline, for questions about crossings.
    points: OnceCell<Points>,
}

impl Sweep<'_> {
    fn turn(&self, a: u32, b: u32, c: u32) -> Sign {
        let [a, b, c] = [a, b, c].map(|point| self.outline.points[point as usize]);
        orientation(a, b, c)
    }

    fn edge(&self, place: usize) -> Edge {
        self.met[self.line[place] as usize].edge
    }

    /// The gap below a place of the line; nothing below all edges.
    fn gap_below(&mut self, place: usize) -> Option<&mut Met> {
        let met = self.line[place.checked_sub(1)?];
        Some(&mut self.met[met as usize])
    }

    /// Moves the line past a point.
    fn pass(&mut self, point: u32) -> Result<(), TriangulationError> {
        let side = |met: u32| {
            let [from, to] = self.met[met as usize].edge.ends;
            self.turn(from, to, point)
        };
        let start = self.line.partition_point(|&met| side(met) == Sign::Positive);
        let end = start + self.line[start..].partition_point(|&met| side(met).is_zero());
        for place in start..end {
            let edge = self.edge(place);
            if edge.ends[1] != point {
                self.leaving[point as usize].push(Edge { ends: [point, edge.ends[1]], ..edge });
            }
        }
        let leaving = self.bundle(point);
        if start == end && leaving.is_empty() {
            return Ok(());
        }
        let (below, above) = self.close(point, start, end);
        self.open(point, start..end, &leaving, [below, above]);
        self.check_neighbours(start)?;
        self.check_neighbours(start + leaving.len())
    }

    /// The edges that leave a point, from below; of those in one direction
    /// the nearest, and what lies beyond its end goes on from there.
    fn bundle(&mut self, point: u32) -> Vec<Edge> {
        let mut edges = std::mem::take(&mut self.leaving[point as usize]);
        edges.sort_by(|a, b| {
            let turn = self.turn(point, a.ends[1], b.ends[1]);
            // Along one direction farther points have greater numbers.
            0.cmp(&turn.to_i32()).then(a.ends[1].cmp(&b.ends[1]))
        });
        let mut bundles: Vec<Edge> = Vec::new();
        for edge in edges {
            match bundles.last_mut() {
                Some(last) if self.turn(point, last.ends[1], edge.ends[1]).is_zero() => {
                    last.change = last.change.plus(edge.change);
                    if last.ends[1] != edge.ends[1] {
                        let rest = Edge { ends: [last.ends[1], edge.ends[1]], ..edge };
                        self.leaving[last.ends[1] as usize].push(rest);
                    }
                }
                _ => bundles.push(edge),
            }
        }
        bundles.retain(|edge| edge.change != Insideness::default());
        bundles
    }

    /// Joins a point to the chains of all gaps that it touches. Returns what
    /// is left of the chain of the lowest gap and of the highest, which are
    /// one gap if no edge ends there.
    fn close(&mut self, point: u32, start: usize, end: usize) -> (Option<Chain>, Option<Chain>) {
        let below = self.gap_below(start).and_then(|gap| gap.chain.take());
        if start == end {
            return match below {
                None => (None, None),
                Some(chain) => {
                    let (below, above) = self.divide(chain, point);
                    (Some(below), Some(above))
                }
            };
        }
        for place in start + 1..end {
            if let Some(mut chain) = self.gap_below(place).and_then(|gap| gap.chain.take()) {
                self.add_from_below(&mut chain, point);
                debug_assert_eq!(chain.points.len(), 2, "a gap is closed by all its triangles");
            }
        }
        let below = below.map(|mut chain| {
            self.add_from_above(&mut chain, point);
            chain
        });
        let above = self.gap_below(end).and_then(|gap| gap.chain.take()).map(|mut chain| {
            self.add_from_below(&mut chain, point);
            chain
        });
        (below, above)
    }

    /// Puts the edges that leave a point in the place of those that end there,
    /// with the chains of the gaps between them.
    fn open(
        &mut self,
        point: u32,
        places: std::ops::Range<usize>,
        leaving: &[Edge],
        [below, above]: [Option<Chain>; 2],
    ) {
        let start = places.start;
        let mut insideness = self.gap_below(start).map_or(Insideness::default(), |gap| gap.above);
        let first = self.met.len() as u32;
        for edge in leaving {
            insideness = insideness.plus(edge.change);
            let chain = insideness.is_inside().then(|| Chain::of(point));
            self.met.push(Met { edge: *edge, above: insideness, chain });
        }
        self.line.splice(places, first..first + leaving.len() as u32);
        if leaving.is_empty() {
            let chain = below.zip(above).map(|(below, above)| join(below, above));
            if let Some(gap) = self.gap_below(start) {
                gap.chain = chain;
            }
            return;
        }
        if let Some(gap) = self.gap_below(start) {
            gap.chain = below;
        }
        if let Some(gap) = self.gap_below(start + leaving.len())
            && above.is_some()
        {
            gap.chain = above;
        }
    }

    /// Refuses edges that cross, below and above a place of the line.
    fn check_neighbours(&self, place: usize) -> Result<(), TriangulationError> {
        if place == 0 || place >= self.line.len() {
            return Ok(());
        }
        let [below, above] = [self.edge(place - 1), self.edge(place)];
        let are_apart = |[a, b]: [u32; 2], [c, d]: [u32; 2]| {
            !self.turn(a, b, c).is_opposite(self.turn(a, b, d))
        };
        let cross = !are_apart(below.ends, above.ends) && !are_apart(above.ends, below.ends);
        if !cross || self.is_crossing_a_point(below.ends, above.ends) {
            return Ok(());
        }
        Err(TriangulationError::Crossing(below.ring.max(above.ring) as usize))
    }

    /// Whether there is a point where two edges cross.
    fn is_crossing_a_point(&self, below: [u32; 2], above: [u32; 2]) -> bool {
        let points = self.points.get_or_init(|| {
            let vertices: Vec<DVec3> = self.outline.points.iter().map(|p| p.extend(0.0)).collect();
            Points::new(&vertices, Eye::Towards(DVec3::Z), None)
        });
        let Some(chart) = Chart::new(points) else { return false };
        let predicates = Predicates::<Exact>::new(points);
        // The lower edge turns left of the upper one.
        let crossing = ImagePoint::Crossing([above, below].map(ImageLine::Edge));
        let order = |point: u32| predicates.sweep(&chart, ImagePoint::Vertex(point), crossing);
        let (mut start, mut end) = (below[0].max(above[0]), below[1].min(above[1]));
        while start < end {
            let middle = start + (end - start) / 2;
            match order(middle) {
                Ordering::Less => start = middle + 1,
                Ordering::Equal => return true,
                Ordering::Greater => end = middle,
            }
        }
        false
    }

    /// Whether a point to the right sees the side of a chain from `low` up
    /// to `high`; then it is a triangle.
    fn sees(&mut self, low: u32, point: u32, high: u32) -> bool {
        let sees = self.turn(low, point, high) == Sign::Positive;
        if sees {
            self.triangles.push([low, point, high]);
        }
        sees
    }

    /// Adds a point of the gap's lower edge.
    fn add_from_below(&mut self, chain: &mut Chain, point: u32) {
        let points = &mut chain.points;
        while points.len() > 1 && self.sees(points[0], point, points[1]) {
            points.pop_front();
        }
        points.push_front(point);
        chain.latest = 0;
    }

    /// Adds a point of the gap's upper edge.
    fn add_from_above(&mut self, chain: &mut Chain, point: u32) {
        let points = &mut chain.points;
        while let Some(low) = points.len().checked_sub(2)
            && self.sees(points[low], point, points[low + 1])
        {
            points.pop_back();
        }
        points.push_back(point);
        chain.latest = points.len() - 1;
    }

    /// Parts a chain at a point inside of its gap.
    fn divide(&mut self, mut chain: Chain, point: u32) -> (Chain, Chain) {
        let points = &chain.points;
        let (mut low, mut high) = (chain.latest, chain.latest);
        while low > 0 && self.sees(points[low - 1], point, points[low]) {
            low -= 1;
        }
        while high + 1 < points.len() && self.sees(points[high], point, points[high + 1]) {
            high += 1;
        }
        let mut above = chain.points.split_off(high);
        above.push_front(point);
        // The stretch is one point where nothing was seen of the chain but it.
        let shared = (low == high).then(|| above[1]);
        chain.points.truncate(low + 1);
        chain.points.extend(shared);
        chain.points.push_back(point);
        chain.latest = chain.points.len() - 1;
        (chain, Chain { points: above, latest: 0 })
    }
}

/// The chain of the gap that two gaps become at a point, which is the last of
/// the lower chain and the first of the upper one.
fn join(mut below: Chain, mut above: Chain) -> Chain {
    above.points.pop_front();
    let latest = below.points.len() - 1;
    match below.points.len().cmp(&above.points.len()) {
        Ordering::Less => {
            for point in below.points.into_iter().rev() {
                above.points.push_front(point);
            }
            Chain { points: above.points, latest }
        }
        _ => {
            below.points.append(&mut above.points);
            Chain { points: below.points, latest }
        }
    }
}
