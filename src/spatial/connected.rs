//! Items connected by a relation between those whose boxes overlap.
//!
//! Where thousands of items lie on one another, all of them related, pairs are
//! far more than it takes to connect them. So items are gathered into sets as
//! pairs are found (union-find: Tarjan 1975), from the lowest groups of a
//! hierarchy upwards, and two groups of which all items are in one set
//! already are passed over with all their pairs.
//!
//! First each part of the hierarchy is worked on by itself; then every part is
//! held against those after it, with what it has found itself and what was
//! known before. So it does not depend on the number of threads which pairs
//! are asked about.
//!
//! O(n log n + pairs of unrelated items) where related items lie together in
//! groups.

use super::Hierarchy;
use super::group::{SIZE, places};
use crate::run::{Run, map_indexed};
use rustc_hash::FxHashMap;

/// A hierarchy is cut into so many parts at least, and less than eight times
/// as many: a pair is asked about for any two of them that are connected.
const PARTS: usize = 64;

/// Disjoint sets of places of the lowest groups.
trait Sets {
    fn root(&mut self, place: u32) -> u32;
    /// Makes one of two roots the other's parent.
    fn set_parent(&mut self, root: u32, parent: u32);

    fn are_joined(&mut self, a: u32, b: u32) -> bool {
        self.root(a) == self.root(b)
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        if a != b {
            self.set_parent(a.max(b), a.min(b));
        }
    }
}

/// Sets of some places that follow one another.
struct Own {
    first: u32,
    parents: Vec<u32>,
}

impl Sets for Own {
    fn root(&mut self, mut place: u32) -> u32 {
        loop {
            let at = (place - self.first) as usize;
            let parent = self.parents[at];
            if parent == place {
                return place;
            }
            // Halves the path.
            self.parents[at] = self.parents[(parent - self.first) as usize];
            place = self.parents[at];
        }
    }

    fn set_parent(&mut self, root: u32, parent: u32) {
        self.parents[(root - self.first) as usize] = parent;
    }
}

/// Sets that are known, and what was joined since.
struct Since<'k> {
    known: &'k [u32],
    parents: FxHashMap<u32, u32>,
}

impl Sets for Since<'_> {
    fn root(&mut self, place: u32) -> u32 {
        let mut root = self.known[place as usize];
        while let Some(&parent) = self.parents.get(&root) {
            if let Some(&above) = self.parents.get(&parent) {
                self.parents.insert(root, above);
            }
            root = parent;
        }
        root
    }

    fn set_parent(&mut self, root: u32, parent: u32) {
        self.parents.insert(root, parent);
    }
}

/// The label of a group whose places are not all in one set.
const SEVERAL: u32 = u32::MAX;

/// For each group of some levels a place of the set that all of its places are
/// in.
struct Labels {
    /// From the lowest level on the first group that has a label here, and
    /// the labels from there on.
    levels: Vec<(usize, Vec<u32>)>,
}

impl Labels {
    /// Those of a group and all below it, to be found.
    fn below(hierarchy: &Hierarchy, level: usize, group: usize) -> Self {
        let of = |below: usize| {
            let per_group = SIZE.pow((level - below) as u32);
            let first = group * per_group;
            let count = per_group.min(hierarchy.groups(below) - first);
            (first, vec![SEVERAL; count])
        };
        Labels { levels: (0..=level).map(of).collect() }
    }

    fn get(&self, level: usize, group: usize) -> u32 {
        let (first, labels) = &self.levels[level];
        labels[group - first]
    }

    fn find(&mut self, hierarchy: &Hierarchy, level: usize, group: usize, sets: &mut impl Sets) {
        let mut members = places(hierarchy.taken(level, group)).map(|place| match level {
            0 => (group * SIZE + place) as u32,
            _ => self.get(level - 1, group * SIZE + place),
        });
        let label = members.next().unwrap_or(SEVERAL);
        let is_one =
            label != SEVERAL && members.all(|own| own != SEVERAL && sets.are_joined(label, own));
        if is_one {
            let (first, labels) = &mut self.levels[level];
            labels[group - *first] = label;
        }
    }
}

impl Hierarchy {
    /// For each item the least of those that it is connected with, through
    /// pairs with overlapping boxes that `related` says to be related; and
    /// the results that `start` begins and `related` adds to, one for each
    /// part of the work. Not all pairs are asked about, and once the run is
    /// stopped none is.
    pub fn connected<T: Send>(
        &self,
        run: &Run<'_>,
        start: impl Fn() -> T + Sync + Send,
        related: impl Fn(&mut T, u32, u32) -> bool + Sync + Send,
    ) -> (Vec<u32>, Vec<T>) {
        let (level, items) = (self.level_of(PARTS), self.items());
        let within = map_indexed(self.groups(level), |group| {
            let mut result = start();
            let first = (group * SIZE.pow(level as u32 + 1)) as u32;
            let count = self.items_below(level, group) as u32;
            let mut sets = Own { first, parents: (first..first + count).collect() };
            let mut labels = Labels::below(self, level, group);
            if !run.is_stopped() {
                let mut pair = |sets: &mut Own, a, b| {
                    self.connect(sets, [a, b], |a, b| related(&mut result, a, b));
                };
                self.connect_within(level, group, &mut sets, &mut labels, &mut pair);
            }
            let roots: Vec<u32> = (first..first + count).map(|place| sets.root(place)).collect();
            (roots, labels, result)
        });
        let mut known = Vec::with_capacity(items.len());
        let mut results = Vec::with_capacity(2 * within.len());
        let mut labels = Vec::with_capacity(within.len());
        for (roots, own, result) in within {
            known.extend(roots);
            labels.push(own);
            results.push(result);
        }
        let between = map_indexed(self.groups(level), |group| {
            let mut result = start();
            let mut sets = Since { known: &known, parents: FxHashMap::default() };
            self.groups_after(level, group, &mut |other| {
                let mut pair = |sets: &mut Since<'_>, a, b| {
                    self.connect(sets, [a, b], |a, b| related(&mut result, a, b));
                };
                if !run.is_stopped() {
                    let labels = [&labels[group], &labels[other]];
                    self.connect_between(level, [group, other], &mut sets, labels, &mut pair);
                    run.advance(0);
                }
            });
            run.advance(self.items_below(level, group) as u64);
            (sets.parents, result)
        });
        let mut sets = Own { first: 0, parents: known };
        for (parents, result) in between {
            // In whatever order: the least place becomes the root.
            parents.into_iter().for_each(|(a, b)| sets.join(a, b));
            results.push(result);
        }
        (self.least_items(&mut sets), results)
    }

    /// For each item the least one of its set.
    fn least_items(&self, sets: &mut Own) -> Vec<u32> {
        let mut least = vec![u32::MAX; self.items().len()];
        for (place, &item) in self.items().iter().enumerate() {
            let root = sets.root(place as u32) as usize;
            least[root] = least[root].min(item);
        }
        let mut of_items = vec![0; self.items().len()];
        for (place, &item) in self.items().iter().enumerate() {
            of_items[item as usize] = least[sets.root(place as u32) as usize];
        }
        of_items
    }

    /// Joins two places, if their items are related.
    fn connect<S: Sets>(
        &self,
        sets: &mut S,
        places: [u32; 2],
        related: impl FnOnce(u32, u32) -> bool,
    ) {
        let [a, b] = places.map(|place| self.items()[place as usize]);
        if related(a, b) {
            sets.join(places[0], places[1]);
        }
    }

    /// Connects the places of one group, and finds the labels of all below.
    fn connect_within<S: Sets>(
        &self,
        level: usize,
        group: usize,
        sets: &mut S,
        labels: &mut Labels,
        pair: &mut impl FnMut(&mut S, u32, u32),
    ) {
        let (boxes, first) = (self.group(level, group), group * SIZE);
        if level > 0 {
            for child in places(self.taken(level, group)) {
                self.connect_within(level - 1, first + child, sets, labels, pair);
            }
        }
        for a in places(self.taken(level, group)) {
            let later = u8::MAX.checked_shl(a as u32 + 1).unwrap_or(0);
            for b in places(boxes.overlapping(&boxes.get(a)) & later) {
                let both = [first + a, first + b];
                if level > 0 {
                    self.connect_between(level - 1, both, sets, [labels, labels], pair);
                } else if !sets.are_joined(both[0] as u32, both[1] as u32) {
                    pair(sets, both[0] as u32, both[1] as u32);
                }
            }
        }
        labels.find(self, level, group, sets);
    }

    /// Connects the places of one group with those of another, each with the
    /// labels of what is below it.
    fn connect_between<S: Sets>(
        &self,
        level: usize,
        [a, b]: [usize; 2],
        sets: &mut S,
        labels: [&Labels; 2],
        pair: &mut impl FnMut(&mut S, u32, u32),
    ) {
        let own = [labels[0].get(level, a), labels[1].get(level, b)];
        let are_one = |sets: &mut S| !own.contains(&SEVERAL) && sets.are_joined(own[0], own[1]);
        if are_one(sets) {
            return;
        }
        let (boxes_a, boxes_b) = (self.group(level, a), self.group(level, b));
        let reaching = boxes_b.overlapping(&boxes_a.around());
        if reaching == 0 {
            return;
        }
        for x in places(boxes_a.overlapping(&boxes_b.around())) {
            for y in places(boxes_b.overlapping(&boxes_a.get(x)) & reaching) {
                let both = [a * SIZE + x, b * SIZE + y];
                if level > 0 {
                    self.connect_between(level - 1, both, sets, labels, pair);
                } else if !sets.are_joined(both[0] as u32, both[1] as u32) {
                    pair(sets, both[0] as u32, both[1] as u32);
                }
                if are_one(sets) {
                    return;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spatial::Bounds;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn sets_are_those_of_all_pairs(
            items in prop::collection::vec(
                (prop::array::uniform3(0..30_i32), 0..6_i32, 0..3_u32),
                0..700,
            ),
        ) {
            let boxes: Vec<Bounds> = items
                .iter()
                .map(|(at, size, _)| {
                    let low = at.map(|x| x as f32 / 15.0 - 1.0);
                    let high = low.map(|x| x + *size as f32 / 30.0);
                    Bounds { low: low.into(), high: high.into() }
                })
                .collect();
            let related = |a: u32, b: u32| items[a as usize].2 == items[b as usize].2;
            let run = Run::default();
            let hierarchy = Hierarchy::new(&boxes);
            let (found, _) = hierarchy.connected(&run, || (), |(), a, b| related(a, b));
            let all = 0..items.len() as u32;
            let mut sets = Own { first: 0, parents: all.clone().collect() };
            for a in 0..items.len() as u32 {
                for b in 0..a {
                    if related(a, b) && boxes[a as usize].overlaps(&boxes[b as usize]) {
                        sets.join(a, b);
                    }
                }
            }
            let expected: Vec<u32> = all.map(|item| sets.root(item)).collect();
            prop_assert_eq!(found, expected);
        }
    }

    #[test]
    fn few_of_the_pairs_of_many_items_in_one_place_are_asked_about() {
        let here = Bounds { low: [0.0; 3].into(), high: [1.0; 3].into() };
        let count = 20_000;
        let hierarchy = Hierarchy::new(&vec![here; count]);
        let related = |asked: &mut usize, _, _| {
            *asked += 1;
            true
        };
        let (roots, asked) = hierarchy.connected(&Run::default(), || 0, related);
        assert!(roots.iter().all(|&root| root == 0));
        // Any two of the parts, and what connects each of them.
        assert!(asked.iter().sum::<usize>() < count + 8 * PARTS * 8 * PARTS / 2);
    }
}
