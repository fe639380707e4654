//! Segments that meet become polylines.
//!
//! Every point where ends of segments coincide, bit for bit, is a joint. At
//! each joint the ends are paired, as many as can be (`joints` says which
//! with which), and a polyline follows the pairs from segment to segment. An
//! end stays single only where the number of ends at its joint is odd, so the
//! number of open polylines is half the number of odd joints, and no set of
//! strokes that covers the drawing once has fewer open ones (Euler, 1736).
//!
//! Pairing first and walking afterwards makes the set of polylines a matter
//! of geometry: the order of the segments decides only the order of the
//! strokes, their sense, and where a closed one begins. Ends are dealt into
//! buckets by the hash of their point; buckets are independent and run in
//! parallel. Everything but the sorting at crowded joints is linear.

use super::joints::Joints;
use super::{Strokes, is_closed};
use crate::run::{map_chunks, map_indexed};
use glam::DVec2;
use rustc_hash::{FxBuildHasher, FxHashMap};
use std::hash::BuildHasher;
use std::ops::Range;

/// No partner: the polyline ends here.
pub(super) const SINGLE: u32 = u32::MAX;

/// Joins `segments`, none of which may be a point, into polylines. Each
/// segment is part of exactly one stroke. Segments with the same number in
/// `runs`, which may be empty, lie on one straight line.
///
/// A joint of two segments on one straight line is no point of the polyline:
/// they are of one run, or the three points are collinear as they stand.
/// Where other polylines meet it there it is a point still if `junctions`
/// asks for those, as what is to be smoothed or ordered does.
pub(super) fn chain(segments: &[[DVec2; 2]], runs: &[u32], junctions: bool) -> Strokes {
    let place = |end| Some(key(point(segments, end)));
    let (partners, busy) = pair_ends(segments, place);
    let mut drawn = vec![false; segments.len()];
    let mut strokes = Strokes::default();
    let mut points = Vec::new();
    for segment in 0..segments.len() {
        if drawn[segment] {
            continue;
        }
        let mut end = first_end(&partners, segment);
        points.clear();
        points.push(point(segments, end));
        let first = end;
        loop {
            drawn[(end / 2) as usize] = true;
            points.push(point(segments, end ^ 1));
            let next = partners[(end ^ 1) as usize];
            if next != SINGLE && next != first && !(junctions && busy[next as usize]) {
                let far = point(segments, next ^ 1);
                if goes_straight_on(segments, runs, [end, next], &points, far) {
                    points.pop();
                }
            }
            match partners[(end ^ 1) as usize] {
                SINGLE => break,
                next if drawn[(next / 2) as usize] => break,
                next => end = next,
            }
        }
        if is_closed(&points) && !(junctions && busy[first as usize]) {
            // The same where a closed polyline happens to begin.
            let second = points[1];
            if 4 < points.len() && goes_straight_on(segments, runs, [end, first], &points, second) {
                points.remove(0);
                points.pop();
                points.push(second);
            }
        }
        strokes.push(points.iter().copied());
    }
    strokes
}

/// Whether the last of `points`, between the segments of two ends, is no
/// corner.
fn goes_straight_on(
    segments: &[[DVec2; 2]],
    runs: &[u32],
    [end, next]: [u32; 2],
    points: &[DVec2],
    far: DVec2,
) -> bool {
    let [.., before, joint] = points else { return false };
    let onward = 0.0 < (*joint - *before).dot(far - *joint);
    let run = |end: u32| runs.get((end / 2) as usize);
    debug_assert!(point(segments, next) == *joint);
    let same_run = run(end).is_some() && run(end) == run(next);
    let coord = |p: DVec2| robust::Coord { x: p.x, y: p.y };
    onward && (same_run || robust::orient2d(coord(*before), coord(*joint), coord(far)) == 0.0)
}

/// The end at which the polyline through `segment` begins, found by walking
/// backwards; that of the segment itself if the polyline is closed.
fn first_end(partners: &[u32], segment: usize) -> u32 {
    let own = 2 * segment as u32;
    let mut end = own;
    loop {
        match partners[end as usize] {
            SINGLE => return end,
            before if before ^ 1 == own => return own,
            before => end = before ^ 1,
        }
    }
}

/// For each segment the number of its polyline, and how many there are.
pub(super) fn stroke_numbers(partners: &[u32]) -> (Vec<u32>, usize) {
    let mut numbers = vec![SINGLE; partners.len() / 2];
    let mut count = 0;
    for segment in 0..numbers.len() {
        if numbers[segment] != SINGLE {
            continue;
        }
        let first = first_end(partners, segment);
        let mut end = first;
        loop {
            numbers[(end / 2) as usize] = count;
            match partners[(end ^ 1) as usize] {
                SINGLE => break,
                next if next == first => break,
                next => end = next,
            }
        }
        count += 1;
    }
    (numbers, count as usize)
}

/// For each end (2 i and 2 i + 1 are those of segment i) the end with which
/// its polyline goes on, and whether three ends or more meet where it is.
/// Ends meet that have the same `place`; those without one meet none.
pub(super) fn pair_ends<const K: usize>(
    segments: &[[DVec2; 2]],
    place: impl Fn(u32) -> Option<[u64; K]> + Sync + Send,
) -> (Vec<u32>, Vec<bool>) {
    let count = 2 * segments.len();
    let pairs = map_joints(count, place, |joined| pair_joined(segments, joined));
    let mut partners = vec![SINGLE; count];
    let mut busy = vec![false; count];
    for (pairs, crowded) in pairs {
        for [one, other] in pairs {
            partners[one as usize] = other;
            partners[other as usize] = one;
        }
        crowded.into_iter().for_each(|end| busy[end as usize] = true);
    }
    (partners, busy)
}

/// Finds the joints of `count` ends, which are those that have the same
/// `place`, and works on them, many at once. Results come in an order that
/// depends on the places alone.
pub(super) fn map_joints<const K: usize, T: Send>(
    count: usize,
    place: impl Fn(u32) -> Option<[u64; K]> + Sync + Send,
    work: impl Fn(&Joined) -> T + Sync + Send,
) -> Vec<T> {
    let buckets = (count / BUCKET).next_power_of_two();
    let parts = map_chunks(count, PART, |part| Dealt::new(&place, part, buckets));
    map_indexed(buckets, |bucket| {
        let ends: Vec<End<K>> =
            parts.iter().flat_map(|part| part.bucket(bucket)).copied().collect();
        work(&Joined::new(&ends))
    })
}

/// Ends per bucket, about: few enough to stay in the cache while their
/// joints are found.
const BUCKET: usize = 1 << 13;

/// Ends that one task deals into buckets.
const PART: usize = 1 << 16;

/// An end and where it lies.
#[derive(Debug, Clone, Copy)]
struct End<const K: usize> {
    key: [u64; K],
    number: u32,
}

/// Some of the ends, dealt into buckets by the hashes of their points.
struct Dealt<const K: usize> {
    ends: Vec<End<K>>,
    /// Where each bucket starts in `ends`, and where the last one stops.
    starts: Vec<u32>,
}

impl<const K: usize> Dealt<K> {
    fn new(place: impl Fn(u32) -> Option<[u64; K]>, part: Range<usize>, buckets: usize) -> Self {
        let bucket_of =
            |key: [u64; K]| (FxBuildHasher.hash_one(key) >> 32) as usize & (buckets - 1);
        let ends = part.filter_map(|number| {
            let number = number as u32;
            place(number).map(|key| End { key, number })
        });
        let mut starts = vec![0; buckets + 1];
        let ends: Vec<(usize, End<K>)> = ends.map(|end| (bucket_of(end.key), end)).collect();
        ends.iter().for_each(|(bucket, _)| starts[bucket + 1] += 1);
        let mut sum = 0;
        for start in &mut starts {
            sum += *start;
            *start = sum;
        }
        let mut fill = starts.clone();
        let mut dealt = vec![End { key: [0; K], number: 0 }; ends.len()];
        for (bucket, end) in ends {
            let slot = &mut fill[bucket];
            dealt[*slot as usize] = end;
            *slot += 1;
        }
        Dealt { ends: dealt, starts }
    }

    fn bucket(&self, bucket: usize) -> &[End<K>] {
        &self.ends[self.starts[bucket] as usize..self.starts[bucket + 1] as usize]
    }
}

/// Ends, joint by joint.
pub(super) struct Joined {
    ends: Vec<u32>,
    /// Where each joint starts in `ends`, and where the last one stops.
    starts: Vec<u32>,
}

impl Joined {
    /// Sorts the ends of one bucket, which holds all ends of each of its
    /// joints.
    fn new<const K: usize>(ends: &[End<K>]) -> Self {
        let (joint_of, starts) = find_joints(ends);
        // Counting sort of the ends by joint: `fill` runs ahead of `starts`.
        let mut fill = starts.clone();
        let mut sorted = vec![0; ends.len()];
        for (end, joint) in ends.iter().zip(joint_of) {
            let slot = &mut fill[joint as usize];
            sorted[*slot as usize] = end.number;
            *slot += 1;
        }
        Joined { ends: sorted, starts }
    }

    /// The ends of each joint, ascending.
    pub(super) fn joints(&self) -> impl Iterator<Item = &[u32]> {
        self.starts.windows(2).map(|bounds| &self.ends[bounds[0] as usize..bounds[1] as usize])
    }
}

/// Pairs the ends of some joints. Beside the pairs, the ends at joints of
/// three or more.
fn pair_joined(segments: &[[DVec2; 2]], joined: &Joined) -> (Vec<[u32; 2]>, Vec<u32>) {
    let mut pairs = Vec::with_capacity(joined.ends.len() / 2);
    let mut crowded = Vec::new();
    let mut joints = Joints::default();
    for ends in joined.joints() {
        match ends {
            [_] => {}
            [one, other] => pairs.push([*one, *other]),
            crowd => {
                crowded.extend_from_slice(crowd);
                joints.pair(segments, crowd, &mut pairs);
            }
        }
    }
    (pairs, crowded)
}

/// The joint of each of some ends, and where each joint's ends start if the
/// ends are sorted by joint. Joints are numbered as they first appear.
fn find_joints<const K: usize>(ends: &[End<K>]) -> (Vec<u32>, Vec<u32>) {
    let mut known: FxHashMap<[u64; K], u32> = FxHashMap::default();
    known.reserve(ends.len() / 2);
    let mut joint_of = Vec::with_capacity(ends.len());
    let mut degrees: Vec<u32> = Vec::new();
    for end in ends {
        let joint = *known.entry(end.key).or_insert(degrees.len() as u32);
        if joint as usize == degrees.len() {
            degrees.push(0);
        }
        degrees[joint as usize] += 1;
        joint_of.push(joint);
    }
    let mut starts = Vec::with_capacity(degrees.len() + 1);
    let mut start = 0;
    for degree in &degrees {
        starts.push(start);
        start += degree;
    }
    starts.push(start);
    (joint_of, starts)
}

/// Equal for equal points: page coordinates are never -0.
fn key(point: DVec2) -> [u64; 2] {
    [point.x.to_bits(), point.y.to_bits()]
}

/// Where an end lies.
pub(super) fn point(segments: &[[DVec2; 2]], end: u32) -> DVec2 {
    segments[(end / 2) as usize][(end % 2) as usize]
}

#[cfg(test)]
mod tests;
