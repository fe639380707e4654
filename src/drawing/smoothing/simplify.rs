//! Points that are within the tolerance of the chord are left out.
//!
//! Douglas and Peucker (1973), with distances from the chord as a segment, not
//! as a line. Then the tolerance holds both ways: between two points that are
//! kept, the stroke lies in the strip of that width around the chord, which is
//! convex; and as it runs from one end of the chord to the other, its nearest
//! points on the chord are all of the chord.

use super::Node;
use glam::DVec2;

/// Appends the points of `stretch` after the first that are kept.
pub(super) fn append(stretch: &[DVec2], tolerance: f64, nodes: &mut Vec<Node>) {
    let mut pending = vec![(0, stretch.len() - 1)];
    while let Some((from, to)) = pending.pop() {
        let (a, b) = (stretch[from], stretch[to]);
        let mut farthest = (tolerance, None);
        for (index, point) in stretch.iter().enumerate().take(to).skip(from + 1) {
            let distance = from_segment(*point, a, b);
            // A closed stretch has no chord: something of it is kept.
            let least = if a == b && farthest.1.is_none() { -1.0 } else { farthest.0 };
            if least < distance {
                farthest = (distance, Some(index));
            }
        }
        match farthest.1 {
            Some(index) => pending.extend([(index, to), (from, index)]),
            None => nodes.push((b, None)),
        }
    }
}

/// The distance of a point from a segment.
pub(super) fn from_segment(point: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let length = along.length_squared();
    let share = if length == 0.0 { 0.0 } else { (point - a).dot(along) / length };
    point.distance(a + along * share.clamp(0.0, 1.0))
}
