//! Floats that know how wrong they may be: the filter in front of exact
//! arithmetic, and the only rounding analysis of this crate.
//!
//! A number carries its float value, the *magnitude* (the same expression
//! with every term replaced by its absolute value) and the *depth* (how
//! many roundings lie on the longest chain of operations). Leaves are exact
//! integers with depth 0. With `u = 2^-53`, every operation multiplies the
//! relative error against the true magnitude by at most `1 + u`:
//!
//! - sum, difference: depth `max(d, e) + 1`, since both terms are off by at
//!   most `(1 + u)^max(d, e) - 1` of their magnitudes and the sum is rounded once;
//! - product: depth `d + e + 1`.
//!
//! Hence `|value - true| <= ((1 + u)^depth - 1) * M` with the true
//! magnitude `M`, and `M <= magnitude * (1 + u)^depth` because the computed
//! magnitude runs through the same roundings. For depths below 2^20 that is
//! less than `(depth + 2) u * magnitude`, the bound used here. The depth is
//! a constant after inlining, so the filter costs a few multiplications.
//! (The idea of magnitudes, or permanents, as error bounds: Shewchuk 1997;
//! Burnikel, Funke and Seel 2001.)
//!
//! Leaves are integers, so a magnitude below 2^53 means that nothing was
//! rounded at all and the value is exact, zero included. That settles the
//! exact zeros of small integer grids and of axis-parallel geometry without
//! leaving floats. Nothing underflows for the same reason. What overflows has
//! a magnitude that does so too, and then a bound that no value exceeds.

use super::{Ring, Sign};
use std::ops::{Add, Mul, Neg, Sub};

/// Half the distance from 1 to the next float.
const UNIT_ROUNDOFF: f64 = 1.0 / 9_007_199_254_740_992.0;

/// Magnitudes below this were computed without any rounding.
const EXACT_BELOW: f64 = 9_007_199_254_740_992.0;

/// A float with the data of its error bound.
#[derive(Debug, Clone, Copy)]
pub struct Filtered {
    value: f64,
    magnitude: f64,
    depth: u32,
}

impl Filtered {
    /// The computed value.
    #[inline(always)]
    pub fn value(self) -> f64 {
        self.value
    }

    /// An upper bound of the distance between the value and the truth.
    #[inline(always)]
    pub fn bound(self) -> f64 {
        f64::from(self.depth + 2) * UNIT_ROUNDOFF * self.magnitude
    }

    /// The sign, where it is certain.
    #[inline(always)]
    pub fn sign(self) -> Option<Sign> {
        let bound = self.bound();
        if self.value > bound {
            Some(Sign::Positive)
        } else if self.value < -bound {
            Some(Sign::Negative)
        } else if self.magnitude < EXACT_BELOW {
            Some(Sign::of(self.value))
        } else {
            None
        }
    }
}

impl Filtered {
    /// The sign of a value that may be off by something more than rounding,
    /// and is not of integers.
    #[inline]
    pub fn sign_beyond(self, more: f64) -> Option<Sign> {
        let bound = self.bound() + more;
        if self.value > bound {
            Some(Sign::Positive)
        } else if self.value < -bound {
            Some(Sign::Negative)
        } else {
            None
        }
    }
}

impl Ring for Filtered {
    const IN_PLACE: bool = true;

    #[inline(always)]
    fn read(value: f64, _unit: i32) -> Self {
        Filtered { value, magnitude: value.abs(), depth: 0 }
    }
}

impl Add for Filtered {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Filtered {
            value: self.value + other.value,
            magnitude: self.magnitude + other.magnitude,
            depth: self.depth.max(other.depth) + 1,
        }
    }
}

impl Sub for Filtered {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        if self.depth == 0 && other.depth == 0 {
            // The difference of two leaves is off by a rounding of itself,
            // not of its terms: this keeps far-away scenes decidable.
            let value = self.value - other.value;
            return Filtered { value, magnitude: value.abs(), depth: 1 };
        }
        Filtered {
            value: self.value - other.value,
            magnitude: self.magnitude + other.magnitude,
            depth: self.depth.max(other.depth) + 1,
        }
    }
}

impl Mul for Filtered {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Filtered {
            value: self.value * other.value,
            magnitude: self.magnitude * other.magnitude,
            depth: self.depth + other.depth + 1,
        }
    }
}

impl Neg for Filtered {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Filtered { value: -self.value, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_overflows_has_no_sign() {
        let [huge, zero] = [1e300, 0.0].map(|value| Filtered::read(value, 0));
        let infinite = huge * huge;
        for none in [infinite, -infinite, infinite - infinite, infinite * zero, infinite + huge] {
            assert_eq!(none.sign(), None);
        }
        assert_eq!((huge + zero).sign(), Some(Sign::Positive));
        assert_eq!((huge * zero).sign(), Some(Sign::Zero));
    }
}
