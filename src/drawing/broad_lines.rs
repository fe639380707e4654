//! Lines wider than the pen, drawn as strokes side by side.
//!
//! A plotter has the pens it has. A line of width W is all that is within
//! W/2 of its stroke; a pen of width p draws what is within p/2 of its own.
//! So n strokes at equal distances, the outermost (W - p)/2 off the middle,
//! fill the line if neighbours are no more than p apart:
//!
//! ```text
//!   (=======================)   around the stroke, (W - p)/2 off
//!   -------------------------   in the middle, if n is odd
//!   (=======================)   the way back
//! ```
//!
//! 1. An open stroke is gone around: along one side, around its end, back on
//!    the other side and around its beginning. That is one closed stroke for
//!    two lines, and the ends become as round as those of a wide pen. A
//!    closed stroke gets one stroke inside and one outside.
//! 2. Corners are arcs around the corner, those on the inner side too: every
//!    point is exactly as far from the stroke as it should be, or nearer, so
//!    nothing reaches beyond the line. Nothing is trimmed where an inner side
//!    crosses itself: what lies between would be a hole.
//! 3. Arcs are halved until they are straight enough, with square roots
//!    alone, which are the same on every machine.
//!
//! Neighbours overlap by a tenth of the pen at least, because neither pens
//! nor plotters are exact.

use super::{Drawing, Strokes, is_closed};
use crate::run::{map_chunks, map_indexed};
use glam::DVec2;

/// How far apart strokes side by side may be, in widths of the pen.
const APART: f64 = 0.9;

/// How far chords may be from their arcs, in widths of the pen.
const SAGITTA: f64 = 0.02;

/// Strokes that one task goes around.
const PART: usize = 1024;

/// The most strokes side by side.
const MOST: f64 = 1000.0;

impl Drawing {
    /// Draws all lines that are wider than `pen` millimetres as strokes of
    /// that width, side by side; other lines stay as they are. Curves become
    /// polylines. O(n) for n points, times the strokes for a line.
    pub fn broaden(&mut self, pen: f64) {
        let layers = map_indexed(self.layers.len(), |i| {
            let layer = &self.layers[i];
            let wide = pen < layer.style.width;
            wide.then(|| side_by_side(&layer.strokes.flat(SAGITTA * pen), layer.style.width, pen))
        });
        for (layer, strokes) in self.layers.iter_mut().zip(layers) {
            if let Some(strokes) = strokes {
                layer.strokes = strokes;
                layer.style.width = pen;
            }
        }
    }
}

/// How far from the middle of a line of `width` its strokes are, the
/// innermost first; those with a distance lie on both sides.
fn distances(width: f64, pen: f64) -> Vec<f64> {
    let reach = 0.5 * (width - pen);
    let count = (2.0 * reach / (APART * pen) - 1e-9).ceil().clamp(1.0, MOST) as u32 + 1;
    let at = |line: u32| reach * (2.0 * f64::from(line) / f64::from(count - 1) - 1.0);
    (count / 2..count).map(|line| at(line).max(0.0)).collect()
}

/// The strokes of a pen for strokes of this width.
fn side_by_side(strokes: &Strokes, width: f64, pen: f64) -> Strokes {
    let distances = distances(width, pen);
    let parts = map_chunks(strokes.len(), PART, |part| {
        let mut lines = Vec::new();
        for stroke in part.map(|index| strokes.get(index)) {
            for &distance in &distances {
                if distance == 0.0 {
                    lines.push(stroke.to_vec());
                } else {
                    around(stroke, distance, SAGITTA * pen, &mut lines);
                }
            }
        }
        lines
    });
    let mut all = Strokes::default();
    parts.into_iter().flatten().for_each(|line| all.push(line));
    all
}

/// Appends the closed strokes at a distance from a stroke.
fn around(stroke: &[DVec2], distance: f64, sagitta: f64, lines: &mut Vec<Vec<DVec2>>) {
    let there = stroke[..stroke.len() - 1].iter().copied();
    let back = stroke[1..].iter().rev().copied();
    if is_closed(stroke) {
        lines.push(beside(&there.collect::<Vec<_>>(), distance, sagitta));
        lines.push(beside(&back.collect::<Vec<_>>(), distance, sagitta));
    } else {
        lines.push(beside(&there.chain(back).collect::<Vec<_>>(), distance, sagitta));
    }
}

/// The closed stroke on the right of a ring of points, y downwards.
fn beside(ring: &[DVec2], distance: f64, sagitta: f64) -> Vec<DVec2> {
    let count = ring.len();
    let way = |i: usize| (ring[(i + 1) % count] - ring[i % count]).normalize_or_zero();
    let mut points = Vec::with_capacity(count + 8);
    // A point for every arc that is shorter than this cosine tells.
    let flat = 1.0 - sagitta / distance;
    for i in 0..count {
        let (corner, ways) = (ring[(i + 1) % count], [way(i), way(i + 1)]);
        let [from, to] = ways.map(|way| -way.perp());
        points.push(corner + distance * from);
        if from.dot(to) < 0.0 && from.perp_dot(to).abs() <= 1e-9 {
            // Back where it came from: the long way around the end.
            arc([from, ways[0]], flat, corner, distance, &mut points);
            points.push(corner + distance * ways[0]);
            arc([ways[0], to], flat, corner, distance, &mut points);
        } else {
            arc([from, to], flat, corner, distance, &mut points);
        }
        points.push(corner + distance * to);
    }
    points.dedup();
    points.iter_mut().for_each(|point| *point += DVec2::ZERO);
    points.extend(points.first().copied());
    points.dedup();
    points
}

/// Appends the points inside an arc of less than a half turn.
fn arc([from, to]: [DVec2; 2], flat: f64, centre: DVec2, radius: f64, points: &mut Vec<DVec2>) {
    // The cosine of half the angle tells how high the arc is over its chord.
    let half = (0.5 + 0.5 * from.dot(to)).max(0.0).sqrt();
    let middle = (from + to).normalize_or_zero();
    if flat <= half || middle == DVec2::ZERO {
        return;
    }
    arc([from, middle], flat, centre, radius, points);
    points.push(centre + radius * middle);
    arc([middle, to], flat, centre, radius, points);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strokes(list: &[&[[f64; 2]]]) -> Strokes {
        let mut strokes = Strokes::default();
        list.iter().for_each(|points| strokes.push(points.iter().map(|&p| DVec2::from(p))));
        strokes
    }

    /// The distance of a point from some strokes.
    fn distance(strokes: &Strokes, point: DVec2) -> f64 {
        let pairs = strokes.iter().flat_map(|stroke| stroke.windows(2));
        let one = |pair: &[DVec2]| {
            let along = pair[1] - pair[0];
            let t = ((point - pair[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            point.distance(pair[0] + t * along)
        };
        pairs.map(one).fold(f64::INFINITY, f64::min)
    }

    /// Open with right, acute and blunt corners; a spike; closed; short.
    const SHAPES: [&[[f64; 2]]; 5] = [
        &[[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [1.0, 2.6], [4.0, 2.5], [5.0, 2.7]],
        &[[0.0, 0.0], [3.0, 1.0], [1.5, 0.5]],
        &[[0.0, 0.0], [4.0, 0.3], [2.0, 3.0], [0.0, 0.0]],
        &[[0.0, 0.0], [0.05, 0.02]],
        &[[0.0, 0.0], [1.0, 0.0], [1.02, 0.01], [1.03, 0.03], [1.03, 0.06], [1.0, 1.0]],
    ];

    #[test]
    fn the_pen_draws_the_line_and_nothing_beyond_it() {
        for (shape, points) in SHAPES.iter().enumerate() {
            for (width, pen) in [(1.0, 0.3), (0.7, 0.5), (0.35, 0.3), (1.0, 0.5), (2.0, 0.13)] {
                let wide = strokes(&[points]);
                let drawn = side_by_side(&wide, width, pen);
                let (mut wanted, mut covered) = (0.0, 0.0);
                // A hundred samples across what may be drawn, small or large.
                let corners = || points.iter().map(|&point| DVec2::from(point));
                let low = corners().fold(DVec2::INFINITY, DVec2::min) - 0.51 * width;
                let high = corners().fold(DVec2::NEG_INFINITY, DVec2::max) + 0.51 * width;
                let step = (high - low).max_element() / 100.0;
                let [columns, rows] = ((high - low) / step).to_array().map(|n| n.ceil() as u32);
                for i in 0..=columns {
                    for j in 0..=rows {
                        let point = low + step * DVec2::new(f64::from(i), f64::from(j));
                        let off = distance(&wide, point) - 0.5 * width;
                        let ink = distance(&drawn, point) - 0.5 * pen;
                        let what = format!("{shape} {width} {pen} {point}: {off} {ink}");
                        assert!(0.0 < off || ink <= 1.1 * SAGITTA * pen, "a hole: {what}");
                        assert!(off <= 1e-9 || 0.0 <= ink, "beyond: {what}");
                        wanted += step * step * f64::from(off <= 0.0);
                        covered += step * step * f64::from(ink <= 0.0);
                    }
                }
                assert!((wanted - covered) <= 0.03 * wanted, "{shape}: {covered} of {wanted}");
            }
        }
    }

    #[test]
    fn two_lines_are_one_closed_stroke_and_the_middle_is_the_stroke_itself() {
        let line = strokes(&[&[[0.0, 0.0], [10.0, 0.0]]]);
        // 0.5 in strokes of 0.3: two, a tenth of a millimetre off the middle.
        let two = side_by_side(&line, 0.5, 0.3);
        assert_eq!((distances(0.5, 0.3), two.len()), (vec![0.1], 1));
        assert!(is_closed(two.get(0)));
        assert!((two.length() - 20.0 - 0.2 * std::f64::consts::PI).abs() < 0.02);
        let three = side_by_side(&line, 0.8, 0.3);
        assert_eq!((distances(0.8, 0.3).len(), three.len()), (2, 2));
        assert_eq!(three.get(0), line.get(0));
        for (width, pen) in [(0.8, 0.3), (1.4, 0.18), (0.31, 0.3)] {
            let found = distances(width, pen);
            assert!((found[found.len() - 1] - 0.5 * (width - pen)).abs() < 1e-12);
            assert!(found[0] <= 0.5 * APART * pen);
            assert!(found.windows(2).all(|two| two[1] - two[0] <= APART * pen + 1e-9));
        }
    }
}
