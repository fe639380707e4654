//! Fewer points and curves, within a stated distance of what was found.
//!
//! What is visible is settled on the straight edges of the mesh; only then may
//! a stroke be drawn with fewer points (Douglas and Peucker 1973) or with
//! cubic curves (Levien's fitting in kurbo). The tolerance holds both ways:
//! no point of the drawn stroke is farther than that from the stroke that was
//! found, and no point of the latter farther from the drawn one.
//!
//! 1. `junctions`: where strokes meet, and where one ends on another, they
//!    still do afterwards.
//! 2. Between two points in which strokes meet, or corners, a stretch is
//!    smoothed by itself. It goes through the feet of strokes that end on it.
//! 3. `fitting` makes curves of stretches of gentle bends, measures what it
//!    has made (`distance`), and where that is not good enough halves the
//!    stretch; what no curve fits is left to `simplify`.
//! 4. A foot is no point where the stroke runs straight through it; and where
//!    more feet are points than points are left out, the stroke stays as it
//!    was. So there are never more points than there were, control points
//!    among them.

mod distance;
mod feet;
mod fitting;
mod junctions;
mod simplify;

use super::dashing::is_corner;
use super::{Strokes, is_closed};
use crate::run::map_indexed;
use feet::Stretch;
use glam::DVec2;
use junctions::{Foot, Junctions};

/// A point of a stroke and, if the way to it is a curve, its two controls.
pub(super) type Node = (DVec2, Option<[DVec2; 2]>);

/// A point of a smoothed stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Smoothed {
    point: DVec2,
    /// If the way to it is a curve, its two controls.
    bend: Option<[DVec2; 2]>,
    /// Which point of the stretch it is, if it is one.
    index: Option<usize>,
}

/// What is done with a stretch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Smoothing {
    /// Points are left out.
    Simplify,
    /// Curves are fitted where they fit, points left out elsewhere.
    Fit,
}

/// Smooths the strokes of all layers to within `tolerance` millimetres.
/// Strokes that end within `reach` of others end on them.
pub(super) fn smooth(
    layers: &[Strokes],
    how: Smoothing,
    tolerance: f64,
    reach: f64,
) -> Vec<Strokes> {
    let junctions = Junctions::find(layers, reach);
    map_indexed(layers.len(), |layer| {
        let strokes = &layers[layer];
        let smoothed = map_indexed(strokes.len(), |index| {
            let stroke = Stroke {
                points: strokes.get(index),
                feet: junctions.feet(layer, index),
                junctions: &junctions,
            };
            stroke.smoothed(how, tolerance)
        });
        let mut all = Strokes::default();
        for nodes in smoothed {
            all.push_curved(nodes.into_iter().map(|node| (node.point, node.bend)));
        }
        all
    })
}

/// A stroke to be smoothed.
#[derive(Clone, Copy)]
struct Stroke<'a> {
    points: &'a [DVec2],
    /// Where other strokes end on it.
    feet: &'a [Foot],
    junctions: &'a Junctions,
}

impl Stroke<'_> {
    fn smoothed(&self, how: Smoothing, tolerance: f64) -> Vec<Smoothed> {
        let last = self.points.len() - 1;
        let closed = is_closed(self.points);
        // A closed stroke is looked at from a fixed point, if it has one; to
        // be fitted, from a foot, so that there is no bend anywhere else.
        let fixed = |vertex: usize| self.is_fixed(vertex, how, closed);
        let start = if closed { (0..last).find(|&vertex| fixed(vertex)) } else { Some(0) };
        let from_foot = start.is_none() && how == Smoothing::Fit && !self.feet.is_empty();
        let ring = start.is_none() && self.feet.is_empty();
        let places = Stretch::places(self.points, self.feet, start.unwrap_or(0), from_foot);
        let mut nodes = vec![Smoothed { point: places.point(0), bend: None, index: None }];
        let stops = (1..places.len()).filter(|&place| {
            let vertex = places.vertex(place);
            let inner = start.is_some() && vertex.is_some_and(fixed);
            inner || place + 1 == places.len()
        });
        let mut from = 0;
        for stop in stops {
            let stretch = places.part(from, stop);
            let fitted = (how == Smoothing::Fit).then(|| stretch.fitted(ring, tolerance)).flatten();
            match fitted {
                Some(fitted) => nodes.extend(fitted),
                // Without a foot at its seam.
                None if from_foot => return self.smoothed(Smoothing::Simplify, tolerance),
                None => nodes.extend(stretch.simplified(tolerance)),
            }
            from = stop;
        }
        nodes
    }

    /// Whether a point stays where it is.
    fn is_fixed(&self, vertex: usize, how: Smoothing, closed: bool) -> bool {
        let (points, last) = (self.points, self.points.len() - 1);
        let before = points[if vertex == 0 { last - 1 } else { vertex - 1 }];
        let after = points[if vertex == last { 1 } else { vertex + 1 }];
        let corner = how == Smoothing::Fit
            && (closed || (0 < vertex && vertex < last))
            && is_corner(before, points[vertex], after);
        corner || self.junctions.holds(points[vertex])
    }
}

#[cfg(test)]
mod tests;
