//! Quotients of integers of fixed width as floats.
//!
//! The leading 106 bits of both are two floats each; one step of division
//! with a remainder (Dekker 1971; Joldes, Muller and Popescu 2017) makes two
//! floats of their quotient that are off by less than 2^-100 of it. Their
//! sum rounds to the first of them unless the quotient lies next to the
//! middle between two floats, which only integers tell.

use super::{BigInteger, SmallInteger};

/// `(high + low) * 2^exponent`, cut off below the 106 bits of both.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leading {
    /// From 2^52 to 2^53, or zero.
    pub(super) high: f64,
    /// Not negative, less than one.
    pub(super) low: f64,
    pub(super) exponent: i32,
}

/// A quotient so much closer to a float than to the middle between two is
/// rounded to it, however it was cut off behind 64 bits.
const TOWARDS_MIDDLE: f64 = 1.0 + 1.0 / 256.0;

impl<const N: usize> SmallInteger<N> {
    /// The float of [`BigInteger::ratio`]. The denominator must not be zero.
    pub fn nearest_ratio(numerator: &Self, denominator: &Self) -> f64 {
        let ([n, d], negative) = (
            [numerator, denominator].map(Self::leading),
            numerator.is_negative() != denominator.is_negative(),
        );
        if n.high == 0.0 {
            return 0.0;
        }
        let first = n.high / d.high;
        let product = first * d.high;
        let error = first.mul_add(d.high, -product);
        let rest = ((n.high - product) - error) + (n.low - first * d.low);
        let second = rest / d.high;
        let quotient = first + second;
        let left = second - (quotient - first);
        if quotient + left * TOWARDS_MIDDLE != quotient {
            return BigInteger::ratio(&numerator.to_big(), &denominator.to_big());
        }
        let scaled = quotient * f64::powi(2.0, n.exponent - d.exponent);
        if negative { -scaled } else { scaled }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Ring;
    use super::*;
    use proptest::prelude::*;

    /// Whole floats of any size that nine words hold, and their neighbours.
    fn integer() -> impl Strategy<Value = SmallInteger<9>> {
        let read = |value: f64| SmallInteger::<9>::read(value, 0);
        let float = (any::<i64>(), 0..120_i32)
            .prop_map(|(bits, shift)| ((bits >> 10) as f64 * f64::powi(2.0, shift - 40)).trunc());
        prop::array::uniform4(float).prop_map(move |[a, b, c, d]| {
            let odd = read(1.0) + read(2.0) * read(d);
            read(a) * read(b) * odd - read(c)
        })
    }

    proptest! {
        #[test]
        fn is_the_float_of_big_integers(n in integer(), d in integer()) {
            prop_assume!(!d.sign().is_zero());
            let exact = BigInteger::ratio(&n.to_big(), &d.to_big());
            prop_assert_eq!(SmallInteger::nearest_ratio(&n, &d), exact);
        }

        /// Quotients in the middle between two floats, and as close to it as
        /// the widths let them be.
        #[test]
        fn is_the_float_of_big_integers_next_to_the_middle(
            float in (1_i64 << 52)..(1_i64 << 53),
            d in integer(),
            aside in -2..=2_i32,
        ) {
            prop_assume!(!d.sign().is_zero());
            let read = |value: f64| SmallInteger::<9>::read(value, 0);
            // Twice the float and one: halves of a unit are whole.
            let n = (read(2.0) * read(float as f64) + read(1.0)) * d + read(aside.into());
            let exact = BigInteger::ratio(&n.to_big(), &d.to_big());
            prop_assert_eq!(SmallInteger::nearest_ratio(&n, &d), exact);
        }
    }
}
