//! Integers of a few words in two's complement: the second step of the
//! ladder where the value has at most six words.
//!
//! Sums run over all words and look at no sign and no length, so there is
//! no branch to be mispredicted; on so few words that is worth more than
//! the multiplications it wastes on leading words. Only a product of many
//! words asks whether a factor has two, as coordinates and their
//! differences do, and then takes half as many steps. Wider values are better off with [`super::FixedInteger`], which counts
//! its words. Overflow is excluded by the caller; a debug build checks it.

use super::quotient::Leading;
use super::{BigInteger, Ring, Sign, Significand};
use std::ops::{Add, Mul, Neg, Sub};

/// An integer below `2^(64 N - 1)` in absolute value.
#[derive(Debug, Clone, Copy)]
pub struct SmallInteger<const N: usize> {
    /// Least significant word first.
    words: [u64; N],
}

impl<const N: usize> SmallInteger<N> {
    /// The sign.
    #[inline]
    pub fn sign(&self) -> Sign {
        if self.is_negative() {
            Sign::Negative
        } else if self.words.iter().all(|word| *word == 0) {
            Sign::Zero
        } else {
            Sign::Positive
        }
    }

    /// A float off by less than one unit in its last place.
    pub fn to_f64(&self) -> f64 {
        let size = if self.is_negative() { -*self } else { *self };
        let Some(top) = (0..N).rev().find(|&i| size.words[i] != 0) else {
            return 0.0;
        };
        // 64 bits at least, cut off below: less than half a unit; a float
        // made of them rounds once more.
        let shift = size.words[top].leading_zeros();
        let below = if top > 0 { size.words[top - 1] } else { 0 };
        let low = if shift == 0 { 0 } else { below >> (64 - shift) };
        let leading = (size.words[top] << shift | low) as f64;
        let value = leading * f64::powi(2.0, 64 * top as i32 - shift as i32);
        if self.is_negative() { -value } else { value }
    }

    /// `numerator / denominator`, off by less than one unit in its last place
    /// and exact where a float has the value. The denominator must not be
    /// zero.
    pub fn ratio(numerator: &Self, denominator: &Self) -> f64 {
        // Twice the bits of a float each; one step of division by hand.
        let [n, d] = [numerator, denominator].map(|value| {
            let high = value.to_f64();
            (high, (*value - Self::read(high, 0)).to_f64())
        });
        let quotient = n.0 / d.0;
        let rest = quotient.mul_add(-d.0, n.0) + quotient.mul_add(-d.1, n.1);
        quotient + rest / d.0
    }

    /// The same as an integer of any size.
    pub fn to_big(&self) -> BigInteger {
        let size = if self.is_negative() { -*self } else { *self };
        BigInteger::of_words(self.is_negative(), &size.words)
    }

    /// The first 106 bits of the absolute value.
    pub(super) fn leading(&self) -> Leading {
        let size = if self.is_negative() { -*self } else { *self };
        let Some(top) = (0..N).rev().find(|&i| size.words[i] != 0) else {
            return Leading { high: 0.0, low: 0.0, exponent: 0 };
        };
        let below = |by: usize| if top >= by { size.words[top - by] } else { 0 };
        let two = u128::from(size.words[top]) << 64 | u128::from(below(1));
        let shift = size.words[top].leading_zeros();
        // In two steps, for a shift by 64 is not defined.
        let bits = two << shift | u128::from(below(2) >> 1 >> (63 - shift));
        let mask = (1_u64 << 53) - 1;
        Leading {
            high: (bits >> 75) as u64 as f64,
            low: ((bits >> 22) as u64 & mask) as f64 / (mask + 1) as f64,
            exponent: 64 * top as i32 + 11 - shift as i32,
        }
    }

    /// The product with a number of another width, in a width that holds it.
    #[inline(always)]
    pub fn wide_product<const M: usize, const K: usize>(
        &self,
        other: &SmallInteger<M>,
    ) -> SmallInteger<K> {
        let a = if self.is_negative() { -*self } else { *self };
        let b = if other.is_negative() { -*other } else { *other };
        let mut words = [0; K];
        for (i, word) in a.words.iter().enumerate() {
            let mut carry = 0_u64;
            for (j, factor) in b.words.iter().enumerate() {
                let wide = u128::from(*word) * u128::from(*factor)
                    + u128::from(words.get(i + j).copied().unwrap_or(0))
                    + u128::from(carry);
                if let Some(place) = words.get_mut(i + j) {
                    *place = wide as u64;
                } else {
                    debug_assert!(wide == 0, "a product exceeds the width");
                }
                carry = (wide >> 64) as u64;
            }
            if let Some(place) = words.get_mut(i + M) {
                *place = carry;
            } else {
                debug_assert!(carry == 0, "a product exceeds the width");
            }
        }
        let product = SmallInteger { words };
        debug_assert!(!product.is_negative(), "a product exceeds the width");
        if self.is_negative() == other.is_negative() { product } else { -product }
    }

    /// The same number in more words.
    #[inline(always)]
    pub fn widened<const K: usize>(&self) -> SmallInteger<K> {
        let extension = if self.is_negative() { u64::MAX } else { 0 };
        let mut words = [extension; K];
        words[..N].copy_from_slice(&self.words);
        SmallInteger { words }
    }

    #[inline(always)]
    pub(super) fn is_negative(&self) -> bool {
        self.words[N - 1] >> 63 == 1
    }

    /// Whether two words hold the number.
    #[inline(always)]
    fn is_short(&self) -> bool {
        let extension = ((self.words[1] as i64) >> 63) as u64;
        (2..N).fold(0, |differing, i| differing | (self.words[i] ^ extension)) == 0
    }

    /// `self * other`.
    #[inline(always)]
    fn product(self, other: Self) -> Self {
        if N > 4 {
            if self.is_short() {
                return other.times_short(self);
            }
            if other.is_short() {
                return self.times_short(other);
            }
        }
        // The words of a product modulo 2^(64 N) do not depend on signs.
        SmallInteger { words: other.times_words(&self.words) }
    }

    /// The words of the product with a number of at most as many words, modulo
    /// 2^(64 N), as if neither had a sign.
    #[inline(always)]
    fn times_words(&self, factor: &[u64]) -> [u64; N] {
        let mut words = [0; N];
        for (i, word) in factor.iter().enumerate() {
            let mut carry = 0_u64;
            for j in 0..N - i {
                let wide = u128::from(*word) * u128::from(self.words[j])
                    + u128::from(words[i + j])
                    + u128::from(carry);
                words[i + j] = wide as u64;
                carry = (wide >> 64) as u64;
            }
        }
        words
    }

    /// `self * short` for a number that two words hold.
    #[inline(always)]
    fn times_short(self, short: Self) -> Self {
        let words = self.times_words(&short.words[..2]);
        // The sign of the short number counts for all words left out.
        let mask = if short.is_negative() { u64::MAX } else { 0 };
        let mut shifted = [0; N];
        for (target, word) in shifted.iter_mut().skip(2).zip(&self.words) {
            *target = word & mask;
        }
        SmallInteger { words: difference(&words, &shifted) }
    }

    /// The bits of the absolute value, or one less for a negative power of two.
    fn bits(&self) -> usize {
        let extension = if self.is_negative() { u64::MAX } else { 0 };
        let used = (0..N).rev().find(|&i| self.words[i] != extension);
        used.map_or(0, |i| 64 * (i + 1) - (self.words[i] ^ extension).leading_zeros() as usize)
    }
}

/// `a - b` modulo `2^(64 N)`.
#[inline(always)]
fn difference<const N: usize>(a: &[u64; N], b: &[u64; N]) -> [u64; N] {
    let mut words = [0; N];
    let mut borrow = false;
    for (word, (a, b)) in words.iter_mut().zip(a.iter().zip(b)) {
        let (partial, under) = a.overflowing_sub(*b);
        let (rest, again) = partial.overflowing_sub(u64::from(borrow));
        *word = rest;
        borrow = under | again;
    }
    words
}

impl<const N: usize> Ring for SmallInteger<N> {
    const IN_PLACE: bool = false;

    #[inline(always)]
    fn read(value: f64, _unit: i32) -> Self {
        let Significand { whole, exponent } = Significand::of(value);
        let mut words = [0; N];
        if exponent <= 0 {
            // Below 2^53; numbers below one are zero, for they are whole.
            words[0] = whole.checked_shr(exponent.unsigned_abs()).unwrap_or(0);
        } else {
            let (word, shift) = (exponent as usize / 64, exponent as usize % 64);
            words[word] = whole << shift;
            // Shifted in two steps, for a shift by 64 is not defined.
            let over = whole >> 1 >> (63 - shift);
            if word + 1 < N {
                words[word + 1] = over;
            } else {
                debug_assert!(over == 0, "a coordinate exceeds the width");
            }
        }
        let number = SmallInteger { words };
        if value < 0.0 { -number } else { number }
    }
}

impl<const N: usize> Add for SmallInteger<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let mut words = [0; N];
        let mut carry = false;
        for (word, (a, b)) in words.iter_mut().zip(self.words.iter().zip(&other.words)) {
            let (partial, over) = a.overflowing_add(*b);
            let (sum, again) = partial.overflowing_add(u64::from(carry));
            *word = sum;
            carry = over | again;
        }
        let sum = SmallInteger { words };
        debug_assert!(
            self.is_negative() != other.is_negative() || sum.is_negative() == self.is_negative(),
            "a sum exceeds the width"
        );
        sum
    }
}

impl<const N: usize> Sub for SmallInteger<N> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        let rest = SmallInteger { words: difference(&self.words, &other.words) };
        debug_assert!(
            self.is_negative() == other.is_negative() || rest.is_negative() == self.is_negative(),
            "a difference exceeds the width"
        );
        rest
    }
}

impl<const N: usize> Mul for SmallInteger<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        debug_assert!(self.bits() + other.bits() <= 64 * N, "a product exceeds the width");
        // The code of a long product is longer than a call.
        if N > 4 { Self::apart(|| self.product(other)) } else { self.product(other) }
    }
}

impl<const N: usize> Neg for SmallInteger<N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        SmallInteger { words: [0; N] } - self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Whole floats below 2^60, and near their largest more often than not.
    fn coordinate() -> impl Strategy<Value = f64> {
        let largest = f64::powi(2.0, 60) - 128.0;
        let whole = (any::<i64>(), 0..8_u32)
            .prop_map(|(bits, shift)| (bits >> 11) as f64 * f64::powi(2.0, shift as i32));
        prop_oneof![whole, Just(largest), Just(-largest), -3.0..3.0_f64].prop_map(f64::trunc)
    }

    fn sample<R: Ring>([a, b, c, d, e, f]: [f64; 6], read: impl Fn(f64) -> R) -> R {
        (read(a) - read(b)) * (read(c) + read(d)) * read(e) + -read(f) * read(a)
    }

    proptest! {
        #[test]
        fn small_and_big_integers_agree(x in prop::array::uniform6(coordinate())) {
            let big = sample(x, |value| BigInteger::read(value, 0)).sign();
            let small = sample(x, |value| SmallInteger::<3>::read(value, 0));
            prop_assert_eq!(small.sign(), big);
            prop_assert_eq!(small.to_big(), sample(x, |value| BigInteger::read(value, 0)));
            let scaled = x.map(|value| value * f64::powi(2.0, 65));
            let big = sample(scaled, |value| BigInteger::read(value, 0)).sign();
            prop_assert_eq!(sample(scaled, |value| SmallInteger::<6>::read(value, 0)).sign(), big);
        }

        #[test]
        fn the_float_of_a_product_is_that_of_big_integers(
            a in coordinate(), b in coordinate(), c in coordinate(),
        ) {
            let small = [a, b, c].map(|value| SmallInteger::<6>::read(value, 0));
            let big = [a, b, c].map(|value| BigInteger::read(value, 0));
            let [x, y, z] = small;
            let [u, v, w] = big;
            let exact = BigInteger::ratio(&(u * v - w), &BigInteger::from(1));
            let rounded = (x * y - z).to_f64();
            prop_assert!((rounded - exact).abs() <= exact.abs() * f64::EPSILON);
        }

        #[test]
        fn quotients_that_are_floats_are_exact(
            a in coordinate(), b in coordinate(), c in coordinate(), d in coordinate(),
        ) {
            prop_assume!(b != 0.0 && c != 0.0);
            let read = |value| SmallInteger::<6>::read(value, 0);
            let divisor = read(b) * read(c);
            prop_assert_eq!(SmallInteger::ratio(&(read(a) * divisor), &divisor), a);
            let big = |value| BigInteger::read(value, 0);
            let exact = BigInteger::ratio(&(big(a) * big(d)), &(big(b) * big(c)));
            let rounded = SmallInteger::ratio(&(read(a) * read(d)), &divisor);
            prop_assert!((rounded - exact).abs() <= exact.abs() * f64::EPSILON);
        }

        #[test]
        fn one_more_than_a_vanishing_difference_is_positive(a in coordinate(), b in coordinate()) {
            let read = |value| SmallInteger::<3>::read(value, 0);
            let rest = read(a) * read(b) - read(b) * read(a);
            prop_assert_eq!(rest.sign(), Sign::Zero);
            prop_assert_eq!((rest + read(1.0)).sign(), Sign::Positive);
            prop_assert_eq!((rest - read(1.0)).sign(), Sign::Negative);
        }
    }
}
