//! Outlines that cross themselves made to touch themselves instead.
//!
//! A polygon is made of its own corners, and where two of its edges cross it
//! has none. It gets one there: both edges run through it from then on, and
//! [`super::triangulate_along`] takes the result as it takes any outline that
//! visits a corner twice. This changes a model, and is done before anything is
//! decided about it: the new corner is the crossing rounded to doubles. Rounding
//! bends both edges by a unit in the last place and may make them cross others;
//! so crossings are looked for again until there are none, as in snap rounding
//! (Hobby 1999). Where edges pass one another at different heights, as those of
//! a polygon that is not planar may, the corner is half way between them.

use super::triangulation::{Outline, Projection};
use crate::kernel::predicates::{crossing_parameter, orientation};
use crate::run::{Run, Silent};
use crate::spatial::{Hierarchy, Rounding};
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// A polygon with corners where its edges crossed.
#[derive(Debug, Clone, PartialEq)]
pub struct Uncrossed {
    /// The rings. Corners are numbered through all rings as they were;
    /// larger numbers are new corners.
    pub rings: Vec<Vec<u32>>,
    /// The new corners, all of them in different places, none in that of a
    /// corner of old.
    pub added: Vec<DVec3>,
    /// The axis along which no edges cross any more.
    pub axis: usize,
}

/// How often rounded crossings are looked through for crossings.
const MOST_ROUNDS: usize = 64;

/// Crossings beyond which an outline is taken to be no outline at all.
const MOST_CROSSINGS: usize = 1 << 20;

/// Makes corners of the crossings of a polygon's edges, as it shows along the
/// axis in which it is largest. Depends on where the corners are alone. Nothing
/// if it has no area, there is no end to it, or the run is stopped. Expected
/// O((n + k) log n) for k crossings.
pub fn uncross<R: AsRef<[DVec3]>>(rings: &[R], run: &Run<'_>) -> Option<Uncrossed> {
    let corners: Vec<DVec3> = rings.iter().flat_map(|ring| ring.as_ref()).copied().collect();
    let (_, axis) = Projection::along_best_axis(&corners, rings.first()?.as_ref().len())?;
    let mut polygon = Polygon::new(rings, corners, axis);
    let mut crossings = 0;
    for _ in 0..MOST_ROUNDS {
        let cuts = polygon.cuts(run)?;
        if cuts.is_empty() {
            let added = polygon.corners.split_off(polygon.given);
            return Some(Uncrossed { rings: polygon.rings, added, axis });
        }
        crossings += cuts.len() / 2;
        if crossings > MOST_CROSSINGS {
            return None;
        }
        polygon.insert(&cuts);
    }
    None
}

/// A polygon that gets more and more corners.
struct Polygon {
    axis: usize,
    corners: Vec<DVec3>,
    /// How many of the corners it had.
    given: usize,
    rings: Vec<Vec<u32>>,
    /// The first corner at each place of the projection.
    at: FxHashMap<[u64; 2], u32>,
}

/// A new corner on an edge.
struct EdgeCut {
    /// The ends of the edge, the one further to the left first.
    ends: [u32; 2],
    /// How far along it the corner is.
    parameter: f64,
    corner: u32,
}

impl Polygon {
    fn new<R: AsRef<[DVec3]>>(rings: &[R], corners: Vec<DVec3>, axis: usize) -> Self {
        let mut first = 0;
        let mut numbers = Vec::with_capacity(rings.len());
        for ring in rings {
            let end = first + ring.as_ref().len() as u32;
            numbers.push((first..end).collect());
            first = end;
        }
        let given = corners.len();
        let mut polygon =
            Polygon { axis, corners, given, rings: numbers, at: FxHashMap::default() };
        for corner in 0..given as u32 {
            let key = polygon.key(polygon.corners[corner as usize]);
            polygon.at.entry(key).or_insert(corner);
        }
        polygon
    }

    fn flat(&self, p: DVec3) -> DVec2 {
        DVec2::new(p[(self.axis + 1) % 3], p[(self.axis + 2) % 3]) + DVec2::ZERO
    }

    /// The bits of a place in the projection.
    fn key(&self, p: DVec3) -> [u64; 2] {
        self.flat(p).to_array().map(f64::to_bits)
    }

    /// Where the edges cross that bound something; nothing if corners fall
    /// together in the projection.
    fn cuts(&mut self, run: &Run<'_>) -> Option<Vec<EdgeCut>> {
        let place = |&corner: &u32| self.corners[corner as usize];
        let rings: Vec<Vec<DVec3>> =
            self.rings.iter().map(|ring| ring.iter().map(place).collect()).collect();
        let all = rings.concat();
        let projection = Projection::along_axis(&all, rings[0].len(), self.axis)?;
        let outline = Outline::new(&rings, &all, &projection).ok()?;
        let numbers = self.rings.concat();
        let number = |point: u32| numbers[outline.corners[point as usize] as usize];
        let pairs = crossing_pairs(&outline, run)?;
        let ends = |edge: u32| outline.edges[edge as usize].ends.map(number);
        Some(pairs.iter().flat_map(|pair| self.cut(pair.map(ends))).collect())
    }

    /// The corner at the crossing of two edges, as it is on each of them.
    fn cut(&mut self, edges: [[u32; 2]; 2]) -> [EdgeCut; 2] {
        let [ab, cd] = edges.map(|ends| ends.map(|corner| self.corners[corner as usize]));
        let [flat_ab, flat_cd] = [ab, cd].map(|ends| ends.map(|p| self.flat(p)));
        let parameters =
            [crossing_parameter(flat_ab, flat_cd), crossing_parameter(flat_cd, flat_ab)];
        let mut place = between(ab, parameters[0]);
        let other = between(cd, parameters[1]);
        if place[self.axis] != other[self.axis] {
            place[self.axis] = place[self.axis] * 0.5 + other[self.axis] * 0.5;
        }
        let next = self.corners.len() as u32;
        let key = self.key(place);
        let corner = *self.at.entry(key).or_insert(next);
        if corner == next {
            self.corners.push(place);
        }
        [0, 1].map(|i| EdgeCut { ends: edges[i], parameter: parameters[i], corner })
    }

    /// Leads the rings through new corners.
    fn insert(&mut self, cuts: &[EdgeCut]) {
        let mut along: FxHashMap<[u32; 2], Vec<&EdgeCut>> = FxHashMap::default();
        for cut in cuts.iter().filter(|cut| !cut.ends.contains(&cut.corner)) {
            along.entry(cut.ends).or_default().push(cut);
        }
        for cuts in along.values_mut() {
            cuts.sort_by(|a, b| a.parameter.total_cmp(&b.parameter).then(a.corner.cmp(&b.corner)));
            cuts.dedup_by_key(|cut| cut.corner);
        }
        let first_at = |corner: u32| self.at[&self.key(self.corners[corner as usize])];
        let longer = |ring: &Vec<u32>| {
            let mut longer = Vec::with_capacity(ring.len());
            for (&from, &to) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                longer.push(from);
                let [from, to] = [from, to].map(first_at);
                let corners = |ends| along.get(&ends).into_iter().flatten().map(|cut| cut.corner);
                longer.extend(corners([from, to]));
                longer.extend(corners([to, from]).collect::<Vec<_>>().into_iter().rev());
            }
            longer
        };
        self.rings = self.rings.iter().map(longer).collect();
    }
}

/// The place on an edge that divides it, between its ends in each coordinate.
fn between([a, b]: [DVec3; 2], parameter: f64) -> DVec3 {
    let place = a * (1.0 - parameter) + b * parameter;
    place.clamp(a.min(b), a.max(b))
}

/// The pairs of edges that cross at a point inside of both, ascending.
fn crossing_pairs(outline: &Outline, run: &Run<'_>) -> Option<Vec<[u32; 2]>> {
    let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (low, high) =
        outline.points.iter().fold(empty, |(low, high), &p| (low.min(p), high.max(p)));
    let rounding = Rounding::for_ranges([low.x..high.x, low.y..high.y, 0.0..1.0]);
    let ends = |edge: u32| outline.edges[edge as usize].ends;
    let points = |edge: u32| ends(edge).map(|point| outline.points[point as usize]);
    let boxes: Vec<_> = (0..outline.edges.len() as u32)
        .map(|edge| {
            let [a, b] = points(edge);
            rounding.around(a.min(b).extend(0.0), a.max(b).extend(0.0))
        })
        .collect();
    let cross = |edge: u32, other: u32| {
        let ([a, b], [c, d]) = (points(edge), points(other));
        orientation(a, b, c).is_opposite(orientation(a, b, d))
            && orientation(c, d, a).is_opposite(orientation(c, d, b))
    };
    let (count, too_many) = (AtomicUsize::new(0), AtomicBool::new(false));
    let search = Run::new(&Silent).with_cancel(&too_many);
    let found = Hierarchy::new(&boxes).overlapping_pairs(&search, Vec::new, |pairs, a, b| {
        if cross(a, b) {
            pairs.push([a.min(b), a.max(b)]);
            let number = count.fetch_add(1, Ordering::Relaxed);
            if number > MOST_CROSSINGS || run.is_stopped() {
                too_many.store(true, Ordering::Relaxed);
            }
        }
    });
    let mut pairs = found.concat();
    pairs.sort_unstable();
    (!search.is_stopped()).then_some(pairs)
}
