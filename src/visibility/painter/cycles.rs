//! Which sheets of a strongly connected component are cut.
//!
//! Where two sheets pass through one another, one of them has to be cut, so
//! all such pairs are, each sheet once before the links are found anew. Only
//! where there are none, cycles are looked for: from each sheet that is left a
//! shortest one, whose sheets are then left alone for this time. On a cycle the
//! cut is taken of which neither piece stands between the two neighbours of its
//! whole any more; where there is none such, the first that there is.

use super::graph::Graph;
use super::judge::{Judge, Relation};
use super::sheets::Sheet;
use crate::kernel::predicates::Policy;
use crate::run::Run;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::VecDeque;

/// A cut: a sheet by the plane of another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Chosen {
    pub(super) sheet: u32,
    pub(super) by: u32,
}

/// Sheets that a search for a further cycle may visit.
const FAR: usize = 256;

/// Cuts for a component: one at least, none twice of one sheet; perhaps fewer
/// once the run is stopped.
pub(super) fn choose<P: Policy>(
    graph: &Graph,
    judge: &Judge<'_, P>,
    component: &[u32],
    run: &Run<'_>,
) -> Vec<Chosen> {
    let crossing = crossing_pairs(graph, component);
    if !crossing.is_empty() {
        return crossing;
    }
    let mut used = FxHashSet::default();
    let mut chosen = Vec::new();
    for &start in component.iter().take_while(|_| !run.is_stopped()) {
        if used.contains(&start) {
            continue;
        }
        let far = if chosen.is_empty() { usize::MAX } else { FAR };
        let Some(cycle) = shortest_cycle(graph, start, &used, far) else { continue };
        if let Some(cut) = cut_on(graph, judge, &cycle) {
            chosen.push(cut);
            used.extend(cycle);
        }
    }
    chosen
}

/// Of each pair that passes through one another the later one is cut, so that
/// of two families of sheets only one is.
fn crossing_pairs(graph: &Graph, component: &[u32]) -> Vec<Chosen> {
    let mut used = FxHashSet::default();
    let mut chosen = Vec::new();
    for &by in component {
        if used.contains(&by) {
            continue;
        }
        let own = graph.labels[by as usize];
        let mut others: Vec<u32> = graph.links[by as usize]
            .iter()
            .filter(|link| link.relation == Relation::Both)
            .map(|link| link.to)
            .filter(|&to| by < to && graph.labels[to as usize] == own)
            .collect();
        others.sort_unstable();
        for sheet in others {
            if used.insert(sheet) {
                used.insert(by);
                chosen.push(Chosen { sheet, by });
            }
        }
    }
    chosen
}

/// A shortest cycle through a sheet that avoids those in `used`, in painting
/// order from that sheet; none if more than `far` would have to be visited.
fn shortest_cycle(
    graph: &Graph,
    start: u32,
    used: &FxHashSet<u32>,
    far: usize,
) -> Option<Vec<u32>> {
    let label = graph.labels[start as usize];
    let mut from: FxHashMap<u32, u32> = FxHashMap::default();
    let mut queue = VecDeque::from([start]);
    while let Some(node) = queue.pop_front() {
        for link in &graph.links[node as usize] {
            let to = link.to;
            let goes_on = link.relation != Relation::After
                && graph.labels[to as usize] == label
                && !used.contains(&to);
            if goes_on && to == start {
                let back = std::iter::successors(Some(node), |node| from.get(node).copied());
                let mut cycle: Vec<u32> = back.collect();
                cycle.reverse();
                return Some(cycle);
            }
            if goes_on && !from.contains_key(&to) {
                from.insert(to, node);
                queue.push_back(to);
            }
        }
        if far < from.len() {
            return None;
        }
    }
    None
}

/// The cut on a cycle.
fn cut_on<P: Policy>(graph: &Graph, judge: &Judge<'_, P>, cycle: &[u32]) -> Option<Chosen> {
    let mut first = None;
    for (i, &sheet) in cycle.iter().enumerate() {
        let [before, after] =
            [i + cycle.len() - 1, i + 1].map(|i| &graph.sheets[cycle[i % cycle.len()] as usize]);
        for &by in cycle.iter().filter(|&&by| by != sheet) {
            let [whole, other] = [sheet, by].map(|i| &graph.sheets[i as usize]);
            let Some(pieces) = whole.cut_by(&judge.predicates, other) else { continue };
            let chosen = Chosen { sheet, by };
            let stands_between = |piece: Sheet| {
                let comes_after = judge.relation(before, &piece);
                let comes_before = judge.relation(&piece, after);
                let leads = |relation| matches!(relation, Relation::Before | Relation::Both);
                leads(comes_after) && leads(comes_before)
            };
            if !pieces.into_iter().any(stands_between) {
                return Some(chosen);
            }
            first = first.or(Some(chosen));
        }
    }
    first
}
