//! Types of lines: what is drawn of a line and what is left out.
//!
//! ISO 128-2 numbers them and measures their dashes and gaps in line widths:
//! a gap is 3, a dash 12, a long dash 24, a dot half a width, which round
//! ends make a dot of.

use super::DrawingError;
use std::str::FromStr;

/// A type of line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, PartialOrd, Ord, Hash)]
pub enum Dash {
    /// Without gaps (ISO 128-2, type 01).
    #[default]
    Continuous,
    /// Dashes (02).
    Dashed,
    /// Dashes of half the length, for what lies behind more.
    Short,
    /// Dots (07).
    Dotted,
    /// A long dash and a dot: centre lines (04).
    Chain,
    /// A long dash and two dots: phantom lines (05).
    DoubleChain,
}

impl Dash {
    /// All types and their names.
    const NAMES: [(&str, Dash); 6] = [
        ("continuous", Dash::Continuous),
        ("dashed", Dash::Dashed),
        ("short", Dash::Short),
        ("dotted", Dash::Dotted),
        ("chain", Dash::Chain),
        ("double-chain", Dash::DoubleChain),
    ];

    /// Dashes and gaps of a period by turns, in line widths; a line begins
    /// and ends with the first dash.
    pub(super) fn elements(self) -> &'static [f64] {
        match self {
            Dash::Continuous => &[],
            Dash::Dashed => &[12.0, 3.0],
            Dash::Short => &[6.0, 3.0],
            Dash::Dotted => &[0.5, 3.0],
            Dash::Chain => &[24.0, 3.0, 0.5, 3.0],
            Dash::DoubleChain => &[24.0, 3.0, 0.5, 3.0, 0.5, 3.0],
        }
    }

    /// What is drawn of lines behind so many sheets or solids, from 1.
    pub(super) fn of_level(level: u32) -> Self {
        match level {
            0 => Dash::Continuous,
            1 => Dash::Dashed,
            2 => Dash::Short,
            _ => Dash::Dotted,
        }
    }
}

/// Reads `continuous`, `dashed`, `short`, `dotted`, `chain`, `double-chain`.
impl FromStr for Dash {
    type Err = DrawingError;

    fn from_str(text: &str) -> Result<Self, DrawingError> {
        let found = Self::NAMES.into_iter().find(|(name, _)| *name == text);
        found.map(|(_, dash)| dash).ok_or_else(|| DrawingError::Choice {
            word: text.to_owned(),
            expected: "continuous, dashed, short, dotted, chain or double-chain",
        })
    }
}
