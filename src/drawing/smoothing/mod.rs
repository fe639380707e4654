//! Fewer points and curves, within a stated distance of what was found.
//!
//! What is visible is settled on the straight edges of the mesh; only then may
//! a stroke be drawn with fewer points (Douglas and Peucker 1973) or with
//! cubic curves (Levien's fitting in kurbo). The tolerance holds both ways:
//! no point of the drawn stroke is farther than that from the stroke that was
//! found, and no point of the latter farther from the drawn one.
//!
//! 1. `junctions`: where strokes meet, and where one ends on another, they
//!    still do afterwards, at the same point bit for bit.
//! 2. Between two such points, or corners, a stretch is smoothed by itself.
//! 3. `fitting` makes curves of stretches of gentle bends, measures what it
//!    has made (`distance`), and where that is not good enough halves the
//!    stretch; what no curve fits is left to `simplify`.

mod distance;
mod fitting;
mod junctions;
mod simplify;

use super::dashing::is_corner;
use super::{Strokes, is_closed};
use crate::run::map_indexed;
use glam::DVec2;
use junctions::Junctions;

/// A point of a stroke and, if the way to it is a curve, its two controls.
pub(super) type Node = (DVec2, Option<[DVec2; 2]>);

/// What is done with a stretch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Smoothing {
    /// Points are left out.
    Simplify,
    /// Curves are fitted where they fit, points left out elsewhere.
    Fit,
}

/// Smooths the strokes of all layers to within `tolerance` millimetres.
pub(super) fn smooth(layers: &[Strokes], how: Smoothing, tolerance: f64) -> Vec<Strokes> {
    let (layers, junctions) = Junctions::find(layers);
    map_indexed(layers.len(), |layer| {
        let strokes = &layers[layer];
        let smoothed = map_indexed(strokes.len(), |index| {
            smooth_stroke(strokes.get(index), &junctions, how, tolerance)
        });
        let mut all = Strokes::default();
        smoothed.into_iter().for_each(|nodes| all.push_curved(nodes));
        all
    })
}

fn smooth_stroke(
    stroke: &[DVec2],
    junctions: &Junctions,
    how: Smoothing,
    tolerance: f64,
) -> Vec<Node> {
    let last = stroke.len() - 1;
    let closed = is_closed(stroke);
    let before = |i: usize| stroke[if i == 0 { last - 1 } else { i - 1 }];
    let after = |i: usize| stroke[if i == last { 1 } else { i + 1 }];
    let fixed = |i: usize| {
        let corner = how == Smoothing::Fit
            && (closed || (0 < i && i < last))
            && is_corner(before(i), stroke[i], after(i));
        junctions.holds(stroke[i]) || corner
    };
    // A closed stroke is looked at from a fixed point, if it has one.
    let start = if closed { (0..last).find(|i| fixed(*i)) } else { Some(0) };
    let points: Vec<DVec2> = match start {
        Some(0) | None => stroke.to_vec(),
        Some(start) => (0..=last).map(|step| stroke[(start + step) % last]).collect(),
    };
    let shift = start.unwrap_or(0);
    let stops = (1..last).filter(|step| {
        let i = if closed { (shift + step) % last } else { *step };
        start.is_some() && fixed(i)
    });
    let mut nodes: Vec<Node> = vec![(points[0], None)];
    let mut from = 0;
    for stop in stops.chain([last]) {
        let stretch = &points[from..=stop];
        let ring = start.is_none();
        match how {
            Smoothing::Simplify => simplify::append(stretch, tolerance, &mut nodes),
            Smoothing::Fit => fitting::append(stretch, ring, tolerance, &mut nodes),
        }
        from = stop;
    }
    nodes
}

#[cfg(test)]
mod tests;
