//! A binary tree of boxes, split at the median of the longer image axis:
//! this room's own search, shared with no object-space method.
//!
//! O(n log n) to build, expected O(log n + answers) to ask.

use crate::model::ViewCoordinates;
use crate::run::map_indexed;
use crate::spatial::Bounds;
use crate::view::LineQuestion;

/// Most items of a leaf.
const LEAF: usize = 4;

#[derive(Debug, Clone, Copy)]
struct Node {
    bounds: Bounds,
    /// Where the items of the subtree begin and end.
    first: u32,
    end: u32,
    /// The second child; the first one follows its parent. Zero: a leaf.
    second: u32,
}

/// Boxes over items `0..n`.
#[derive(Debug, Clone)]
pub struct BoxTree {
    boxes: Vec<Bounds>,
    items: Vec<u32>,
    nodes: Vec<Node>,
}

impl BoxTree {
    /// Builds the tree; items with empty boxes are left out.
    pub fn new(boxes: Vec<Bounds>) -> Self {
        let mut items: Vec<u32> =
            (0..boxes.len() as u32).filter(|&i| !boxes[i as usize].is_empty()).collect();
        let mut nodes = Vec::new();
        let end = items.len();
        if end > 0 {
            build(&boxes, &mut items, 0, end, &mut nodes);
        }
        BoxTree { boxes, items, nodes }
    }

    /// The tree of all triangles that can hide something: edge-on ones are
    /// left out.
    pub fn of_triangles(question: &LineQuestion, coordinates: &ViewCoordinates) -> Self {
        let triangles = question.mesh.triangles();
        BoxTree::new(map_indexed(triangles.len(), |i| match question.facing[i].is_zero() {
            true => Bounds::EMPTY,
            false => coordinates.bounds(triangles[i]),
        }))
    }

    /// Calls `found` with all items whose images' boxes meet that of
    /// `bounds` and that reach in front of its farthest point; items in a
    /// fixed order.
    pub fn in_front(&self, bounds: &Bounds, mut found: impl FnMut(u32)) {
        let meets = |other: &Bounds| {
            (0..2).all(|i| other.low[i] <= bounds.high[i] && bounds.low[i] <= other.high[i])
                && other.low[2] <= bounds.high[2]
        };
        let mut waiting = Vec::with_capacity(64);
        if !self.nodes.is_empty() && !bounds.is_empty() {
            waiting.push(0_u32);
        }
        while let Some(index) = waiting.pop() {
            let node = &self.nodes[index as usize];
            if !meets(&node.bounds) {
                continue;
            }
            if node.second > 0 {
                waiting.extend([node.second, index + 1]);
                continue;
            }
            for &item in &self.items[node.first as usize..node.end as usize] {
                if meets(&self.boxes[item as usize]) {
                    found(item);
                }
            }
        }
    }
}

/// Builds the subtree of `items[first..end]` and returns its node.
fn build(
    boxes: &[Bounds],
    items: &mut [u32],
    first: usize,
    end: usize,
    nodes: &mut Vec<Node>,
) -> u32 {
    let part = &mut items[first..end];
    let bounds = part.iter().fold(Bounds::EMPTY, |sum, &item| sum.union(&boxes[item as usize]));
    let index = nodes.len();
    nodes.push(Node { bounds, first: first as u32, end: end as u32, second: 0 });
    if part.len() > LEAF {
        let axis = usize::from(bounds.high[1] - bounds.low[1] > bounds.high[0] - bounds.low[0]);
        let centre = |item: u32| {
            let bounds = &boxes[item as usize];
            // Halves first: boxes may be unbounded on both sides.
            bounds.low[axis] * 0.5 + bounds.high[axis] * 0.5
        };
        let middle = part.len() / 2;
        part.select_nth_unstable_by(middle, |&a, &b| {
            centre(a).total_cmp(&centre(b)).then(a.cmp(&b))
        });
        build(boxes, items, first, first + middle, nodes);
        nodes[index].second = build(boxes, items, first + middle, end, nodes);
    }
    index as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_that_meets_a_box_is_found() {
        let mut state = 5_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(99);
            (state >> 40) as f32 / 16_777_216.0
        };
        let mut one = |size: f32| {
            let low = [random(), random(), random()];
            Bounds { low, high: low.map(|x| x + size * random()) }
        };
        let mut boxes: Vec<Bounds> = (0..300).map(|_| one(0.1)).collect();
        boxes[17] = Bounds::ALL;
        boxes[18] = Bounds::EMPTY;
        let tree = BoxTree::new(boxes.clone());
        for _ in 0..100 {
            let query = one(0.3);
            let mut found = Vec::new();
            tree.in_front(&query, |item| found.push(item));
            found.sort_unstable();
            let expected: Vec<u32> = (0..300)
                .filter(|&i| !boxes[i as usize].is_empty() && boxes[i as usize].may_hide(&query))
                .collect();
            assert_eq!(found, expected);
        }
    }
}
