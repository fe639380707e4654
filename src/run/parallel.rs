//! Loops over many independent pieces of work, on all cores where the
//! feature `parallel` is on and one after the other where it is not.
//!
//! Results come back in the order of the input whatever the number of
//! threads, so nothing that is built from them can depend on it.
//!
//! What is to be done is handed to the scheduler as `&dyn Fn`: it is compiled
//! once for each type of result, not once for each loop of the crate, and
//! holds no copies of their bodies. That spares a quarter of all that would be
//! compiled; a call costs a few nanoseconds.

use std::sync::{Mutex, PoisonError};

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
        return scheduled(count, 1, &work);
    }
    (0..count).map(work).collect()
}

/// The same for work that is small.
pub fn map_small<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    #[cfg(feature = "parallel")]
    if count > LEAST {
        return scheduled(count, LEAST, &work);
    }
    (0..count).map(work).collect()
}

/// The results of work on all cores, at least so many pieces done by one.
#[cfg(feature = "parallel")]
fn scheduled<T: Send>(count: usize, least: usize, work: &(dyn Fn(usize) -> T + Sync)) -> Vec<T> {
    let mut results = Vec::new();
    (0..count).into_par_iter().with_min_len(least).map(work).collect_into_vec(&mut results);
    results
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
        return scheduled_with_place(count, &item);
    }
    let mut all = Vec::with_capacity(lists.iter().map(|list| list.len()).sum());
    for (list, items) in lists.iter().enumerate() {
        all.extend(items.iter().map(|item| work(list, item)));
    }
    all
}

/// Joins lists as [`concat_map`] and gives their memory back, for what is
/// joined next.
pub fn join_lists<S: Sync, T: Send>(
    lists: Vec<Vec<S>>,
    work: impl Fn(usize, &S) -> T + Sync + Send,
) -> Vec<T> {
    let lists_of: Vec<&[S]> = lists.iter().map(|list| &list[..]).collect();
    concat_map(&lists_of, work)
}

/// The results of work that remembers where it was.
#[cfg(feature = "parallel")]
fn scheduled_with_place<T: Send>(
    count: usize,
    work: &(dyn Fn(&mut usize, usize) -> T + Sync),
) -> Vec<T> {
    let mut results = Vec::new();
    (0..count).into_par_iter().map_init(usize::default, work).collect_into_vec(&mut results);
    results
}

/// Overwrites each `target[i]` with `work(i)`.
pub fn fill_indexed<T: Send>(target: &mut [T], work: impl Fn(usize) -> T + Sync + Send) {
    let fill = |start: usize, part: &mut [T]| {
        part.iter_mut().zip(start..).for_each(|(slot, i)| *slot = work(i));
    };
    #[cfg(feature = "parallel")]
    if target.len() > LEAST {
        return scheduled_in_place(target, &fill);
    }
    fill(0, target);
}

/// Work on all parts of a list, told where each starts.
#[cfg(feature = "parallel")]
fn scheduled_in_place<T: Send>(target: &mut [T], work: &(dyn Fn(usize, &mut [T]) + Sync)) {
    let parts = target.par_chunks_mut(LEAST).enumerate();
    parts.for_each(|(part, slots)| work(part * LEAST, slots));
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
    // Nobody waits for a lock: each part is worked on once.
    let parts: Vec<Mutex<&mut [T]>> = ends.iter().map(cut).map(Mutex::new).collect();
    map_indexed(parts.len(), |number| {
        let mut part = parts[number].lock().unwrap_or_else(PoisonError::into_inner);
        work(number, &mut part)
    })
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
