//! Integers modulo the prime 2^61 - 1: fingerprints of exact numbers.
//!
//! Two is a unit of the field, and its powers repeat after 61, so every finite
//! float has a residue that is found by a rotation of bits. A formula in
//! residues costs little more than in floats and is never rounded: what is
//! equal exactly has equal residues. The reverse holds but for one chance in
//! 2^61, so residues bring equals together and exact signs decide.
//!
//! Source: R. Karp and M. Rabin, "Efficient randomized pattern-matching
//! algorithms", 1987, for the idea; the prime is Mersenne's ninth.

use super::{Ring, Significand};
use std::ops::{Add, Mul, Neg, Sub};

/// The prime.
const PRIME: u64 = (1 << 61) - 1;

/// An integer modulo 2^61 - 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Residue(u64);

impl Residue {
    /// Zero.
    pub(crate) const ZERO: Self = Residue(0);
    const ONE: Self = Residue(1);

    /// The residue, from 0 on.
    pub(crate) fn value(self) -> u64 {
        self.0
    }

    /// The prime is congruent to zero.
    #[inline(always)]
    fn reduced(sum: u64) -> Self {
        Residue(if sum >= PRIME { sum - PRIME } else { sum })
    }

    /// `1 / self` by Fermat's little theorem; zero has no inverse and gives zero.
    fn inverse(self) -> Self {
        let mut power = self;
        let mut result = Residue::ONE;
        let mut exponent = PRIME - 2;
        while exponent > 0 {
            if exponent & 1 == 1 {
                result = result * power;
            }
            power = power * power;
            exponent >>= 1;
        }
        result
    }

    /// The inverses of some numbers, those of zeros being zero, for the price
    /// of one and three products for each (Montgomery 1987).
    pub(crate) fn inverses(numbers: &[Self]) -> Vec<Self> {
        let one_for_zero =
            |number: Self| if number == Residue::ZERO { Residue::ONE } else { number };
        let mut product = Residue::ONE;
        let mut inverses: Vec<Residue> = Vec::with_capacity(numbers.len());
        for &number in numbers {
            inverses.push(product);
            product = product * one_for_zero(number);
        }
        let mut inverse = product.inverse();
        for (before, &number) in inverses.iter_mut().zip(numbers).rev() {
            *before = if number == Residue::ZERO { number } else { *before * inverse };
            inverse = inverse * one_for_zero(number);
        }
        inverses
    }
}

impl Ring for Residue {
    const IN_PLACE: bool = true;

    #[inline(always)]
    fn read(value: f64, unit: i32) -> Self {
        let Significand { whole, exponent } = Significand::of(value);
        let shift = (exponent - unit).rem_euclid(61);
        let wide = u128::from(whole) << shift;
        let folded = (wide as u64 & PRIME) + (wide >> 61) as u64;
        let residue = Residue::reduced(folded);
        if value < 0.0 { -residue } else { residue }
    }
}

impl Add for Residue {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Residue::reduced(self.0 + other.0)
    }
}

impl Sub for Residue {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Residue::reduced(self.0 + PRIME - other.0)
    }
}

impl Mul for Residue {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let product = u128::from(self.0) * u128::from(other.0);
        Residue::reduced((product as u64 & PRIME) + (product >> 61) as u64)
    }
}

impl Neg for Residue {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Residue::reduced(PRIME - self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn read(value: f64) -> Residue {
        Residue::read(value, 0)
    }

    proptest! {
        #[test]
        fn sums_and_products_are_those_of_the_numbers(a in -1e6..1e6_f64, b in -1e6..1e6_f64) {
            // Of integers, so that the floats are exact.
            let (a, b) = (a.round(), b.round());
            prop_assert_eq!(read(a) + read(b), read(a + b));
            prop_assert_eq!(read(a) - read(b), read(a - b));
            prop_assert_eq!(read(a) * read(b), read(a * b));
            prop_assert_eq!(-read(a), read(-a));
        }

        #[test]
        fn powers_of_two_are_units(value in any::<f64>(), unit in -1100..1100_i32) {
            prop_assume!(value.is_finite());
            let two = read(2.0);
            let scaled = Residue::read(value, unit);
            prop_assert_eq!(Residue::read(value, unit - 1), scaled * two);
        }

        #[test]
        fn a_number_times_its_inverse_is_one(numbers in prop::collection::vec(0..PRIME, 0..20)) {
            let numbers: Vec<Residue> = numbers.into_iter().map(Residue).collect();
            for (&number, inverse) in numbers.iter().zip(Residue::inverses(&numbers)) {
                let product = if number == Residue::ZERO { Residue::ZERO } else { Residue::ONE };
                prop_assert_eq!(number * inverse, product);
            }
        }
    }

    #[test]
    fn zeros_among_others_have_no_inverse_and_do_no_harm() {
        let numbers = [read(3.0), Residue::ZERO, read(-0.125), read(0.0)];
        let inverses = Residue::inverses(&numbers);
        assert_eq!(numbers[0] * inverses[0], Residue::ONE);
        assert_eq!(numbers[2] * inverses[2], Residue::ONE);
        assert_eq!([inverses[1], inverses[3]], [Residue::ZERO; 2]);
    }

    #[test]
    fn the_prime_is_zero() {
        assert_eq!(read(2.0_f64.powi(61)) - read(1.0), Residue::ZERO);
        assert_eq!(-Residue::ZERO, Residue::ZERO);
    }
}
