//! A hierarchy of boxes over items sorted along a space-filling curve.
//!
//! Items are sorted by the Morton cell in which they lie; then every eight
//! neighbours make a group, every eight groups a group above, up to one.
//! There are no pointers: the children of a group are eight consecutive
//! places of the level below (a packed R-tree: Kamel and Faloutsos 1993).
//! The boxes of a group lie side by side, so that one query looks at all
//! eight at once. Building is a sort and one pass, queries adapt to any
//! distribution of sizes. Everything is O(n log n) at worst to build and
//! expected O(log n + answers) to ask.

use super::group::{Group, SIZE, places};
use super::{Bounds, Related};
use crate::run::{Run, concat_map, map_chunks, map_indexed, map_small};
use glam::Vec3A;
use std::cell::Cell;

/// Boxes over items `0..n`.
#[derive(Debug, Clone)]
pub struct Hierarchy {
    /// The items in the order of the lowest level.
    items: Vec<u32>,
    /// Groups of boxes from the lowest level (boxes of items) up to the one
    /// at the top. Place `i` of group `g` is the box of group `8 g + i` of
    /// the level below, or of the item at that place.
    levels: Vec<Vec<Group>>,
}

impl Hierarchy {
    /// Sorts and groups the items with these boxes. Items with empty boxes
    /// are never found.
    pub fn new(boxes: &[Bounds]) -> Self {
        let middle = |i: usize| boxes[i].low * 0.5 + boxes[i].high * 0.5;
        Hierarchy::of(boxes.len(), middle, |i| boxes[i])
    }

    /// The same for boxes that are made as they are needed. `place` is some
    /// point near an item, `bounds` its box.
    pub fn of(
        count: usize,
        place: impl Fn(usize) -> Vec3A + Sync + Send,
        bounds: impl Fn(usize) -> Bounds + Sync + Send,
    ) -> Self {
        Hierarchy::of_sorted(along_curve(count, place), bounds)
    }

    /// The same for some of the items only.
    pub fn of_some(
        items: Vec<u32>,
        place: impl Fn(usize) -> Vec3A + Sync + Send,
        bounds: impl Fn(usize) -> Bounds + Sync + Send,
    ) -> Self {
        let order = along_curve(items.len(), |i| place(items[i] as usize));
        let sorted = order.into_iter().map(|i| items[i as usize]).collect();
        Hierarchy::of_sorted(sorted, bounds)
    }

    fn of_sorted(items: Vec<u32>, bounds: impl Fn(usize) -> Bounds + Sync + Send) -> Self {
        let mut levels = vec![grouped(items.len(), |i| bounds(items[i] as usize))];
        while let Some(below) = levels.last()
            && below.len() > 1
        {
            levels.push(grouped(below.len(), |i| below[i].around()));
        }
        Hierarchy { items, levels }
    }

    /// The items in the order of the lowest groups.
    pub fn items(&self) -> &[u32] {
        &self.items
    }

    /// How many groups a level has.
    pub(super) fn groups(&self, level: usize) -> usize {
        self.levels[level].len()
    }

    /// The boxes of a group.
    #[inline(always)]
    pub(super) fn group(&self, level: usize, group: usize) -> &Group {
        &self.levels[level][group]
    }

    /// How many items are below a group.
    pub(super) fn items_below(&self, level: usize, group: usize) -> usize {
        let per_group = SIZE.pow(level as u32 + 1);
        per_group.min(self.items.len() - group * per_group)
    }

    /// The highest level with so many groups that they can be dealt out to
    /// threads. Few items are not worth waking threads for.
    pub(super) fn level_of(&self, groups: usize) -> usize {
        let top = self.levels.len() - 1;
        let wide = |&level: &usize| self.levels[level].len() >= groups;
        let few = self.levels[0].len() < 64;
        if few { top } else { (0..=top).rev().find(wide).unwrap_or(0) }
    }

    /// Calls `found` with the groups of a level after `own` whose boxes
    /// overlap the one around it.
    pub(super) fn groups_after(&self, level: usize, own: usize, found: &mut impl FnMut(usize)) {
        let top = self.levels.len() - 1;
        if level < top {
            let bounds = self.levels[level + 1][own / SIZE].get(own % SIZE);
            self.later_groups(top, 0, level, own, &bounds, &mut |other, _| found(other));
        }
    }

    /// The places of a group that are taken.
    #[inline(always)]
    pub(super) fn taken(&self, level: usize, group: usize) -> u8 {
        let last = self.levels[level].len() - 1;
        if group < last {
            return u8::MAX;
        }
        let below = if level == 0 { self.items.len() } else { self.levels[level - 1].len() };
        u8::MAX >> (SIZE - (below - last * SIZE))
    }

    /// Calls `found` with every item whose box, like all boxes above it, is
    /// among those that `may` chooses from its group. In a fixed order.
    #[inline]
    pub fn visit(&self, may: impl Fn(&Group) -> u8, mut found: impl FnMut(u32)) {
        self.descend(may, |group, chosen| self.items_of(group, chosen, &mut found));
    }

    /// The lowest groups of which `may` chooses something, if they are at
    /// most `most`.
    pub(super) fn lowest_groups(
        &self,
        may: impl Fn(&Group) -> u8,
        most: usize,
    ) -> Option<Vec<u32>> {
        let mut found = Vec::new();
        let count = Cell::new(0);
        let until_too_many = |group: &Group| if count.get() > most { 0 } else { may(group) };
        self.descend(until_too_many, |group, _| {
            found.push(group as u32);
            count.set(found.len());
        });
        (found.len() <= most).then_some(found)
    }

    /// The same as `visit` for one of the lowest groups.
    #[inline]
    pub(super) fn visit_group(
        &self,
        group: u32,
        may: impl Fn(&Group) -> u8,
        mut found: impl FnMut(u32),
    ) {
        let group = group as usize;
        let chosen = may(&self.levels[0][group]) & self.taken(0, group);
        self.items_of(group, chosen, &mut found);
    }

    /// Calls `found` with the chosen items of one of the lowest groups.
    #[inline(always)]
    fn items_of(&self, group: usize, chosen: u8, found: &mut impl FnMut(u32)) {
        places(chosen).for_each(|place| found(self.items[group * SIZE + place]));
    }

    /// Calls `found` with the lowest groups of which `may` chooses something,
    /// and with what that is.
    #[inline(always)]
    fn descend(&self, may: impl Fn(&Group) -> u8, mut found: impl FnMut(usize, u8)) {
        if self.items.is_empty() {
            return;
        }
        // Each level adds at most seven groups beyond the one taken off,
        // and 32-bit items make at most eleven levels.
        let mut stack = [(0_u32, 0_u32); 96];
        let mut height = 1;
        stack[0] = (self.levels.len() as u32 - 1, 0);
        while height > 0 {
            height -= 1;
            let (level, group) = stack[height];
            let (depth, group) = (level as usize, group as usize);
            let chosen = may(&self.levels[depth][group]) & self.taken(depth, group);
            if level == 0 {
                if chosen != 0 {
                    found(group, chosen);
                }
                continue;
            }
            for place in places(chosen) {
                stack[height] = (level - 1, (group * SIZE + place) as u32);
                height += 1;
            }
        }
    }

    /// All pairs of items with overlapping boxes, each pair once, handed to
    /// `found` in groups: `start` begins the result of a group. Results come
    /// in an order that depends on the boxes alone. Asks the run every few
    /// thousand pairs, and tells it of every item that is done; once it is
    /// stopped, pairs are left out.
    pub fn overlapping_pairs<T: Send>(
        &self,
        run: &Run<'_>,
        start: impl Fn() -> T + Sync + Send,
        found: impl Fn(&mut T, u32, u32) + Sync + Send,
    ) -> Vec<T> {
        self.pairs(|_, _| 0, run, start, found)
    }

    /// The same without related pairs.
    pub fn unrelated_pairs<T: Send>(
        &self,
        related: &Related,
        run: &Run<'_>,
        start: impl Fn() -> T + Sync + Send,
        found: impl Fn(&mut T, u32, u32) + Sync + Send,
    ) -> Vec<T> {
        self.pairs(|place, group| related.to(place, group), run, start, found)
    }

    /// Pairs but those of an item, given by its place, and items of one of the
    /// lowest groups that are to be spared.
    fn pairs<T: Send>(
        &self,
        spared: impl Fn(usize, usize) -> u8 + Sync + Send,
        run: &Run<'_>,
        start: impl Fn() -> T + Sync + Send,
        found: impl Fn(&mut T, u32, u32) + Sync + Send,
    ) -> Vec<T> {
        // One result per group, which meets itself and all later groups.
        let (level, top) = (self.level_of(256), self.levels.len() - 1);
        map_indexed(self.levels[level].len(), |group| {
            let mut result = start();
            if run.is_stopped() {
                return result;
            }
            self.pairs_within(level, group, run, &spared, &mut |a, b| found(&mut result, a, b));
            if level < top {
                let own = self.levels[level + 1][group / SIZE].get(group % SIZE);
                self.later_groups(top, 0, level, group, &own, &mut |other, bounds| {
                    let pair = [(group, &own), (other, bounds)];
                    let mut found = |a, b| found(&mut result, a, b);
                    self.pairs_between(level, pair, run, &spared, &mut found);
                    run.advance(0);
                });
            }
            if !run.is_stopped() {
                run.advance(self.items_below(level, group) as u64);
            }
            result
        })
    }

    /// Calls `found` with the groups of `level` after `own` whose boxes
    /// overlap `bounds`, the box of `own`. Looks below `group` of the level
    /// `at`, which is above `level`.
    fn later_groups(
        &self,
        at: usize,
        group: usize,
        level: usize,
        own: usize,
        bounds: &Bounds,
        found: &mut impl FnMut(usize, &Bounds),
    ) {
        let boxes = &self.levels[at][group];
        for place in places(boxes.overlapping(bounds)) {
            let child = group * SIZE + place;
            let last = (child + 1) * SIZE.pow((at - 1 - level) as u32) - 1;
            if last <= own {
                continue;
            }
            if at - 1 == level {
                found(child, &boxes.get(place));
            } else {
                self.later_groups(at - 1, child, level, own, bounds, found);
            }
        }
    }

    fn pairs_within(
        &self,
        level: usize,
        group: usize,
        run: &Run<'_>,
        spared: &impl Fn(usize, usize) -> u8,
        found: &mut impl FnMut(u32, u32),
    ) {
        let boxes = &self.levels[level][group];
        let first = group * SIZE;
        for a in places(self.taken(level, group)) {
            if level > 0 {
                self.pairs_within(level - 1, first + a, run, spared, found);
            }
            let own = boxes.get(a);
            let later = u8::MAX.checked_shl(a as u32 + 1).unwrap_or(0);
            let chosen = boxes.overlapping(&own) & later;
            if level == 0 {
                self.pairs_of(first + a, group, chosen, spared, found);
                continue;
            }
            for b in places(chosen) {
                let pair = [(first + a, &own), (first + b, &boxes.get(b))];
                self.pairs_between(level - 1, pair, run, spared, found);
            }
        }
    }

    /// Pairs between two groups of a level, given with the boxes around them.
    fn pairs_between(
        &self,
        level: usize,
        [(a, around_a), (b, around_b)]: [(usize, &Bounds); 2],
        run: &Run<'_>,
        spared: &impl Fn(usize, usize) -> u8,
        found: &mut impl FnMut(u32, u32),
    ) {
        // Below two groups of the level of items there are 64 pairs, below
        // two of the next 4096: few enough to be done in any case.
        if level > 0 && run.is_stopped() {
            return;
        }
        let (boxes_a, boxes_b) = (&self.levels[level][a], &self.levels[level][b]);
        // Only boxes that reach into the other group are compared.
        let reaching = boxes_b.overlapping(around_a);
        if reaching == 0 {
            return;
        }
        for x in places(boxes_a.overlapping(around_b)) {
            let own = boxes_a.get(x);
            let chosen = boxes_b.overlapping(&own) & reaching;
            if level == 0 {
                self.pairs_of(a * SIZE + x, b, chosen, spared, found);
                continue;
            }
            for y in places(chosen) {
                let pair = [(a * SIZE + x, &own), (b * SIZE + y, &boxes_b.get(y))];
                self.pairs_between(level - 1, pair, run, spared, found);
            }
        }
    }

    /// The pairs of an item and the chosen ones of one of the lowest groups.
    #[inline(always)]
    fn pairs_of(
        &self,
        place: usize,
        group: usize,
        chosen: u8,
        spared: &impl Fn(usize, usize) -> u8,
        found: &mut impl FnMut(u32, u32),
    ) {
        if chosen == 0 {
            return;
        }
        for other in places(chosen & !spared(place, group)) {
            found(self.items[place], self.items[group * SIZE + other]);
        }
    }
}

/// Groups boxes `0..count`.
fn grouped(count: usize, bounds: impl Fn(usize) -> Bounds + Sync + Send) -> Vec<Group> {
    map_small(count.div_ceil(SIZE), |group| {
        let first = group * SIZE;
        Group::of((first..count.min(first + SIZE)).map(&bounds))
    })
}

/// The items sorted by the cells of a space-filling curve, so fine that items on
/// a surface have cells of their own. Sorting is counting: first by the upper
/// half of a cell's bits, in parts of the items, then by the lower half, in
/// ranges of cells. Within a cell items keep their order.
fn along_curve(count: usize, place: impl Fn(usize) -> Vec3A + Sync + Send) -> Vec<u32> {
    /// Items of one part.
    const PART: usize = 1 << 16;
    /// Ranges that one task sorts.
    const RANGES: usize = 1 << 6;
    let axis_bits = (count.max(1).ilog2() / 2).clamp(1, 8);
    let shift = 63 - 3 * axis_bits;
    let cells = map_small(count, |i| (morton_code(place(i)) >> shift) as u32);
    let lower = 3 * axis_bits / 2;
    let ranges = 1 << (3 * axis_bits - lower);
    let parts = map_chunks(count, PART, |part| {
        let cells = &cells[part.clone()];
        let keys = cells.iter().map(|&cell| (cell >> lower) as usize);
        let pairs = (part.start as u32..).zip(cells.iter().copied());
        sorted_by_counting(keys, pairs, ranges)
    });
    let of_range = |range: usize| {
        let items = || {
            parts.iter().flat_map(|(pairs, ends)| {
                let start = if range == 0 { 0 } else { ends[range - 1] as usize };
                pairs[start..ends[range] as usize].iter().copied()
            })
        };
        if items().next().is_none() {
            return Vec::new();
        }
        let key = |(_, cell): (u32, u32)| (cell & ((1 << lower) - 1)) as usize;
        sorted_by_counting(items().map(key), items().map(|(item, _)| item), 1 << lower).0
    };
    // Few items are not worth waking threads for.
    let at_once = if parts.len() > 1 { RANGES } else { ranges };
    let sorted = map_chunks(ranges, at_once, |part| part.flat_map(of_range).collect::<Vec<_>>());
    match &sorted[..] {
        [_] => sorted.concat(),
        _ => {
            let lists: Vec<&[u32]> = sorted.iter().map(|list| &list[..]).collect();
            concat_map(&lists, |_, item| *item)
        }
    }
}

/// Items sorted by their keys below `most`, and where those of each key end.
fn sorted_by_counting<T: Copy + Default>(
    keys: impl Iterator<Item = usize> + Clone,
    items: impl Iterator<Item = T>,
    most: usize,
) -> (Vec<T>, Vec<u32>) {
    let mut ends = vec![0_u32; most];
    keys.clone().for_each(|key| ends[key] += 1);
    let mut sum = 0;
    for end in &mut ends {
        // For now, where they begin.
        sum += std::mem::replace(end, sum);
    }
    let mut sorted = vec![T::default(); sum as usize];
    for (key, item) in keys.zip(items) {
        sorted[ends[key] as usize] = item;
        ends[key] += 1;
    }
    (sorted, ends)
}

/// Spreads the lower 21 bits of `x` to every third bit.
fn spread(x: u64) -> u64 {
    let x = (x | x << 32) & 0x001f_0000_0000_ffff;
    let x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    let x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    let x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}

/// The place of a point on a curve through [-1, 1]^3.
fn morton_code(place: Vec3A) -> u64 {
    // Places of unbounded boxes are NaN or infinite: `as` saturates.
    let cell = |axis: usize| ((place[axis] + 1.0) * 1_048_576.0) as u64 & 0x1f_ffff;
    spread(cell(0)) | spread(cell(1)) << 1 | spread(cell(2)) << 2
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
                hierarchy.visit(|group| group.overlapping(&ask), |item| found.push(item));
                found.sort_unstable();
                let expected: Vec<u32> = (0..boxes.len() as u32)
                    .filter(|&i| boxes[i as usize].overlaps(&ask))
                    .collect();
                prop_assert_eq!(found, expected);
            }
        }

        #[test]
        fn a_stop_leaves_pairs_out(boxes in boxes(2000)) {
            let hierarchy = Hierarchy::new(&boxes);
            let flag = true.into();
            let run = Run::default().with_cancel(&flag);
            let groups = hierarchy.overlapping_pairs(&run, || 0, |count, _, _| *count += 1);
            prop_assert_eq!(groups.into_iter().sum::<usize>(), 0);
        }

        #[test]
        fn pairs_are_those_of_brute_force(boxes in boxes(700)) {
            let hierarchy = Hierarchy::new(&boxes);
            let groups = hierarchy.overlapping_pairs(&Run::default(), Vec::new, |list, a, b| list.push([a.min(b), a.max(b)]));
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
