//! How large the model becomes on paper.

use super::DrawingError;
use super::length::parse_number;
use std::str::FromStr;

/// Millimetres of paper for a length of the image.
///
/// Orthographic views have true lengths: ratio and factor both say paper
/// length by model length. A perspective view has none; its image plane is
/// measured in tangents, and a factor says how many millimetres one unit of
/// tangent becomes. That is the distance from which the page, looked at,
/// shows the model as the eye saw it: 300 for reading distance.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Scale {
    /// As large as the page allows; 1:1 on tight paper.
    #[default]
    Fit,
    /// Paper length by model length, given as a ratio. Orthographic only.
    Ratio(f64),
    /// Paper length by model length, or mm per unit of tangent.
    Factor(f64),
}

/// Reads `fit`, `1:2`, `0.5`.
impl FromStr for Scale {
    type Err = DrawingError;

    fn from_str(text: &str) -> Result<Self, DrawingError> {
        let plain = text.trim();
        let scale = match plain.split_once(':') {
            _ if plain.eq_ignore_ascii_case("fit") => Some(Scale::Fit),
            Some((paper, model)) => ratio(paper, model).map(Scale::Ratio),
            None => parse_number(plain).filter(|factor| 0.0 < *factor).map(Scale::Factor),
        };
        scale.ok_or_else(|| DrawingError::Scale(text.to_owned()))
    }
}

fn ratio(paper: &str, model: &str) -> Option<f64> {
    let ratio = parse_number(paper.trim())? / parse_number(model.trim())?;
    (ratio.is_finite() && 0.0 < ratio).then_some(ratio)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fit_ratios_and_factors_are_read() {
        assert_eq!("fit".parse(), Ok(Scale::Fit));
        assert_eq!("1:2".parse(), Ok(Scale::Ratio(0.5)));
        assert_eq!("5 : 1".parse(), Ok(Scale::Ratio(5.0)));
        assert_eq!("0.5".parse(), Ok(Scale::Factor(0.5)));
    }

    #[test]
    fn what_is_no_scale_is_refused() {
        for text in ["", "0", "1:0", "0:1", "-1", "big", "1:2:3", "inf", "nan:1"] {
            let refused = text.parse::<Scale>();
            assert_eq!(refused, Err(DrawingError::Scale(text.to_owned())), "{text}");
        }
    }
}
