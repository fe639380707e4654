//! How far a curve is from a stroke: a bound for the Hausdorff distance.
//!
//! Both are walked in small steps, and for every step the distance from the
//! other is found by walking along with it. Nothing nearer that lies
//! elsewhere is looked for, and half a step is added, so what comes out is
//! never too small.

use super::super::strokes::flatten;
use super::simplify::from_segment;
use glam::DVec2;
use kurbo::{CubicBez, Point};

/// How many segments ahead something nearer is looked for.
const AHEAD: usize = 12;

/// A bound for how far any point of the curves is from the stroke and any
/// point of the stroke from the curves. Good to about a third of `tolerance`.
pub(super) fn both_ways(stroke: &[DVec2], curves: &[CubicBez], tolerance: f64) -> f64 {
    let flatness = tolerance / 16.0;
    let vector = |p: Point| DVec2::new(p.x, p.y);
    let mut flat = vec![stroke[0]];
    for curve in curves {
        flatten([curve.p0, curve.p1, curve.p2].map(vector), vector(curve.p3), flatness, &mut flat);
        flat.push(vector(curve.p3));
    }
    let step = tolerance / 4.0;
    one_way(stroke, &flat, step).max(one_way(&flat, stroke, step)) + 0.5 * step + flatness
}

/// The greatest distance of steps along `from` from `to`.
fn one_way(from: &[DVec2], to: &[DVec2], step: f64) -> f64 {
    let mut worst: f64 = 0.0;
    let mut at = 0;
    for pair in from.windows(2) {
        let parts = (pair[0].distance(pair[1]) / step).ceil().max(1.0);
        for part in 0..=parts as u32 {
            let point = pair[0].lerp(pair[1], f64::from(part) / parts);
            let distance = |segment: usize| from_segment(point, to[segment], to[segment + 1]);
            let mut best = distance(at);
            let mut next = at + 1;
            while next + 1 < to.len() && next <= at + AHEAD {
                let other = distance(next);
                if other <= best {
                    (best, at) = (other, next);
                }
                next += 1;
            }
            worst = worst.max(best);
        }
    }
    worst
}
