//! Outlines of lines and Bezier curves, made of straight pieces.
//!
//! A curve is halved by de Casteljau's construction until its control
//! points lie close to its chord. It lies in the hull of them, so then every
//! point of it lies as close; and as the control points lie along the chord
//! too, in order, the chord's points lie as close to the curve.

use glam::DVec2;

/// Times a curve is halved at most: a million pieces.
const DEEPEST: u32 = 20;

/// Closed contours made of points, at most `tolerance` away from the curves
/// they were made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    tolerance: f64,
    contours: Vec<Vec<DVec2>>,
}

impl Outline {
    /// An empty outline; `tolerance` in the unit of the points.
    pub fn new(tolerance: f64) -> Self {
        Outline { tolerance, contours: Vec::new() }
    }

    /// The contours, each closed by the line from its last point to its first.
    pub fn contours(&self) -> impl Iterator<Item = &[DVec2]> {
        self.contours.iter().map(Vec::as_slice)
    }

    /// Begins a contour.
    pub fn move_to(&mut self, point: DVec2) {
        self.contours.push(vec![point]);
    }

    /// A straight line. Without a contour this and all curves begin one at
    /// the origin.
    pub fn line_to(&mut self, point: DVec2) {
        self.contour().push(point);
    }

    /// A quadratic curve.
    pub fn quadratic_to(&mut self, control: DVec2, end: DVec2) {
        let start = self.last();
        self.halve([start, control, end], DEEPEST);
    }

    /// A cubic curve.
    pub fn cubic_to(&mut self, first: DVec2, second: DVec2, end: DVec2) {
        let start = self.last();
        self.halve([start, first, second, end], DEEPEST);
    }

    fn contour(&mut self) -> &mut Vec<DVec2> {
        if self.contours.is_empty() {
            self.contours.push(vec![DVec2::ZERO]);
        }
        let last = self.contours.len() - 1;
        &mut self.contours[last]
    }

    fn last(&mut self) -> DVec2 {
        self.contour().last().copied().unwrap_or(DVec2::ZERO)
    }

    fn halve<const N: usize>(&mut self, curve: [DVec2; N], depth: u32) {
        if depth == 0 || is_flat(&curve, self.tolerance) {
            self.contour().push(curve[N - 1]);
            return;
        }
        let (mut left, mut right) = (curve, curve);
        // Each round of middles gives one point of either half.
        for (i, point) in left.iter_mut().enumerate().skip(1) {
            for j in 0..N - i {
                right[j] = (right[j] + right[j + 1]) * 0.5;
            }
            *point = right[0];
        }
        self.halve(left, depth - 1);
        self.halve(right, depth - 1);
    }
}

/// Whether all control points lie within `tolerance` of the chord and in
/// order along it. A curve without a chord is flat if it is a point.
fn is_flat(curve: &[DVec2], tolerance: f64) -> bool {
    let (start, end) = (curve[0], curve[curve.len() - 1]);
    let chord = end - start;
    let length = chord.length();
    if length <= tolerance {
        return curve.iter().all(|point| point.distance(start) <= tolerance);
    }
    let mut along = 0.0;
    curve.iter().all(|point| {
        let offset = *point - start;
        let forward = along <= offset.dot(chord) && offset.dot(chord) <= length * length;
        along = offset.dot(chord);
        // NaN is not flat, and halving ends all the same.
        forward && offset.perp_dot(chord).abs() <= tolerance * length
    })
}
