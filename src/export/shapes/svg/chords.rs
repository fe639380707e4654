//! Outlines as rings of straight lines, in millimetres of the page.
//!
//! Curves become chords that are nowhere farther from them than the flatness:
//! a parameter curve whose second derivative is at most `m` lies within
//! `m h^2 / 8` of its chords over steps of `h` (the error of linear
//! interpolation; for Bézier curves Wang's bound, 1984). The bound is taken
//! on the page, after all transforms. Steps are equal and points computed
//! alike from both ends, so a curve walked backwards has the same points.
//!
//! What units or transforms convert is rounded to a grid: 37.795276 pixels
//! are 10 mm, but not in doubles. What is written in millimetres is taken as
//! it is, unless a grid is asked for.

use glam::{DAffine2, DMat2, DVec2, dvec2};
use std::f64::consts::TAU;

/// The most points of a file: more would not be believed.
pub(super) const MOST_POINTS: usize = 1 << 24;

/// An arc of an ellipse from angle to angle, in user units.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arc {
    /// Its middle.
    pub(super) center: DVec2,
    /// The half axes as columns: where the angle is 0, and a quarter turn on.
    pub(super) axes: DMat2,
    /// The first angle, and how far it goes on; radians.
    pub(super) start: f64,
    /// Negative where it turns back.
    pub(super) sweep: f64,
}

/// How chords are made.
#[derive(Debug, Clone, Copy)]
pub(super) struct Accuracy {
    /// Chords are nowhere farther from their curves, mm.
    pub(super) flatness: f64,
    /// Places are multiples of this, mm; nothing for places as they are.
    pub(super) grid: Option<f64>,
}

/// Draws outlines by moves, lines and curves in user units.
#[derive(Debug)]
pub(super) struct Chords {
    to_page: DAffine2,
    accuracy: Accuracy,
    /// Points that are left.
    left: usize,
    start: DVec2,
    at: DVec2,
    ring: Vec<DVec2>,
    rings: Vec<Vec<DVec2>>,
    is_curved: bool,
}

impl Chords {
    /// Chords on a page, of at most so many points.
    pub(super) fn new(to_page: DAffine2, accuracy: Accuracy, left: usize) -> Self {
        Chords {
            to_page,
            accuracy,
            left,
            start: DVec2::ZERO,
            at: DVec2::ZERO,
            ring: Vec::new(),
            rings: Vec::new(),
            is_curved: false,
        }
    }

    /// Where the pen is, in user units.
    pub(super) fn at(&self) -> DVec2 {
        self.at
    }

    /// Begins another ring.
    pub(super) fn move_to(&mut self, to: DVec2) -> Result<(), String> {
        self.finish_ring();
        (self.start, self.at) = (to, to);
        self.push(to)
    }

    /// A straight line.
    pub(super) fn line_to(&mut self, to: DVec2) -> Result<(), String> {
        self.begin()?;
        self.at = to;
        self.push(to)
    }

    /// A quadratic Bézier curve.
    pub(super) fn quadratic_to(&mut self, control: DVec2, to: DVec2) -> Result<(), String> {
        self.begin()?;
        let [a, b, c] = [self.at, control, to].map(|point| self.to_page.transform_point2(point));
        let steps = self.steps(2.0 * (a - 2.0 * b + c).length())?;
        for step in 1..steps {
            let [s, t] = shares(step, steps);
            self.push_on_page((s * s * a + t * t * c) + 2.0 * s * t * b)?;
        }
        self.at = to;
        self.push(to)
    }

    /// A cubic Bézier curve.
    pub(super) fn cubic_to(&mut self, [b, c]: [DVec2; 2], to: DVec2) -> Result<(), String> {
        self.begin()?;
        let [a, b, c, d] = [self.at, b, c, to].map(|point| self.to_page.transform_point2(point));
        let bend = (a - 2.0 * b + c).length().max((b - 2.0 * c + d).length());
        let steps = self.steps(6.0 * bend)?;
        for step in 1..steps {
            let [s, t] = shares(step, steps);
            let ends = s * s * s * a + t * t * t * d;
            self.push_on_page(ends + (3.0 * s * s * t * b + 3.0 * s * t * t * c))?;
        }
        self.at = to;
        self.push(to)
    }

    /// An arc of an ellipse, whose last point is known.
    pub(super) fn arc_to(&mut self, arc: &Arc, to: DVec2) -> Result<(), String> {
        self.begin()?;
        let axes = self.to_page.matrix2 * arc.axes;
        // The longer half axis on the page: the greater singular value.
        let (sum, product) =
            (axes.x_axis.length_squared() + axes.y_axis.length_squared(), axes.determinant());
        let radius = ((sum + (sum * sum - 4.0 * product * product).max(0.0).sqrt()) / 2.0).sqrt();
        let steps = self.steps(arc.sweep * arc.sweep * radius)?;
        for step in 1..steps {
            let [s, t] = shares(step, steps);
            let (sin, cos) = (s * arc.start + t * (arc.start + arc.sweep)).sin_cos();
            self.push(arc.center + arc.axes * dvec2(cos, sin))?;
        }
        self.at = to;
        self.push(to)
    }

    /// A whole ellipse with axes along the coordinates, from greatest x on.
    pub(super) fn ellipse(&mut self, center: DVec2, radii: DVec2) -> Result<(), String> {
        let quarters = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y];
        self.move_to(center + radii * quarters[0])?;
        for quarter in 0..4 {
            let arc = Arc {
                center,
                axes: DMat2::from_diagonal(radii),
                start: TAU / 4.0 * quarter as f64,
                sweep: TAU / 4.0,
            };
            self.arc_to(&arc, center + radii * quarters[(quarter + 1) % 4])?;
        }
        self.close();
        Ok(())
    }

    /// Goes back to where the ring began.
    pub(super) fn close(&mut self) {
        self.finish_ring();
        self.at = self.start;
    }

    /// Whether some line was curved, and all rings.
    pub(super) fn finish(mut self) -> (bool, Vec<Vec<DVec2>>) {
        self.finish_ring();
        (self.is_curved, self.rings)
    }

    /// What follows a closed ring without a move starts where that did.
    fn begin(&mut self) -> Result<(), String> {
        match self.ring.is_empty() {
            true => self.push(self.start),
            false => Ok(()),
        }
    }

    fn finish_ring(&mut self) {
        let mut ring = std::mem::take(&mut self.ring);
        if ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        if !ring.is_empty() {
            self.rings.push(ring);
        }
    }

    /// How many steps a curve takes whose second derivative over its whole
    /// length is at most `bend`.
    fn steps(&mut self, bend: f64) -> Result<usize, String> {
        self.is_curved = true;
        let steps = (bend / (8.0 * self.accuracy.flatness)).sqrt().ceil().max(1.0);
        match steps <= self.left as f64 {
            true => Ok(steps as usize),
            false => Err(self.too_many()),
        }
    }

    fn push(&mut self, point: DVec2) -> Result<(), String> {
        self.push_on_page(self.to_page.transform_point2(point))
    }

    fn push_on_page(&mut self, place: DVec2) -> Result<(), String> {
        if !place.is_finite() {
            return Err("a place beyond the range of numbers, expected smaller ones".to_owned());
        }
        if self.left == 0 {
            return Err(self.too_many());
        }
        self.left -= 1;
        let place = match self.accuracy.grid {
            Some(grid) => dvec2(on_grid(place.x, grid), on_grid(place.y, grid)),
            None => place,
        };
        self.ring.push(place);
        Ok(())
    }

    fn too_many(&self) -> String {
        let flatness = self.accuracy.flatness;
        format!(
            "outlines of more than {MOST_POINTS} points with curves within {flatness} mm, expected \
             fewer or shorter curves, or a greater flatness"
        )
    }
}

/// How much the first and the last point count at a step.
fn shares(step: usize, steps: usize) -> [f64; 2] {
    let count = steps as f64;
    [(steps - step) as f64 / count, step as f64 / count]
}

/// The nearest multiple of a grid. Where one is a whole number of grid steps,
/// it is the double nearest to the decimal number that is meant.
pub(super) fn on_grid(value: f64, grid: f64) -> f64 {
    let per_unit = (1.0 / grid).round();
    let is_whole = 1.0 <= per_unit && (per_unit * grid - 1.0).abs() < 1e-9;
    let steps = if is_whole { value * per_unit } else { value / grid };
    // So large a number has no digits below the grid.
    if 2f64.powi(52) <= steps.abs() {
        return value;
    }
    let steps = steps.round() + 0.0;
    if is_whole { steps / per_unit } else { steps * grid }
}
