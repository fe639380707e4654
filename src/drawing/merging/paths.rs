//! How lines go on from piece to piece, as far as that matters: where others
//! run along with them.
//!
//! Pieces that end in one point and are of one rank go on as one another as
//! strokes do, the straightest first, but never turn back. What goes on so is
//! a path. Where all ends of one layer lie in one point is a node; with an odd
//! number of ends a stroke ends there, with an even one none need.

use super::Subject;
use super::filter::Filter;
use super::ink::NOWHERE;
use crate::drawing::chaining::{Joined, map_joints};
use crate::drawing::joints::Joints;
use crate::run::sort_by;
use glam::DVec2;
use std::cmp::Ordering;

/// Where ends of one layer lie in one point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    pub(super) point: DVec2,
    pub(super) layer: u32,
    /// The number of ends.
    pub(super) degree: u32,
}

impl Node {
    pub(super) fn is_odd(&self) -> bool {
        self.degree % 2 == 1
    }
}

/// Where a piece goes on from its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Next {
    /// Nowhere.
    Nothing,
    /// As a piece along which nothing runs.
    Alone,
    /// As this end, of a piece that has neighbours.
    End(u32),
}

/// A piece of a path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    /// Index among the pieces with neighbours.
    pub(super) piece: u32,
    /// Whether the path runs against the piece.
    pub(super) back: bool,
}

/// Pieces that go on as one another.
#[derive(Debug, Clone)]
pub(super) struct Path {
    pub(super) steps: Vec<Step>,
    pub(super) closed: bool,
    /// Whether the line goes on before the first and after the last piece.
    pub(super) goes_on: [bool; 2],
    rank: Rank,
}

/// What decides which of several lines is drawn.
#[derive(Debug, Clone, Copy)]
struct Rank {
    /// Level, outline and class.
    kind: [u32; 3],
    /// The nearest depth.
    depth: f64,
    /// First and last point.
    ends: [DVec2; 2],
}

impl Rank {
    fn compare(&self, other: &Self) -> Ordering {
        self.kind
            .cmp(&other.kind)
            .then_with(|| self.depth.total_cmp(&other.depth))
            .then_with(|| compare_points(self.ends[0], other.ends[0]))
            .then_with(|| compare_points(self.ends[1], other.ends[1]))
    }
}

pub(super) fn compare_points(a: DVec2, b: DVec2) -> Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
}

/// Paths and nodes.
pub(super) struct Net {
    pub(super) nodes: Vec<Node>,
    /// For each end of the pieces with neighbours its node.
    pub(super) node_of: Vec<u32>,
    /// In the order of their rank.
    pub(super) paths: Vec<Path>,
}

/// What is found at some joints.
#[derive(Default)]
struct Found {
    nodes: Vec<Node>,
    /// An end of a piece with neighbours, its node and where it goes on.
    ends: Vec<(u32, u32, Next)>,
}

impl Net {
    /// Finds the paths of the pieces `chosen`, in ascending order.
    pub(super) fn new(subject: &Subject<'_>, chosen: &[u32]) -> Self {
        let count = subject.lines.pieces.len();
        let mut place_of = vec![NOWHERE; count];
        chosen.iter().zip(0..).for_each(|(&piece, place)| place_of[piece as usize] = place);
        let ends = chosen.iter().flat_map(|&piece| subject.segment(piece as usize));
        let filter = Filter::new(ends);
        let place = |end: u32| {
            let piece = (end / 2) as usize;
            subject
                .is_drawn(piece)
                .then(|| subject.end(end))
                .filter(|&p| filter.may_hold(p))
                .map(key)
        };
        let found = map_joints(2 * count, place, |joined| at_joints(subject, &place_of, joined));
        let mut nodes = Vec::new();
        let mut node_of = vec![NOWHERE; 2 * chosen.len()];
        let mut next = vec![Next::Nothing; 2 * chosen.len()];
        for mut part in found {
            let first = nodes.len() as u32;
            for (end, node, goes_on) in part.ends {
                node_of[end as usize] = first + node;
                next[end as usize] = goes_on;
            }
            nodes.append(&mut part.nodes);
        }
        let mut paths = paths(subject, chosen, &next);
        sort_by(&mut paths, |a, b| {
            let by_rank = a.rank.compare(&b.rank);
            by_rank.then_with(|| a.compare_course(b, subject, chosen))
        });
        Net { nodes, node_of, paths }
    }
}

/// Equal for equal points: page coordinates are never -0.
pub(super) fn key(point: DVec2) -> [u64; 2] {
    [point.x.to_bits(), point.y.to_bits()]
}

/// The nodes at some joints, and how pieces go on there.
fn at_joints(subject: &Subject<'_>, place_of: &[u32], joined: &Joined) -> Found {
    let mut found = Found::default();
    let mut work = Work::default();
    for ends in joined.joints() {
        if ends.iter().any(|end| place_of[(end / 2) as usize] != NOWHERE) {
            work.joint(subject, place_of, ends, &mut found);
        }
    }
    found
}

/// Lists that serve one joint after another.
#[derive(Default)]
struct Work {
    joints: Joints,
    kinds: Vec<([u32; 3], u32)>,
    spokes: Vec<[DVec2; 2]>,
    numbers: Vec<u32>,
    pairs: Vec<[u32; 2]>,
}

impl Work {
    fn joint(&mut self, subject: &Subject<'_>, place_of: &[u32], ends: &[u32], found: &mut Found) {
        let point = subject.end(ends[0]);
        let own = |end: u32| place_of[(end / 2) as usize];
        let (first, new) = (found.nodes.len(), found.ends.len());
        for &end in ends {
            let layer = subject.layer((end / 2) as usize);
            let node = found.nodes[first..].iter().position(|node| node.layer == layer);
            let node = node.map_or_else(
                || {
                    found.nodes.push(Node { point, layer, degree: 0 });
                    found.nodes.len() - 1
                },
                |node| first + node,
            );
            found.nodes[node].degree += 1;
            if own(end) != NOWHERE {
                found.ends.push((2 * own(end) + end % 2, node as u32, Next::Nothing));
            }
        }
        self.kinds.clear();
        self.kinds.extend(ends.iter().map(|&end| (subject.kind((end / 2) as usize), end)));
        self.kinds.sort_unstable();
        for kind in self.kinds.chunk_by(|a, b| a.0 == b.0).filter(|kind| kind.len() > 1) {
            self.spokes.clear();
            self.spokes.extend(kind.iter().map(|&(_, end)| [point, subject.end(end ^ 1)]));
            self.numbers.clear();
            self.numbers.extend((0..kind.len() as u32).map(|i| 2 * i));
            self.pairs.clear();
            self.joints.pair(&self.spokes, &self.numbers, &mut self.pairs);
            for pair in &self.pairs {
                let [a, b] = pair.map(|end| (end / 2) as usize);
                let away = |i: usize| (self.spokes[i][1] - point).normalize_or_zero();
                if BACK < away(a).dot(away(b)) {
                    continue;
                }
                let [a, b] = [kind[a].1, kind[b].1];
                for (end, other) in [(a, b), (b, a)] {
                    if own(end) == NOWHERE {
                        continue;
                    }
                    let goes_on = match own(other) {
                        NOWHERE => Next::Alone,
                        place => Next::End(2 * place + other % 2),
                    };
                    let number = 2 * own(end) + end % 2;
                    let slot = found.ends[new..].iter_mut().find(|slot| slot.0 == number);
                    slot.into_iter().for_each(|slot| slot.2 = goes_on);
                }
            }
        }
    }
}

/// The cosine between two ways that are one and back.
const BACK: f64 = 0.9;

/// All paths of some pieces.
fn paths(subject: &Subject<'_>, chosen: &[u32], next: &[Next]) -> Vec<Path> {
    let mut walked = vec![false; chosen.len()];
    let mut paths = Vec::new();
    for piece in 0..chosen.len() as u32 {
        if walked[piece as usize] {
            continue;
        }
        // Backwards to where the path begins.
        let mut end = 2 * piece;
        let mut closed = false;
        while let Next::End(before) = next[end as usize] {
            end = before ^ 1;
            closed = end == 2 * piece;
            if closed {
                break;
            }
        }
        let first = end;
        let mut steps = Vec::new();
        let last = loop {
            walked[(end / 2) as usize] = true;
            steps.push(Step { piece: end / 2, back: end % 2 == 1 });
            match next[(end ^ 1) as usize] {
                Next::End(on) if on != first => end = on,
                _ => break end ^ 1,
            }
        };
        let goes_on = [first, last].map(|end| !closed && next[end as usize] == Next::Alone);
        paths.push(Path::new(subject, chosen, steps, closed, goes_on));
    }
    paths
}

impl Path {
    fn new(
        subject: &Subject<'_>,
        chosen: &[u32],
        mut steps: Vec<Step>,
        closed: bool,
        mut goes_on: [bool; 2],
    ) -> Self {
        let start =
            |step: &Step| subject.end(2 * chosen[step.piece as usize] + u32::from(step.back));
        let end =
            |step: &Step| subject.end(2 * chosen[step.piece as usize] + u32::from(!step.back));
        let count = steps.len();
        if closed {
            // From its least point towards the lesser of the next ones.
            let least =
                (0..count).min_by(|&a, &b| compare_points(start(&steps[a]), start(&steps[b])));
            steps.rotate_left(least.unwrap_or(0));
        }
        let reverse = if closed {
            compare_points(start(&steps[count - 1]), end(&steps[0])).is_lt()
        } else {
            compare_points(end(&steps[count - 1]), start(&steps[0])).is_lt()
        };
        if reverse {
            steps.reverse();
            steps.iter_mut().for_each(|step| step.back = !step.back);
            goes_on.reverse();
        }
        let piece = |step: &Step| chosen[step.piece as usize] as usize;
        let depths = steps.iter().flat_map(|step| subject.lines.pieces[piece(step)].depth);
        let rank = Rank {
            kind: subject.kind(piece(&steps[0])),
            depth: depths.fold(f64::INFINITY, f64::min),
            ends: [start(&steps[0]), end(&steps[count - 1])],
        };
        Path { steps, closed, goes_on, rank }
    }

    /// Compares the ways of two paths between their ends, point by point, so
    /// that the order of pieces decides only between paths that coincide.
    fn compare_course(&self, other: &Self, subject: &Subject<'_>, chosen: &[u32]) -> Ordering {
        let start =
            |step: &Step| subject.end(2 * chosen[step.piece as usize] + u32::from(step.back));
        for (own, other) in self.steps.iter().zip(&other.steps) {
            let order = compare_points(start(own), start(other));
            if order.is_ne() {
                return order;
            }
        }
        let length = self.steps.len().cmp(&other.steps.len());
        length.then(self.steps[0].piece.cmp(&other.steps[0].piece))
    }
}
