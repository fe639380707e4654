//! Where a drawing is nearest to a point of the image: rounded coordinates,
//! which only say what is asked about.

use super::EndThere;
use crate::view::VisibleLines;
use glam::DVec2;

/// The piece nearest to a point; of equally near ones the least hidden, then
/// the first.
pub(super) fn piece(lines: &VisibleLines, point: DVec2) -> Option<usize> {
    let far = |&index: &usize| on(lines.pieces[index].points, point).distance_squared(point);
    let hidden = |index: usize| lines.pieces[index].invisibility;
    (0..lines.pieces.len())
        .min_by(|a, b| far(a).total_cmp(&far(b)).then_with(|| hidden(*a).cmp(&hidden(*b))))
}

/// The point of a segment that is nearest to another point.
pub(super) fn on([start, end]: [DVec2; 2], point: DVec2) -> DVec2 {
    start.lerp(end, along([start, end], point))
}

/// How far along a segment a point lies, from 0 to 1.
fn along([start, end]: [DVec2; 2], point: DVec2) -> f64 {
    let along = end - start;
    // Not a number where the segment has no length, or one beyond all floats.
    let share = (point - start).dot(along) / along.length_squared();
    if share.is_nan() { 0.5 } else { share.clamp(0.0, 1.0) }
}

/// The share of a piece's length in space, from its first end, that has the
/// image `image`.
pub(super) fn share(ends: &[EndThere; 2], image: DVec2, perspective: bool) -> f64 {
    let share = along(ends.map(|end| end.image), image);
    if !perspective {
        return share;
    }
    // The inverse of the depth is linear in a perspective image.
    let [near, far] = ends.map(|end| end.depth);
    let share = share * near / ((1.0 - share) * far + share * near);
    if share.is_nan() { 0.5 } else { share.clamp(0.0, 1.0) }
}
