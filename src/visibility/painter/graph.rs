//! The graph of what must be painted before what, and the order it allows.
//!
//! 1. *Pairs.* Sheets whose boxes overlap in the image, from a hierarchy of
//!    flat boxes; each pair that overlaps in area is linked in the sense that
//!    the tests find, or in both where two sheets pass through one another.
//! 2. *Components.* Only strongly connected ones have no order. In each, sheets
//!    are cut ([`super::cycles`]), the links of the pieces within the component
//!    are found anew, and what is still strongly connected is treated alike.
//!    To sheets outside pieces have the links of the whole: what was no cycle
//!    does not become one.
//! 3. *Order.* Of all that may come next, the one with the deepest point comes
//!    first (Kahn 1962), so sheets that are free stand by depth. Parts of one
//!    flat area follow one another unless another face must come in between:
//!    the graph of whole areas has components too, and areas on none are
//!    painted in one go.

use super::components::{Scratch, components};
use super::cycles::{Chosen, choose};
use super::faces::Faces;
use super::judge::{Judge, Relation};
use super::order::farthest_first;
use super::sheets::Sheet;
use super::{Ordered, PainterError};
use crate::kernel::predicates::{Policy, Predicates, sort_by_predicates};
use crate::run::{Growing, Run};
use crate::spatial::Hierarchy;
use crate::view::LineQuestion;
use rustc_hash::FxHashMap;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// How a sheet stands to another one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Link {
    pub(super) to: u32,
    /// Never free.
    pub(super) relation: Relation,
}

impl Link {
    /// The other sheet, if this one must be painted before it.
    fn later(self) -> Option<u32> {
        (self.relation != Relation::After).then_some(self.to)
    }
}

/// Sheets and pieces of sheets, and their links.
pub(super) struct Graph {
    pub(super) sheets: Vec<Sheet>,
    pub(super) links: Vec<Vec<Link>>,
    /// Sheets of one component that is being worked on have one label.
    pub(super) labels: Vec<u32>,
    cuts: usize,
}

/// What a pair that is linked takes: itself, and a link of each sheet, in lists
/// that may have room for twice as many.
const PAIR_BYTES: usize = 2 * size_of::<(u32, u32, Relation)>() + 4 * size_of::<Link>();

/// No component.
const SETTLED: u32 = u32::MAX;

/// Brings sheets into painting order.
pub(super) fn order<P: Policy>(
    question: &LineQuestion<'_>,
    faces: &Faces,
    sheets: Vec<Sheet>,
    most_cuts: usize,
    run: &Run<'_>,
) -> Result<Ordered, PainterError> {
    let count = sheets.len() as u64;
    let mut graph = run.stage("painter-graph", count, || linked::<P>(question, sheets, run))?;
    let judge = Judge::<P>::new(Predicates::new(question.points));
    run.stage("painter-cycles", count, || graph.resolve(&judge, most_cuts, run))?;
    let order = run.stage("painter-order", count, || graph.order(&judge.predicates, faces));
    judge.report(run);
    Ok(Ordered { sheets: order, cuts: graph.cuts })
}

/// All links.
fn linked<P: Policy>(
    question: &LineQuestion<'_>,
    sheets: Vec<Sheet>,
    run: &Run<'_>,
) -> Result<Graph, PainterError> {
    let boxes: Vec<_> = sheets.iter().map(|sheet| sheet.bounds).collect();
    let hierarchy = Hierarchy::new(&boxes);
    let judge = || Judge::<P>::new(Predicates::new(question.points));
    let start = || (judge(), Vec::new(), Growing::new(run, PAIR_BYTES));
    let found = hierarchy.overlapping_pairs(run, start, |(judge, found, growing), a, b| {
        if !growing.goes_on(found.len()) {
            return;
        }
        let (a, b) = (a.min(b), a.max(b));
        let [p, q] = [a, b].map(|i| &sheets[i as usize]);
        let relation = judge.relation(p, q);
        if relation != Relation::Free {
            found.push((a, b, relation));
        }
    });
    run.check()?;
    let mut links: Vec<Vec<Link>> = vec![Vec::new(); sheets.len()];
    for (judge, found, mut growing) in found {
        growing.finish(found.len())?;
        judge.report(run);
        for (a, b, relation) in found {
            links[a as usize].push(Link { to: b, relation });
            links[b as usize].push(Link { to: a, relation: relation.exchanged() });
        }
    }
    links.iter_mut().for_each(|list| list.sort_unstable_by_key(|link| link.to));
    let labels = vec![SETTLED; sheets.len()];
    Ok(Graph { sheets, links, labels, cuts: 0 })
}

impl Graph {
    /// Cuts sheets until no component is left.
    fn resolve<P: Policy>(
        &mut self,
        judge: &Judge<'_, P>,
        most_cuts: usize,
        run: &Run<'_>,
    ) -> Result<(), PainterError> {
        let mut scratch = Scratch::default();
        let mut next_label = 0;
        let all = (0..self.sheets.len() as u32).collect();
        let mut open = self.components_of(all, &mut scratch, &mut next_label);
        while let Some(mut component) = open.pop() {
            run.check()?;
            run.advance(0);
            let chosen = choose(self, judge, &component, run);
            run.check()?;
            if chosen.is_empty() {
                return Err(PainterError::NoCut);
            }
            for cut in chosen {
                run.take(self.bytes_of_cut(cut))?;
                run.advance(0);
                component.extend(self.cut(judge, cut, run));
                if most_cuts < self.cuts {
                    return Err(PainterError::TooManyCuts(most_cuts));
                }
            }
            run.check()?;
            open.extend(self.components_of(component, &mut scratch, &mut next_label));
        }
        Ok(())
    }

    /// What a cut takes at most: a sheet more, and its links.
    fn bytes_of_cut(&self, chosen: Chosen) -> u64 {
        let whole = chosen.sheet as usize;
        let links = 2 * self.links[whole].len() * size_of::<Link>();
        (self.sheets[whole].bytes() + links) as u64
    }

    /// The components among some sheets of one label, labelled anew.
    fn components_of(
        &mut self,
        nodes: Vec<u32>,
        scratch: &mut Scratch,
        next_label: &mut u32,
    ) -> Vec<Vec<u32>> {
        scratch.grow(self.sheets.len());
        let found = {
            // Edges to other labels are passed over by going round in place.
            let next = |node: u32, i: usize| {
                let link = self.links[node as usize].get(i)?;
                let stays = self.labels[link.to as usize] == self.labels[node as usize];
                Some(link.later().filter(|_| stays).unwrap_or(node))
            };
            components(nodes.iter().copied(), scratch, next)
        };
        nodes.iter().for_each(|&node| self.labels[node as usize] = SETTLED);
        for component in &found {
            component.iter().for_each(|&node| self.labels[node as usize] = *next_label);
            *next_label += 1;
        }
        found
    }

    /// Cuts one sheet by the plane of another; returns the new sheet, if the
    /// plane still cuts it. Links are left out once the run is stopped.
    fn cut<P: Policy>(
        &mut self,
        judge: &Judge<'_, P>,
        chosen: Chosen,
        run: &Run<'_>,
    ) -> Option<u32> {
        let whole = chosen.sheet as usize;
        let by = &self.sheets[chosen.by as usize];
        let [first, second] = self.sheets[whole].cut_by(&judge.predicates, by)?;
        self.cuts += 1;
        let added = self.sheets.len() as u32;
        self.sheets[whole] = first;
        self.sheets.push(second);
        self.labels.push(self.labels[whole]);
        self.links.push(Vec::new());
        let links = std::mem::take(&mut self.links[whole]);
        for link in links.into_iter().take_while(|_| !run.is_stopped()) {
            self.links[link.to as usize].retain(|back| back.to != chosen.sheet);
            let is_within = self.labels[link.to as usize] == self.labels[whole];
            for piece in [chosen.sheet, added] {
                let relation = match is_within {
                    true => {
                        let [p, q] = [piece, link.to].map(|i| &self.sheets[i as usize]);
                        judge.relation(p, q)
                    }
                    false => link.relation,
                };
                self.link(piece, link.to, relation);
            }
        }
        Some(added)
    }

    fn link(&mut self, from: u32, to: u32, relation: Relation) {
        if relation != Relation::Free {
            self.links[from as usize].push(Link { to, relation });
            self.links[to as usize].push(Link { to: from, relation: relation.exchanged() });
        }
    }

    /// The sheets in an order that all links allow.
    fn order<P: Policy>(&mut self, predicates: &Predicates<'_, P>, faces: &Faces) -> Vec<Sheet> {
        let count = self.sheets.len();
        let mut by_depth: Vec<u32> = (0..count as u32).collect();
        sort_by_predicates::<P, _>(&mut by_depth, |&a, &b| {
            farthest_first(predicates, &self.sheets, a, b)
        });
        let units = self.units(faces, &by_depth);
        let mut waiting = vec![0_u32; units.members.len()];
        for (node, links) in self.links.iter().enumerate() {
            let unit = units.of[node];
            let earlier = links.iter().filter(|link| {
                link.relation != Relation::Before && units.of[link.to as usize] != unit
            });
            waiting[unit as usize] += earlier.count() as u32;
        }
        // Units are numbered by depth.
        let ready = (0..waiting.len() as u32).filter(|&unit| waiting[unit as usize] == 0);
        let mut ready: BinaryHeap<Reverse<u32>> = ready.map(Reverse).collect();
        let mut order = Vec::with_capacity(count);
        while let Some(Reverse(unit)) = ready.pop() {
            for &node in &units.members[unit as usize] {
                order.push(node);
                for later in self.links[node as usize].iter().filter_map(|link| link.later()) {
                    let other = units.of[later as usize];
                    if other == unit {
                        continue;
                    }
                    waiting[other as usize] -= 1;
                    if waiting[other as usize] == 0 {
                        ready.push(Reverse(other));
                    }
                }
            }
        }
        debug_assert_eq!(order.len(), count, "there is no cycle any more");
        let mut sheets: Vec<Option<Sheet>> =
            std::mem::take(&mut self.sheets).into_iter().map(Some).collect();
        order.into_iter().filter_map(|node| sheets[node as usize].take()).collect()
    }

    /// Sheets that are painted in one go: those of a flat area of which no
    /// other must come in between; all others alone.
    fn units(&self, faces: &Faces, by_depth: &[u32]) -> Units {
        let mut number: FxHashMap<u32, u32> = FxHashMap::default();
        let mut whole_of = Vec::with_capacity(self.sheets.len());
        let mut members: Vec<Vec<u32>> = Vec::new();
        for (node, sheet) in self.sheets.iter().enumerate() {
            let whole = faces.list[sheet.face as usize].area();
            let whole = *number.entry(whole).or_insert_with(|| {
                members.push(Vec::new());
                members.len() as u32 - 1
            });
            whole_of.push(whole);
            members[whole as usize].push(node as u32);
        }
        let mut starts: Vec<Vec<u32>> = vec![Vec::new(); members.len()];
        for (whole, nodes) in members.iter().enumerate() {
            let links = nodes.iter().flat_map(|&node| &self.links[node as usize]);
            let later = links.filter_map(|link| link.later());
            starts[whole].extend(later.map(|node| whole_of[node as usize]));
        }
        let mut scratch = Scratch::default();
        scratch.grow(members.len());
        let next = |whole: u32, i: usize| starts[whole as usize].get(i).copied();
        let mut is_broken = vec![false; members.len()];
        for component in components(0..members.len() as u32, &mut scratch, next) {
            component.into_iter().for_each(|whole| is_broken[whole as usize] = true);
        }
        let mut units = Units { of: vec![u32::MAX; self.sheets.len()], members: Vec::new() };
        for &node in by_depth {
            if units.of[node as usize] != u32::MAX {
                continue;
            }
            let whole = whole_of[node as usize] as usize;
            let own = match is_broken[whole] {
                true => vec![node],
                false => self.sorted(std::mem::take(&mut members[whole])),
            };
            let unit = units.members.len() as u32;
            own.iter().for_each(|&node| units.of[node as usize] = unit);
            units.members.push(own);
        }
        units
    }

    /// Some sheets in an order that the links between them allow. A face that
    /// is no plane hides parts of itself.
    fn sorted(&self, members: Vec<u32>) -> Vec<u32> {
        let place: FxHashMap<u32, usize> = members.iter().copied().zip(0..).collect();
        let linked = |node: u32| {
            let links = self.links[node as usize].iter();
            links.filter_map(|link| Some((*place.get(&link.to)?, link)))
        };
        let earlier =
            |node: u32| linked(node).filter(|(_, link)| link.relation != Relation::Before).count();
        let mut waiting: Vec<usize> = members.iter().map(|&node| earlier(node)).collect();
        if waiting.iter().all(|&count| count == 0) {
            return members;
        }
        let ready = (0..members.len()).filter(|&i| waiting[i] == 0);
        let mut ready: BinaryHeap<Reverse<usize>> = ready.map(Reverse).collect();
        let mut order = Vec::with_capacity(members.len());
        while let Some(Reverse(first)) = ready.pop() {
            order.push(members[first]);
            for (other, _) in linked(members[first]).filter(|(_, link)| link.later().is_some()) {
                waiting[other] -= 1;
                if waiting[other] == 0 {
                    ready.push(Reverse(other));
                }
            }
        }
        order
    }
}

/// Sheets that are painted in one go, by their deepest points.
struct Units {
    /// The unit of each sheet.
    of: Vec<u32>,
    members: Vec<Vec<u32>>,
}
