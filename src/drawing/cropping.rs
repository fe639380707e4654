//! The picture window of a perspective view.
//!
//! A perspective camera sees a pyramid; what lies outside of its field of
//! view is cut off, or a line that passes close by the eye would stretch the
//! drawing without bound. The window is as high as the field of view says
//! and as wide as the page's shape asks for. Pieces are cut at its border
//! (Liang and Barsky 1984); that is a matter of the page, not of what is
//! visible, so floats do.

use super::{DrawingOptions, Paper};
use crate::view::{LinePiece, VisibleLines};
use glam::DVec2;
use std::borrow::Cow;

/// The lines as far as they lie in the window; all of them if nothing is
/// cut. O(n).
pub(super) fn crop<'a>(lines: &'a VisibleLines, options: &DrawingOptions) -> Cow<'a, VisibleLines> {
    let Some(half_height) = lines.frame.half_height else {
        return Cow::Borrowed(lines);
    };
    let window = DVec2::new(half_height * aspect(options), half_height);
    let inside = |piece: &LinePiece| piece.points.iter().all(|p| p.abs().cmple(window).all());
    if lines.pieces.iter().all(inside) {
        return Cow::Borrowed(lines);
    }
    let pieces = lines.pieces.iter().filter_map(|piece| clip(piece, window)).collect();
    let (objects, counters) = (lines.objects.clone(), lines.counters.clone());
    Cow::Owned(VisibleLines { frame: lines.frame, objects, pieces, counters })
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

/// The part of a piece within the window around the origin, if any. Points
/// that are not finite are left for the placement to refuse.
fn clip(piece: &LinePiece, window: DVec2) -> Option<LinePiece> {
    let [start, end] = piece.points;
    let along = end - start;
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for (offset, step, limit) in [(start.x, along.x, window.x), (start.y, along.y, window.y)] {
        if step == 0.0 {
            if offset.abs() > limit {
                return None;
            }
            continue;
        }
        let (one, other) = ((-limit - offset) / step, (limit - offset) / step);
        first = first.max(one.min(other));
        last = last.min(one.max(other));
    }
    if first >= last {
        return None;
    }
    let at = |t: f64, kept: usize| match t {
        // An end that is kept keeps its bits, so that strokes still join.
        0.0 | 1.0 => (piece.points[kept], piece.depth[kept]),
        _ => (start + along * t, depth_at(piece.depth, t)),
    };
    let ends = [at(first, 0), at(last, 1)];
    Some(LinePiece { points: ends.map(|end| end.0), depth: ends.map(|end| end.1), ..*piece })
}

/// The depth at an image parameter: its inverse is linear.
fn depth_at([start, end]: [f64; 2], t: f64) -> f64 {
    1.0 / ((1.0 - t) / start + t / end)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::{LineClass, LineSource};

    fn piece(points: [[f64; 2]; 2]) -> LinePiece {
        LinePiece {
            class: LineClass::Crease,
            invisibility: 0,
            points: points.map(DVec2::from_array),
            depth: [1.0, 3.0],
            object: 0,
            source: LineSource::Edge([0, 1]),
            run: 0,
        }
    }

    #[test]
    fn pieces_are_cut_at_the_border_of_the_window() {
        let window = DVec2::new(2.0, 1.0);
        let cut = |points| clip(&piece(points), window).map(|piece| piece.points);
        let across = cut([[-4.0, 0.5], [4.0, 0.5]]);
        assert_eq!(across, Some([DVec2::new(-2.0, 0.5), DVec2::new(2.0, 0.5)]));
        assert_eq!(cut([[0.0, 1.5], [1.0, 1.5]]), None);
        assert_eq!(cut([[1.5, 2.0], [4.0, 0.0]]), None);
        let inside = [[0.1, 0.2], [0.3, -0.4]];
        assert_eq!(cut(inside), Some(inside.map(DVec2::from_array)));
    }

    #[test]
    fn depth_is_linear_in_space_not_in_the_image() {
        let cut = clip(&piece([[0.0, 0.0], [4.0, 0.0]]), DVec2::new(2.0, 1.0));
        assert_eq!(cut.map(|piece| piece.depth[1]), Some(1.5));
    }
}
