//! Sorting by what predicates say.

use super::Policy;
use std::cmp::Ordering;

/// Sorts by an order that predicates under a policy decide; equal ones keep
/// their order. Signs that floats get wrong may contradict one another, and
/// the sort of the standard library may panic then: where they can, items are
/// put in one by one, each at a place found by halving. O(n log n), and O(n^2)
/// moves under a policy that errs.
pub fn sort_by_predicates<P: Policy, T>(list: &mut [T], order: impl Fn(&T, &T) -> Ordering) {
    if P::NEVER_ERRS {
        return list.sort_by(order);
    }
    for next in 1..list.len() {
        let (before, rest) = list.split_at(next);
        let place = before.partition_point(|other| order(other, &rest[0]).is_le());
        list[place..=next].rotate_right(1);
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Exact, Plain};
    use super::*;

    #[test]
    fn both_ways_sort_and_keep_the_order_of_equals() {
        let numbers: Vec<(u32, u32)> = (0..100).map(|i| (i * 37 % 11, i)).collect();
        let (mut one, mut other) = (numbers.clone(), numbers);
        sort_by_predicates::<Exact, _>(&mut one, |a, b| a.0.cmp(&b.0));
        sort_by_predicates::<Plain, _>(&mut other, |a, b| a.0.cmp(&b.0));
        assert!(one.is_sorted());
        assert_eq!(one, other);
    }

    #[test]
    fn contradictions_are_sorted_somehow() {
        // Rock, paper, scissors, many times.
        let mut numbers: Vec<u32> = (0..1000).map(|i| i * 7 % 3).collect();
        sort_by_predicates::<Plain, _>(&mut numbers, |a, b| match (3 + a - b) % 3 {
            0 => Ordering::Equal,
            1 => Ordering::Greater,
            _ => Ordering::Less,
        });
        assert_eq!(numbers.len(), 1000);
    }
}
