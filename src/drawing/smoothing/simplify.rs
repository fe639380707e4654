//! Points that are within the tolerance of the chord are left out.
//!
//! Douglas and Peucker (1973), with distances from the chord as a segment, not
//! as a line. Then the tolerance holds both ways: between two points that are
//! kept, the stroke lies in the strip of that width around the chord, which is
//! convex; and as it runs from one end of the chord to the other, its nearest
//! points on the chord are all of the chord.

use super::Smoothed;
use glam::DVec2;

/// Appends the points between two of `points` that are kept, and the second
/// of the two.
pub(super) fn append(
    points: &[DVec2],
    [first, last]: [usize; 2],
    tolerance: f64,
    nodes: &mut Vec<Smoothed>,
) {
    let mut pending = vec![(first, last)];
    while let Some((from, to)) = pending.pop() {
        let (a, b) = (points[from], points[to]);
        let mut farthest = (tolerance, None);
        for (index, point) in points.iter().enumerate().take(to).skip(from + 1) {
            let distance = from_segment(*point, a, b);
            // A closed stretch has no chord: something of it is kept.
            let least = if a == b && farthest.1.is_none() { -1.0 } else { farthest.0 };
            if least < distance {
                farthest = (distance, Some(index));
            }
        }
        match farthest.1 {
            Some(index) => pending.extend([(index, to), (from, index)]),
            None => nodes.push(Smoothed { point: b, bend: None, index: Some(to) }),
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
