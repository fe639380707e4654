//! One name for a ring, wherever it begins and whichever way it runs.

/// The items of a ring in the order that is least of all: over all places to
/// begin and both directions. Two rings are the same, up to rotation and
/// reversal, if and only if these are equal. O(n), by comparing two candidates
/// for the least rotation at a time (Shiloach 1981).
///
/// ```
/// use umriss::polygon::canonical_cycle;
///
/// assert_eq!(canonical_cycle(&[3, 1, 2, 1]), [1, 2, 1, 3]);
/// assert_eq!(canonical_cycle(&[1, 3, 1, 2]), [1, 2, 1, 3]);
/// ```
pub fn canonical_cycle<T: Ord + Copy>(ring: &[T]) -> Vec<T> {
    let count = ring.len();
    if count == 0 {
        return Vec::new();
    }
    let forward = |i: usize| ring[i % count];
    let backward = |i: usize| ring[count - 1 - i % count];
    let rotated = |at: &dyn Fn(usize) -> T| -> Vec<T> {
        let start = least_rotation(count, at);
        (start..start + count).map(at).collect()
    };
    rotated(&forward).min(rotated(&backward))
}

/// Where the least rotation of a ring of `count` items begins.
fn least_rotation<T: Ord>(count: usize, at: &dyn Fn(usize) -> T) -> usize {
    // Two candidates that agree in `same` items.
    let (mut one, mut other, mut same) = (0, 1, 0);
    while one < count && other < count && same < count {
        // The greater is out, and all up to the place where they differ.
        match at(one + same).cmp(&at(other + same)) {
            std::cmp::Ordering::Equal => {
                same += 1;
                continue;
            }
            std::cmp::Ordering::Greater => one += same + 1,
            std::cmp::Ordering::Less => other += same + 1,
        }
        other += usize::from(one == other);
        same = 0;
    }
    one.min(other)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// All rotations of both directions.
    fn by_trying(ring: &[u8]) -> Vec<u8> {
        let rotations = |ring: Vec<u8>| -> Vec<Vec<u8>> {
            (0..ring.len()).map(|i| [&ring[i..], &ring[..i]].concat()).collect()
        };
        let back = ring.iter().rev().copied().collect();
        [rotations(ring.to_vec()), rotations(back)].concat().into_iter().min().unwrap_or_default()
    }

    proptest! {
        #[test]
        fn it_is_the_least_of_all(ring in prop::collection::vec(0..3_u8, 0..12)) {
            prop_assert_eq!(canonical_cycle(&ring), by_trying(&ring));
        }
    }

    #[test]
    fn a_ring_of_two_items_in_turn_takes_no_quadratic_time() {
        let mut ring = [1, 2].repeat(1_000_000);
        ring[777_777] = 0;
        let canonical = canonical_cycle(&ring);
        assert_eq!(canonical[..3], [0, 1, 2]);
    }
}
