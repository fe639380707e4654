//! Integers of a fixed largest width on the stack: the second step of the
//! ladder.
//!
//! Sign and magnitude with a count of the limbs in use, so that a product
//! costs what its factors really need: a difference of coordinates has one
//! or two limbs, a 2 x 2 minor four, and only the last sum is wide. The
//! caller chooses a width that the formula's degree and the scene's spread
//! cannot exceed; a debug build checks it.

use super::{BigInteger, Ring, Sign, Significand};
use std::ops::{Add, Mul, Neg, Sub};

/// An integer below `2^(64 N)` in absolute value.
#[derive(Debug, Clone, Copy)]
pub struct FixedInteger<const N: usize> {
    negative: bool,
    /// Limbs in use; the highest of them is not zero, the rest is not read.
    length: usize,
    limbs: [u64; N],
}

impl<const N: usize> FixedInteger<N> {
    const ZERO: Self = FixedInteger { negative: false, length: 0, limbs: [0; N] };

    /// The sign.
    #[inline]
    pub fn sign(&self) -> Sign {
        match (self.length, self.negative) {
            (0, _) => Sign::Zero,
            (_, true) => Sign::Negative,
            (_, false) => Sign::Positive,
        }
    }

    /// The same as an integer of any size.
    pub fn to_big(&self) -> BigInteger {
        BigInteger::of_words(self.negative, &self.limbs[..self.length])
    }

    /// Compares absolute values.
    #[inline]
    fn magnitude_at_least(&self, other: &Self) -> bool {
        if self.length != other.length {
            return self.length > other.length;
        }
        for i in (0..self.length).rev() {
            if self.limbs[i] != other.limbs[i] {
                return self.limbs[i] > other.limbs[i];
            }
        }
        true
    }

    /// `|self| + |other|` with the given sign.
    #[inline]
    fn add_magnitudes(&self, other: &Self, negative: bool) -> Self {
        let (long, short) = if self.length >= other.length { (self, other) } else { (other, self) };
        let mut sum = Self { negative, ..Self::ZERO };
        let mut carry = false;
        for i in 0..long.length {
            let addend = if i < short.length { short.limbs[i] } else { 0 };
            let (partial, over) = long.limbs[i].overflowing_add(addend);
            let (limb, again) = partial.overflowing_add(u64::from(carry));
            sum.limbs[i] = limb;
            carry = over || again;
        }
        sum.length = long.length;
        if carry {
            debug_assert!(sum.length < N, "a sum exceeds the fixed width");
            sum.limbs[sum.length] = 1;
            sum.length += 1;
        }
        sum
    }

    /// `|self| - |other|` with the given sign, for `|self| >= |other|`.
    #[inline]
    fn subtract_magnitudes(&self, other: &Self, negative: bool) -> Self {
        let mut rest = Self { negative, ..Self::ZERO };
        let mut borrow = false;
        for i in 0..self.length {
            let subtrahend = if i < other.length { other.limbs[i] } else { 0 };
            let (partial, under) = self.limbs[i].overflowing_sub(subtrahend);
            let (limb, again) = partial.overflowing_sub(u64::from(borrow));
            rest.limbs[i] = limb;
            borrow = under || again;
        }
        rest.length = self.length;
        rest.trim();
        rest
    }

    /// Drops leading zero limbs.
    #[inline]
    fn trim(&mut self) {
        while self.length > 0 && self.limbs[self.length - 1] == 0 {
            self.length -= 1;
        }
    }

    /// `self + other`, where `other` counts with the sign `other_negative`.
    #[inline(never)]
    fn add_signed(&self, other: &Self, other_negative: bool) -> Self {
        if other.length == 0 {
            *self
        } else if self.length == 0 {
            Self { negative: other_negative, ..*other }
        } else if self.negative == other_negative {
            self.add_magnitudes(other, self.negative)
        } else if self.magnitude_at_least(other) {
            self.subtract_magnitudes(other, self.negative)
        } else {
            other.subtract_magnitudes(self, other_negative)
        }
    }
}

impl<const N: usize> Ring for FixedInteger<N> {
    const IN_PLACE: bool = false;

    #[inline(never)]
    fn read(value: f64, _unit: i32) -> Self {
        if value.abs() < 1.0 {
            // Integers below one are zero.
            return Self::ZERO;
        }
        let Significand { whole, exponent } = Significand::of(value);
        let mut number = Self { negative: value < 0.0, ..Self::ZERO };
        if exponent <= 0 {
            // Below 2^53: only zero bits fall off, at most 52.
            number.limbs[0] = whole >> exponent.unsigned_abs();
            number.length = 1;
            return number;
        }
        let (limb, shift) = (exponent as usize / 64, exponent as usize % 64);
        number.limbs[limb] = whole << shift;
        // Shifted in two steps, for a shift by 64 is not defined.
        let over = whole >> 1 >> (63 - shift);
        number.length = limb + 1;
        if over != 0 {
            number.limbs[limb + 1] = over;
            number.length += 1;
        } else {
            number.trim();
        }
        number
    }
}

impl<const N: usize> Add for FixedInteger<N> {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        self.add_signed(&other, other.negative)
    }
}

impl<const N: usize> Sub for FixedInteger<N> {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self.add_signed(&other, !other.negative)
    }
}

impl<const N: usize> Mul for FixedInteger<N> {
    type Output = Self;

    #[inline(never)]
    fn mul(self, other: Self) -> Self {
        let mut product = Self { negative: self.negative != other.negative, ..Self::ZERO };
        if self.length == 0 || other.length == 0 {
            return Self::ZERO;
        }
        for i in 0..self.length {
            let mut carry = 0_u64;
            for j in 0..other.length {
                let wide = u128::from(self.limbs[i]) * u128::from(other.limbs[j])
                    + u128::from(product.limbs[i + j])
                    + u128::from(carry);
                product.limbs[i + j] = wide as u64;
                carry = (wide >> 64) as u64;
            }
            if i + other.length < N {
                product.limbs[i + other.length] = carry;
            } else {
                debug_assert!(carry == 0, "a product exceeds the fixed width");
            }
        }
        product.length = (self.length + other.length).min(N);
        product.trim();
        product
    }
}

impl<const N: usize> Neg for FixedInteger<N> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self { negative: !self.negative, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Integers with up to 53 significant bits anywhere below 2^125.
    fn coordinate() -> impl Strategy<Value = f64> {
        (any::<i64>(), 0..72_u32)
            .prop_map(|(mantissa, shift)| ((mantissa >> 11) as f64) * f64::powi(2.0, shift as i32))
    }

    /// `(a - b) * (c - d) - e * f`, the shape of everything evaluated here.
    fn sample<R: Ring>(x: &[f64]) -> R {
        let [a, b, c, d, e, f] = [0, 1, 2, 3, 4, 5].map(|i| R::read(x[i], 0));
        (a - b) * (c - d) - e * f
    }

    proptest! {
        #[test]
        fn fixed_and_big_integers_agree(x in prop::array::uniform6(coordinate())) {
            let fixed: FixedInteger<6> = sample(&x);
            let big: BigInteger = sample(&x);
            prop_assert_eq!(fixed.sign(), big.sign());
            prop_assert_eq!(&fixed.to_big(), &big);
            let square = fixed * FixedInteger::<6>::read(1.0, 0) - fixed;
            prop_assert_eq!(square.sign(), Sign::Zero);
        }

        #[test]
        fn differences_of_equal_products_vanish(a in coordinate(), b in coordinate()) {
            let read = |x| FixedInteger::<6>::read(x, 0);
            let rest = read(a) * read(b) - read(b) * read(a);
            prop_assert_eq!(rest.sign(), Sign::Zero);
            let one_off = read(a) * read(b) - read(b) * read(a) + read(-1.0);
            prop_assert_eq!(one_off.sign(), Sign::Negative);
        }
    }
}
