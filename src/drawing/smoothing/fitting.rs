//! Curves for stretches of gentle bends.
//!
//! A smooth curve through the points of the stretch, whose directions are
//! those of a parabola through each three of them, is what kurbo fits its
//! cubics to; they meet without a bend. Kurbo's error is an estimate, so what
//! it returns is measured against the stretch itself. If it is too far off,
//! more cubics are asked for, then the stretch is halved; both halves keep the
//! direction at the point between them. A stretch of few points, or one too
//! coarse for any smooth curve within the tolerance, is simplified instead.

use super::distance::both_ways;
use super::{Smoothed, simplify};
use glam::DVec2;
use kurbo::simplify::SimplifyBezPath;
use kurbo::{BezPath, CubicBez, PathEl, Point, fit_to_bezpath};

/// Stretches of fewer points are not made curves.
const FEWEST: usize = 4;

/// The accuracies asked for, in tolerances.
const ACCURACIES: [f64; 2] = [0.5, 0.125];

/// Appends the nodes between two of `points`, and the second of the two;
/// `ring` says that these are one point without a corner.
pub(super) fn append(
    points: &[DVec2],
    [first, last]: [usize; 2],
    ring: bool,
    tolerance: f64,
    nodes: &mut Vec<Smoothed>,
) {
    let directions = directions(&points[first..=last], ring);
    let mut pending = vec![(first, last)];
    while let Some((from, to)) = pending.pop() {
        let part = &points[from..=to];
        if part.len() < FEWEST {
            simplify::append(points, [from, to], tolerance, nodes);
            continue;
        }
        match fit(part, &directions[from - first..=to - first], tolerance) {
            Some(curves) => {
                for curve in &curves[..curves.len() - 1] {
                    nodes.push(node(curve, vector(curve.p3), None));
                }
                nodes.push(node(&curves[curves.len() - 1], points[to], Some(to)));
            }
            None => {
                let middle = (from + to) / 2;
                pending.extend([(middle, to), (from, middle)]);
            }
        }
    }
}

/// Curves within the tolerance of the part, if they are found, and if their
/// points, controls among them, are no more than those of the part.
fn fit(part: &[DVec2], directions: &[DVec2], tolerance: f64) -> Option<Vec<CubicBez>> {
    let mut smooth = BezPath::new();
    smooth.move_to(point(part[0]));
    for (pair, along) in part.windows(2).zip(directions.windows(2)) {
        let third = pair[0].distance(pair[1]) / 3.0;
        let controls = [pair[0] + along[0] * third, pair[1] - along[1] * third];
        smooth.curve_to(point(controls[0]), point(controls[1]), point(pair[1]));
    }
    let source = SimplifyBezPath::new(smooth);
    for accuracy in ACCURACIES {
        let fitted = fit_to_bezpath(&source, accuracy * tolerance);
        let mut start = point(part[0]);
        let mut curves = Vec::new();
        for element in fitted.elements() {
            if let PathEl::CurveTo(a, b, end) = *element {
                curves.push(CubicBez::new(start, a, b, end));
                start = end;
            }
        }
        let last = curves.last_mut()?;
        last.p3 = point(part[part.len() - 1]);
        let sound =
            curves.iter().all(|curve| [curve.p1, curve.p2, curve.p3].iter().all(|p| p.is_finite()));
        if part.len() <= 3 * curves.len() || !sound {
            return None;
        }
        if both_ways(part, &curves, tolerance) <= tolerance {
            return Some(curves);
        }
    }
    None
}

/// The direction of the curve at every point: that of the parabola through
/// it and its neighbours, nearer neighbours counting more.
fn directions(stretch: &[DVec2], ring: bool) -> Vec<DVec2> {
    let last = stretch.len() - 1;
    let through = |a: DVec2, b: DVec2, c: DVec2| {
        let (before, after) = (b - a, c - b);
        let (short, long) = (before.length(), after.length());
        (before / short * long + after / long * short).normalize_or_zero()
    };
    let inner = |i: usize| through(stretch[i - 1], stretch[i], stretch[i + 1]);
    let mut all: Vec<DVec2> = Vec::with_capacity(stretch.len());
    all.push(DVec2::ZERO);
    all.extend((1..last).map(inner));
    all.push(DVec2::ZERO);
    if ring {
        let seam = through(stretch[last - 1], stretch[0], stretch[1]);
        (all[0], all[last]) = (seam, seam);
    } else if last == 1 {
        all.fill((stretch[1] - stretch[0]).normalize_or_zero());
    } else {
        // The parabola's: as far to the other side of the chord.
        let mirrored = |end: DVec2, next: DVec2, direction: DVec2| {
            let chord = (next - end).normalize_or_zero();
            2.0 * chord * chord.dot(direction) - direction
        };
        all[0] = mirrored(stretch[0], stretch[1], all[1]);
        all[last] = mirrored(stretch[last - 1], stretch[last], all[last - 1]);
    }
    all
}

fn node(curve: &CubicBez, end: DVec2, index: Option<usize>) -> Smoothed {
    Smoothed { point: end, bend: Some([vector(curve.p1), vector(curve.p2)]), index }
}

fn point(vector: DVec2) -> Point {
    Point::new(vector.x, vector.y)
}

fn vector(point: Point) -> DVec2 {
    // Page coordinates are never -0.
    DVec2::new(point.x, point.y) + DVec2::ZERO
}
