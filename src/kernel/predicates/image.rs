//! Position in the image, decided on symbolic points and lines.
//!
//! Three polynomials decide all that an arrangement of lines needs. With the
//! triples of a [`Chart`]:
//!
//! ```text
//!   beside(l, p)  = sign l . p            + : p is left of l
//!   bend(l, m)    = sign front . (l x m)  + : m turns left of l
//!   sweep(p, q)   = sign key . (p x q)    Less : p is swept before q
//! ```
//!
//! A crossing is a cross product itself, so `beside` of a crossing is the
//! determinant of three lines, zero where they are concurrent. In the plane
//! the degrees are 2 and 4, 2, and from 1 to 5; from a point 3 and 6, 5, and
//! from 3 to 9. (Sweeps with exact order of crossings: Bentley and Ottmann
//! 1979; Boissonnat and Preparata 2000 for their degrees.)

use super::chart::Bits;
use super::{Chart, Formula, ImageLine, ImagePoint, Points, Policy, Predicate, Predicates};
use crate::kernel::numbers::{
    BigInteger, Dyadic, Filtered, Ring, Sign, SmallInteger, cross, dot, scale_by_power_of_two,
};
use std::cmp::Ordering;

/// A point of the image in floats, near enough to decide most questions.
#[derive(Debug, Clone, Copy)]
pub struct Approximation {
    /// Right and up; in the plane the coordinates of the point, in units of
    /// its [`Points`].
    pub place: [f64; 2],
    /// A bound of the error of either, or infinity.
    pub error: f64,
}

impl Approximation {
    /// Compares two points in the order of [`Predicates::sweep`], if the floats
    /// are good enough.
    #[inline]
    pub fn compare(&self, other: &Self) -> Option<Ordering> {
        // The sum rounds, so a little is added to it.
        let error = (self.error + other.error) * 1.000_001;
        for i in 0..2 {
            let difference = self.place[i] - other.place[i];
            if difference.abs() > error {
                return Some(if difference < 0.0 { Ordering::Less } else { Ordering::Greater });
            }
            if error != 0.0 {
                return None;
            }
        }
        Some(Ordering::Equal)
    }
}

/// `l . p`.
struct Beside<'c>(&'c Chart, ImageLine, ImagePoint);

impl Formula for Beside<'_> {
    const PREDICATE: Predicate = Predicate::Beside;

    fn degree(&self) -> u32 {
        6
    }

    fn bits(&self, spread: u32) -> u32 {
        let chart = self.0.of_spread(spread);
        chart.line_bits(self.1).dot(chart.point_bits(self.2))
    }

    #[inline(always)]
    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        dot(self.0.line(points, self.1), self.0.point(points, self.2))
    }
}

/// `front . (l x m)`.
struct Bend<'c>(&'c Chart, [ImageLine; 2]);

impl Formula for Bend<'_> {
    const PREDICATE: Predicate = Predicate::Bend;

    fn degree(&self) -> u32 {
        5
    }

    fn bits(&self, spread: u32) -> u32 {
        let chart = self.0.of_spread(spread);
        let [first, second] = self.1.map(|line| chart.line_bits(line));
        first.cross(second).dot(chart.key_bits())
    }

    #[inline(always)]
    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let [first, second] = self.1.map(|line| self.0.line::<R>(points, line));
        if self.0.is_flat() {
            let ([a, b, _], [c, d, _]) = (first, second);
            return a * d - b * c;
        }
        dot(self.0.front(points), cross(first, second))
    }
}

/// `key . (p x q)`.
struct Sweep<'c>(&'c Chart, [ImagePoint; 2], usize);

impl Formula for Sweep<'_> {
    const PREDICATE: Predicate = Predicate::Sweep;

    fn degree(&self) -> u32 {
        9
    }

    fn bits(&self, spread: u32) -> u32 {
        let chart = self.0.of_spread(spread);
        let [first, second] = self.1.map(|point| chart.point_bits(point));
        first.cross(second).dot(chart.key_bits())
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let [first, second] = self.1.map(|point| self.0.point::<R>(points, point));
        let [right, up] = self.0.sweep_keys::<R>(points);
        dot(if self.2 == 0 { right } else { up }, cross(first, second))
    }
}

/// `key . l`: which way a line runs through the sweep.
struct Run<'c>(&'c Chart, ImageLine, usize);

impl Formula for Run<'_> {
    const PREDICATE: Predicate = Predicate::Sweep;

    fn degree(&self) -> u32 {
        3
    }

    fn bits(&self, spread: u32) -> u32 {
        let chart = self.0.of_spread(spread);
        chart.line_bits(self.1).dot(chart.key_bits())
    }

    fn evaluate<R: Ring>(&self, points: &Points) -> R {
        let [right, up] = self.0.sweep_keys::<R>(points);
        dot(if self.2 == 0 { right } else { up }, self.0.line(points, self.1))
    }
}

impl<P: Policy> Predicates<'_, P> {
    /// On which side of a line does a point of the image lie? Positive is
    /// left. Points that are named as lying on the line cost nothing.
    #[inline]
    pub fn beside(&self, chart: &Chart, line: ImageLine, point: ImagePoint) -> Sign {
        match (line, point) {
            (ImageLine::Edge([a, b]), ImagePoint::Vertex(x)) => {
                if x == a || x == b {
                    Sign::Zero
                } else {
                    self.side(a, b, x)
                }
            }
            (_, ImagePoint::Crossing([l, m])) if line == l || line == m => Sign::Zero,
            _ => self.decide(&Beside(chart, line, point)),
        }
    }

    /// Which way the second line turns from the first: positive is left,
    /// zero if they are parallel in the image.
    #[inline]
    pub fn bend(&self, chart: &Chart, first: ImageLine, second: ImageLine) -> Sign {
        if first == second { Sign::Zero } else { self.decide(&Bend(chart, [first, second])) }
    }

    /// Compares two points of the image by the order in which a line that
    /// moves to the right meets them, from bottom to top where it meets both
    /// at once. Equal if they are one point. Both must lie in front of the eye.
    pub fn sweep(&self, chart: &Chart, first: ImagePoint, second: ImagePoint) -> Ordering {
        if first == second {
            return Ordering::Equal;
        }
        let key = |key| -self.decide(&Sweep(chart, [first, second], key));
        key(0).or_else_sign(|| key(1)).into()
    }

    /// Whether a line runs the way of the sweep: right, or straight up.
    pub fn runs_forward(&self, chart: &Chart, line: ImageLine) -> bool {
        let key = |key| self.decide(&Run(chart, line, key));
        key(0).or_else_sign(|| key(1)) == Sign::Positive
    }

    /// A point in floats, with a bound of the error.
    #[inline]
    pub fn approximate(&self, chart: &Chart, point: ImagePoint) -> Approximation {
        let points = self.points();
        if let (true, ImagePoint::Vertex(vertex)) = (chart.is_flat(), point) {
            let [x, y, _] = points.floats(vertex);
            return Approximation { place: [x, y], error: 0.0 };
        }
        let bits = chart.point_bits(point).dot(two_keys(chart));
        if !points.floats_hold(bits) {
            return Approximation { place: [0.0; 2], error: f64::INFINITY };
        }
        let triple = chart.point::<Filtered>(points, point);
        let (parts, weight) = if chart.is_flat() {
            ([triple[0], triple[1]], triple[2])
        } else {
            let parts = chart.coordinates::<Filtered>(points).map(|f| dot(f, triple));
            (parts, dot(chart.front(points), triple))
        };
        let origin = chart.origin(points);
        let (mut place, mut error) = ([0.0; 2], 0.0_f64);
        for (i, part) in parts.into_iter().enumerate() {
            let quotient = part.value() / weight.value();
            let least = weight.value() - weight.bound();
            // The quotient and the sum round once each.
            let off = (part.bound() + quotient.abs() * weight.bound()) / least;
            place[i] = quotient + origin[i];
            let rounding = (quotient.abs() + place[i].abs()) * f64::EPSILON;
            error = error.max(if least > 0.0 { off * 1.001 + rounding } else { f64::INFINITY });
        }
        if error.is_nan() {
            error = f64::INFINITY;
        }
        Approximation { place, error }
    }

    /// The coordinates of a point as numerators and their common positive
    /// denominator, exactly: x and y in the plane; else right and up in the
    /// chart. Times the power of two of [`Self::ratio_exponent`].
    pub fn ratio(&self, chart: &Chart, point: ImagePoint) -> ([BigInteger; 2], BigInteger) {
        ratio(chart, self.points(), point)
    }

    /// The exponent of the unit of [`Self::ratio`] in the plane.
    pub fn ratio_exponent(&self) -> i32 {
        self.points().integer_exponent()
    }

    /// The coordinates of [`Self::ratio`] in floats, each off by less than
    /// one unit in its last place and exact where a float has the value; in
    /// the plane, those of the input.
    pub fn round(&self, chart: &Chart, point: ImagePoint) -> [f64; 2] {
        let points = self.points();
        let bits = chart.point_bits(point).dot(two_keys(chart)) + points.spread();
        let exponent = if chart.is_flat() { self.ratio_exponent() } else { 0 };
        let width = if points.is_narrow() { bits } else { u32::MAX };
        let quotients = match width {
            0..=255 => quotients::<4>(chart, points, point),
            256..=383 => quotients::<6>(chart, points, point),
            384..=511 => quotients::<8>(chart, points, point),
            _ => {
                let (parts, weight) = ratio::<Dyadic>(chart, points, point);
                return parts.map(|part| Dyadic::scaled_ratio(&part, &weight, exponent));
            }
        };
        quotients.map(|quotient| scale_by_power_of_two(quotient, exponent.into()))
    }
}

fn quotients<const N: usize>(chart: &Chart, points: &Points, point: ImagePoint) -> [f64; 2] {
    let (parts, weight) = ratio::<SmallInteger<N>>(chart, points, point);
    parts.map(|part| SmallInteger::ratio(&part, &weight))
}

fn ratio<R: Ring>(chart: &Chart, points: &Points, point: ImagePoint) -> ([R; 2], R) {
    let triple = chart.point::<R>(points, point);
    if chart.is_flat() && !points.is_empty() {
        // The coordinates are members of the triple, but for the origin.
        let ([right, up, weight], [x, y, _]) = (triple, points.vertex::<R>(0));
        return ([right + x * weight.clone(), up + y * weight.clone()], weight);
    }
    let weight = dot(chart.front(points), triple.clone());
    (chart.coordinates::<R>(points).map(|f| dot(f, triple.clone())), weight)
}

/// The bits of a functional for coordinates: a product of two directions.
fn two_keys(chart: &Chart) -> Bits {
    let key = chart.key_bits();
    key.cross(key)
}

impl Sign {
    /// This sign, or the one that `other` finds where this one is zero.
    fn or_else_sign(self, other: impl FnOnce() -> Sign) -> Sign {
        if self.is_zero() { other() } else { self }
    }
}
