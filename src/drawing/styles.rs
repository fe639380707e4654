//! How lines look: what is said of all, of a class, of an object.
//!
//! A piece has one look. It begins with the widths of the options; weight,
//! then the rule for visible lines or for the level of hidden ones, then
//! that of the class, then what is asked of the outer outline, then those of
//! the object each overrule what they name. Of hidden lines, classes and objects decide the pen and the colour
//! only: what is hidden looks hidden.

use super::weight::Weights;
use super::{Dash, DrawingOptions, Hidden, HiddenBy};
use crate::model::Color;
use crate::view::{LineClass, LinePiece};

/// What a rule says; nothing where it says nothing.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LineRule {
    /// Width, mm.
    pub width: Option<f64>,
    /// Colour.
    pub color: Option<Color>,
    /// Type of line.
    pub dash: Option<Dash>,
    /// The number of the layer, which is the pen of a plotter; at least 1.
    pub pen: Option<u32>,
}

/// What is said of objects with a name.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ObjectRule {
    /// The name; `*` stands for any characters.
    pub name: String,
    /// How its lines look.
    pub line: LineRule,
    /// Whether it is left out of the scene.
    pub exclude: bool,
    /// Whether it hides nothing.
    pub see_through: bool,
    /// Its own threshold of creases, degrees.
    pub crease: Option<f64>,
}

/// Rules for the lines of a drawing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Styles {
    /// For visible lines.
    pub visible: LineRule,
    /// For lines behind one sheet or solid, behind two, and so on; the last
    /// one is for all behind more. Where hidden lines are not told apart, the
    /// first is for all.
    pub hidden: Vec<LineRule>,
    /// For visible lines of classes.
    pub classes: Vec<(LineClass, LineRule)>,
    /// For the outer outline, where that was looked for.
    pub outline: LineRule,
    /// For objects; later rules overrule earlier ones.
    pub objects: Vec<ObjectRule>,
}

impl Styles {
    /// The levels of hidden lines that are told apart.
    pub(super) fn levels(&self, options: &DrawingOptions) -> u32 {
        match options.hidden_by {
            HiddenBy::Together => 1,
            _ => (self.hidden.len() as u32).max(DEFAULT_LEVELS),
        }
    }

    /// The level of a piece: 0 is visible.
    pub(super) fn level(&self, piece: &LinePiece, options: &DrawingOptions) -> u32 {
        let behind = match options.hidden_by {
            HiddenBy::Solids => piece.invisibility.div_ceil(2),
            HiddenBy::Together | HiddenBy::Sheets => piece.invisibility,
        };
        behind.min(self.levels(options))
    }

    /// The look of a piece of an object called `object`.
    pub(super) fn look(
        &self,
        piece: &LinePiece,
        object: &str,
        options: &DrawingOptions,
        weights: Option<&Weights>,
    ) -> Look {
        let level = self.level(piece, options);
        let mut look = if level == 0 {
            let width = weights.map(|weights| weights.widths[weights.step(piece)]);
            let width = width.unwrap_or(options.visible_width);
            Look { width, ..Look::default() }
        } else {
            let dash = match options.hidden {
                Hidden::Dashed => Dash::of_level(level),
                _ => Dash::Continuous,
            };
            Look { width: options.hidden_width, dash, ..Look::default() }
        };
        let own = if level == 0 {
            Some(&self.visible)
        } else {
            let last = self.hidden.len().wrapping_sub(1);
            self.hidden.get(last.min(level as usize - 1))
        };
        own.into_iter().for_each(|rule| look.apply(rule));
        let color_and_pen = |rule: &LineRule| LineRule { width: None, dash: None, ..*rule };
        let narrowed = |rule: &LineRule| if level == 0 { *rule } else { color_and_pen(rule) };
        for (_, rule) in self.classes.iter().filter(|(class, _)| *class == piece.class) {
            look.apply(&narrowed(rule));
        }
        if piece.outline {
            look.width = options.outline_width().unwrap_or(look.width);
            look.apply(&self.outline);
        }
        for rule in self.objects.iter().filter(|rule| matches(&rule.name, object)) {
            look.apply(&narrowed(&rule.line));
        }
        look
    }
}

/// Levels of hidden lines, if rules do not ask for more: behind one, behind
/// two, behind more.
const DEFAULT_LEVELS: u32 = 3;

/// How lines of one layer look.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Look {
    pub(super) width: f64,
    pub(super) color: Color,
    pub(super) dash: Dash,
    pub(super) pen: Option<u32>,
}

impl Default for Look {
    fn default() -> Self {
        Look { width: 0.0, color: Color([0; 3]), dash: Dash::Continuous, pen: None }
    }
}

impl Look {
    fn apply(&mut self, rule: &LineRule) {
        self.width = rule.width.unwrap_or(self.width);
        self.color = rule.color.unwrap_or(self.color);
        self.dash = rule.dash.unwrap_or(self.dash);
        self.pen = rule.pen.or(self.pen);
    }

    /// Wide lines first, then by colour, type and pen.
    pub(super) fn compare(&self, other: &Self) -> std::cmp::Ordering {
        let key = |look: &Look| (look.color.0, look.dash, look.pen);
        other.width.total_cmp(&self.width).then_with(|| key(self).cmp(&key(other)))
    }
}

/// Whether a name fits a pattern in which `*` stands for any characters.
/// O(pattern times name).
pub fn matches(pattern: &str, name: &str) -> bool {
    let Some((first, rest)) = pattern.split_once('*') else {
        return pattern == name;
    };
    let Some(name) = name.strip_prefix(first) else {
        return false;
    };
    // The shortest way to the next part is as good as any; the last part
    // must end the name.
    let mut name = name;
    let parts: Vec<&str> = rest.split('*').collect();
    for (index, part) in parts.iter().enumerate() {
        if index + 1 == parts.len() {
            return name.ends_with(part);
        }
        match name.find(part) {
            Some(at) => name = &name[at + part.len()..],
            None => return false,
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::matches;

    #[test]
    fn stars_stand_for_any_characters() {
        for (pattern, name, fits) in [
            ("wheel", "wheel", true),
            ("wheel", "wheels", false),
            ("wheel*", "wheel-3", true),
            ("*", "", true),
            ("*-left", "door-left", true),
            ("a*b*c", "a-bb-c", true),
            ("a*b", "ab-", false),
            ("ab*ab", "ab", false),
        ] {
            assert_eq!(matches(pattern, name), fits, "{pattern} {name}");
        }
    }
}
