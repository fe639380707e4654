//! The order of a tree for one eye.

use super::{Bsp, Fragment, Node};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Policy, Predicates};

/// What is still to be done, last first.
enum Step {
    Visit(u32),
    Emit(u32),
}

impl Bsp {
    /// Calls `paint` with all fragments that are not edge-on for the eye of
    /// `predicates`, from back to front: none hides a later one. Of fragments
    /// in one plane that with the least number comes last. The vertices must be
    /// those with which the tree was built. O(n).
    pub fn back_to_front<P: Policy>(
        &self,
        predicates: &Predicates<'_, P>,
        mut paint: impl FnMut(&Fragment),
    ) {
        self.walk(predicates, Sign::Negative, |node| {
            self.of(node).iter().rev().for_each(&mut paint);
        });
    }

    /// The same from front to back.
    pub fn front_to_back<P: Policy>(
        &self,
        predicates: &Predicates<'_, P>,
        mut paint: impl FnMut(&Fragment),
    ) {
        self.walk(predicates, Sign::Positive, |node| {
            self.of(node).iter().for_each(&mut paint);
        });
    }

    fn of(&self, node: &Node) -> &[Fragment] {
        &self.fragments[node.fragments.start as usize..node.fragments.end as usize]
    }

    /// Visits all nodes, of two halves first the one where planes have the
    /// sign that they have at the eye, times `first`.
    fn walk<P: Policy>(
        &self,
        predicates: &Predicates<'_, P>,
        first: Sign,
        mut emit: impl FnMut(&Node),
    ) {
        let root = if self.nodes.is_empty() { None } else { Some(0) };
        let mut steps: Vec<Step> = root.into_iter().map(Step::Visit).collect();
        while let Some(step) = steps.pop() {
            let number = match step {
                Step::Emit(number) => {
                    emit(&self.nodes[number as usize]);
                    continue;
                }
                Step::Visit(number) => number,
            };
            let node = &self.nodes[number as usize];
            let sign = predicates.eye_above(node.plane) * first;
            let (early, late) = match sign {
                Sign::Positive => (node.above, node.below),
                _ => (node.below, node.above),
            };
            steps.extend(late.map(Step::Visit));
            // Edge-on there is nothing to be painted.
            if !sign.is_zero() && !node.fragments.is_empty() {
                steps.push(Step::Emit(number));
            }
            steps.extend(early.map(Step::Visit));
        }
    }
}
