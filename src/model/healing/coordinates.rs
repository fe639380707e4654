//! Faces across an axis: flat, and in one plane where they touch.
//!
//! What is drawn square to the axes lies in planes that doubles can express:
//! one coordinate is the same at all corners. Where it is not quite, or where
//! two such faces touch and theirs differ by less than the tolerance, one
//! number stands for all, at all vertices that have one of them, so that what
//! was one plane stays one plane exactly. The number that most places have is
//! kept. A slope is left alone, however slight, for then the numbers that hang
//! together differ by more.

use super::Tolerance;
use super::net::{Net, Rings};
use crate::model::components::{join, root};
use crate::run::{Run, map_chunks};
use crate::spatial::{Bounds, Hierarchy, Rounding};
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

/// A plane across an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
struct Level {
    axis: u8,
    /// The coordinate, in the order of numbers.
    key: i64,
}

impl Level {
    fn new(axis: usize, coordinate: f64) -> Self {
        // As the total order of floats has it.
        let bits = (coordinate + 0.0).to_bits() as i64;
        Level { axis: axis as u8, key: bits ^ (((bits >> 63) as u64) >> 1) as i64 }
    }

    fn axis(self) -> usize {
        self.axis.into()
    }

    fn coordinate(self) -> f64 {
        f64::from_bits((self.key ^ (((self.key >> 63) as u64) >> 1) as i64) as u64)
    }
}

/// Vertices that one task looks at.
const PART: usize = 1 << 14;

/// The axes across which a face lies exactly, as bits.
fn axes_across(net: &Net<'_>, rings: &Rings) -> u8 {
    let [first, others @ ..] = &*rings.corners else { return 0 };
    let first = net.at(*first);
    let same = |bits: u8, &corner: &u32| bits & first.cmpeq(net.at(corner)).bitmask() as u8;
    others.iter().fold(0b111, same)
}

/// Which coordinates of each place belong to a plane, as bits by axis: those
/// that a move would bend a face by.
pub(super) fn locks(net: &Net<'_>) -> Vec<u8> {
    let parts = net.map_faces(Vec::new, |found: &mut Vec<(u32, u8)>, _, rings| {
        let across = axes_across(net, rings);
        if across != 0 {
            found.extend(rings.corners.iter().map(|&place| (place, across)));
        }
    });
    let mut locks = vec![0; net.first.len()];
    parts.iter().flatten().for_each(|&(place, across)| locks[place as usize] |= across);
    locks
}

/// Brings planes together; whether a place was moved.
pub(super) fn align(net: &mut Net<'_>, tolerance: Tolerance, run: &Run<'_>) -> bool {
    let parts = net.map_faces(Default::default, |found: &mut Found, _, rings| {
        if let Some(face) = FlatFace::of(net, rings, tolerance) {
            found.add(net, &face, rings);
        }
    });
    let mut found = Found::default();
    for part in parts {
        found.levels.extend(part.levels);
        found.links.extend(part.links);
    }
    let mut levels: Vec<Level> = found.levels.into_iter().collect();
    levels.sort_unstable();
    let reach = tolerance.distance();
    let close = |pair: &[Level; 2]| {
        pair[0].axis == pair[1].axis && pair[1].coordinate() - pair[0].coordinate() <= reach
    };
    let suspects: FxHashSet<Level> =
        levels.array_windows().filter(|pair| close(pair)).flatten().copied().collect();
    if suspects.is_empty() || run.is_stopped() {
        return false;
    }
    let mut links = touching(net, &suspects, tolerance, run);
    links.extend(found.links);
    links.sort_unstable();
    links.dedup();
    let moves = moves(net, &classes(&links), reach);
    apply(net, &moves, tolerance)
}

/// What all faces say.
#[derive(Default)]
struct Found {
    /// Planes in which there are corners of a face across their axis.
    levels: FxHashSet<Level>,
    /// Planes that meet in such a face, which is then not quite across it.
    links: FxHashSet<[Level; 2]>,
}

impl Found {
    fn add(&mut self, net: &Net<'_>, face: &FlatFace, rings: &Rings) {
        let level = |&corner: &u32| Level::new(face.axis, net.at(corner)[face.axis]);
        self.levels.insert(face.level);
        for other in rings.corners.iter().map(level).filter(|other| *other != face.level) {
            self.levels.insert(other);
            self.links.insert([face.level, other]);
        }
    }
}

/// A face across an axis, exactly or within the tolerance.
#[derive(Debug, Clone, Copy)]
struct FlatFace {
    axis: usize,
    /// The lowest of its corners' planes.
    level: Level,
    /// Its box.
    low: DVec3,
    high: DVec3,
}

/// A face less than so many tolerances wide has no axis that it is across of.
const LEAST_WIDTH: f64 = 16.0;

impl FlatFace {
    fn of(net: &Net<'_>, rings: &Rings, tolerance: Tolerance) -> Option<Self> {
        let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let corners = rings.corners.iter().map(|&corner| net.at(corner));
        let (low, high) = corners.fold(empty, |(low, high), p| (low.min(p), high.max(p)));
        let size = high - low;
        let flat = size.cmple(DVec3::splat(tolerance.distance())).bitmask();
        let wide = size.cmpge(DVec3::splat(LEAST_WIDTH * tolerance.distance())).bitmask();
        if !flat.is_power_of_two() || (flat | wide) != 0b111 {
            return None;
        }
        let axis = flat.trailing_zeros() as usize;
        Some(FlatFace { axis, level: Level::new(axis, low[axis]), low, high })
    }
}

/// Planes of faces that touch.
fn touching(
    net: &Net<'_>,
    suspects: &FxHashSet<Level>,
    tolerance: Tolerance,
    run: &Run<'_>,
) -> Vec<[Level; 2]> {
    let parts = net.map_faces(Vec::new, |found: &mut Vec<FlatFace>, _, rings| {
        let face = FlatFace::of(net, rings, tolerance);
        found.extend(face.filter(|face| suspects.contains(&face.level)));
    });
    let faces = parts.concat();
    let boxes: Vec<[DVec3; 2]> = faces.iter().map(|face| [face.low, face.high]).collect();
    let (_, hierarchy) = hierarchy(&boxes, tolerance);
    let reach = DVec3::splat(tolerance.distance());
    let found = hierarchy.overlapping_pairs(run, FxHashSet::default, |found, a, b| {
        let [a, b] = [a, b].map(|face| &faces[face as usize]);
        let touch = (a.low - reach).cmple(b.high) & (b.low - reach).cmple(a.high);
        if a.axis == b.axis && a.level != b.level && touch.all() {
            found.insert([a.level.min(b.level), a.level.max(b.level)]);
        }
    });
    found.into_iter().flatten().collect()
}

/// Boxes wide enough to find what is within the tolerance, and how boxes that
/// are held against them are rounded.
pub(super) fn hierarchy(boxes: &[[DVec3; 2]], tolerance: Tolerance) -> (Rounding, Hierarchy) {
    let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let all = boxes.iter().fold(empty, |[low, high], &[l, h]| [low.min(l), high.max(h)]);
    let rounding = Rounding::for_ranges([0, 1, 2].map(|axis| all[0][axis]..all[1][axis]));
    let reach = DVec3::splat(tolerance.distance());
    let bounds: Vec<Bounds> =
        boxes.iter().map(|&[low, high]| rounding.around(low - reach, high + reach)).collect();
    (rounding, Hierarchy::new(&bounds))
}

/// Items that hang together by pairs, which are sorted.
fn classes<T: Copy + Ord>(pairs: &[[T; 2]]) -> Vec<Vec<T>> {
    let mut items: Vec<T> = pairs.iter().flatten().copied().collect();
    items.sort_unstable();
    items.dedup();
    let place = |item: &T| items.binary_search(item).unwrap_or(0) as u32;
    let mut parents: Vec<u32> = (0..items.len() as u32).collect();
    for pair in pairs {
        join(&mut parents, pair.map(|item| place(&item)));
    }
    let mut members: FxHashMap<u32, Vec<T>> = FxHashMap::default();
    for (number, &item) in (0..).zip(&items) {
        members.entry(root(&mut parents, number)).or_default().push(item);
    }
    let mut classes: Vec<Vec<T>> = members.into_values().collect();
    classes.sort_unstable();
    classes
}

/// Which plane goes to which, the smallest way first.
fn moves(net: &Net<'_>, groups: &[Vec<Level>], reach: f64) -> Vec<[Level; 2]> {
    let counts = count_places(net, &groups.iter().flatten().copied().collect());
    let mut moves = Vec::new();
    for group in groups {
        // Groups are sorted. Of one that is deeper than the tolerance, which
        // may be a slope in small steps, nothing is known.
        let [low, high] = [group[0], group[group.len() - 1]].map(Level::coordinate);
        let reaches_all = |level: &&Level| {
            let coordinate = level.coordinate();
            coordinate - low <= reach && high - coordinate <= reach
        };
        let rank = |a: &Level, b: &Level| {
            let [x, y] = [a, b].map(|level| level.coordinate());
            (counts[b].cmp(&counts[a])).then(x.abs().total_cmp(&y.abs())).then(x.total_cmp(&y))
        };
        if let Some(kept) = group.iter().filter(reaches_all).min_by(|a, b| rank(a, b)) {
            moves.extend(group.iter().filter(|level| *level != kept).map(|&level| [level, *kept]));
        }
    }
    let way = |[from, to]: &[Level; 2]| (to.coordinate() - from.coordinate()).abs();
    moves.sort_by(|a, b| way(a).total_cmp(&way(b)).then(a.cmp(b)));
    moves
}

/// How many places lie in each of some planes.
fn count_places(net: &Net<'_>, wanted: &FxHashSet<Level>) -> FxHashMap<Level, usize> {
    let parts = map_chunks(net.first.len(), PART, |part| {
        let mut counts: FxHashMap<Level, usize> = FxHashMap::default();
        for place in part.map(|vertex| vertex as u32).filter(|&vertex| net.is_place(vertex)) {
            let levels = (0..3).map(|axis| Level::new(axis, net.at(place)[axis]));
            levels.filter(|level| wanted.contains(level)).for_each(|level| {
                *counts.entry(level).or_default() += 1;
            });
        }
        counts
    });
    let mut counts: FxHashMap<Level, usize> = wanted.iter().map(|&level| (level, 0)).collect();
    parts
        .into_iter()
        .flatten()
        .for_each(|(level, count)| *counts.entry(level).or_default() += count);
    counts
}

/// Moves all places of a plane or none.
fn apply(net: &mut Net<'_>, moves: &[[Level; 2]], tolerance: Tolerance) -> bool {
    let target: FxHashMap<Level, Level> = moves.iter().map(|&[from, to]| (from, to)).collect();
    let mut places: FxHashMap<Level, Vec<u32>> = FxHashMap::default();
    for place in (0..net.first.len() as u32).filter(|&vertex| net.is_place(vertex)) {
        let levels = (0..3).map(|axis| Level::new(axis, net.at(place)[axis]));
        levels.filter(|level| target.contains_key(level)).for_each(|level| {
            places.entry(level).or_default().push(place);
        });
    }
    let mut moved = false;
    for [from, to] in moves {
        let there = |place: u32| {
            let mut position = net.at(place);
            position[from.axis()] = to.coordinate();
            (place, position)
        };
        let all: Vec<(u32, DVec3)> =
            places.get(from).into_iter().flatten().map(|&place| there(place)).collect();
        if all.iter().all(|&(place, position)| net.allows(place, position, tolerance)) {
            all.into_iter().for_each(|(place, position)| net.put(place, position));
            moved = true;
        }
    }
    moved
}
