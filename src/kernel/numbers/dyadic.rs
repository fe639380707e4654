//! Integers times powers of two: exact like big integers, and as short as the
//! numbers they are made of.
//!
//! Where one coordinate is 1e-60 and the others are not, all of them have
//! hundreds of bits in one common unit, and so do all differences and
//! products. With an exponent of its own a number has only the bits between
//! its first and its last one, and most formulas see none of the odd ones.

use super::{BigInteger, Ring, Sign, Significand};
use dashu_int::IBig;
use std::ops::{Add, Mul, Neg, Sub};

/// `whole * 2^exponent`.
#[derive(Debug, Clone)]
pub struct Dyadic {
    whole: IBig,
    /// Anything where the number is zero.
    exponent: i32,
}

/// Wholes of more bits lie on the heap, and lose the zeros at their ends.
const SHORT: usize = 128;

impl Dyadic {
    /// The sign.
    pub fn sign(&self) -> Sign {
        self.whole.cmp(&IBig::ZERO).into()
    }

    /// The float of [`BigInteger::ratio`], times `2^exponent`.
    pub(crate) fn scaled_ratio(numerator: &Self, denominator: &Self, exponent: i32) -> f64 {
        let [n, d] = [numerator, denominator].map(|number| BigInteger::of(number.whole.clone()));
        BigInteger::scaled_ratio(&n, &d, exponent + numerator.exponent - denominator.exponent)
    }

    /// The same without zeros at the end of a long number.
    fn shortened(whole: IBig, exponent: i32) -> Self {
        use dashu_int::ops::{BitTest, UnsignedAbs};
        if whole.clone().unsigned_abs().bit_len() > SHORT
            && let Some(zeros) = whole.trailing_zeros()
            && zeros > 0
        {
            return Dyadic { whole: whole >> zeros, exponent: exponent + zeros as i32 };
        }
        Dyadic { whole, exponent }
    }
}

impl Ring for Dyadic {
    const IN_PLACE: bool = false;

    fn read(value: f64, unit: i32) -> Self {
        let Significand { whole, exponent } = Significand::of(value);
        // A zero has 64 zeros at its end.
        let zeros = whole.trailing_zeros();
        let whole = IBig::from(whole.checked_shr(zeros).unwrap_or(0));
        Dyadic {
            whole: if value < 0.0 { -whole } else { whole },
            exponent: exponent + zeros as i32 - unit,
        }
    }
}

impl Add for Dyadic {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if self.whole == IBig::ZERO {
            return other;
        }
        if other.whole == IBig::ZERO {
            return self;
        }
        let (high, low) =
            if self.exponent < other.exponent { (other, self) } else { (self, other) };
        let shift = (high.exponent - low.exponent).unsigned_abs() as usize;
        let high = if shift == 0 { high.whole } else { high.whole << shift };
        Dyadic::shortened(high + low.whole, low.exponent)
    }
}

impl Sub for Dyadic {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Dyadic {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Dyadic {
            whole: self.whole * other.whole,
            // Of a zero too: exponents of formulas are far from the ends of the range.
            exponent: self.exponent + other.exponent,
        }
    }
}

impl Neg for Dyadic {
    type Output = Self;

    fn neg(self) -> Self {
        Dyadic { whole: -self.whole, exponent: self.exponent }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Floats of all sizes, and some that cancel one another.
    fn number() -> impl Strategy<Value = f64> {
        prop_oneof![
            proptest::num::f64::NORMAL | proptest::num::f64::SUBNORMAL | proptest::num::f64::ZERO,
            (-8..8_i32, -60..60_i32).prop_map(|(x, y)| f64::from(x) * f64::powi(2.0, y)),
            Just(1e-60),
        ]
    }

    fn sample<R: Ring>(x: [f64; 6]) -> R {
        let [a, b, c, d, e, f] = x.map(|value| R::read(value, -1074));
        (a.clone() - b) * (c - d) * e.clone() - -e * f * a
    }

    proptest! {
        #[test]
        fn dyadic_numbers_and_big_integers_agree(
            x in prop::array::uniform6(number()),
            y in prop::array::uniform6(number()),
        ) {
            let (n, big) = (sample::<Dyadic>(x), sample::<BigInteger>(x));
            prop_assert_eq!(n.sign(), big.sign());
            let (d, divisor) = (sample::<Dyadic>(y), sample::<BigInteger>(y));
            prop_assert_eq!((n.clone() - d.clone()).sign(), (big.clone() - divisor.clone()).sign());
            prop_assume!(!d.sign().is_zero());
            let exact = BigInteger::ratio(&big, &divisor);
            prop_assert_eq!(Dyadic::scaled_ratio(&n, &d, 0), exact);
        }

        #[test]
        fn equal_products_vanish(x in prop::array::uniform6(number())) {
            let rest = sample::<Dyadic>(x) - sample::<Dyadic>(x);
            prop_assert_eq!(rest.sign(), Sign::Zero);
            prop_assert_eq!((rest + Dyadic::read(-1.0, 0)).sign(), Sign::Negative);
        }
    }
}
