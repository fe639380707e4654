//! The points at which strokes meet, in all layers together.
//!
//! Strokes meet in a common point, or one ends on another: where a line goes
//! behind a contour, its end lies on an edge of the contour that has no point
//! there. Such an end was rounded by itself, and where lines that nearly
//! coincide were merged it may end beside the one that was kept. So it is
//! looked for within a distance; what it is found at is a foot on the other
//! stroke, which that one has to go through.

use super::super::{Strokes, is_closed};
use crate::run::map_indexed;
use crate::spatial::{Bounds, Hierarchy};
use glam::DVec2;
use rustc_hash::FxHashMap;

/// How far from a stroke an end may be and still lie on it, mm: far above
/// rounding and far below the width of any pen.
const ON: f64 = 1e-6;

/// The points that strokes keep.
pub(super) struct Junctions {
    /// How many strokes come to a point; its open ends count twice.
    visits: FxHashMap<[u64; 2], u32>,
    /// The feet on each stroke of each layer, in their order along it.
    feet: Vec<FxHashMap<u32, Vec<Foot>>>,
}

/// Where another stroke ends on a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Foot {
    /// The point of the stroke before it.
    pub(super) after: usize,
    /// The share of the way from there to the next point.
    pub(super) share: f64,
    pub(super) point: DVec2,
}

/// A segment: its layer, its stroke, the number of its first point.
type Place = (u32, u32, u32);

impl Junctions {
    /// Finds all junctions; ends within `reach` of a stroke end on it.
    /// Expected O(n log n).
    pub(super) fn find(layers: &[Strokes], reach: f64) -> Self {
        let mut visits: FxHashMap<[u64; 2], u32> = FxHashMap::default();
        let mut ends = Vec::new();
        for stroke in layers.iter().flat_map(Strokes::iter) {
            let closed = is_closed(stroke);
            let last = stroke.len() - 1;
            for (index, point) in stroke[usize::from(closed)..].iter().enumerate() {
                let end = !closed && (index == 0 || index == last);
                *visits.entry(key(*point)).or_default() += if end { 2 } else { 1 };
                ends.extend(end.then_some(*point));
            }
        }
        ends.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        ends.dedup();
        Junctions { visits, feet: feet(layers, &ends, reach.max(ON)) }
    }

    /// Whether strokes meet or end in a point.
    pub(super) fn holds(&self, point: DVec2) -> bool {
        self.visits.get(&key(point)).is_some_and(|visits| 1 < *visits)
    }

    /// The feet on a stroke, in their order along it.
    pub(super) fn feet(&self, layer: usize, stroke: usize) -> &[Foot] {
        self.feet[layer].get(&(stroke as u32)).map_or(&[], Vec::as_slice)
    }
}

/// Where some ends lie within `reach` on strokes, but for points of these.
fn feet(layers: &[Strokes], ends: &[DVec2], reach: f64) -> Vec<FxHashMap<u32, Vec<Foot>>> {
    let mut places: Vec<Place> = Vec::new();
    let mut boxes = Vec::new();
    for (layer, strokes) in layers.iter().enumerate() {
        for (stroke, points) in strokes.iter().enumerate() {
            for (first, pair) in points.windows(2).enumerate() {
                places.push((layer as u32, stroke as u32, first as u32));
                boxes.push(around(pair[0].min(pair[1]), pair[0].max(pair[1]), reach));
            }
        }
    }
    let hierarchy = Hierarchy::new(&boxes);
    let found = map_indexed(ends.len(), |end| {
        let end = ends[end];
        let own = around(end, end, 0.0);
        let mut found = Vec::new();
        hierarchy.visit(
            |group| group.overlapping(&own),
            |item| {
                let place = places[item as usize];
                let points = layers[place.0 as usize].get(place.1 as usize);
                let (a, b) = (points[place.2 as usize], points[place.2 as usize + 1]);
                // What ends beside itself is no junction.
                let own = points[0] == end || points[points.len() - 1] == end;
                let reach = if own { ON } else { reach };
                found.extend(foot([a, b], end, reach).map(|foot| (place, foot)));
            },
        );
        found
    });
    let mut feet = vec![FxHashMap::<u32, Vec<Foot>>::default(); layers.len()];
    for ((layer, stroke, after), (share, point)) in found.into_iter().flatten() {
        let foot = Foot { after: after as usize, share, point };
        feet[layer as usize].entry(stroke).or_default().push(foot);
    }
    for feet in feet.iter_mut().flat_map(|layer| layer.values_mut()) {
        feet.sort_by(|a, b| a.after.cmp(&b.after).then(a.share.total_cmp(&b.share)));
        feet.dedup_by(|a, b| a.point == b.point);
    }
    feet
}

/// The foot of an end on a segment, between the ends of that.
fn foot([a, b]: [DVec2; 2], end: DVec2, reach: f64) -> Option<(f64, DVec2)> {
    let along = b - a;
    let share = (end - a).dot(along) / along.length_squared();
    let foot = a + along * share;
    let apart = foot.distance(end);
    let inside = 0.0 < share && share < 1.0 && end != a && end != b && apart <= reach;
    // What lies on a stroke is its own foot, so that it stays there bit for bit.
    let foot = if apart <= ON { end } else { foot + DVec2::ZERO };
    (inside && foot != a && foot != b).then_some((share, foot))
}

/// A box with room for rounding.
fn around(low: DVec2, high: DVec2, reach: f64) -> Bounds {
    let down = |value: f64| ((value - reach) as f32).next_down();
    let up = |value: f64| ((value + reach) as f32).next_up();
    Bounds {
        low: [down(low.x), down(low.y), 0.0].into(),
        high: [up(high.x), up(high.y), 0.0].into(),
    }
}

fn key(point: DVec2) -> [u64; 2] {
    // Page coordinates are never -0, so equal points have equal bits.
    [point.x.to_bits(), point.y.to_bits()]
}
