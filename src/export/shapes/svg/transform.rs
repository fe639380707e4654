//! Transform lists: those of SVG 1.1 (section 7.6) and what CSS adds to them
//! (CSS Transforms 1): units of angles and pixels, and some more functions.
//!
//! Quarter turns are exact: their sines and cosines are 0 and 1.

use glam::{DAffine2, DMat2, DVec2, dvec2};

/// Reads a list; it may be empty.
pub(super) fn transform(text: &str) -> Result<DAffine2, String> {
    let mut rest = text.trim_matches(is_space);
    let mut all = DAffine2::IDENTITY;
    if rest.eq_ignore_ascii_case("none") {
        return Ok(all);
    }
    while !rest.is_empty() {
        let Some((name, after)) = rest.split_once('(') else {
            return Err(unknown(rest));
        };
        let Some((list, after)) = after.split_once(')') else {
            return Err(format!("`{rest}` is not closed, expected )"));
        };
        all *= function(name.trim_matches(is_space), list).ok_or_else(|| unknown(rest))?;
        rest = after.trim_start_matches(|c| is_space(c) || c == ',');
    }
    Ok(all)
}

fn unknown(text: &str) -> String {
    let start: String = text.chars().take(40).collect();
    format!(
        "the transform `{start}` cannot be read, expected a list of matrix, translate, scale, \
         rotate and skew with their numbers"
    )
}

fn function(name: &str, list: &str) -> Option<DAffine2> {
    let words: Vec<&str> = list
        .split(|c| is_space(c) || c == ',')
        .filter(|word| !word.is_empty())
        .flat_map(split_numbers)
        .collect();
    let length = |index: usize| words.get(index).and_then(|word| number(word, &[("px", 1.0)]));
    let plain = |index: usize| words.get(index).and_then(|word| number(word, &[]));
    let angle = |index: usize| words.get(index).and_then(|word| number(word, &ANGLES));
    let count = words.len();
    let by = DAffine2::from_translation;
    Some(match (name.to_ascii_lowercase().as_str(), count) {
        ("matrix", 6) => {
            let number = |index: usize| if index < 4 { plain(index) } else { length(index) };
            let column = |i: usize| Some(dvec2(number(i)?, number(i + 1)?));
            DAffine2::from_cols(column(0)?, column(2)?, column(4)?)
        }
        ("translate", 1 | 2) => by(dvec2(length(0)?, if count == 2 { length(1)? } else { 0.0 })),
        ("translatex", 1) => by(dvec2(length(0)?, 0.0)),
        ("translatey", 1) => by(dvec2(0.0, length(0)?)),
        ("scale", 1 | 2) => DAffine2::from_scale(dvec2(plain(0)?, plain(count - 1)?)),
        ("scalex", 1) => DAffine2::from_scale(dvec2(plain(0)?, 1.0)),
        ("scaley", 1) => DAffine2::from_scale(dvec2(1.0, plain(0)?)),
        ("rotate", 1) => DAffine2::from_mat2(turn(angle(0)?)),
        ("rotate", 3) => {
            let center = dvec2(length(1)?, length(2)?);
            by(center) * DAffine2::from_mat2(turn(angle(0)?)) * by(-center)
        }
        ("skewx", 1) => DAffine2::from_mat2(skew(angle(0)?, 0.0)),
        ("skewy", 1) => DAffine2::from_mat2(skew(0.0, angle(0)?)),
        ("skew", 1 | 2) => {
            DAffine2::from_mat2(skew(angle(0)?, if count == 2 { angle(1)? } else { 0.0 }))
        }
        _ => return None,
    })
}

/// Degrees in one of each unit of angles.
const ANGLES: [(&str, f64); 4] =
    [("deg", 1.0), ("grad", 0.9), ("rad", 180.0 / std::f64::consts::PI), ("turn", 360.0)];

/// A number, with one of these units or without.
fn number(word: &str, units: &[(&str, f64)]) -> Option<f64> {
    let lower = word.to_ascii_lowercase();
    let unit = units.iter().find_map(|(unit, factor)| Some((lower.strip_suffix(unit)?, *factor)));
    let (digits, factor) = unit.unwrap_or((&lower, 1.0));
    let is_number = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | 'e');
    let value = digits.parse::<f64>().ok().filter(|_| digits.chars().all(is_number))?;
    Some(value * factor).filter(|value| value.is_finite())
}

/// Numbers that follow one another without space: `1-2` and `.5.5`.
fn split_numbers(word: &str) -> Vec<&str> {
    let bytes = word.as_bytes();
    let (mut parts, mut start, mut has_point) = (Vec::new(), 0, false);
    for (index, byte) in bytes.iter().enumerate().skip(1) {
        let is_exponent = matches!(bytes[index - 1], b'e' | b'E');
        let begins = match byte {
            b'+' | b'-' => !is_exponent,
            b'.' => has_point || bytes[start..index].contains(&b'.'),
            _ => false,
        };
        if begins {
            parts.push(&word[start..index]);
            start = index;
        }
        has_point = *byte == b'.';
    }
    parts.push(&word[start..]);
    parts
}

/// A turn from x to y.
fn turn(degrees: f64) -> DMat2 {
    let axis = match degrees.rem_euclid(360.0) {
        0.0 => DVec2::X,
        90.0 => DVec2::Y,
        180.0 => DVec2::NEG_X,
        270.0 => DVec2::NEG_Y,
        other => DVec2::from_angle(other.to_radians()),
    };
    DMat2::from_cols(axis, axis.perp())
}

fn skew(x: f64, y: f64) -> DMat2 {
    DMat2::from_cols(dvec2(1.0, y.to_radians().tan()), dvec2(x.to_radians().tan(), 1.0))
}

fn is_space(c: char) -> bool {
    matches!(c, ' ' | '\t' | '\n' | '\r' | '\x0c')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(text: &str, x: f64, y: f64) -> DVec2 {
        transform(text).unwrap().transform_point2(dvec2(x, y))
    }

    #[test]
    fn lists_are_read_in_every_spelling() {
        assert_eq!(transform("").unwrap(), DAffine2::IDENTITY);
        assert_eq!(transform(" none ").unwrap(), DAffine2::IDENTITY);
        assert_eq!(image("translate(3)scale(2)", 1.0, 1.0), dvec2(5.0, 2.0));
        assert_eq!(image("scale(2, -3),translate(1-.5)", 1.0, 1.0), dvec2(4.0, -1.5));
        assert_eq!(image("matrix(1 2 3 4 5e0 6)", 1.0, 10.0), dvec2(36.0, 48.0));
        assert_eq!(image("rotate(90)", 3.0, 1.0), dvec2(-1.0, 3.0));
        assert_eq!(image("rotate(-0.5turn, 10px, 0)", 3.0, 1.0), dvec2(17.0, -1.0));
        assert_eq!(image("rotate(100grad) translateX(4px)", 0.0, 0.0), dvec2(0.0, 4.0));
        let skewed = image("skewX(45)", 1.0, 2.0);
        assert!((skewed - dvec2(3.0, 2.0)).length() < 1e-12, "{skewed}");
    }

    #[test]
    fn what_cannot_be_read_is_told() {
        for text in ["foo", "scale(", "scale()", "scale(1,2,3)", "rotate(1em)", "translate(nan)"] {
            let message = transform(text).unwrap_err();
            assert!(message.contains("expected"), "{message}");
        }
    }
}
