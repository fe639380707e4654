//! Quotients of big integers: exact areas, for comparing and for tests.
//!
//! No decision of the engine needs a quotient; these are for questions such
//! as whether the parts of a polygon have the area of the whole.

use super::{BigInteger, Sign};
use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, Mul, Neg, Sub};

/// A rational number in lowest terms.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fraction {
    numerator: BigInteger,
    /// Positive.
    denominator: BigInteger,
}

impl Fraction {
    /// `numerator / denominator`; none if that is a division by zero.
    pub fn new(numerator: BigInteger, denominator: BigInteger) -> Option<Self> {
        match denominator.sign() {
            Sign::Zero => None,
            Sign::Positive => Some(Self::reduced(numerator, denominator)),
            Sign::Negative => Some(Self::reduced(-numerator, -denominator)),
        }
    }

    /// Zero.
    pub fn zero() -> Self {
        Self::whole(0.into())
    }

    /// A whole number.
    pub fn whole(value: BigInteger) -> Self {
        Fraction { numerator: value, denominator: 1.into() }
    }

    /// The value of a finite float.
    pub fn of_float(value: f64) -> Self {
        use super::Ring;
        Self::whole(BigInteger::read(value, LEAST_EXPONENT)).times_power_of_two(LEAST_EXPONENT)
    }

    fn reduced(numerator: BigInteger, denominator: BigInteger) -> Self {
        let divisor = numerator.gcd(&denominator);
        Fraction {
            numerator: numerator.quotient(&divisor),
            denominator: denominator.quotient(&divisor),
        }
    }

    /// `self * 2^exponent`.
    #[must_use]
    pub fn times_power_of_two(self, exponent: i32) -> Self {
        let power = BigInteger::power_of_two(exponent.unsigned_abs());
        if exponent >= 0 {
            Self::reduced(self.numerator * power, self.denominator)
        } else {
            Self::reduced(self.numerator, self.denominator * power)
        }
    }

    /// The sign.
    pub fn sign(&self) -> Sign {
        self.numerator.sign()
    }

    /// One over it; none for zero.
    pub fn inverse(self) -> Option<Self> {
        Self::new(self.denominator, self.numerator)
    }

    /// Without its sign.
    #[must_use]
    pub fn abs(self) -> Self {
        if self.sign() == Sign::Negative { -self } else { self }
    }

    /// The nearest float or one next to it.
    pub fn to_f64(&self) -> f64 {
        BigInteger::ratio(&self.numerator, &self.denominator)
    }

    /// The sum of many, by halves: partial sums stay short for long.
    pub fn sum(terms: &[Fraction]) -> Self {
        match terms {
            [] => Self::zero(),
            [one] => one.clone(),
            _ => {
                let (left, right) = terms.split_at(terms.len() / 2);
                Self::sum(left) + Self::sum(right)
            }
        }
    }
}

/// The exponent of the least float.
const LEAST_EXPONENT: i32 = -1074;

impl Add for Fraction {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let numerator =
            self.numerator * other.denominator.clone() + other.numerator * self.denominator.clone();
        Self::reduced(numerator, self.denominator * other.denominator)
    }
}

impl Sub for Fraction {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Fraction {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self::reduced(self.numerator * other.numerator, self.denominator * other.denominator)
    }
}

impl Neg for Fraction {
    type Output = Self;

    fn neg(self) -> Self {
        Fraction { numerator: -self.numerator, denominator: self.denominator }
    }
}

impl PartialOrd for Fraction {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Fraction {
    fn cmp(&self, other: &Self) -> Ordering {
        let left = self.numerator.clone() * other.denominator.clone();
        left.cmp(&(other.numerator.clone() * self.denominator.clone()))
    }
}

impl fmt::Display for Fraction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.numerator)?;
        if self.denominator == 1.into() { Ok(()) } else { write!(f, "/{}", self.denominator) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(a: i64, b: i64) -> Fraction {
        Fraction::new(a.into(), b.into()).unwrap()
    }

    #[test]
    fn fractions_are_kept_in_lowest_terms() {
        assert_eq!(ratio(6, -4).to_string(), "-3/2");
        assert_eq!((ratio(1, 6) + ratio(1, 3)).to_string(), "1/2");
        assert_eq!((ratio(2, 3) * ratio(3, 2)).to_string(), "1");
        assert_eq!(ratio(0, 5), Fraction::zero());
        assert!(Fraction::new(1.into(), 0.into()).is_none());
    }

    #[test]
    fn floats_keep_their_value() {
        assert_eq!(Fraction::of_float(-0.375), ratio(-3, 8));
        for value in [0.1, 5e-324, 1e308, -3.0, 0.0] {
            assert_eq!(Fraction::of_float(value).to_f64(), value);
        }
        assert!(Fraction::of_float(0.1) > ratio(1, 10));
        assert_eq!(Fraction::sum(&[ratio(1, 2), ratio(1, 3), ratio(1, 6)]), ratio(1, 1));
    }
}
