//! Functionals over a lattice of samples: affine floats that say where they
//! are certain.
//!
//! A raster method asks the same few questions at very many samples: on
//! which side of an edge, which of two planes is nearer. The functionals
//! behind them are linear in the sample, and samples lie on a plane in rows
//! and columns, so over column `i` and row `j` each is `a i + b j + c` up to
//! an error that is bounded here once. Where the value exceeds the bound its
//! sign is certain; elsewhere the caller asks the predicate itself
//! ([`Predicates::side`], [`Predicates::nearer`]). Pineda 1988 steps along
//! such functions; nothing is stepped here, so no error adds up.
//!
//! **The bound.** Let `u = 2^-53`. All coordinates are floats of the scaled
//! scene. A functional is `n . (x - p)` with `n = v x w`, where v and w are
//! coordinates or differences of two of them.
//!
//! 1. A difference is off by at most u of itself; so a component of n is off
//!    by at most `((1 + u)^4 - 1) N < 5 u N`, where `N = |v_i w_j| + |v_j w_i|`.
//! 2. [`Lattice::new`] looks at every sample and finds the largest distance
//!    `noise` between a coordinate of it and of `origin + i across + j down`,
//!    adding what may be wrong in that difference. So nothing is assumed
//!    about how samples were rounded.
//! 3. With `R = |origin - p| + columns |across| + rows |down|`, component by
//!    component, the value at (i, j) is a sum of at most nine products of
//!    numbers whose magnitudes sum to `M = sum N R`; fourteen roundings at
//!    most lie on the way of each. Together with 1 the float is off by less
//!    than `((1 + u)^20 - 1) M < 21 u M`, and by `sum N noise`.
//! 4. Magnitudes are rounded themselves, by a factor above `(1 - u)^20`.
//!
//! `32 u M + 1.001 sum N noise` covers it. Coordinates of narrow scenes are
//! integers, so nothing underflows but quotients that are added to larger
//! numbers; wide scenes have infinite bounds and are decided exactly.

use super::{Points, Policy, Predicates};
use crate::kernel::numbers::{Sign, cross, difference, dot};
use std::ops::Range;

/// A multiple of the unit roundoff that covers the error of a form.
const ROUNDINGS: f64 = 32.0 / 9_007_199_254_740_992.0;

/// Bits that a value of degree three needs at most beyond three spreads.
const SPARE_BITS: u32 = 64;

/// Vertices in rows and columns: `origin + i across + j down`, each
/// coordinate off by at most `noise`.
#[derive(Debug, Clone, Copy)]
pub struct Lattice {
    origin: [f64; 3],
    across: [f64; 3],
    down: [f64; 3],
    columns: f64,
    rows: f64,
    noise: f64,
}

/// An affine function of column and row, off by at most its bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Form {
    /// Growth from one column to the next.
    across: f64,
    /// Growth from one row to the next.
    down: f64,
    /// Value at column 0 of row 0.
    constant: f64,
    /// Greatest error over the lattice; infinite if nothing is known.
    bound: f64,
}

impl Lattice {
    /// The lattice of the vertices `first..`, row by row. O(samples).
    pub fn new(points: &Points, first: u32, columns: u32, rows: u32) -> Self {
        let at = |column: u32, row: u32| points.vertex::<f64>(first + row * columns + column);
        let [width, height] = [columns, rows].map(|count| f64::from(count.max(2) - 1));
        let origin = at(0, 0);
        let step = |end: [f64; 3], count: f64| difference(end, &origin).map(|x| x / count);
        let across = step(at(columns - 1, 0), width);
        let down = step(at(0, rows - 1), height);
        let mut lattice = Lattice {
            origin,
            across,
            down,
            columns: f64::from(columns),
            rows: f64::from(rows),
            noise: 0.0,
        };
        let mut noise: f64 = 0.0;
        for row in 0..rows {
            for column in 0..columns {
                let off = difference(lattice.place(column, row), &at(column, row));
                noise = off.iter().fold(noise, |most, x| most.max(x.abs()));
            }
        }
        // A place is four roundings away from itself, its difference to the
        // vertex one more.
        let largest = (0..3)
            .map(|k| origin[k].abs() + across[k].abs() * width + down[k].abs() * height)
            .fold(0.0, f64::max);
        lattice.noise = if points.floats_hold(3 * (points.spread() + 2) + SPARE_BITS) {
            noise + ROUNDINGS * largest
        } else {
            f64::INFINITY
        };
        lattice
    }

    /// About where a vertex lies.
    fn place(&self, column: u32, row: u32) -> [f64; 3] {
        let (i, j) = (f64::from(column), f64::from(row));
        [0, 1, 2].map(|k| self.origin[k] + i * self.across[k] + j * self.down[k])
    }

    /// The form of `(v x w) . (x - p)`.
    fn form(&self, v: [f64; 3], w: [f64; 3], p: [f64; 3]) -> Form {
        let normal = cross(v, w);
        let sizes = cross_sizes(v, w);
        let offset = difference(self.origin, &p);
        let (mut magnitude, mut shaking) = (0.0, 0.0);
        for k in 0..3 {
            let reach = offset[k].abs()
                + self.columns * self.across[k].abs()
                + self.rows * self.down[k].abs();
            magnitude += sizes[k] * reach;
            shaking += sizes[k];
        }
        Form {
            across: dot(normal, self.across),
            down: dot(normal, self.down),
            constant: dot(normal, offset),
            // Written so that an infinite noise counts where sizes vanish.
            bound: ROUNDINGS * magnitude + (shaking + f64::MIN_POSITIVE) * self.noise * 1.001,
        }
    }
}

/// `|v_i w_j| + |v_j w_i|`: magnitudes of the components of `v x w`.
fn cross_sizes(v: [f64; 3], w: [f64; 3]) -> [f64; 3] {
    let size = |i: usize, j: usize| (v[i] * w[j]).abs() + (v[j] * w[i]).abs();
    [size(1, 2), size(2, 0), size(0, 1)]
}

impl<P: Policy> Predicates<'_, P> {
    /// The form of [`Self::side`]: `[E, p, q, x]` over the samples x.
    pub fn side_form(&self, lattice: &Lattice, p: u32, q: u32) -> Form {
        let points = self.points();
        let [p, q] = [p, q].map(|vertex| points.vertex::<f64>(vertex));
        let along = difference(q, &p);
        let eye = points.eye::<f64>();
        // [E, p, q, x] = ((q - p) x (p - E)) . (x - p) for an eye that is a
        // point, and (E x (q - p)) . (x - p) for a direction.
        if points.is_perspective() {
            lattice.form(along, difference(p, &eye), p)
        } else {
            lattice.form(eye, along, p)
        }
    }

    /// The form of `[a, b, c, x] / [E, a, b, c]`: how near to the eye, in
    /// multiples of it, the ray through a sample x meets the plane of a
    /// triangle (see [`Self::nearer`], which decides between two of them).
    /// Without bound if the triangle may be edge-on.
    pub fn nearness_form(&self, lattice: &Lattice, triangle: [u32; 3]) -> Form {
        let points = self.points();
        let [a, b, c] = triangle.map(|vertex| points.vertex::<f64>(vertex));
        let (v, w) = (difference(b, &a), difference(c, &a));
        let plane = lattice.form(v, w, a);
        // With m = v x w the plane's functional is -m . (x - a), its facing
        // m . (E - a), or m . E for a direction.
        let eye = points.eye::<f64>();
        let ray = if points.is_perspective() { difference(eye, &a) } else { eye };
        let facing = -dot(cross(v, w), ray);
        let sizes = cross_sizes(v, w);
        let error = ROUNDINGS * (0..3).map(|k| sizes[k] * ray[k].abs()).sum::<f64>();
        // Of a quotient p / f with errors d and e: (d + |p / f| e) / (|f| - e).
        let largest = plane.constant.abs()
            + plane.across.abs() * lattice.columns
            + plane.down.abs() * lattice.rows;
        let least = facing.abs() - error;
        let wrong = plane.bound + largest * (error / facing.abs() + ROUNDINGS);
        let bound = if least > 0.0 { wrong * 1.001 / least } else { f64::INFINITY };
        Form {
            across: plane.across / facing,
            down: plane.down / facing,
            constant: plane.constant / facing,
            bound,
        }
    }
}

impl Form {
    /// The value at a sample, off by at most [`Self::bound`].
    #[inline(always)]
    pub fn value(&self, column: u32, row: u32) -> f64 {
        f64::from(column) * self.across + (f64::from(row) * self.down + self.constant)
    }

    /// The greatest error of a value.
    pub fn bound(&self) -> f64 {
        self.bound
    }

    /// The sign at a sample, where it is certain.
    #[inline(always)]
    pub fn sign(&self, column: u32, row: u32) -> Option<Sign> {
        let value = self.value(column, row);
        if value > self.bound {
            Some(Sign::Positive)
        } else if value < -self.bound {
            Some(Sign::Negative)
        } else {
            None
        }
    }

    /// The form whose values are those of this one times a sign that is not
    /// zero.
    #[must_use]
    pub fn times(self, sign: Sign) -> Self {
        let factor = f64::from(sign.to_i32());
        Form {
            across: self.across * factor,
            down: self.down * factor,
            constant: self.constant * factor,
            bound: self.bound,
        }
    }

    /// The form of the difference of two functionals.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        // The subtractions are off by at most u times both magnitudes, of
        // which the bounds have eleven to spare.
        Form {
            across: self.across - other.across,
            down: self.down - other.down,
            constant: self.constant - other.constant,
            bound: (self.bound + other.bound) * 1.001,
        }
    }

    /// Growth of the value over one column and over one row.
    pub fn growth(&self) -> [f64; 2] {
        [self.across, self.down]
    }

    /// The columns of a row, out of `columns`, at which the value is not below
    /// `-bound`: elsewhere the sign is negative for certain. O(1).
    pub fn not_negative(&self, columns: Range<u32>, row: u32) -> Range<u32> {
        let least = (-self.bound).next_down();
        if self.bound.is_finite() { self.above(least, columns, row) } else { columns }
    }

    /// The columns of a row, out of `columns`, at which the sign is positive
    /// for certain. O(1).
    pub fn positive(&self, columns: Range<u32>, row: u32) -> Range<u32> {
        let first = columns.start;
        if self.bound.is_finite() { self.above(self.bound, columns, row) } else { first..first }
    }

    /// The columns at which the value exceeds `least`. The value as computed
    /// grows or falls with the column, for rounding keeps order; so the end
    /// is where it is found to be.
    fn above(&self, least: f64, columns: Range<u32>, row: u32) -> Range<u32> {
        let holds = |column: u32| self.value(column, row) > least;
        if columns.is_empty() {
            return columns;
        }
        let (first, last) = (columns.start, columns.end - 1);
        match (holds(first), holds(last)) {
            (true, true) => columns,
            (false, false) => first..first,
            (starts, _) => {
                let at_zero = f64::from(row) * self.down + self.constant;
                let guess = (least - at_zero) / self.across;
                let mut end = (guess.clamp(f64::from(first), f64::from(last)) as u32) + 1;
                // The guess is off by one now and then, and by more only if
                // the form hardly grows.
                while end <= last && holds(end) == starts {
                    end += 1;
                }
                while end > first && holds(end - 1) != starts {
                    end -= 1;
                }
                if starts { first..end } else { end..columns.end }
            }
        }
    }
}

#[cfg(test)]
mod tests;
