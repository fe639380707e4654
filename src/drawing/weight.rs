//! Lines that are wider in front than behind, or wider for one class than
//! for another.
//!
//! Elber (1995) lets the width of a line follow its depth. A page has pens,
//! and a pen has one width, so the range of widths is cut into equal steps:
//! a piece is cut where its depth comes to the next step, and each step has
//! a layer of its own. A step draws the width at its middle, so no width is
//! off by more than half a step. With depth d from 0 (the nearest point of
//! all visible lines) to 1 (the farthest):
//!
//! ```text
//!   wanted   near + (far - near) d
//!   drawn    near + (far - near) (k + 1/2) / n    for k / n <= d <= (k + 1) / n
//! ```
//!
//! Depth is linear along the image of a line in parallel views, its inverse
//! in perspective ones. Hidden lines have the width of hidden lines.

use super::DrawingError;
use super::length::{parse_number, split_unit};
use crate::run::{concat_map, map_chunks};
use crate::view::{LineClass, LinePiece, Projection, VisibleLines};
use std::str::FromStr;

/// The largest error of a width unless a number of steps is asked for, mm.
const ERROR: f64 = 0.05;

/// The most steps.
const MOST: u32 = 64;

/// Pieces that one task cuts.
const PART: usize = 1 << 13;

/// What the width of a line follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum WeightBy {
    /// How far it is away.
    #[default]
    Depth,
    /// Its class: outlines, then folds and other lines, then mesh edges.
    Class,
}

/// Reads `depth`, `class`.
impl FromStr for WeightBy {
    type Err = DrawingError;

    fn from_str(text: &str) -> Result<Self, DrawingError> {
        match text {
            "depth" => Ok(WeightBy::Depth),
            "class" => Ok(WeightBy::Class),
            _ => Err(DrawingError::Choice { word: text.to_owned(), expected: "depth or class" }),
        }
    }
}

/// Widths from one end of a range to the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weight {
    /// Width of the nearest lines, or of outlines, mm.
    pub near: f64,
    /// Width of the farthest lines, or of mesh edges, mm.
    pub far: f64,
    /// What the width follows.
    pub by: WeightBy,
    /// The number of widths by depth; without one, as few as keep every
    /// width within 0.05 mm.
    pub steps: Option<u32>,
}

/// Reads `0.7..0.18mm`: by depth, near and far.
impl FromStr for Weight {
    type Err = DrawingError;

    fn from_str(text: &str) -> Result<Self, DrawingError> {
        let refuse = || DrawingError::Weight(text.to_owned());
        let (near, far) = text.trim().split_once("..").ok_or_else(refuse)?;
        let ((near, own), (far, unit)) = (split_unit(near.trim()), split_unit(far.trim()));
        let unit = unit.ok_or_else(refuse)?;
        let near = parse_number(near).ok_or_else(refuse)? * own.unwrap_or(unit);
        let far = parse_number(far).ok_or_else(refuse)? * unit;
        Ok(Weight { near, far, by: WeightBy::Depth, steps: None })
    }
}

impl Weight {
    /// The widths of all steps, mm, from near to far.
    pub fn widths(&self) -> Vec<f64> {
        let steps = match self.by {
            WeightBy::Class => {
                return vec![self.near, 0.5 * (self.near + self.far), self.far];
            }
            WeightBy::Depth => self.steps.unwrap_or_else(|| {
                let least = ((self.near - self.far).abs() / (2.0 * ERROR) - 1e-9).ceil();
                least as u32
            }),
        };
        let steps = steps.clamp(1, MOST);
        let at = |step: u32| (f64::from(step) + 0.5) / f64::from(steps);
        (0..steps).map(|step| self.near + (self.far - self.near) * at(step)).collect()
    }
}

/// Which step each visible piece of a drawing has.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Weights {
    pub(super) widths: Vec<f64>,
    by: WeightBy,
    /// Depths of the nearest and the farthest visible point.
    range: [f64; 2],
    perspective: bool,
}

impl Weights {
    /// For all visible lines of a drawing, whatever part of it is drawn.
    pub(super) fn new(lines: &VisibleLines, weight: &Weight) -> Self {
        let visible = lines.pieces.iter().filter(|piece| piece.is_visible());
        let (low, high) = visible
            .flat_map(|piece| piece.depth)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), d| (low.min(d), high.max(d)));
        Weights {
            widths: weight.widths(),
            by: weight.by,
            range: [low, high],
            perspective: lines.frame.projection == Projection::Perspective,
        }
    }

    /// The step of a visible piece that [`Self::split`] has cut.
    pub(super) fn step(&self, piece: &LinePiece) -> usize {
        match self.by {
            WeightBy::Depth => self.step_at(0.5 * piece.depth[0] + 0.5 * piece.depth[1]),
            WeightBy::Class => match piece.class {
                LineClass::Contour | LineClass::Boundary | LineClass::NonManifold => 0,
                LineClass::Crease | LineClass::Intersection | LineClass::Line => 1,
                LineClass::Mesh => 2,
            },
        }
    }

    fn step_at(&self, depth: f64) -> usize {
        let [low, high] = self.range;
        let share = (depth - low) / (high - low);
        // Not a number where all is equally far: the saturating cast is 0.
        ((share * self.widths.len() as f64) as usize).min(self.widths.len() - 1)
    }

    /// The depth at which step `step` begins.
    fn start(&self, step: usize) -> f64 {
        let [low, high] = self.range;
        low + (high - low) * (step as f64 / self.widths.len() as f64)
    }

    /// The lines with visible ones cut wherever their step changes.
    pub(super) fn split(&self, lines: &VisibleLines) -> VisibleLines {
        let parts = map_chunks(lines.pieces.len(), PART, |part| {
            let mut pieces = Vec::with_capacity(part.len());
            for piece in &lines.pieces[part] {
                match self.by {
                    WeightBy::Depth if piece.is_visible() => self.split_piece(piece, &mut pieces),
                    _ => pieces.push(*piece),
                }
            }
            pieces
        });
        let parts: Vec<&[LinePiece]> = parts.iter().map(Vec::as_slice).collect();
        let pieces = concat_map(&parts, |_, piece| *piece);
        let (objects, counters) = (lines.objects.clone(), lines.counters.clone());
        VisibleLines { frame: lines.frame, objects, pieces, counters }
    }

    fn split_piece(&self, piece: &LinePiece, pieces: &mut Vec<LinePiece>) {
        let [from, to] = piece.depth.map(|depth| self.step_at(depth));
        let steps: Vec<usize> =
            if from <= to { (from + 1..=to).collect() } else { (to + 1..=from).rev().collect() };
        let mut rest = *piece;
        for depth in steps.into_iter().map(|step| self.start(step)) {
            let share = self.share(piece.depth, depth);
            if 0.0 < share && share < 1.0 {
                let point = piece.points[0].lerp(piece.points[1], share);
                let first = LinePiece {
                    points: [rest.points[0], point],
                    depth: [rest.depth[0], depth],
                    ..rest
                };
                rest = LinePiece {
                    points: [point, rest.points[1]],
                    depth: [depth, rest.depth[1]],
                    ..rest
                };
                pieces.push(first);
            }
        }
        pieces.push(rest);
    }

    /// Where along the image of a piece it has this depth.
    fn share(&self, [from, to]: [f64; 2], depth: f64) -> f64 {
        if self.perspective {
            (1.0 / depth - 1.0 / from) / (1.0 / to - 1.0 / from)
        } else {
            (depth - from) / (to - from)
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn no_width_is_off_by_more_than_the_error() {
        let weight: Weight = "0.7..0.18mm".parse().unwrap();
        let widths = weight.widths();
        assert_eq!(widths.len(), 6);
        for i in 0..=1000 {
            let depth = f64::from(i) / 1000.0;
            let wanted = 0.7 + (0.18 - 0.7) * depth;
            let step = ((depth * 6.0) as usize).min(5);
            assert!((widths[step] - wanted).abs() <= ERROR);
        }
        assert!(widths.is_sorted_by(|a, b| a > b));
    }

    #[test]
    fn a_range_of_widths_is_read_with_its_unit() {
        let read = |text: &str| text.parse::<Weight>().map(|w| [w.near, w.far]);
        assert_eq!(read("1mm..0.2mm"), Ok([1.0, 0.2]));
        assert_eq!(read("0.1 .. 0.02cm"), Ok([1.0, 0.2]));
        for text in ["0.7", "0.7..0.2", "..1mm", "1mm..", "-1..1mm"] {
            assert_eq!(read(text), Err(DrawingError::Weight(text.to_owned())), "{text}");
        }
    }
}
