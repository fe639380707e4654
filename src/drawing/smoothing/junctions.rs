//! The points at which strokes meet, in all layers together.
//!
//! Strokes meet in a common point, or one ends on another: where a line goes
//! behind a contour, its end lies on an edge of the contour that has no point
//! there. Such an end was rounded by itself, so it is looked for within a
//! distance that is far above rounding and far below the width of any pen,
//! and becomes a point of the stroke on which it lies.

use super::super::{Strokes, is_closed};
use crate::spatial::{Bounds, Hierarchy};
use glam::DVec2;
use rustc_hash::FxHashMap;

/// How far from a stroke an end may be and still lie on it, mm.
const ON: f64 = 1e-6;

/// The points that strokes keep.
pub(super) struct Junctions {
    /// How many strokes come to a point; its open ends count twice.
    visits: FxHashMap<[u64; 2], u32>,
}

/// A segment: its layer, its stroke, the number of its first point.
type Place = (u32, u32, u32);

/// A point to put in after that number, at that share of the way to the next.
type Extra = (u32, f64, DVec2);

impl Junctions {
    /// Finds all junctions; returns the strokes with the ends of others as
    /// points of theirs. Expected O(n log n).
    pub(super) fn find(layers: &[Strokes]) -> (Vec<Strokes>, Self) {
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
        // An end that it shares with nothing may lie on something.
        ends.retain(|end| visits.get(&key(*end)) == Some(&2));
        let layers = with_points(layers, &ends, &mut visits);
        (layers, Junctions { visits })
    }

    /// Whether strokes meet or end in a point.
    pub(super) fn holds(&self, point: DVec2) -> bool {
        self.visits.get(&key(point)).is_some_and(|visits| 1 < *visits)
    }
}

/// The strokes with those of `ends` as points that lie on them.
fn with_points(
    layers: &[Strokes],
    ends: &[DVec2],
    visits: &mut FxHashMap<[u64; 2], u32>,
) -> Vec<Strokes> {
    let mut places: Vec<Place> = Vec::new();
    let mut boxes = Vec::new();
    for (layer, strokes) in layers.iter().enumerate() {
        for (stroke, points) in strokes.iter().enumerate() {
            for (first, pair) in points.windows(2).enumerate() {
                places.push((layer as u32, stroke as u32, first as u32));
                boxes.push(around(pair[0].min(pair[1]), pair[0].max(pair[1])));
            }
        }
    }
    let hierarchy = Hierarchy::new(&boxes);
    let mut more: FxHashMap<(u32, u32), Vec<Extra>> = FxHashMap::default();
    for end in ends {
        let own = around(*end, *end);
        hierarchy.visit(
            |group| group.overlapping(&own),
            |item| {
                let (layer, stroke, first) = places[item as usize];
                let points = layers[layer as usize].get(stroke as usize);
                let (a, b) = (points[first as usize], points[first as usize + 1]);
                let along = b - a;
                let share = (*end - a).dot(along) / along.length_squared();
                let inside = 0.0 < share && share < 1.0 && *end != a && *end != b;
                if inside && (a + along * share).distance(*end) <= ON {
                    more.entry((layer, stroke)).or_default().push((first, share, *end));
                    *visits.entry(key(*end)).or_default() += 1;
                }
            },
        );
    }
    let strokes = |(layer, strokes): (usize, &Strokes)| {
        let mut all = Strokes::default();
        for (stroke, points) in strokes.iter().enumerate() {
            match more.get_mut(&(layer as u32, stroke as u32)) {
                None => all.push(points.iter().copied()),
                Some(extra) => {
                    extra.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
                    extra.dedup_by(|a, b| a.2 == b.2);
                    let mut extra = extra.iter().peekable();
                    let mut with = Vec::with_capacity(points.len() + extra.len());
                    for (index, point) in points.iter().enumerate() {
                        with.push(*point);
                        while let Some((_, _, end)) =
                            extra.next_if(|(first, _, _)| *first as usize == index)
                        {
                            with.push(*end);
                        }
                    }
                    all.push(with);
                }
            }
        }
        all
    };
    layers.iter().enumerate().map(strokes).collect()
}

/// A box with room for rounding.
fn around(low: DVec2, high: DVec2) -> Bounds {
    let down = |value: f64| ((value - ON) as f32).next_down();
    let up = |value: f64| ((value + ON) as f32).next_up();
    Bounds {
        low: [down(low.x), down(low.y), 0.0].into(),
        high: [up(high.x), up(high.y), 0.0].into(),
    }
}

fn key(point: DVec2) -> [u64; 2] {
    // Page coordinates are never -0, so equal points have equal bits.
    [point.x.to_bits(), point.y.to_bits()]
}
