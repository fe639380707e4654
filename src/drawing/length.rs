//! Lengths on paper, written with their unit.

use super::DrawingError;
use std::str::FromStr;

/// The units a length may be given in, and millimetres in one of each.
const UNITS: [(&str, f64); 3] = [("mm", 1.0), ("cm", 10.0), ("in", 25.4)];

/// A length on paper, in millimetres; neither negative nor infinite.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct Length(f64);

impl Length {
    /// A length of so many millimetres, if that is a length.
    pub fn new(millimetres: f64) -> Result<Self, DrawingError> {
        if millimetres.is_finite() && 0.0 <= millimetres {
            Ok(Length(millimetres + 0.0))
        } else {
            Err(DrawingError::Length(format!("{millimetres}mm")))
        }
    }

    /// A length that is known to be one.
    pub(super) const fn from_millimetres(millimetres: f64) -> Self {
        Length(millimetres)
    }

    /// The length in millimetres.
    pub fn millimetres(self) -> f64 {
        self.0
    }
}

/// Reads `10mm`, `1.5cm`, `0.5in`; zero needs no unit.
impl FromStr for Length {
    type Err = DrawingError;

    fn from_str(text: &str) -> Result<Self, DrawingError> {
        let refuse = || DrawingError::Length(text.to_owned());
        let (number, factor) = split_unit(text.trim());
        let number = parse_number(number).ok_or_else(refuse)?;
        match factor {
            Some(factor) => Length::new(number * factor).map_err(|_| refuse()),
            None if number == 0.0 => Ok(Length(0.0)),
            None => Err(refuse()),
        }
    }
}

/// Splits off a unit: what is before it, and millimetres in one of it.
pub(super) fn split_unit(text: &str) -> (&str, Option<f64>) {
    for (unit, factor) in UNITS {
        if let Some((number, last)) = text.split_at_checked(text.len().saturating_sub(unit.len()))
            && last.eq_ignore_ascii_case(unit)
        {
            return (number.trim_end(), Some(factor));
        }
    }
    (text, None)
}

/// A plain decimal number, not negative: digits and a point, no exponent.
pub(super) fn parse_number(text: &str) -> Option<f64> {
    let plain = text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    text.parse().ok().filter(|number: &f64| plain && number.is_finite())
}

/// A length in millimetres as a short number: at most three decimals.
pub(super) fn plain(millimetres: f64) -> String {
    let text = format!("{millimetres:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_unit_is_read() {
        for (text, millimetres) in
            [("10mm", 10.0), ("1.5cm", 15.0), ("0.5in", 12.7), (" 2 MM ", 2.0), ("0", 0.0)]
        {
            assert_eq!(text.parse(), Length::new(millimetres), "{text}");
        }
    }

    #[test]
    fn what_is_no_length_is_refused() {
        for text in ["", "10", "mm", "-1mm", "1e3mm", "nanmm", "infmm", "1,5cm", "3px", "é"] {
            let refused = text.parse::<Length>();
            assert_eq!(refused, Err(DrawingError::Length(text.to_owned())), "{text}");
        }
    }
}
