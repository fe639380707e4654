//! Polylines become dashes.
//!
//! ISO 128-2 makes a dashed line of dashes 12 line widths long and gaps of 3;
//! other types of line have other periods (`dash`).
//! Practice adds that a dashed line begins and ends with a dash and that its
//! corners are drawn. Therefore:
//!
//! 1. A polyline is cut into stretches at its corners, where it turns by more
//!    than 30 degrees; gentler bends are part of a curve, and dashes bend with
//!    it. A stretch too short for a gap is not cut off but left to the next.
//! 2. In a stretch of length L the number of periods is the one that brings
//!    them nearest to their nominal length, and dashes and gaps are stretched
//!    alike so that the first dash begins at its beginning and the same dash
//!    ends at its end:
//!
//!    ```text
//!    |=====  =====  =====|      n dashes, n - 1 periods
//!    ```
//!
//! 3. Two dashes that meet at a corner are drawn as one stroke.
//! 4. A closed curve without corners begins and ends with half a dash, which
//!    together are one: it has no seam.
//!
//! What is shorter than a dash, or has no room for a gap, is drawn solid.

use super::{Dash, Strokes, is_closed};
use crate::run::map_chunks;
use glam::DVec2;

/// Square of the cosine of 30 degrees: where a corner begins.
const CORNER: f64 = 0.75;

/// Dashes along all of `strokes` for a line of `width` millimetres.
pub(super) fn dashed(strokes: &Strokes, dash: Dash, width: f64) -> Strokes {
    let Some(pattern) = Pattern::new(dash, width) else {
        return strokes.clone();
    };
    let parts = map_chunks(strokes.len(), PART, |part| {
        let mut dashes = Strokes::default();
        for index in part {
            let path = Path::new(strokes.get(index));
            for [from, to] in pattern.along(&path) {
                path.draw(from, to, &mut dashes);
            }
        }
        dashes
    });
    Strokes::concat(&parts)
}

/// Strokes that one task cuts into dashes.
const PART: usize = 512;

/// Dashes and gaps in line widths, and the width.
struct Pattern {
    elements: &'static [f64],
    /// The first dash, with which a line begins and ends.
    dash: f64,
    /// All elements together.
    period: f64,
    width: f64,
}

impl Pattern {
    fn new(dash: Dash, width: f64) -> Option<Self> {
        let elements = dash.elements();
        let dash = *elements.first()?;
        Some(Pattern { elements, dash, period: elements.iter().sum(), width })
    }

    /// Dashes of one period from `start`, a line width being `unit` long.
    fn push_period(&self, start: f64, unit: f64, dashes: &mut Vec<[f64; 2]>) {
        let mut at = 0.0;
        for pair in self.elements.chunks(2) {
            dashes.push([start + at * unit, start + (at + pair[0]) * unit]);
            at += pair.iter().sum::<f64>();
        }
    }
}

impl Pattern {
    /// Where the dashes of a path begin and end, by length along it.
    fn along(&self, path: &Path) -> Vec<[f64; 2]> {
        let corners = path.corners();
        if path.closed && corners.is_empty() {
            return self.ring(path.length());
        }
        let mut dashes: Vec<[f64; 2]> = Vec::new();
        let mut start = 0.0;
        let stops = corners.into_iter().chain([path.length()]);
        for stop in stops {
            let last = stop == path.length();
            // The least length of a stretch is a period and a dash.
            let too_short = |length: f64| length < (self.period + self.dash) * self.width;
            if !last && (too_short(stop - start) || too_short(path.length() - stop)) {
                continue;
            }
            let first = dashes.len();
            self.stretch(start, stop, &mut dashes);
            if 0 < first {
                // Rule 3: the corner's two dashes are one.
                dashes[first - 1][1] = dashes[first][1];
                dashes.remove(first);
            }
            start = stop;
        }
        dashes
    }

    /// Rule 2: dashes from `start` to `stop`, a dash at either end.
    fn stretch(&self, start: f64, stop: f64, dashes: &mut Vec<[f64; 2]>) {
        let (length, rest) = (stop - start, self.period - self.dash);
        let count = ((length / self.width + rest) / self.period).round().max(1.0);
        let unit = length / (count * self.period - rest);
        for period in 0..count as u64 - 1 {
            self.push_period(start + period as f64 * self.period * unit, unit, dashes);
        }
        // The end is where it is, whatever the sums above are rounded to.
        dashes.push([start + (count - 1.0) * self.period * unit, stop]);
    }

    /// Rule 4: dashes around a closed curve of `length`.
    fn ring(&self, length: f64) -> Vec<[f64; 2]> {
        let count = (length / self.width / self.period).round();
        if count < 2.0 {
            return vec![[0.0, length]];
        }
        let unit = length / (count * self.period);
        let half = 0.5 * self.dash * unit;
        let mut dashes = Vec::new();
        for period in 0..count as u64 {
            self.push_period(period as f64 * self.period * unit - half, unit, &mut dashes);
        }
        dashes[0] = [0.0, half];
        dashes.push([length - half, length]);
        dashes
    }
}

/// A polyline measured by length.
struct Path {
    points: Vec<DVec2>,
    /// Length from the beginning to each point.
    lengths: Vec<f64>,
    closed: bool,
}

impl Path {
    /// Measures `stroke`; a closed one begins at its first corner, if any.
    fn new(stroke: &[DVec2]) -> Self {
        let closed = is_closed(stroke);
        let mut points = stroke.to_vec();
        if closed {
            let ring = stroke.len() - 1;
            let before = |i: usize| stroke[if i == 0 { ring - 1 } else { i - 1 }];
            let corner = |i: &usize| is_corner(before(*i), stroke[*i], stroke[*i + 1]);
            if let Some(corner) = (0..ring).find(corner) {
                points.truncate(ring);
                points.rotate_left(corner);
                points.push(points[0]);
            }
        }
        let mut lengths = Vec::with_capacity(points.len());
        let mut length = 0.0;
        lengths.push(length);
        for pair in points.windows(2) {
            length += pair[0].distance(pair[1]);
            lengths.push(length);
        }
        Path { points, lengths, closed }
    }

    fn length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// Where the path turns sharply between its ends; for a closed path that
    /// begins at a corner, its beginning as well.
    fn corners(&self) -> Vec<f64> {
        let mut corners = Vec::new();
        if self.closed
            && is_corner(self.points[self.points.len() - 2], self.points[0], self.points[1])
        {
            corners.push(0.0);
        }
        for (index, three) in self.points.windows(3).enumerate() {
            if is_corner(three[0], three[1], three[2]) {
                corners.push(self.lengths[index + 1]);
            }
        }
        corners
    }

    /// Draws the part between two lengths.
    fn draw(&self, from: f64, to: f64, strokes: &mut Strokes) {
        let inner = self.lengths.partition_point(|length| *length <= from)
            ..self.lengths.partition_point(|length| *length < to);
        let inner = self.points.get(inner).unwrap_or_default();
        strokes.push([self.at(from)].into_iter().chain(inner.iter().copied()).chain([self.at(to)]));
    }

    /// The point at a length; exactly a point of the polyline where it is one.
    fn at(&self, length: f64) -> DVec2 {
        let next = self.lengths.partition_point(|known| *known < length);
        let next = next.min(self.lengths.len() - 1);
        if next == 0 || self.lengths[next] <= length {
            return self.points[next];
        }
        let (before, after) = (self.lengths[next - 1], self.lengths[next]);
        self.points[next - 1].lerp(self.points[next], (length - before) / (after - before))
            + DVec2::ZERO
    }
}

/// Whether the way from `a` over `b` to `c` turns by more than 30 degrees.
pub(super) fn is_corner(a: DVec2, b: DVec2, c: DVec2) -> bool {
    let (before, after) = (b - a, c - b);
    let cosine = before.dot(after);
    cosine < 0.0 || cosine * cosine < CORNER * before.length_squared() * after.length_squared()
}

#[cfg(test)]
mod tests;
