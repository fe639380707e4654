//! Drawings compared as sets of points of the page, whatever their lines
//! are called and wherever they are cut.

use glam::DVec2;
use umriss::view::VisibleLines;

/// The visible pieces' ends.
pub(crate) fn visible_segments(lines: &VisibleLines) -> Vec<[DVec2; 2]> {
    lines.pieces.iter().filter(|piece| piece.is_visible()).map(|piece| piece.points).collect()
}

/// Panics unless the visible parts of two drawings cover the same points.
pub(crate) fn assert_same_picture(a: &VisibleLines, b: &VisibleLines, what: &str) {
    let [a, b] = [a, b].map(visible_segments);
    let length =
        |list: &[[DVec2; 2]]| list.iter().map(|[from, to]| from.distance(*to)).sum::<f64>();
    let (x, y) = (length(&a), length(&b));
    for (list, other) in [(&a, &b), (&b, &a)] {
        for &[from, to] in list {
            for i in 1..32 {
                let point = from.lerp(to, f64::from(i) / 32.0);
                let covered = other.iter().any(|&segment| distance(point, segment) < 1e-9);
                assert!(covered, "{what}: {point} of {from} to {to} is drawn once only");
            }
        }
    }
    // Nothing is drawn twice either.
    assert!((x - y).abs() < 1e-8 * (1.0 + x), "{what}: lengths {x} and {y}");
}

/// The distance of a point from a segment.
pub(crate) fn distance(point: DVec2, [from, to]: [DVec2; 2]) -> f64 {
    let along = to - from;
    if along == DVec2::ZERO {
        return point.distance(from);
    }
    let t = ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    point.distance(from.lerp(to, t))
}
