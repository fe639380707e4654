//! A float as an integer times a power of two [IEEE 754].

/// A finite float without its sign: `whole * 2^exponent`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Significand {
    /// At most 53 bits.
    pub(crate) whole: u64,
    /// From -1074 to 971.
    pub(crate) exponent: i32,
}

impl Significand {
    /// The parts of `|value|`, exactly; `value` is finite.
    #[inline(always)]
    pub(crate) fn of(value: f64) -> Self {
        let bits = value.to_bits();
        let field = ((bits >> 52) & 0x7ff) as i32;
        let fraction = bits & ((1 << 52) - 1);
        // Subnormal numbers have no leading one.
        let leading = u64::from(field != 0) << 52;
        Significand { whole: fraction | leading, exponent: field.max(1) - 1075 }
    }
}

#[cfg(test)]
mod tests {
    use super::Significand;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn is_the_float_again(value in proptest::num::f64::NORMAL | proptest::num::f64::SUBNORMAL) {
            let Significand { whole, exponent } = Significand::of(value);
            prop_assert!(whole < 1 << 53);
            prop_assert!((-1074..=971).contains(&exponent));
            // In two steps, each of which is exact: the powers alone may
            // leave the range of floats.
            let half = exponent / 2;
            let scaled = whole as f64 * f64::powi(2.0, half) * f64::powi(2.0, exponent - half);
            prop_assert_eq!(scaled, value.abs());
        }
    }

    #[test]
    fn zero_and_the_ends_of_the_range() {
        assert_eq!(Significand::of(-0.0).whole, 0);
        assert_eq!(Significand::of(5e-324), Significand { whole: 1, exponent: -1074 });
        let least = Significand { whole: 1 << 52, exponent: -1074 };
        assert_eq!(Significand::of(f64::MIN_POSITIVE), least);
        let largest = Significand { whole: (1 << 53) - 1, exponent: 971 };
        assert_eq!(Significand::of(f64::MAX), largest);
    }
}
