//! Crossings with plates, whose triangles lie side by side in one plane.
//!
//! Pairs of one plate need no look. A triangle or a plate that does not reach
//! into a plate's plane has nothing to do with any of its triangles, and one
//! that ends in the plane at vertices and edges of the plate itself only has
//! what it shares. Two plates that pass through one another do so along the
//! common line of their planes: each triangle has one interval of it, and those
//! that overlap are looked at. Intervals are rounded outward.
//!
//! O(n log n) for n triangles, beside the pairs that are looked at.

use super::pair::{Search, straddles};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Estimate, Policy};
use crate::model::Mesh;
use crate::model::plates::{Plate, Plates};
use crate::model::world_boxes::WorldBoxes;
use crate::run::{Run, map_indexed};
use crate::spatial::Hierarchy;

/// What plates have in common with one another and with all other triangles,
/// which are in the hierarchy.
pub(super) fn add_plates<'p, P: Policy>(
    mesh: &Mesh,
    plates: &Plates<'_>,
    others: &Hierarchy,
    start: impl Fn() -> Search<'p, P> + Sync + Send,
    run: &Run<'_>,
) -> Vec<Search<'p, P>> {
    let (all, boxes) = (plates.all(), plates.boxes());
    let hierarchies = map_indexed(all.len(), |i| boxes.hierarchy(all[i].triangles.clone()));
    map_indexed(all.len(), |i| {
        let mut search = start();
        let mut near = Vec::new();
        others.visit(|group| group.overlapping(&all[i].bounds), |other| near.push(other));
        for triangle in near.into_iter().take_while(|_| !run.is_stopped()) {
            if search.reaches_into((plates, i), triangle) {
                let around = boxes.around(&mesh.triangles()[triangle as usize]);
                hierarchies[i].visit(
                    |group| group.overlapping(&around),
                    |other| search.add_pair([triangle.min(other), triangle.max(other)]),
                );
            }
        }
        for j in i + 1..all.len() {
            if all[i].bounds.overlaps(&all[j].bounds) && !run.is_stopped() {
                search.add_pair_of_plates(plates, [i, j]);
            }
        }
        run.advance(all[i].triangles.len() as u64);
        search
    })
}

/// What a triangle has of a line, about, along an axis.
struct Interval {
    low: f64,
    high: f64,
    triangle: u32,
    /// Whether that is a corner, and no more.
    is_corner: bool,
}

impl<P: Policy> Search<'_, P> {
    /// Whether a triangle may have more in common with triangles of a plate
    /// than vertices and edges.
    fn reaches_into(&self, (plates, index): (&Plates<'_>, usize), triangle: u32) -> bool {
        let plate = &plates.all()[index];
        let corners = self.mesh.triangles()[triangle as usize];
        let signs = corners.map(|corner| self.side_of_plate(plate, corner));
        if straddles(signs) {
            return true;
        }
        let within = |i: &usize| signs[*i].is_zero();
        let within: Vec<u32> = (0..3).filter(within).map(|i| corners[i]).collect();
        match within[..] {
            [] => false,
            [vertex] => !plate.has_vertex(vertex),
            [a, b] => !plates.has_edge(self.mesh, index, [a, b]),
            _ => true,
        }
    }

    /// On which side of a plate's plane a vertex lies; its own by name.
    fn side_of_plate(&self, plate: &Plate, vertex: u32) -> Sign {
        match plate.face.contains(&vertex) || plate.has_vertex(vertex) {
            true => Sign::Zero,
            false => self.predicates.plane(plate.face, vertex),
        }
    }

    /// Adds what two plates have in common.
    fn add_pair_of_plates(&mut self, plates: &Plates<'_>, pair: [usize; 2]) {
        let mut intervals = [Vec::new(), Vec::new()];
        let axis = self.axis_along(pair.map(|i| plates.all()[i].face));
        for (own, other) in [(0, 1), (1, 0)] {
            let (plate, against) = (&plates.all()[pair[own]], &plates.all()[pair[other]]);
            let side = |&vertex: &u32| self.side_of_plate(against, vertex);
            let signs: Vec<Sign> = plate.vertices.iter().map(side).collect();
            self.add_touching_of_plate(plate, &signs, against, plates.boxes());
            let is_aside = !signs.contains(&Sign::Negative) || !signs.contains(&Sign::Positive);
            if is_aside && !signs.contains(&Sign::Zero) {
                return;
            }
            for &triangle in &plate.triangles {
                let corners = self.mesh.triangles()[triangle as usize];
                let signs = corners.map(|corner| {
                    plate.vertices.binary_search(&corner).map_or(Sign::Zero, |place| signs[place])
                });
                intervals[own].extend(self.interval(triangle, signs, against, axis));
            }
        }
        let [first, second] = intervals;
        overlaps(first, second, |s, t| self.add_pair([s.min(t), s.max(t)]));
    }

    /// Notes the vertices of a plate that lie in the plane of another, near it
    /// and no vertices of it, as if they lay on it: what is known of them is of
    /// no use then, and that is all.
    fn add_touching_of_plate(
        &mut self,
        plate: &Plate,
        signs: &[Sign],
        other: &Plate,
        boxes: &WorldBoxes<'_>,
    ) {
        if self.known.fans.is_none() {
            return;
        }
        for (&vertex, sign) in plate.vertices.iter().zip(signs) {
            let near = || boxes.around(&[vertex]).overlaps(&other.bounds);
            if sign.is_zero() && !other.has_vertex(vertex) && near() {
                self.touching.push(vertex);
            }
        }
    }

    /// The axis along which the common line of two planes is longest, about.
    fn axis_along(&self, faces: [[u32; 3]; 2]) -> usize {
        let at = |vertex: u32| self.mesh.vertices()[vertex as usize];
        let [m, n] = faces.map(|[a, b, c]| {
            let normal = (at(b) - at(a)).cross(at(c) - at(a));
            normal / normal.abs().max_element()
        });
        let [x, y, z] = m.cross(n).abs().to_array();
        if x >= y && x >= z { 0 } else { 1 + usize::from(z > y) }
    }

    /// What a triangle of one plate has of the plane of another, along an axis,
    /// if that is more than a vertex of both. `signs` are those of its corners
    /// against the plane.
    fn interval(
        &self,
        triangle: u32,
        signs: [Sign; 3],
        other: &Plate,
        axis: usize,
    ) -> Option<Interval> {
        let corners = self.mesh.triangles()[triangle as usize];
        let at = |i: usize| self.mesh.vertices()[corners[i] as usize][axis];
        let within: Vec<usize> = (0..3).filter(|&i| signs[i].is_zero()).collect();
        let is_corner = match within[..] {
            _ if straddles(signs) => false,
            // An edge of the other plate may go through a corner.
            [i] if !other.has_vertex(corners[i]) => true,
            [_, _] => false,
            _ => return None,
        };
        let (low, high) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut interval = Interval { low, high, triangle, is_corner };
        let mut add = |low: f64, high: f64| {
            interval.low = interval.low.min(low);
            interval.high = interval.high.max(high);
        };
        for i in 0..3 {
            let j = (i + 1) % 3;
            if signs[i].is_zero() {
                add(at(i), at(i));
            } else if signs[i].is_opposite(signs[j]) {
                let estimate = |i: usize| self.predicates.plane_estimate(other.face, corners[i]);
                let shares = shares([estimate(i), estimate(j)]);
                let (from, to) = (at(i), at(j));
                let slack = 8.0 * f64::EPSILON * (from.abs() + to.abs());
                for share in shares {
                    let place = from + (to - from) * share;
                    add(place - slack, place + slack);
                }
            }
        }
        Some(interval)
    }
}

/// Between which shares of the way from one vertex to another a plane is met,
/// given how far off it they are, about, on either side.
fn shares([from, to]: [Estimate; 2]) -> [f64; 2] {
    let range = |estimate: Estimate| {
        let distance = estimate.value.abs();
        [(distance - estimate.bound).max(0.0), distance + estimate.bound]
    };
    let ([a_low, a_high], [b_low, b_high]) = (range(from), range(to));
    let share = |a: f64, b: f64| a / (a + b);
    let (low, high) = (share(a_low, b_high), share(a_high, b_low));
    // What is unbounded is not known.
    let margin = 4.0 * f64::EPSILON;
    [if low.is_nan() { 0.0 } else { low - margin }, if high.is_nan() { 1.0 } else { high + margin }]
}

/// Calls `found` with the triangles of all intervals, one from each list, that
/// overlap and are not both corners. O(n log n + pairs).
fn overlaps(first: Vec<Interval>, second: Vec<Interval>, mut found: impl FnMut(u32, u32)) {
    let mut all: Vec<(Interval, usize)> = Vec::with_capacity(first.len() + second.len());
    all.extend(first.into_iter().map(|interval| (interval, 0)));
    all.extend(second.into_iter().map(|interval| (interval, 1)));
    all.sort_by(|(a, _), (b, _)| a.low.total_cmp(&b.low));
    // Of each list those that are corners, and the others.
    let mut active: [[Vec<Interval>; 2]; 2] = Default::default();
    for (interval, list) in all {
        for others in &mut active[1 - list][usize::from(interval.is_corner)..] {
            others.retain(|other| interval.low <= other.high);
            others.iter().for_each(|other| found(interval.triangle, other.triangle));
        }
        active[list][usize::from(!interval.is_corner)].push(interval);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn intervals_overlap_if_they_have_a_point_in_common(
            lists in prop::array::uniform2(prop::collection::vec((0..30_i32, 0..6_i32), 0..20)),
        ) {
            let interval = |(i, &(low, length)): (usize, &(i32, i32))| Interval {
                low: low.into(),
                high: (low + length).into(),
                triangle: i as u32,
                is_corner: length == 0,
            };
            let [first, second] =
                lists.each_ref().map(|list| list.iter().enumerate().map(interval).collect());
            let mut pairs = Vec::new();
            overlaps(first, second, |a, b| pairs.push([a, b]));
            // Which list is named first depends on where they begin.
            prop_assert_eq!(pairs.len(), {
                let meets = |&(a, l): &(i32, i32), &(b, m): &(i32, i32)| {
                    a <= b + m && b <= a + l && 0 < l + m
                };
                let pairs = lists[0].iter().flat_map(|a| lists[1].iter().map(move |b| (a, b)));
                pairs.filter(|(a, b)| meets(a, b)).count()
            });
        }
    }
}
