//! A hierarchy of boxes over items sorted along a space-filling curve.
//!
//! Items are sorted by the Morton cell of their box's middle; then every
//! eight neighbours make a node, every eight nodes a node above, up to one
//! root. There are no pointers: a node's children are eight consecutive
//! places of the level below (a packed R-tree: Kamel and Faloutsos 1993).
//! Building is a sort and one pass, queries adapt to any distribution of
//! sizes. Everything is O(n log n) at worst to build and expected
//! O(log n + answers) to ask.

use super::Bounds;
use crate::run::{map_chunks, map_indexed};

/// Children of a node.
const FANOUT: usize = 8;

/// Boxes over items `0..n`.
#[derive(Debug, Clone)]
pub struct Hierarchy {
    /// The items in the order of the lowest level.
    items: Vec<u32>,
    /// Boxes from the lowest level (one per item) up to the root.
    levels: Vec<Vec<Bounds>>,
}

impl Hierarchy {
    /// Sorts and groups the items with these boxes. Items with empty boxes
    /// are left out.
    pub fn new(boxes: &[Bounds]) -> Self {
        let items = along_curve(boxes);
        let mut levels = vec![map_indexed(items.len(), |i| boxes[items[i] as usize])];
        while let Some(below) = levels.last()
            && below.len() > 1
        {
            let above = map_chunks(below.len(), FANOUT * 1024, |part| {
                below[part]
                    .chunks(FANOUT)
                    .map(|group| group.iter().fold(Bounds::EMPTY, |sum, one| sum.union(one)))
                    .collect::<Vec<_>>()
            })
            .concat();
            levels.push(above);
        }
        Hierarchy { items, levels }
    }

    /// The number of items in it.
    pub fn len(&self) -> usize {
        self.items.len()
    }

    /// Whether there is no item in it.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// Calls `found` with every item whose box, like all boxes above it,
    /// satisfies `may`. In a fixed order.
    #[inline]
    pub fn visit(&self, may: impl Fn(&Bounds) -> bool, mut found: impl FnMut(u32)) {
        let top = self.levels.len() - 1;
        if self.items.is_empty() || !may(&self.levels[top][0]) {
            return;
        }
        if top == 0 {
            return found(self.items[0]);
        }
        // Each level adds at most seven places beyond the one taken off,
        // and 32-bit items make at most eleven levels.
        let mut stack = [(0_u32, 0_u32); 96];
        let mut height = 1;
        stack[0] = (top as u32, 0);
        while height > 0 {
            height -= 1;
            let (level, node) = stack[height];
            let below = level as usize - 1;
            let first = node as usize * FANOUT;
            let end = (first + FANOUT).min(self.levels[below].len());
            for child in first..end {
                if may(&self.levels[below][child]) {
                    if below == 0 {
                        found(self.items[child]);
                    } else {
                        stack[height] = (below as u32, child as u32);
                        height += 1;
                    }
                }
            }
        }
    }

    /// All pairs of items with overlapping boxes, each pair once, handed to
    /// `found` in groups: `work` starts the result of a group. Results come
    /// in an order that depends on the boxes alone.
    pub fn overlapping_pairs<T: Send>(
        &self,
        start: impl Fn() -> T + Sync + Send,
        found: impl Fn(&mut T, u32, u32) + Sync + Send,
    ) -> Vec<T> {
        if self.items.len() < 2 {
            return Vec::new();
        }
        // A level with enough nodes to deal them out: one result per node,
        // which meets itself and all later nodes.
        let top = self.levels.len() - 1;
        let wide = |&level: &usize| self.levels[level].len() >= 256;
        let level = (1..=top).rev().find(wide).unwrap_or(1.min(top));
        map_indexed(self.levels[level].len(), |node| {
            let mut result = start();
            self.pairs_within(level, node, &mut |a, b| found(&mut result, a, b));
            let own = self.levels[level][node];
            self.later_nodes(top, 0, level, node, &own, &mut |other| {
                self.pairs_between(level, node, other, &mut |a, b| found(&mut result, a, b));
            });
            result
        })
    }

    /// Calls `found` with the nodes of `level` after `node` that overlap `own`.
    fn later_nodes(
        &self,
        at: usize,
        place: usize,
        level: usize,
        node: usize,
        own: &Bounds,
        found: &mut impl FnMut(usize),
    ) {
        let last = (place + 1) * FANOUT.pow((at - level) as u32) - 1;
        if last <= node || !self.levels[at][place].overlaps(own) {
            return;
        }
        if at == level {
            return found(place);
        }
        for child in self.children(at, place) {
            self.later_nodes(at - 1, child, level, node, own, found);
        }
    }

    fn children(&self, level: usize, node: usize) -> std::ops::Range<usize> {
        node * FANOUT..((node + 1) * FANOUT).min(self.levels[level - 1].len())
    }

    fn pairs_within(&self, level: usize, node: usize, found: &mut impl FnMut(u32, u32)) {
        if level == 0 {
            return;
        }
        for a in self.children(level, node) {
            self.pairs_within(level - 1, a, found);
            for b in a + 1..self.children(level, node).end {
                self.pairs_between(level - 1, a, b, found);
            }
        }
    }

    fn pairs_between(&self, level: usize, a: usize, b: usize, found: &mut impl FnMut(u32, u32)) {
        if !self.levels[level][a].overlaps(&self.levels[level][b]) {
            return;
        }
        if level == 0 {
            return found(self.items[a], self.items[b]);
        }
        // Only children that reach into the other node are compared.
        let (own, beside) = (self.levels[level][a], self.levels[level][b]);
        let below = &self.levels[level - 1];
        let mut reaching = [0; FANOUT];
        let mut count = 0;
        for y in self.children(level, b) {
            if below[y].overlaps(&own) {
                reaching[count] = y;
                count += 1;
            }
        }
        for x in self.children(level, a) {
            if count > 0 && below[x].overlaps(&beside) {
                for &y in &reaching[..count] {
                    self.pairs_between(level - 1, x, y, found);
                }
            }
        }
    }
}

/// The items with boxes, sorted by the cells of a space-filling curve.
/// There are about as many cells as items, so sorting is counting; within a
/// cell items keep their order.
fn along_curve(boxes: &[Bounds]) -> Vec<u32> {
    const OUT: u32 = u32::MAX;
    let axis_bits = (boxes.len().max(1).ilog2() / 3 + 1).min(8);
    let shift = 63 - 3 * axis_bits;
    let cells = map_indexed(boxes.len(), |i| match boxes[i].is_empty() {
        true => OUT,
        false => (morton_code(&boxes[i]) >> shift) as u32,
    });
    let mut next = vec![0_u32; (1 << (3 * axis_bits)) + 1];
    cells.iter().filter(|&&cell| cell != OUT).for_each(|&cell| next[cell as usize + 1] += 1);
    let mut sum = 0;
    for start in &mut next {
        sum += *start;
        *start = sum;
    }
    let mut items = vec![0; sum as usize];
    for (item, &cell) in cells.iter().enumerate() {
        if cell != OUT {
            let slot = &mut next[cell as usize];
            items[*slot as usize] = item as u32;
            *slot += 1;
        }
    }
    items
}

/// Spreads the lower 21 bits of `x` to every third bit.
fn spread(x: u64) -> u64 {
    let x = (x | x << 32) & 0x001f_0000_0000_ffff;
    let x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    let x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    let x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}

/// The place of a box's middle on a curve through [-1, 1]^3.
fn morton_code(bounds: &Bounds) -> u64 {
    let cell = |axis: usize| {
        let middle = bounds.low[axis] * 0.5 + bounds.high[axis] * 0.5;
        // Middles of unbounded boxes are NaN or infinite: `as` saturates.
        ((middle + 1.0) * 1_048_576.0) as u64 & 0x1f_ffff
    };
    spread(cell(0)) | spread(cell(1)) << 1 | spread(cell(2)) << 2
}

/// A segment in narrow view coordinates, for asking which boxes its image
/// may meet: tighter than its box where it runs askew.
#[derive(Debug, Clone, Copy)]
pub struct SegmentProbe {
    bounds: Bounds,
    start: [f32; 2],
    normal: [f32; 2],
    slack: f32,
}

impl SegmentProbe {
    /// The probe of a segment with outward-rounded `bounds` and ends near
    /// `start` and `end`.
    pub fn new(bounds: Bounds, start: [f32; 2], end: [f32; 2]) -> Self {
        let normal = [end[1] - start[1], start[0] - end[0]];
        // Coordinates lie within [-1, 1] up to rounding, where a narrow
        // float is off by at most 2^-24: the ends' errors enter through the
        // normal (times a distance below 4) and the start (times the
        // normal), each product and sum rounds once more. Unbounded
        // segments make this infinite or NaN, and then only the box counts.
        let slack = (normal[0].abs() + normal[1].abs()) * 4e-6 + 2e-6;
        SegmentProbe { bounds, start, normal, slack }
    }

    /// The outward-rounded box of the segment.
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// Whether the segment's image may meet that of `other`.
    #[inline(always)]
    pub fn may_meet_image(&self, other: &Bounds) -> bool {
        let [nx, ny] = self.normal;
        let middle = |i: usize| other.low[i] * 0.5 + other.high[i] * 0.5;
        let half = |i: usize| other.high[i] * 0.5 - other.low[i] * 0.5;
        let (x, y) = (middle(0) - self.start[0], middle(1) - self.start[1]);
        let reach = nx.abs() * half(0) + ny.abs() * half(1) + self.slack;
        // Not comparable, where something is unbounded, says "maybe".
        let offset = (nx * x + ny * y).abs();
        offset.partial_cmp(&reach) != Some(std::cmp::Ordering::Greater)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn boxes(count: usize) -> impl Strategy<Value = Vec<Bounds>> {
        let coordinate = || (-8..8_i32).prop_map(|x| x as f32 / 8.0);
        let one = (coordinate(), coordinate(), coordinate(), 0..4_i32, 0..4_i32, 0..4_i32);
        prop::collection::vec(one, 0..count).prop_map(|list| {
            let extent = |x: i32| x as f32 / 8.0;
            list.into_iter()
                .map(|(x, y, z, a, b, c)| Bounds {
                    low: [x, y, z].into(),
                    high: [x + extent(a), y + extent(b), z + extent(c)].into(),
                })
                .collect()
        })
    }

    proptest! {
        #[test]
        fn queries_find_what_brute_force_finds(boxes in boxes(300), ask in boxes(2)) {
            let hierarchy = Hierarchy::new(&boxes);
            for ask in ask {
                let mut found = Vec::new();
                hierarchy.visit(|node| node.overlaps(&ask), |item| found.push(item));
                found.sort_unstable();
                let expected: Vec<u32> = (0..boxes.len() as u32)
                    .filter(|&i| boxes[i as usize].overlaps(&ask))
                    .collect();
                prop_assert_eq!(found, expected);
            }
        }

        #[test]
        fn pairs_are_those_of_brute_force(boxes in boxes(700)) {
            let hierarchy = Hierarchy::new(&boxes);
            let groups = hierarchy.overlapping_pairs(Vec::new, |list, a, b| list.push([a.min(b), a.max(b)]));
            let mut found = groups.concat();
            found.sort_unstable();
            let mut expected = Vec::new();
            for a in 0..boxes.len() {
                for b in a + 1..boxes.len() {
                    if boxes[a].overlaps(&boxes[b]) {
                        expected.push([a as u32, b as u32]);
                    }
                }
            }
            prop_assert_eq!(found, expected);
        }
    }
}
