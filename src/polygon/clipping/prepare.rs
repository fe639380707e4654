//! From rings to sorted edges.

use super::fill::{FillRule, States};
use super::sweep::{Edge, Ends};
use super::{Corner, Operand};
use crate::kernel::predicates::{Approximation, Chart, ImagePoint, Policy, Predicates};
use crate::run::sort_by;
use std::cmp::Ordering;

/// All edges of all operands, by their left ends, and these ends.
pub(super) fn prepare<P: Policy>(
    predicates: &Predicates<'_, P>,
    chart: &Chart,
    operands: &[Operand<'_>],
    states: &mut States<'_>,
) -> (Ends, Vec<Edge>) {
    let mut corners: Vec<ImagePoint> = Vec::new();
    for operand in operands {
        let shift = |corner: &Corner| corner.shifted(operand.first_vertex).point;
        let rings = operand.polygons.iter().flat_map(|polygon| &polygon.rings);
        corners.extend(rings.flatten().map(shift));
    }
    let (ends, numbers) = sort_ends(predicates, chart, &corners);
    let mut edges = Vec::with_capacity(corners.len());
    let mut first = 0;
    for (number, operand) in operands.iter().enumerate() {
        let mut counters = Counters { operand: number as u32, rule: operand.rule, common: None };
        for (polygon, rings) in operand.polygons.iter().enumerate() {
            for (place, ring) in rings.rings.iter().enumerate() {
                let counter = counters.of_ring(states, polygon as u32, place);
                let numbers = &numbers[first..first + ring.len()];
                let shift = operand.first_vertex;
                add_ring(ring, shift, numbers, counter, &mut edges);
                first += ring.len();
            }
        }
    }
    (ends, by_left_end(edges, numbers.len()))
}

/// Hands out the counters of an operand.
struct Counters {
    operand: u32,
    rule: FillRule,
    common: Option<u32>,
}

impl Counters {
    fn of_ring(&mut self, states: &mut States<'_>, polygon: u32, place: usize) -> u32 {
        if self.rule == FillRule::Polygons {
            return states.counter(self.operand, polygon, place > 0);
        }
        *self.common.get_or_insert_with(|| states.counter(self.operand, 0, false))
    }
}

fn add_ring(ring: &[Corner], shift: u32, ends: &[u32], counter: u32, edges: &mut Vec<Edge>) {
    for (i, corner) in ring.iter().enumerate() {
        let (from, to) = (ends[i], ends[if i + 1 == ends.len() { 0 } else { i + 1 }]);
        let line = corner.shifted(shift).line;
        match from.cmp(&to) {
            Ordering::Less => {
                edges.push(Edge { line, left: from, right: to, counter, delta: 1 });
            }
            Ordering::Greater => {
                let line = line.reversed();
                edges.push(Edge { line, left: to, right: from, counter, delta: -1 });
            }
            // An edge without an image.
            Ordering::Equal => {}
        }
    }
}

/// Sorts edges by their left ends, by counting.
fn by_left_end(edges: Vec<Edge>, ends: usize) -> Vec<Edge> {
    let Some(&filler) = edges.first() else {
        return edges;
    };
    let mut next = vec![0_u32; ends + 1];
    edges.iter().for_each(|edge| next[edge.left as usize + 1] += 1);
    let mut sum = 0;
    for start in &mut next {
        sum += *start;
        *start = sum;
    }
    let mut sorted = vec![filler; edges.len()];
    for edge in edges {
        let place = &mut next[edge.left as usize];
        sorted[*place as usize] = edge;
        *place += 1;
    }
    sorted
}

/// Sorts points in the order of the sweep and numbers them; those at one
/// place have one number.
fn sort_ends<P: Policy>(
    predicates: &Predicates<'_, P>,
    chart: &Chart,
    corners: &[ImagePoint],
) -> (Ends, Vec<u32>) {
    let mut order: Vec<(Approximation, u32)> = corners
        .iter()
        .enumerate()
        .map(|(i, &point)| (predicates.approximate(chart, point), i as u32))
        .collect();
    let compare = |a: &(Approximation, u32), b: &(Approximation, u32)| {
        a.0.compare(&b.0).unwrap_or_else(|| {
            predicates.sweep(chart, corners[a.1 as usize], corners[b.1 as usize])
        })
    };
    if order.iter().all(|(approximation, _)| approximation.error == 0.0) {
        // Places that are known exactly need no predicate.
        sort_by(&mut order, |(a, i), (b, j)| {
            let [[x, y], [u, v]] = [a.place, b.place];
            x.total_cmp(&u).then(y.total_cmp(&v)).then(i.cmp(j))
        });
    } else {
        order.sort_unstable_by(|a, b| compare(a, b).then(a.1.cmp(&b.1)));
    }
    let mut ends = Ends::default();
    ends.points.reserve(corners.len());
    ends.approximations.reserve(corners.len());
    let mut numbers = vec![0; corners.len()];
    for (i, (approximation, corner)) in order.iter().enumerate() {
        if i == 0 || compare(&order[i - 1], &order[i]) == Ordering::Less {
            ends.points.push(corners[*corner as usize]);
            ends.approximations.push(*approximation);
        }
        numbers[*corner as usize] = ends.points.len() as u32 - 1;
    }
    (ends, numbers)
}
