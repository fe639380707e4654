//! Which of many points is nearest, while points are taken away.
//!
//! A balanced k-d tree (Bentley 1975), that is, a grid whose cells follow the
//! points: the ends of strokes crowd where a model is detailed, and no one
//! size of cell suits both the crowd and the open page. The tree has no
//! pointers: level by level each range of points is cut in two halves across
//! the longer side of its box. Every node counts the points below it that are
//! still there, so what is empty is not entered.

use glam::DVec2;

/// At most this many points are in a leaf.
const LEAF: usize = 8;

/// Points that can be asked for by nearness, each with its number.
pub(super) struct Nearest {
    points: Vec<DVec2>,
    /// The number of each point, in the order of the tree.
    numbers: Vec<u32>,
    /// Where each number stands in that order.
    places: Vec<u32>,
    present: Vec<bool>,
    levels: u32,
    /// Node k has the children 2 k + 1 and 2 k + 2; the last level are leaves.
    nodes: Vec<Node>,
}

#[derive(Clone, Copy)]
struct Node {
    low: DVec2,
    high: DVec2,
    present: u32,
}

impl Node {
    /// Square of the distance of a point from the box.
    fn distance(&self, point: DVec2) -> f64 {
        (self.low - point).max(point - self.high).max(DVec2::ZERO).length_squared()
    }
}

impl Nearest {
    /// A tree of `points`, numbered in their order. O(n log n).
    pub(super) fn new(points: &[DVec2]) -> Self {
        let mut levels = 0;
        while LEAF << levels < points.len() {
            levels += 1;
        }
        let mut numbers: Vec<u32> = (0..points.len() as u32).collect();
        let empty = Node { low: DVec2::INFINITY, high: DVec2::NEG_INFINITY, present: 0 };
        let mut nodes = vec![empty; (2 << levels) - 1];
        for level in 0..=levels {
            for index in 0..1_usize << level {
                let [low, high] = range(points.len(), level, index);
                let part = &mut numbers[low..high];
                let node = &mut nodes[(1 << level) - 1 + index];
                node.present = part.len() as u32;
                for number in part.iter() {
                    node.low = node.low.min(points[*number as usize]);
                    node.high = node.high.max(points[*number as usize]);
                }
                if level < levels {
                    let size = node.high - node.low;
                    let axis = usize::from(size.x < size.y);
                    let middle = range(points.len(), level + 1, 2 * index)[1] - low;
                    part.select_nth_unstable_by(middle, |a, b| {
                        let [p, q] = [a, b].map(|number| points[*number as usize][axis]);
                        p.total_cmp(&q).then(a.cmp(b))
                    });
                }
            }
        }
        let mut places = vec![0; points.len()];
        for (place, number) in numbers.iter().enumerate() {
            places[*number as usize] = place as u32;
        }
        let points = numbers.iter().map(|number| points[*number as usize]).collect();
        let present = vec![true; places.len()];
        Nearest { points, numbers, places, present, levels, nodes }
    }

    /// Takes a point away; one that is gone stays gone.
    pub(super) fn remove(&mut self, number: u32) {
        let place = self.places[number as usize] as usize;
        if !std::mem::replace(&mut self.present[place], false) {
            return;
        }
        let leaves = 1_usize << self.levels;
        let leaf = ((place + 1) * leaves - 1) / self.points.len();
        let mut node = leaves - 1 + leaf;
        loop {
            self.nodes[node].present -= 1;
            if node == 0 {
                return;
            }
            node = (node - 1) / 2;
        }
    }

    /// The number of the nearest point that is still there.
    pub(super) fn find(&self, point: DVec2) -> Option<u32> {
        let mut best = [(f64::INFINITY, u32::MAX)];
        self.search(point, 0, 0, &mut best, &|_| true);
        (best[0].1 != u32::MAX).then_some(best[0].1)
    }

    /// The nearest points for which `fits` holds, nearest first, as many as
    /// `best` has places for; `u32::MAX` where there are no more.
    pub(super) fn find_many(
        &self,
        point: DVec2,
        best: &mut [(f64, u32)],
        fits: &impl Fn(u32) -> bool,
    ) {
        best.fill((f64::INFINITY, u32::MAX));
        self.search(point, 0, 0, best, fits);
    }

    fn search(
        &self,
        point: DVec2,
        level: u32,
        index: usize,
        best: &mut [(f64, u32)],
        fits: &impl Fn(u32) -> bool,
    ) {
        if level == self.levels {
            let [low, high] = range(self.points.len(), level, index);
            for place in low..high {
                let distance = self.points[place].distance_squared(point);
                let number = self.numbers[place];
                if self.present[place] && distance < best[best.len() - 1].0 && fits(number) {
                    insert(best, (distance, number));
                }
            }
            return;
        }
        let first = (2 << level) - 1 + 2 * index;
        let distances = [0, 1].map(|child| self.nodes[first + child].distance(point));
        let nearer = usize::from(distances[1] < distances[0]);
        for child in [nearer, 1 - nearer] {
            if 0 < self.nodes[first + child].present && distances[child] < best[best.len() - 1].0 {
                self.search(point, level + 1, 2 * index + child, best, fits);
            }
        }
    }
}

/// The places of node `index` of a level.
fn range(count: usize, level: u32, index: usize) -> [usize; 2] {
    [index, index + 1].map(|index| (count * index) >> level)
}

/// Puts an entry into its place; the last one falls out.
fn insert(best: &mut [(f64, u32)], entry: (f64, u32)) {
    let mut place = best.len() - 1;
    while 0 < place && entry.0 < best[place - 1].0 {
        best[place] = best[place - 1];
        place -= 1;
    }
    best[place] = entry;
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_nearest_is_found_as_by_trying_all(
            points in prop::collection::vec((0i32..40, 0i32..9), 1..200),
            gone in prop::collection::vec(0usize..200, 0..150),
            from in (-5i32..45, -5i32..15),
        ) {
            let at = |(x, y): (i32, i32)| DVec2::new(f64::from(x), f64::from(y));
            let points: Vec<DVec2> = points.into_iter().map(at).collect();
            let mut left: Vec<bool> = vec![true; points.len()];
            let mut tree = Nearest::new(&points);
            for number in gone {
                if number < points.len() {
                    left[number] = false;
                    tree.remove(number as u32);
                }
            }
            let from = at(from);
            let mut expected: Vec<f64> = (0..points.len())
                .filter(|number| left[*number])
                .map(|number| points[number].distance_squared(from))
                .collect();
            expected.sort_by(f64::total_cmp);
            let found = tree.find(from).map(|n| points[n as usize].distance_squared(from));
            prop_assert_eq!(found, expected.first().copied());
            let mut best = [(0.0, 0); 5];
            tree.find_many(from, &mut best, &|_| true);
            let best: Vec<f64> =
                best.iter().filter(|entry| entry.1 != u32::MAX).map(|entry| entry.0).collect();
            prop_assert_eq!(&best[..], &expected[..expected.len().min(5)]);
        }
    }
}
