//! Millimetres as short decimal numbers, quickly.
//!
//! A coordinate is multiplied by a power of ten and rounded to an integer,
//! ties to even; that integer is what is compared and what is written. Page
//! coordinates stay below 10⁶ mm and decimals below 10, so the integers
//! stay below 2⁵³ and every one of them is exact.

/// Powers of ten by their number of zeros.
const POWERS: [f64; 10] = [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9];

/// The multiples of 10^-decimals.
#[derive(Debug, Clone, Copy)]
pub(super) struct DecimalGrid {
    decimals: usize,
}

impl DecimalGrid {
    /// The grid of 0 to 9 decimals.
    pub(super) fn new(decimals: u8) -> Option<Self> {
        let decimals = usize::from(decimals);
        (decimals < POWERS.len()).then_some(DecimalGrid { decimals })
    }

    /// The nearest multiple, as an integer.
    pub(super) fn round(self, value: f64) -> i64 {
        (value * POWERS[self.decimals]).round_ties_even() as i64
    }

    /// Appends a multiple without trailing zeros: `12.5`, `-0.001`, `0`.
    pub(super) fn push(self, out: &mut String, multiple: i64) {
        let mut digits = [0; 32];
        let mut start = digits.len();
        let mut rest = multiple.unsigned_abs();
        let mut decimals = self.decimals;
        while 0 < decimals && rest.is_multiple_of(10) {
            rest /= 10;
            decimals -= 1;
        }
        let mut written = 0;
        while 0 < rest || written <= decimals {
            if written == decimals && 0 < decimals {
                start -= 1;
                digits[start] = b'.';
            }
            start -= 1;
            digits[start] = b'0' + (rest % 10) as u8;
            rest /= 10;
            written += 1;
        }
        if multiple < 0 {
            start -= 1;
            digits[start] = b'-';
        }
        out.extend(digits[start..].iter().map(|digit| char::from(*digit)));
    }

    /// `value` rounded and written.
    pub(super) fn format(self, value: f64) -> String {
        let mut text = String::new();
        self.push(&mut text, self.round(value));
        text
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn zeros_are_trimmed_and_never_negative() {
        let grid = DecimalGrid::new(3).unwrap();
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (-0.0004, "0"),
            (-0.0006, "-0.001"),
            (12.5, "12.5"),
            (100.0, "100"),
            (0.05, "0.05"),
            (-7.125, "-7.125"),
            (1e6, "1000000"),
        ] {
            assert_eq!(grid.format(value), text);
        }
        assert_eq!(DecimalGrid::new(0).unwrap().format(2.5), "2");
        assert!(DecimalGrid::new(10).is_none());
    }

    proptest! {
        #[test]
        fn the_text_is_the_number_on_the_grid(value in -1e6..1e6f64, decimals in 0u8..10) {
            let grid = DecimalGrid::new(decimals).unwrap();
            let text = grid.format(value);
            let step = 10f64.powi(-i32::from(decimals));
            let read: f64 = text.parse().unwrap();
            prop_assert!((read - value).abs() <= 0.5 * step * (1.0 + 1e-5) + 1e-9);
            prop_assert_eq!(grid.round(read), grid.round(value));
            prop_assert!(!text.contains('.') || !text.ends_with(['0', '.']));
        }
    }
}
