//! Sheets of paper, under the names that vpype gives them.

use super::DrawingError;
use super::length::{parse_number, split_unit};
use std::str::FromStr;

/// Named sheets: short side and long side, mm.
const SHEETS: [(&str, f64, f64); 11] = [
    ("a6", 105.0, 148.0),
    ("a5", 148.0, 210.0),
    ("a4", 210.0, 297.0),
    ("a3", 297.0, 420.0),
    ("a2", 420.0, 594.0),
    ("a1", 594.0, 841.0),
    ("a0", 841.0, 1189.0),
    ("letter", 215.9, 279.4),
    ("legal", 215.9, 355.6),
    ("executive", 184.15, 266.7),
    ("tabloid", 279.4, 431.8),
];

/// The longest side of a page, mm: a kilometre.
pub(super) const LONGEST: f64 = 1e6;

/// What the drawing is put on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Paper {
    /// As large as the drawing and its margins.
    Tight,
    /// A sheet of this width and height, mm.
    Sheet {
        /// From left to right.
        width: f64,
        /// From top to bottom.
        height: f64,
    },
}

impl Paper {
    /// A5, upright.
    pub const A5: Paper = Paper::Sheet { width: 148.0, height: 210.0 };

    /// A4, upright.
    pub const A4: Paper = Paper::Sheet { width: 210.0, height: 297.0 };

    /// The same sheet with its longer side lying.
    #[must_use]
    pub fn landscape(self) -> Self {
        match self {
            Paper::Sheet { width, height } if width < height => {
                Paper::Sheet { width: height, height: width }
            }
            other => other,
        }
    }
}

/// Reads a name, or a size as in `200x100mm`, `8.5inx11in`, `20cmx100mm`.
/// The unit of the width may be left out if the height has it.
impl FromStr for Paper {
    type Err = DrawingError;

    fn from_str(text: &str) -> Result<Self, DrawingError> {
        let name = text.trim().to_ascii_lowercase();
        if name == "tight" {
            return Ok(Paper::Tight);
        }
        if let Some((_, width, height)) = SHEETS.into_iter().find(|sheet| sheet.0 == name) {
            return Ok(Paper::Sheet { width, height });
        }
        parse_size(&name).ok_or_else(|| DrawingError::Paper(text.to_owned()))
    }
}

fn parse_size(text: &str) -> Option<Paper> {
    let (width, height) = text.split_once('x')?;
    let (height, unit) = split_unit(height.trim());
    let unit = unit?;
    let (width, own_unit) = split_unit(width.trim());
    let width = parse_number(width)? * own_unit.unwrap_or(unit);
    let height = parse_number(height)? * unit;
    let possible = |side: f64| 0.0 < side && side <= LONGEST;
    (possible(width) && possible(height)).then_some(Paper::Sheet { width, height })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_sizes_are_read() {
        let sheet = |width, height| Ok(Paper::Sheet { width, height });
        assert_eq!("a4".parse(), Ok(Paper::A4));
        assert_eq!("Tight".parse(), Ok(Paper::Tight));
        assert_eq!("Letter".parse(), sheet(215.9, 279.4));
        assert_eq!("200x100mm".parse(), sheet(200.0, 100.0));
        assert_eq!("20cmx100mm".parse(), sheet(200.0, 100.0));
        assert_eq!("2 x 4in".parse(), sheet(50.8, 101.6));
    }

    #[test]
    fn what_is_no_paper_is_refused() {
        for text in ["", "a7", "200x100", "0x10mm", "10mm", "10xmm", "-1x5mm", "1x2x3mm", "x"] {
            let refused = text.parse::<Paper>();
            assert_eq!(refused, Err(DrawingError::Paper(text.to_owned())), "{text}");
        }
    }

    #[test]
    fn landscape_turns_only_what_stands() {
        let lying = Paper::Sheet { width: 297.0, height: 210.0 };
        assert_eq!(Paper::A4.landscape(), lying);
        assert_eq!(lying.landscape(), lying);
        assert_eq!(Paper::Tight.landscape(), Paper::Tight);
    }
}
