//! Pairs that need not be looked at because of something they have in common.
//!
//! Every item of a hierarchy may have up to three labels. They lie side by
//! side in the order of the hierarchy's lowest groups, so that one item is
//! compared with all eight of a group at once, beside their boxes, before any
//! of them is touched.

use super::Hierarchy;
use super::group::SIZE;
use crate::run::map_small;

/// Labels of the items of a hierarchy. Items with a label in common are
/// related.
#[derive(Debug, Clone)]
pub struct Related {
    groups: Vec<[[u32; SIZE]; 3]>,
}

/// No label, among the items of a group,
const NONE: u32 = u32::MAX;

/// and of the item that is compared with them.
const NOTHING: u32 = u32::MAX - 1;

impl Related {
    /// Takes the labels of all items of a hierarchy; labels are less than
    /// `u32::MAX - 1`. O(n).
    pub fn new(
        hierarchy: &Hierarchy,
        labels: impl Fn(u32) -> [Option<u32>; 3] + Sync + Send,
    ) -> Self {
        let items = hierarchy.items();
        let groups = map_small(items.len().div_ceil(SIZE), |group| {
            let mut own = [[NONE; SIZE]; 3];
            for (place, &item) in items[group * SIZE..].iter().take(SIZE).enumerate() {
                for (row, label) in own.iter_mut().zip(labels(item)) {
                    row[place] = label.unwrap_or(NONE);
                }
            }
            own
        });
        Related { groups }
    }

    /// What the labels of so many items take.
    pub fn bytes(items: usize) -> usize {
        items.div_ceil(SIZE) * size_of::<[[u32; SIZE]; 3]>()
    }

    /// Which items of a group are related to the one at `place`, a bit for
    /// each.
    #[inline(always)]
    pub(super) fn to(&self, place: usize, group: usize) -> u8 {
        let mut found = [0; SIZE];
        for own in &self.groups[place / SIZE] {
            let label = if own[place % SIZE] == NONE { NOTHING } else { own[place % SIZE] };
            for others in &self.groups[group] {
                for (i, found) in found.iter_mut().enumerate() {
                    *found |= u32::from(others[i] == label) << i;
                }
            }
        }
        found.into_iter().fold(0, |bits, bit| bits | bit) as u8
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Run;
    use crate::spatial::Bounds;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn pairs_are_left_out_if_and_only_if_they_share_a_label(
            items in prop::collection::vec(
                (prop::array::uniform3(-4..4_i32), prop::array::uniform3(prop::option::of(0..40_u32))),
                0..200,
            ),
        ) {
            let boxes: Vec<Bounds> = items
                .iter()
                .map(|(at, _)| {
                    let low = at.map(|x| x as f32 / 5.0);
                    Bounds { low: low.into(), high: low.map(|x| x + 0.25).into() }
                })
                .collect();
            let hierarchy = Hierarchy::new(&boxes);
            let labels = |item: u32| items[item as usize].1;
            let related = Related::new(&hierarchy, labels);
            let pairs = |list: &mut Vec<[u32; 2]>, a: u32, b: u32| list.push([a.min(b), a.max(b)]);
            let run = Run::default();
            let mut all = hierarchy.overlapping_pairs(&run, Vec::new, pairs).concat();
            let mut found = hierarchy.unrelated_pairs(&related, &run, Vec::new, pairs).concat();
            all.retain(|&[a, b]| {
                let share = |label: &Option<u32>| label.is_some() && labels(b).contains(label);
                !labels(a).iter().any(share)
            });
            all.sort_unstable();
            found.sort_unstable();
            prop_assert_eq!(found, all);
        }
    }
}
