//! Ends that fall together where lines were left out are joined.
//!
//! Where one of two lines is left out, what went on from it ends beside the
//! other one. If a stroke ends there too, the two are one stroke again: the
//! end is moved over if that cannot be seen, else a line as long as the way
//! between them is drawn. Nearer ends are joined first.

use super::filter::Filter;
use super::key;
use super::paths::compare_points;
use crate::run::map_chunks;
use glam::{DVec2, I64Vec2};
use rustc_hash::{FxHashMap, FxHashSet};

/// Ends are moved over so many reaches.
pub(super) const MOVED: f64 = 0.01;

/// Segments that one task looks through.
const PART: usize = 1 << 14;

/// Points at which lines were left out, and how far ends are joined, mm.
pub(in crate::drawing) struct Loose {
    points: FxHashSet<[u64; 2]>,
    filter: Filter,
    reach: f64,
}

impl Loose {
    pub(super) fn new(points: Vec<DVec2>, reach: f64) -> Self {
        let filter = Filter::new(points.iter().copied());
        Loose { points: points.into_iter().map(key).collect(), filter, reach }
    }

    /// How far ends are joined, mm.
    pub(in crate::drawing) fn reach(&self) -> f64 {
        self.reach
    }
}

/// Joins loose ends of segments of one layer. Segments of a length of
/// nothing are left out.
pub(in crate::drawing) fn join_ends(
    segments: &mut Vec<[DVec2; 2]>,
    runs: &mut Vec<u32>,
    loose: &Loose,
) {
    let odd = odd_ends(segments, loose);
    let mut moved: FxHashMap<[u64; 2], DVec2> = FxHashMap::default();
    let mut run = u32::MAX;
    for [one, other] in pairs(&odd, loose.reach) {
        if one.distance(other) <= MOVED * loose.reach {
            moved.insert(key(other), one);
        } else {
            segments.push([one, other]);
            runs.push(run);
            run -= 1;
        }
    }
    if moved.is_empty() {
        return;
    }
    for segment in segments.iter_mut() {
        for end in segment {
            if loose.filter.may_hold(*end) {
                *end = moved.get(&key(*end)).copied().unwrap_or(*end);
            }
        }
    }
    let mut kept = segments.iter().map(|segment| segment[0] != segment[1]);
    runs.retain(|_| kept.next().unwrap_or(true));
    segments.retain(|segment| segment[0] != segment[1]);
}

/// Loose points in which an odd number of segments ends, sorted.
fn odd_ends(segments: &[[DVec2; 2]], loose: &Loose) -> Vec<DVec2> {
    let found = map_chunks(segments.len(), PART, |part| {
        let ends = segments[part].iter().flatten().copied();
        let ends = ends.filter(|&end| loose.filter.may_hold(end));
        ends.filter(|&end| loose.points.contains(&key(end))).collect::<Vec<_>>()
    });
    let mut ends = found.concat();
    ends.sort_unstable_by(|a, b| compare_points(*a, *b));
    let odd = ends.chunk_by(|a, b| a == b).filter(|same| same.len() % 2 == 1);
    odd.map(|same| same[0]).collect()
}

/// Distances that differ by less than this part of the reach are the same:
/// where parallel lines end on one another there are many such, and no
/// rounding is to decide which ends are joined.
const SAME: f64 = 1e-6;

/// Pairs of points that are near each other, the nearest first and then in
/// the order of the points; no point is in two.
fn pairs(points: &[DVec2], reach: f64) -> Vec<[DVec2; 2]> {
    let cell = |point: DVec2| (point / reach).floor().as_i64vec2();
    let mut cells: FxHashMap<I64Vec2, Vec<u32>> = FxHashMap::default();
    let mut near: Vec<(f64, [u32; 2])> = Vec::new();
    for (number, &point) in (0..).zip(points) {
        let own = cell(point);
        for (column, row) in (-1..=1).flat_map(|column| (-1..=1).map(move |row| (column, row))) {
            for &other in cells.get(&(own + I64Vec2::new(column, row))).into_iter().flatten() {
                let apart = point.distance(points[other as usize]);
                if apart <= reach {
                    near.push(((apart / (SAME * reach)).round(), [other, number]));
                }
            }
        }
        cells.entry(own).or_default().push(number);
    }
    near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut taken = vec![false; points.len()];
    let mut pairs = Vec::new();
    for (_, pair) in near {
        let pair = pair.map(|point| point as usize);
        if pair.iter().all(|&point| !taken[point]) {
            pair.iter().for_each(|&point| taken[point] = true);
            pairs.push(pair.map(|point| points[point]));
        }
    }
    pairs
}
