//! Whole ways to draw, by name.
//!
//! - `technical`: hidden lines dashed, wide and narrow lines of the ISO 128
//!   line group 0.5, strokes of one class each.
//! - `sketch`: lines wide in front and narrow behind, interrupted behind
//!   others, as curves.
//! - `plotter`: one pen of 0.3 mm, no needless points, nothing too short for
//!   a pen, a short way between strokes.
//! - `patent`: black, the borders of PCT rule 11 at their widest (2.5 cm),
//!   outlines heavier than folds.

use super::{DrawingError, DrawingOptions, Effort, Hidden, Join, Length, Weight, WeightBy};
use std::str::FromStr;

/// A way to draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Preset {
    /// For workshops.
    Technical,
    /// For the eye.
    Sketch,
    /// For pens.
    Plotter,
    /// For patent offices.
    Patent,
}

/// Reads `technical`, `sketch`, `plotter`, `patent`.
impl FromStr for Preset {
    type Err = DrawingError;

    fn from_str(text: &str) -> Result<Self, DrawingError> {
        match text {
            "technical" => Ok(Preset::Technical),
            "sketch" => Ok(Preset::Sketch),
            "plotter" => Ok(Preset::Plotter),
            "patent" => Ok(Preset::Patent),
            _ => Err(DrawingError::Choice {
                word: text.to_owned(),
                expected: "technical, sketch, plotter or patent",
            }),
        }
    }
}

impl Preset {
    /// What it asks of a page.
    pub fn options(self) -> DrawingOptions {
        let default = DrawingOptions::default();
        let length = Length::from_millimetres;
        let weight = |near, far, by| Some(Weight { near, far, by, steps: None });
        match self {
            Preset::Technical => {
                DrawingOptions { hidden: Hidden::Dashed, join: Join::Class, ..default }
            }
            Preset::Sketch => DrawingOptions {
                weight: weight(0.7, 0.18, WeightBy::Depth),
                halo: length(1.2),
                fit: length(0.05),
                ..default
            },
            Preset::Plotter => DrawingOptions {
                visible_width: 0.3,
                hidden_width: 0.3,
                simplify: length(0.02),
                min_length: length(0.2),
                ..default
            },
            Preset::Patent => DrawingOptions {
                margin: length(25.0),
                weight: weight(0.7, 0.25, WeightBy::Class),
                ..default
            },
        }
    }

    /// How its strokes are put in order.
    pub fn effort(self) -> Effort {
        match self {
            Preset::Plotter => Effort::Best,
            _ => Effort::Keep,
        }
    }
}
