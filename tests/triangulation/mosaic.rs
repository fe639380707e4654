//! Areas made of the cells of a mosaic, and closed walks around them.
//!
//! Which cells are in an area is known, so a triangulation of any outline of
//! it can be judged without geometry: all triangles turn one way, and what is
//! left of their edges, once opposite ones have cancelled out, is the border of
//! the cells. Then they cover the area once and nothing else, for how often a
//! place is covered is how often the border goes around it.

use crate::split_mix::split_mix;
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use umriss::kernel::numbers::{BigInteger, Ring, Sign};

/// Points, and cells as counterclockwise cycles of them.
#[derive(Debug, Clone)]
pub(crate) struct Mosaic {
    pub points: Vec<DVec2>,
    pub cells: Vec<Vec<usize>>,
}

/// Edges with a direction, and how often they stand there.
pub(crate) type Chain = BTreeMap<[usize; 2], i32>;

/// Bits of all that random choices are made of.
#[derive(Debug, Clone)]
pub(crate) struct Chance(pub(crate) u64);

impl Chance {
    pub(crate) fn below(&mut self, count: usize) -> usize {
        (split_mix(&mut self.0) % count as u64) as usize
    }
}

/// Rectangles between these coordinates.
pub(crate) fn rectangles(mut xs: Vec<f64>, mut ys: Vec<f64>) -> Mosaic {
    for list in [&mut xs, &mut ys] {
        list.sort_by(f64::total_cmp);
        list.dedup();
    }
    let points = ys.iter().flat_map(|&y| xs.iter().map(move |&x| DVec2::new(x, y))).collect();
    let width = xs.len();
    let cell = |i: usize, j: usize| {
        let corner = j * width + i;
        vec![corner, corner + 1, corner + width + 1, corner + width]
    };
    let cells = (1..ys.len()).flat_map(|j| (1..width).map(move |i| cell(i - 1, j - 1))).collect();
    Mosaic { points, cells }
}

/// Triangles: a grid of squares whose corners are moved a little, each cut
/// along one diagonal or the other.
pub(crate) fn triangles(side: usize, chance: &mut Chance) -> Mosaic {
    let width = side + 1;
    let mut shaken = |k: usize| 8.0 * k as f64 + chance.below(5) as f64 - 2.0;
    let points: Vec<DVec2> =
        (0..width * width).map(|i| DVec2::new(shaken(i % width), shaken(i / width))).collect();
    let mut cells = Vec::new();
    for i in 0..side * side {
        let a = i / side * width + i % side;
        let [b, c, d] = [a + 1, a + width + 1, a + width];
        let halves =
            if chance.below(2) == 0 { [[a, b, c], [c, d, a]] } else { [[b, c, d], [d, a, b]] };
        cells.extend(halves.map(|half| half.to_vec()));
    }
    Mosaic { points, cells }
}

/// Adds an edge, or cancels its opposite.
pub(crate) fn add(chain: &mut Chain, [a, b]: [usize; 2]) {
    if let Some(count) = chain.get_mut(&[b, a]) {
        *count -= 1;
        if *count == 0 {
            chain.remove(&[b, a]);
        }
    } else {
        *chain.entry([a, b]).or_default() += 1;
    }
}

/// The edges of a ring.
pub(crate) fn edges_of<T: Copy>(ring: &[T]) -> impl Iterator<Item = [T; 2]> + '_ {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&a, &b)| [a, b])
}

impl Mosaic {
    /// The border of some cells, which lie on its left.
    pub(crate) fn border(&self, cells: &BTreeSet<usize>) -> Chain {
        let mut chain = Chain::new();
        for &cell in cells {
            edges_of(&self.cells[cell]).for_each(|edge| add(&mut chain, edge));
        }
        chain
    }

    /// Each edge once.
    fn edges(&self) -> Vec<[usize; 2]> {
        let edges = self.cells.iter().flat_map(|cell| edges_of(cell));
        let edges: BTreeSet<[usize; 2]> = edges.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        edges.into_iter().collect()
    }

    /// A closed walk along each edge of a border once, and along others
    /// there and back: bridges between its parts, and some spikes.
    pub(crate) fn walk(&self, border: &Chain, chance: &mut Chance) -> Vec<usize> {
        let mut around: Vec<Vec<usize>> = vec![Vec::new(); self.points.len()];
        let mut join = |[a, b]: [usize; 2]| {
            around[a].push(b);
            around[b].push(a);
        };
        let mut parents: Vec<usize> = (0..self.points.len()).collect();
        fn root(parents: &[usize], mut point: usize) -> usize {
            while parents[point] != point {
                point = parents[point];
            }
            point
        }
        for &[a, b] in border.keys() {
            join([a, b]);
            let (a, b) = (root(&parents, a), root(&parents, b));
            parents[a] = b;
        }
        // A tree that joins all points, without twigs that lead nowhere.
        let mut others = self.edges();
        let mut tree: Vec<[usize; 2]> = Vec::new();
        while !others.is_empty() {
            let edge = others.swap_remove(chance.below(others.len()));
            let [a, b] = edge.map(|point| root(&parents, point));
            if a != b {
                parents[a] = b;
                tree.push(edge);
            }
        }
        let bounding: BTreeSet<usize> = border.keys().flatten().copied().collect();
        loop {
            let degree = |point: usize| tree.iter().flatten().filter(|&&p| p == point).count();
            let is_twig = |edge: &&[usize; 2]| {
                edge.iter().any(|point| !bounding.contains(point) && degree(*point) == 1)
            };
            let twigs: Vec<_> = tree.iter().filter(is_twig).copied().collect();
            if twigs.is_empty() || chance.below(4) == 0 {
                break;
            }
            tree.retain(|edge| !twigs.contains(edge));
        }
        for edge in tree {
            join(edge);
            join(edge);
        }
        euler_walk(around, chance)
    }

    /// The corners of a walk, less some at which it goes straight on; of
    /// visits to one point one remains, for two of them may cross there.
    pub(crate) fn without_some_straight(&self, walk: &[usize], chance: &mut Chance) -> Vec<usize> {
        let mut kept = walk.to_vec();
        let mut visits = vec![0; self.points.len()];
        walk.iter().for_each(|&point| visits[point] += 1);
        let once: Vec<bool> = visits.iter().map(|&count| count == 1).collect();
        let mut i = 0;
        while i < kept.len() {
            let count = kept.len();
            let point = kept[i];
            let [a, b, c] = [i + count - 1, i, i + 1].map(|k| self.points[kept[k % count]]);
            let goes_on = turn([a, b, c]).is_zero() && a != c && is_between(a, b, c);
            let may_go = count > 3 && (once[point] || visits[point] > 1);
            if goes_on && may_go && chance.below(2) == 0 {
                kept.remove(i);
                visits[point] -= 1;
            } else {
                i += 1;
            }
        }
        kept
    }

    /// The parts of an edge between points of the mosaic.
    fn parts(&self, [a, b]: [usize; 2]) -> Vec<[usize; 2]> {
        let [from, to] = [a, b].map(|i| self.points[i]);
        let mut on: Vec<usize> = (0..self.points.len())
            .filter(|&i| {
                let p = self.points[i];
                is_between(from, p, to) && turn([from, p, to]).is_zero()
            })
            .collect();
        let key = |&i: &usize| (self.points[i].x, self.points[i].y);
        on.sort_by(|i, j| key(i).partial_cmp(&key(j)).expect("finite"));
        if key(&b) < key(&a) {
            on.reverse();
        }
        on.windows(2).map(|pair| [pair[0], pair[1]]).collect()
    }

    /// Whether triangles, given by their corners, turn one way and have the
    /// border that is expected.
    pub(crate) fn judge(&self, triangles: &[[usize; 3]], expected: &Chain) -> Result<(), String> {
        let turn_of = |corners: &[usize; 3]| turn(corners.map(|i| self.points[i]));
        let first = triangles.first().map_or(Sign::Zero, turn_of);
        let mut chain = Chain::new();
        for triangle in triangles {
            if turn_of(triangle).is_zero() || turn_of(triangle) != first {
                return Err(format!("{triangle:?} turns another way"));
            }
            edges_of(triangle).for_each(|edge| add(&mut chain, edge));
        }
        // Only now, so that vertices on inner edges are found.
        let mut border = Chain::new();
        for (&[a, b], &count) in &chain {
            let edge = if first == Sign::Positive { [a, b] } else { [b, a] };
            for part in self.parts(edge) {
                *border.entry(part).or_default() += count;
            }
        }
        if border == *expected { Ok(()) } else { Err(format!("{border:?}, not {expected:?}")) }
    }
}

/// A closed walk along all edges of a connected graph of even degrees, each
/// once. (Hierholzer 1873.)
fn euler_walk(mut around: Vec<Vec<usize>>, chance: &mut Chance) -> Vec<usize> {
    let start = around.iter().position(|list| !list.is_empty()).unwrap_or(0);
    let (mut stack, mut walk) = (vec![start], Vec::new());
    while let Some(&point) = stack.last() {
        let count = around[point].len();
        if count == 0 {
            walk.push(point);
            stack.pop();
            continue;
        }
        let next = around[point].swap_remove(chance.below(count));
        let back = around[next].iter().position(|&p| p == point).expect("an edge has two ends");
        around[next].swap_remove(back);
        stack.push(next);
    }
    walk.pop();
    walk
}

/// Whether the box of two points has a third.
fn is_between(a: DVec2, b: DVec2, c: DVec2) -> bool {
    a.min(c).cmple(b).all() && b.cmple(a.max(c)).all()
}

/// Which way three points turn, by integers of any size.
pub(crate) fn turn(corners: [DVec2; 3]) -> Sign {
    const LEAST: i32 = -1074;
    let read = |x: f64| BigInteger::read(x, LEAST);
    let [[ax, ay], [bx, by], [cx, cy]] = corners.map(|p| [read(p.x), read(p.y)]);
    let [ux, uy] = [bx - ax.clone(), by - ay.clone()];
    let [vx, vy] = [cx - ax, cy - ay];
    (ux * vy - uy * vx).sign()
}

/// A plane in space, for points of any size: coordinates change places, and
/// the one left out is constant or one of the others again.
pub(crate) fn lift(p: DVec2, axis: usize, third: usize) -> DVec3 {
    let mut corner = [0.0; 3];
    corner[(axis + 1) % 3] = p.x;
    corner[(axis + 2) % 3] = p.y;
    corner[axis] = [0.25, p.x, p.y][third];
    DVec3::from(corner)
}

/// Coordinates of all exponents.
pub(crate) fn wild() -> impl Strategy<Value = f64> {
    prop_oneof![
        2 => (-9..=9_i32).prop_map(f64::from),
        2 => (-1074..1023_i32, 1.0..2.0_f64, any::<bool>()).prop_map(|(exponent, m, negative)| {
            let value = m * f64::powi(2.0, exponent / 2) * f64::powi(2.0, exponent - exponent / 2);
            if negative { -value } else { value }
        }),
        1 => (-120..-20_i32).prop_map(|exponent| f64::powi(2.0, exponent)),
    ]
}
