//! Pictures end at a window: the one asked for, or the field of view.
//!
//! A perspective camera sees a pyramid; what lies outside of its field of
//! view is cut off, or a line that passes close by the eye would stretch the
//! drawing without bound. That window is as high as the field of view says
//! and as wide as the page's shape asks for. A window that is asked for takes
//! its place, and cuts parallel views as well.
//!
//! Where a piece enters and leaves is Liang and Barsky's question (1984),
//! asked without their division: the border that a piece crosses later is
//! found by the side of the piece on which the corner of the two borders
//! lies, and that side is exact (Shewchuk 1997). The point of the cut lies on
//! its border bit for bit; its other coordinate is worked out in pairs of
//! doubles and rounded once. So windows that share a border share their cuts,
//! and the tiles of a picture, laid side by side, are the picture.

use super::{DrawingError, DrawingOptions, Paper, Window};
use crate::view::{Frame, ImageRegions, LinePiece, Projection, VisibleLines};
use glam::DVec2;
use robust::{Coord, orient2d};
use std::borrow::Cow;

impl DrawingOptions {
    /// The window at which a drawing ends that is seen in this frame: the one
    /// asked for, or a perspective one's field of view.
    pub fn window_in(&self, frame: &Frame) -> Option<Window> {
        self.window.or_else(|| {
            let half_height = frame.half_height?;
            Some(Window::around_zero(DVec2::new(half_height * aspect(self), half_height)))
        })
    }
}

impl Window {
    /// Whether something of a piece lies in the window.
    pub fn shows(&self, piece: &LinePiece, projection: Projection) -> bool {
        clip(piece, self, projection).is_some()
    }
}

/// The lines as far as they lie in the window; all of them if nothing is
/// cut. There may be none if `regions`, which are drawn too, reach into the
/// window. O(n).
///
/// # Errors
///
/// If a window was asked for in which there is nothing.
pub(super) fn crop<'a>(
    lines: &'a VisibleLines,
    regions: Option<&ImageRegions>,
    options: &DrawingOptions,
) -> Result<Cow<'a, VisibleLines>, DrawingError> {
    let Some(window) = options.window_in(&lines.frame) else {
        return Ok(Cow::Borrowed(lines));
    };
    let inside = |piece: &LinePiece| piece.points.iter().all(|point| window.holds(*point));
    if lines.pieces.iter().all(inside) {
        return Ok(Cow::Borrowed(lines));
    }
    let projection = lines.frame.projection;
    let pieces: Vec<_> =
        lines.pieces.iter().filter_map(|piece| clip(piece, &window, projection)).collect();
    let is_filled = regions.is_some_and(|regions| !regions.regions.is_empty());
    if pieces.is_empty() && !is_filled && options.window.is_some() {
        return Err(nothing_of(lines.pieces.iter().flat_map(|piece| piece.points)));
    }
    let (objects, counters) = (lines.objects.clone(), lines.counters.clone());
    Ok(Cow::Owned(VisibleLines { frame: lines.frame, objects, pieces, counters }))
}

/// The refusal of a window in which there is nothing of these points.
pub(super) fn nothing_of(points: impl Iterator<Item = DVec2> + Clone) -> DrawingError {
    DrawingError::EmptyWindow {
        low: points.clone().fold(DVec2::INFINITY, DVec2::min).to_array(),
        high: points.fold(DVec2::NEG_INFINITY, DVec2::max).to_array(),
    }
}

/// Width over height of the room on the page; that of A4 on tight paper.
fn aspect(options: &DrawingOptions) -> f64 {
    let sheet = match options.paper {
        Paper::Tight => Paper::A4,
        sheet => sheet,
    };
    let sheet = if options.landscape { sheet.landscape() } else { sheet };
    let Paper::Sheet { width, height } = sheet else { return 1.0 };
    let margin = 2.0 * options.margin.millimetres();
    let (width, height) = (width - margin, height - margin);
    if width > 0.0 && height > 0.0 { width / height } else { 1.0 }
}

/// A border of the window: the axis it is perpendicular to, and where.
#[derive(Debug, Clone, Copy)]
struct Border {
    axis: usize,
    at: f64,
}

/// The part of a piece within the window, if any. Points that are not finite
/// are left for the placement to refuse.
pub(super) fn clip(
    piece: &LinePiece,
    window: &Window,
    projection: Projection,
) -> Option<LinePiece> {
    let [start, end] = piece.points;
    if !(start.is_finite() && end.is_finite()) {
        return Some(*piece);
    }
    let borders = crossed(piece.points, window)?;
    let end = |end: usize| match borders[end] {
        Some(border) => (on_border(piece.points, border), depth_at(piece, border, projection)),
        None => (piece.points[end], piece.depth[end]),
    };
    let ends = [end(0), end(1)];
    let points = ends.map(|end| end.0);
    (points[0] != points[1]).then(|| LinePiece { points, depth: ends.map(|end| end.1), ..*piece })
}

/// The part of a segment within the window, if any.
pub(super) fn clip_segment(points: [DVec2; 2], window: &Window) -> Option<[DVec2; 2]> {
    let borders = crossed(points, window)?;
    let end = |end: usize| borders[end].map_or(points[end], |border| on_border(points, border));
    let ends = [end(0), end(1)];
    (ends[0] != ends[1]).then_some(ends)
}

/// The borders at which a line enters the window and leaves it, as far as it
/// does; nothing if it is never inside.
fn crossed(points: [DVec2; 2], window: &Window) -> Option<[Option<Border>; 2]> {
    let [start, end] = points;
    let (mut enter, mut leave) = (None, None);
    for axis in 0..2 {
        let (low, high) = (window.low()[axis], window.high()[axis]);
        if start[axis].max(end[axis]) < low || high < start[axis].min(end[axis]) {
            return None;
        }
        if let Some(at) = beyond(start[axis], low, high) {
            let border = Border { axis, at };
            enter = Some(enter.map_or(border, |other| later(points, border, other)));
        }
        if let Some(at) = beyond(end[axis], low, high) {
            let border = Border { axis, at };
            leave = Some(leave.map_or(border, |other| earlier(points, border, other)));
        }
    }
    match (enter, leave) {
        (Some(enter), Some(leave)) if !comes_first(points, enter, leave) => None,
        both => Some(both.into()),
    }
}

/// The border beyond which a coordinate lies.
fn beyond(coordinate: f64, low: f64, high: f64) -> Option<f64> {
    if coordinate < low {
        Some(low)
    } else if high < coordinate {
        Some(high)
    } else {
        None
    }
}

fn later(points: [DVec2; 2], one: Border, other: Border) -> Border {
    if comes_first(points, one, other) { other } else { one }
}

fn earlier(points: [DVec2; 2], one: Border, other: Border) -> Border {
    if comes_first(points, other, one) { other } else { one }
}

/// Whether the line crosses `one` strictly before `other`.
fn comes_first([start, end]: [DVec2; 2], one: Border, other: Border) -> bool {
    if one.axis == other.axis {
        // It runs across both, so the first is the one nearer to its start.
        return (start[one.axis] < end[one.axis]) == (one.at < other.at) && one.at != other.at;
    }
    let mut corner = DVec2::ZERO;
    (corner[one.axis], corner[other.axis]) = (one.at, other.at);
    // Above, in the sense of the axis of `other`, if the line is still below
    // the corner where it crosses `one`.
    let side = orient2d(coord(start), coord(end), coord(corner));
    let turned = if one.axis == 0 { side } else { -side };
    let along = (end - start).signum();
    0.0 < turned * along[one.axis] * along[other.axis]
}

fn coord(point: DVec2) -> Coord<f64> {
    Coord { x: point.x, y: point.y }
}

/// The point of a line on a border that it crosses.
fn on_border([start, end]: [DVec2; 2], border: Border) -> DVec2 {
    let (axis, other) = (border.axis, 1 - border.axis);
    let mut point = DVec2::ZERO;
    point[axis] = border.at;
    let value = on_line([start[axis], end[axis]], [start[other], end[other]], border.at);
    point[other] = value.clamp(start[other].min(end[other]), start[other].max(end[other])) + 0.0;
    point
}

/// The depth of a piece on a border.
fn depth_at(piece: &LinePiece, border: Border, projection: Projection) -> f64 {
    let [start, end] = piece.points.map(|point| point[border.axis]);
    let share = (border.at - start) / (end - start);
    let [from, to] = piece.depth;
    match projection {
        Projection::Orthographic => from + (to - from) * share,
        // The inverse of a depth is linear in the image.
        Projection::Perspective => 1.0 / ((1.0 - share) / from + share / to),
    }
}

/// The y at which the line through (x0, y0) and (x1, y1) reaches `x`, worked
/// out in pairs of doubles.
fn on_line([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], x: f64) -> f64 {
    let (offset, run, rise) = (difference(x, x0), difference(x1, x0), difference(y1, y0));
    let product = offset.0 * rise.0;
    let rest = offset.0.mul_add(rise.0, -product) + offset.0 * rise.1 + offset.1 * rise.0;
    let quotient = product / run.0;
    let remainder = (-quotient).mul_add(run.0, product) - quotient * run.1 + rest;
    let sum = difference(y0, -quotient);
    sum.0 + (sum.1 + remainder / run.0)
}

/// a - b as a double and what it lacks (Knuth's two-sum).
fn difference(a: f64, b: f64) -> (f64, f64) {
    let rounded = a - b;
    let part = rounded - a;
    (rounded, (a - (rounded - part)) - (b + part))
}

#[cfg(test)]
mod tests;
