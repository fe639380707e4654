//! Integers of any size: for quotients, and for checking the others.

use super::{Ring, Sign, Significand};
use dashu_int::{IBig, UBig};
use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};

/// An integer of any size (a thin shell around a library's).
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct BigInteger(IBig);

impl BigInteger {
    /// The sign.
    pub fn sign(&self) -> Sign {
        self.0.cmp(&IBig::ZERO).into()
    }

    /// A library's integer.
    pub(super) fn of(value: IBig) -> Self {
        BigInteger(value)
    }

    /// The integer of some words, the least first, with a sign.
    pub(super) fn of_words(negative: bool, words: &[u64]) -> Self {
        let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
        let magnitude = IBig::from(UBig::from_le_bytes(&bytes));
        BigInteger(if negative { -magnitude } else { magnitude })
    }

    /// The greatest common divisor, not negative; one if both are zero.
    pub(super) fn gcd(&self, other: &Self) -> Self {
        use dashu_int::ops::Gcd;
        if self.0 == IBig::ZERO && other.0 == IBig::ZERO {
            return BigInteger(IBig::ONE);
        }
        BigInteger((&self.0).gcd(&other.0).into())
    }

    /// `self / other`, where that is whole; `other` must not be zero.
    pub(super) fn quotient(&self, other: &Self) -> Self {
        BigInteger(&self.0 / &other.0)
    }

    /// `2^exponent`.
    pub(super) fn power_of_two(exponent: u32) -> Self {
        BigInteger(IBig::ONE << exponent as usize)
    }

    /// `numerator / denominator` as the nearest float or one next to it.
    /// The denominator must not be zero; zero gives zero.
    ///
    /// The quotient is formed with 64 significant bits by integer division,
    /// so its error is far below one unit in the last place.
    pub fn ratio(numerator: &Self, denominator: &Self) -> f64 {
        Self::scaled_ratio(numerator, denominator, 0)
    }

    /// `numerator / denominator * 2^exponent`, which may be a float where
    /// the quotient is beyond their range.
    pub(crate) fn scaled_ratio(numerator: &Self, denominator: &Self, exponent: i32) -> f64 {
        if numerator.0 == IBig::ZERO || denominator.0 == IBig::ZERO {
            return 0.0;
        }
        let excess = bit_length(&denominator.0) as i64 - bit_length(&numerator.0) as i64 + 64;
        let quotient = if excess >= 0 {
            (&numerator.0 << excess as usize) / &denominator.0
        } else {
            &numerator.0 / (&denominator.0 << (-excess) as usize)
        };
        let rounded: f64 = quotient.to_f64().value();
        scale_by_power_of_two(rounded, i64::from(exponent) - excess)
    }
}

/// The number of bits of the absolute value.
fn bit_length(value: &IBig) -> usize {
    use dashu_int::ops::{BitTest, UnsignedAbs};
    value.unsigned_abs().bit_len()
}

/// `value * 2^exponent` for exponents outside the range of a float too.
pub(crate) fn scale_by_power_of_two(value: f64, exponent: i64) -> f64 {
    let mut scaled = value;
    let mut left = exponent;
    while left != 0 && scaled != 0.0 && scaled.is_finite() {
        let step = left.clamp(-1000, 1000);
        scaled *= f64::powi(2.0, step as i32);
        left -= step;
    }
    scaled
}

impl Ring for BigInteger {
    const IN_PLACE: bool = false;

    fn read(value: f64, unit: i32) -> Self {
        let Significand { whole, exponent } = Significand::of(value);
        let shift = exponent - unit;
        let magnitude = if shift >= 0 {
            IBig::from(whole) << shift as usize
        } else {
            // The value is a multiple of 2^unit: only zero bits fall off.
            IBig::from(whole.checked_shr(shift.unsigned_abs()).unwrap_or(0))
        };
        BigInteger(if value < 0.0 { -magnitude } else { magnitude })
    }
}

impl fmt::Display for BigInteger {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl From<i64> for BigInteger {
    fn from(value: i64) -> Self {
        BigInteger(IBig::from(value))
    }
}

impl Add for BigInteger {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        BigInteger(self.0 + other.0)
    }
}

impl Sub for BigInteger {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        BigInteger(self.0 - other.0)
    }
}

impl Mul for BigInteger {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        BigInteger(self.0 * other.0)
    }
}

impl Neg for BigInteger {
    type Output = Self;

    fn neg(self) -> Self {
        BigInteger(-self.0)
    }
}
