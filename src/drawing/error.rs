//! What can be wrong with the wishes for a page.

use crate::run::Cancelled;

/// A drawing cannot be laid out, or a wish for it cannot be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DrawingError {
    /// The run was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// Not a length.
    #[error("`{0}` is no length; expected a number with mm, cm or in, as in 10mm")]
    Length(String),
    /// Not a paper.
    #[error(
        "`{0}` is no paper; expected tight, a6 to a0, letter, legal, executive, tabloid, \
         or a size as in 200x100mm"
    )]
    Paper(String),
    /// Not a scale.
    #[error("`{0}` is no scale; expected fit, a ratio as in 1:2, or a factor as in 0.5")]
    Scale(String),
    /// Not a window of the picture.
    #[error("`{0}` is no frame; expected two corners U0,V0,U1,V1 with an area between them")]
    Window(String),
    /// A window in which there is nothing to draw.
    #[error(
        "nothing is drawn in this frame; the lines reach from {},{} to {},{}",
        low[0], low[1], high[0], high[1]
    )]
    EmptyWindow {
        /// The left and lower border of all lines.
        low: [f64; 2],
        /// The right and upper border of all lines.
        high: [f64; 2],
    },
    /// Not a range of widths.
    #[error("`{0}` is no range of widths; expected near and far with a unit, as in 0.7..0.18mm")]
    Weight(String),
    /// A style file that cannot be read.
    #[error("line {line}: {message}")]
    Styles {
        /// Where, counted from 1.
        line: usize,
        /// What is wrong.
        message: String,
    },
    /// A hatch too fine to be one.
    #[error("hatch lines {0} mm apart; expected at least 0.02 mm")]
    HatchSpacing(f64),
    /// A word that is none of the words expected.
    #[error("`{word}` is no choice here; expected {expected}")]
    Choice {
        /// The word given.
        word: String,
        /// The words that would do.
        expected: &'static str,
    },
    /// A pen width outside 0.01 mm to 100 mm.
    #[error("a line of {0} mm cannot be drawn; expected 0.01 mm to 100 mm")]
    PenWidth(f64),
    /// The margins leave nothing of the page.
    #[error("a margin of {margin} mm leaves nothing of a page of {width} x {height} mm")]
    Margin {
        /// The margin, mm.
        margin: f64,
        /// Width of the page, mm.
        width: f64,
        /// Height of the page, mm.
        height: f64,
    },
    /// At the scale asked for the drawing is larger than the page.
    #[error(
        "at this scale the drawing measures {width:.1} x {height:.1} mm, more than the page of \
         {page_width} x {page_height} mm; expected a smaller scale, larger paper, or tight"
    )]
    TooLarge {
        /// Width of the drawing, mm.
        width: f64,
        /// Height of the drawing, mm.
        height: f64,
        /// Width of the page, mm.
        page_width: f64,
        /// Height of the page, mm.
        page_height: f64,
    },
    /// Tight paper would be longer than a kilometre.
    #[error("at this scale the page measures {width} x {height} mm; expected less than 1000000")]
    Endless {
        /// Width of the page, mm.
        width: f64,
        /// Height of the page, mm.
        height: f64,
    },
    /// A ratio of lengths was asked of a perspective view.
    #[error(
        "a perspective view has no ratio of lengths; expected the scale fit, or a factor: \
         the distance in mm from which the page is to be looked at"
    )]
    PerspectiveRatio,
    /// Coordinates that are not finite, or so large that their extent is not.
    #[error("the lines have coordinates that are not finite or too far apart for a page")]
    NotFinite,
}
