//! Lengths with their units (SVG 1.1, section 7.10).
//!
//! Within a page a length is in user units, of which an inch has 96 before
//! any transform. The sizes of the page itself are wanted in millimetres,
//! and are taken there directly, so that 100 mm are 100.

use super::property::Property;
use svgtypes::{Length, LengthUnit};

/// Millimetres of an inch.
const INCH: f64 = 25.4;

/// User units of an inch.
const DENSITY: f64 = 96.0;

/// Millimetres of a user unit that no transform has changed.
pub(super) const PIXEL: f64 = INCH / DENSITY;

/// What relative lengths are relative to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lengths {
    /// The viewport's width and height, in user units; not a number where
    /// the page has no size.
    pub(super) viewport: [f64; 2],
    /// What one em is, in user units.
    pub(super) font_size: f64,
}

impl Lengths {
    /// What a property says. Percents are those of the viewport along the
    /// property's axis; along neither, of its diagonal over the square root
    /// of two.
    pub(super) fn along(&self, property: Property, text: &str) -> Result<f64, String> {
        let [width, height] = self.viewport;
        let whole = match property {
            Property::X | Property::Width | Property::Cx | Property::Rx => width,
            Property::Y | Property::Height | Property::Cy | Property::Ry => height,
            _ => width.hypot(height) / 2f64.sqrt(),
        };
        self.of(parse(text)?, whole)
    }

    /// A length of which percents are those of a whole.
    pub(super) fn of(&self, length: Length, whole: f64) -> Result<f64, String> {
        let Length { number, unit } = length;
        let value = match unit {
            LengthUnit::None | LengthUnit::Px => number,
            LengthUnit::Em => number * self.font_size,
            LengthUnit::Ex => number * self.font_size / 2.0,
            LengthUnit::Percent if whole.is_nan() => {
                return Err(format!(
                    "{number}% of a page that has no size, expected width and height of <svg>, or \
                     viewBox"
                ));
            }
            LengthUnit::Percent => number / 100.0 * whole,
            _ => number * (millimetres(unit).unwrap_or(PIXEL) / PIXEL),
        };
        match value.is_finite() {
            true => Ok(value),
            false => Err("a length beyond the range of numbers, expected a smaller one".to_owned()),
        }
    }
}

/// A length of the page.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum PageLength {
    Millimetres(f64),
    /// Of what the viewer has, or of the viewBox.
    Percent(f64),
}

/// Reads a width or height of a page; nothing for `auto`.
pub(super) fn page_length(text: &str) -> Result<Option<PageLength>, String> {
    if text.eq_ignore_ascii_case("auto") {
        return Ok(None);
    }
    let Length { number, unit } = parse(text)?;
    Ok(Some(match unit {
        LengthUnit::Percent => PageLength::Percent(number),
        LengthUnit::Em => PageLength::Millimetres(number * 16.0 * PIXEL),
        LengthUnit::Ex => PageLength::Millimetres(number * 8.0 * PIXEL),
        _ => PageLength::Millimetres(number * millimetres(unit).unwrap_or(PIXEL)),
    }))
}

/// The size of a font, in user units.
pub(super) fn font_size(text: &str, parent: f64) -> Option<f64> {
    // Sizes that have names grow by this (CSS 2.1, section 15.7).
    const STEP: f64 = 1.2;
    let named = |steps: i32, medium: f64| Some(medium * STEP.powi(steps));
    match text.to_ascii_lowercase().as_str() {
        "xx-small" => named(-3, 16.0),
        "x-small" => named(-2, 16.0),
        "small" => named(-1, 16.0),
        "medium" | "initial" => named(0, 16.0),
        "large" => named(1, 16.0),
        "x-large" => named(2, 16.0),
        "xx-large" => named(3, 16.0),
        "smaller" => named(-1, parent),
        "larger" => named(1, parent),
        _ => {
            let lengths = Lengths { viewport: [parent; 2], font_size: parent };
            lengths.along(Property::Width, text).ok().filter(|size| *size >= 0.0)
        }
    }
}

fn parse(text: &str) -> Result<Length, String> {
    text.trim().to_ascii_lowercase().parse().map_err(|_| {
        format!(
            "`{text}` is no length, expected a number, perhaps with px, mm, cm, in, pt, pc, em or %"
        )
    })
}

/// Millimetres in one of a unit that is not relative.
fn millimetres(unit: LengthUnit) -> Option<f64> {
    Some(match unit {
        LengthUnit::None | LengthUnit::Px => PIXEL,
        LengthUnit::In => INCH,
        LengthUnit::Cm => 10.0,
        LengthUnit::Mm => 1.0,
        LengthUnit::Pt => INCH / 72.0,
        LengthUnit::Pc => INCH / 6.0,
        LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_unit_is_what_it_is_on_the_page() {
        let lengths = Lengths { viewport: [200.0, 50.0], font_size: 10.0 };
        for (text, expected) in [
            ("7", 7.0),
            (" 7PX ", 7.0),
            ("1in", 96.0),
            ("25.4mm", 96.0),
            ("2.54cm", 96.0),
            ("72pt", 96.0),
            ("6pc", 96.0),
            ("2em", 20.0),
            ("2ex", 10.0),
            ("50%", 100.0),
            ("-1e1", -10.0),
        ] {
            let found = lengths.along(Property::X, text).unwrap();
            assert!((found - expected).abs() < 1e-12, "{text}: {found}");
        }
        assert_eq!(lengths.along(Property::Height, "50%"), Ok(25.0));
        let square = Lengths { viewport: [30.0; 2], font_size: 10.0 };
        assert_eq!(square.along(Property::R, "50%"), Ok(15.0));
        for text in ["", "7 mm x", "7furlongs", "1e999", "auto"] {
            assert!(lengths.along(Property::X, text).is_err(), "{text}");
        }
        assert_eq!(page_length("100mm"), Ok(Some(PageLength::Millimetres(100.0))));
        assert_eq!(page_length("100%"), Ok(Some(PageLength::Percent(100.0))));
        assert_eq!(page_length("auto"), Ok(None));
    }

    #[test]
    fn percents_of_a_page_without_a_size_are_refused() {
        let lengths = Lengths { viewport: [f64::NAN; 2], font_size: 10.0 };
        assert!(lengths.along(Property::X, "5%").unwrap_err().contains("no size"));
    }
}
