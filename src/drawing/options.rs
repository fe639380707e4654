//! What may be wished of a drawing.

use super::{DrawingError, Length, Paper, Scale, Weight, Window};
use crate::model::Unit;
use std::str::FromStr;

/// How hidden lines are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Hidden {
    /// Not at all.
    #[default]
    None,
    /// As dashes.
    Dashed,
    /// As thin lines.
    Solid,
}

/// Reads `none`, `dashed`, `solid`.
impl FromStr for Hidden {
    type Err = DrawingError;

    fn from_str(text: &str) -> Result<Self, DrawingError> {
        match text {
            "none" => Ok(Hidden::None),
            "dashed" => Ok(Hidden::Dashed),
            "solid" => Ok(Hidden::Solid),
            _ => Err(refuse(text, "none, dashed or solid")),
        }
    }
}

/// What hidden lines are told apart by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum HiddenBy {
    /// Nothing: hidden is hidden.
    #[default]
    Together,
    /// The number of surfaces in front.
    Sheets,
    /// The number of closed solids in front: two surfaces are one.
    Solids,
}

impl HiddenBy {
    /// Whether there is more than one kind of hidden lines.
    pub fn tells_apart(self) -> bool {
        self != HiddenBy::Together
    }
}

/// Reads `together`, `sheets`, `solids`.
impl FromStr for HiddenBy {
    type Err = DrawingError;

    fn from_str(text: &str) -> Result<Self, DrawingError> {
        match text {
            "together" => Ok(HiddenBy::Together),
            "sheets" => Ok(HiddenBy::Sheets),
            "solids" => Ok(HiddenBy::Solids),
            _ => Err(refuse(text, "together, sheets or solids")),
        }
    }
}

/// What decides the layer of a line. Hidden lines always have layers of
/// their own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LayerBy {
    /// Visible or hidden.
    #[default]
    Visibility,
    /// The class of the line.
    Class,
    /// The name of the object.
    Object,
    /// The class within the object.
    Part,
}

/// Reads `visibility`, `class`, `object`, `part`.
impl FromStr for LayerBy {
    type Err = DrawingError;

    fn from_str(text: &str) -> Result<Self, DrawingError> {
        match text {
            "visibility" => Ok(LayerBy::Visibility),
            "class" => Ok(LayerBy::Class),
            "object" => Ok(LayerBy::Object),
            "part" => Ok(LayerBy::Part),
            _ => Err(refuse(text, "visibility, class, object or part")),
        }
    }
}

/// Which segments may be joined to one stroke.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Join {
    /// All of a layer.
    #[default]
    All,
    /// Those of one class: a contour goes on as a contour, whatever joins it.
    Class,
}

/// Reads `all`, `class`.
impl FromStr for Join {
    type Err = DrawingError;

    fn from_str(text: &str) -> Result<Self, DrawingError> {
        match text {
            "all" => Ok(Join::All),
            "class" => Ok(Join::Class),
            _ => Err(refuse(text, "all or class")),
        }
    }
}

fn refuse(word: &str, expected: &'static str) -> DrawingError {
    DrawingError::Choice { word: word.to_owned(), expected }
}

/// The wishes for a page. The default is A4 upright, margins of 10 mm, as
/// large as fits, visible lines only, in the ISO 128 line group 0.5.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DrawingOptions {
    /// What the drawing is put on.
    pub paper: Paper,
    /// Whether the longer side of the paper lies.
    pub landscape: bool,
    /// The border kept free when the drawing is fitted, or added around it
    /// on tight paper.
    pub margin: Length,
    /// The part of the picture that is drawn, cut at its border; it and not
    /// the box of the lines is then fitted and centred.
    pub window: Option<Window>,
    /// How large the drawing becomes.
    pub scale: Scale,
    /// The unit of the view frame's lengths.
    pub unit: Unit,
    /// What decides the layer of a line.
    pub layer_by: LayerBy,
    /// How hidden lines are drawn.
    pub hidden: Hidden,
    /// What hidden lines are told apart by, in layers and types of line.
    pub hidden_by: HiddenBy,
    /// Of lines that run within this distance of one another one is drawn; 0
    /// leaves all. Without one it is 0.02 mm or a tenth of the width of the
    /// line that is drawn, whichever is more.
    pub merge: Option<Length>,
    /// How wide the gap is in a line where another passes in front of it,
    /// across that one; 0 is no gap.
    pub halo: Length,
    /// Widths of visible lines by depth or class, in place of one width.
    pub weight: Option<Weight>,
    /// Width of the outer outline, where that was looked for; 0 is that of
    /// other visible lines.
    pub outline: Length,
    /// Which segments may be joined to one stroke.
    pub join: Join,
    /// Whether strokes keep a point on a straight line where others meet it.
    /// Wanted where the strokes are put in order later, so that the pen may
    /// pass there from one to another; otherwise such points are nothing.
    pub junctions: bool,
    /// Strokes shorter than this are left out; 0 leaves out none.
    pub min_length: Length,
    /// Points are left out as long as strokes stay within this distance of
    /// what was found, measured both ways; 0 leaves out none.
    pub simplify: Length,
    /// Curves are fitted within this distance, measured both ways, and points
    /// left out where no curve fits; 0 fits none.
    pub fit: Length,
    /// Width of visible lines, mm: 0.5, the wide line of ISO 128 for sheets
    /// up to A2.
    pub visible_width: f64,
    /// Width of hidden lines, mm: 0.25, the narrow line of the same group.
    /// Dashes are measured in it.
    pub hidden_width: f64,
}

impl Default for DrawingOptions {
    fn default() -> Self {
        DrawingOptions {
            paper: Paper::A4,
            landscape: false,
            margin: DEFAULT_MARGIN,
            window: None,
            scale: Scale::Fit,
            unit: Unit::Millimetre,
            layer_by: LayerBy::Visibility,
            hidden: Hidden::None,
            hidden_by: HiddenBy::Together,
            merge: None,
            halo: Length::from_millimetres(0.0),
            weight: None,
            outline: Length::from_millimetres(0.0),
            join: Join::All,
            junctions: false,
            min_length: Length::from_millimetres(0.0),
            simplify: Length::from_millimetres(0.0),
            fit: Length::from_millimetres(0.0),
            visible_width: 0.5,
            hidden_width: 0.25,
        }
    }
}

impl DrawingOptions {
    /// The width of the outer outline, mm, if it has one of its own.
    pub(super) fn outline_width(&self) -> Option<f64> {
        Some(self.outline.millimetres()).filter(|width| *width != 0.0)
    }
}

/// The margin unless another is asked for: 10 mm.
const DEFAULT_MARGIN: Length = Length::from_millimetres(10.0);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_are_read_by_their_names() {
        assert_eq!("dashed".parse(), Ok(Hidden::Dashed));
        assert_eq!("object".parse(), Ok(LayerBy::Object));
        let refused = "dotted".parse::<Hidden>();
        assert_eq!(refused, Err(refuse("dotted", "none, dashed or solid")));
    }
}
