//! Hidden polylines become dashes.
//!
//! ISO 128-2 makes a dashed line of dashes 12 line widths long and gaps of 3.
//! Practice adds that a dashed line begins and ends with a dash and that its
//! corners are drawn. Therefore:
//!
//! 1. A polyline is cut into stretches at its corners, where it turns by more
//!    than 30 degrees; gentler bends are part of a curve, and dashes bend with
//!    it. A stretch too short for a gap is not cut off but left to the next.
//! 2. In a stretch of length L the number of dashes is the one that brings the
//!    period nearest to its nominal length, and dashes and gaps are stretched
//!    alike so that the first dash begins at its beginning and the last
//!    ends at its end:
//!
//!    ```text
//!    |=====  =====  =====|      n dashes, n - 1 gaps
//!    ```
//!
//! 3. Two dashes that meet at a corner are drawn as one stroke.
//! 4. A closed curve without corners begins and ends with half a dash, which
//!    together are one: it has no seam.
//!
//! What is shorter than a dash, or has no room for a gap, is drawn solid.

use super::{Strokes, is_closed};
use glam::DVec2;

/// Length of a dash in line widths [ISO 128-2, line 02].
const DASH: f64 = 12.0;

/// Length of a gap in line widths.
const GAP: f64 = 3.0;

/// The least length of a stretch, in line widths: two dashes and a gap.
const STRETCH: f64 = 2.0 * DASH + GAP;

/// Square of the cosine of 30 degrees: where a corner begins.
const CORNER: f64 = 0.75;

/// Dashes along all of `strokes` for a line of `width` millimetres.
pub(super) fn dashed(strokes: &Strokes, width: f64) -> Strokes {
    let mut dashes = Strokes::default();
    for stroke in strokes.iter() {
        let path = Path::new(stroke);
        for [from, to] in pattern(&path, width) {
            path.draw(from, to, &mut dashes);
        }
    }
    dashes
}

/// Where the dashes of a path begin and end, by length along it.
fn pattern(path: &Path, width: f64) -> Vec<[f64; 2]> {
    let corners = path.corners();
    if path.closed && corners.is_empty() {
        return ring_pattern(path.length(), width);
    }
    let mut dashes: Vec<[f64; 2]> = Vec::new();
    let mut start = 0.0;
    let stops = corners.into_iter().chain([path.length()]);
    for stop in stops {
        let last = stop == path.length();
        let too_short = |length: f64| length < STRETCH * width;
        if !last && (too_short(stop - start) || too_short(path.length() - stop)) {
            continue;
        }
        let first = dashes.len();
        stretch_pattern(start, stop, width, &mut dashes);
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
fn stretch_pattern(start: f64, stop: f64, width: f64, dashes: &mut Vec<[f64; 2]>) {
    let length = stop - start;
    let count = ((length / width + GAP) / (DASH + GAP)).round().max(1.0);
    let unit = length / (count * (DASH + GAP) - GAP);
    for dash in 0..count as u64 {
        let from = start + dash as f64 * (DASH + GAP) * unit;
        dashes.push([from, from + DASH * unit]);
    }
    // The ends are where they are, whatever the sums above were rounded to.
    if let Some(dash) = dashes.last_mut() {
        dash[1] = stop;
    }
}

/// Rule 4: dashes around a closed curve of `length`.
fn ring_pattern(length: f64, width: f64) -> Vec<[f64; 2]> {
    let count = (length / width / (DASH + GAP)).round();
    if count < 2.0 {
        return vec![[0.0, length]];
    }
    let unit = length / (count * (DASH + GAP));
    let mut dashes = vec![[0.0, 0.5 * DASH * unit]];
    for dash in 1..count as u64 {
        let middle = dash as f64 * (DASH + GAP) * unit;
        dashes.push([middle - 0.5 * DASH * unit, middle + 0.5 * DASH * unit]);
    }
    dashes.push([length - 0.5 * DASH * unit, length]);
    dashes
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
