//! Loops over many independent pieces of work, on all cores where the
//! feature `parallel` is on and one after the other where it is not.
//!
//! Results come back in the order of the input whatever the number of
//! threads, so nothing that is built from them can depend on it.

#[cfg(feature = "parallel")]
use rayon::prelude::*;

/// So many small pieces of work are done by one thread.
#[cfg(feature = "parallel")]
const LEAST: usize = 1024;

/// `[work(0), work(1), ..., work(count - 1)]`.
pub fn map_indexed<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    // To wake a thread takes longer than much work of a single piece.
    #[cfg(feature = "parallel")]
    if count > 1 {
        return (0..count).into_par_iter().map(work).collect();
    }
    (0..count).map(work).collect()
}

/// The same for work that is small.
pub fn map_small<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    #[cfg(feature = "parallel")]
    if count > LEAST {
        return (0..count).into_par_iter().with_min_len(LEAST).map(work).collect();
    }
    (0..count).map(work).collect()
}

/// Cuts `0..count` into ranges of `size` and maps each of them; results in
/// the order of the ranges.
pub fn map_chunks<T: Send>(
    count: usize,
    size: usize,
    work: impl Fn(std::ops::Range<usize>) -> T + Sync + Send,
) -> Vec<T> {
    let size = size.max(1);
    map_indexed(count.div_ceil(size), |chunk| work(chunk * size..((chunk + 1) * size).min(count)))
}

/// Joins lists, each item turned into `work(number of its list, item)`: to
/// copy much is work for all cores too.
pub fn concat_map<S: Sync, T: Send>(
    lists: &[&[S]],
    work: impl Fn(usize, &S) -> T + Sync + Send,
) -> Vec<T> {
    #[cfg(feature = "parallel")]
    if lists.len() > 1 {
        let mut count = 0;
        let mut starts = Vec::with_capacity(lists.len());
        for list in lists {
            starts.push(count);
            count += list.len();
        }
        // Each task goes on in the list in which it was.
        let item = |list: &mut usize, i: usize| {
            if i < starts[*list] || starts[*list] + lists[*list].len() <= i {
                // The last list that starts there or before is not empty.
                *list = starts.partition_point(|&start| start <= i) - 1;
            }
            work(*list, &lists[*list][i - starts[*list]])
        };
        return (0..count).into_par_iter().map_init(|| 0, item).collect();
    }
    let mut all = Vec::with_capacity(lists.iter().map(|list| list.len()).sum());
    for (list, items) in lists.iter().enumerate() {
        all.extend(items.iter().map(|item| work(list, item)));
    }
    all
}

/// Overwrites each `target[i]` with `work(i)`.
pub fn fill_indexed<T: Send>(target: &mut [T], work: impl Fn(usize) -> T + Sync + Send) {
    #[cfg(feature = "parallel")]
    if target.len() > LEAST {
        let slots = target.par_iter_mut().enumerate().with_min_len(LEAST);
        return slots.for_each(|(i, slot)| *slot = work(i));
    }
    target.iter_mut().enumerate().for_each(|(i, slot)| *slot = work(i));
}

/// Cuts `target` where `ends` says that its parts end, and works on each of
/// them, given its number; results in their order. The last part ends where
/// `target` does.
pub fn map_parts<T: Send, R: Send>(
    target: &mut [T],
    ends: &[usize],
    work: impl Fn(usize, &mut [T]) -> R + Sync + Send,
) -> Vec<R> {
    let mut rest = target;
    let mut start = 0;
    let cut = |&end: &usize| {
        let (part, others) = std::mem::take(&mut rest).split_at_mut(end - start);
        (rest, start) = (others, end);
        part
    };
    let parts: Vec<&mut [T]> = ends.iter().map(cut).collect();
    let parts = parts.into_iter().enumerate();
    #[cfg(feature = "parallel")]
    let parts = parts.collect::<Vec<_>>().into_par_iter();
    parts.map(|(number, part)| work(number, part)).collect()
}

/// Sorts by an order in which no two are equal.
pub fn sort_by<T: Send>(list: &mut [T], order: impl Fn(&T, &T) -> std::cmp::Ordering + Sync) {
    #[cfg(feature = "parallel")]
    if list.len() > LEAST {
        return list.par_sort_unstable_by(order);
    }
    list.sort_unstable_by(order);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_joined_in_order_and_empty_ones_left_out() {
        let lists: [&[u32]; 5] = [&[], &[1, 2], &[], &[3], &[]];
        assert_eq!(concat_map(&lists, |list, item| (list, *item)), [(1, 1), (1, 2), (3, 3)]);
        assert!(concat_map(&[] as &[&[u32]], |_, item| *item).is_empty());
    }

    #[test]
    fn parts_of_any_length_are_worked_on_in_order() {
        let mut target = [0; 5];
        let lengths = map_parts(&mut target, &[0, 3, 3, 5], |number, part| {
            part.fill(number);
            part.len()
        });
        assert_eq!((lengths, target), (vec![0, 3, 0, 2], [1, 1, 1, 3, 3]));
    }
}
