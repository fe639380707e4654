//! Rules for lines and objects from a TOML file.
//!
//! ```toml
//! [visible]                 # width, color, line, pen: each may be left out
//! width = "0.5mm"
//! color = "#1b1b3a"
//!
//! [[hidden]]                # behind one surface or solid; the next behind two
//! line = "dashed"           # continuous, dashed, short, dotted, chain, double-chain
//!
//! [class.crease]
//! width = "0.25mm"
//!
//! [outline]                 # where visible lines part the picture from the background
//! width = "0.7mm"
//!
//! [object."wheel*"]         # * stands for any characters
//! pen = 3                   # rules apply in the order of their names
//! crease = 20               # degrees; also: exclude = true, see-through = true
//! ```

use super::{Dash, DrawingError, Length, LineRule, ObjectRule, Styles};
use crate::model::Color;
use crate::view::LineClass;
use serde::Deserialize;
use std::collections::BTreeMap;

/// Reads rules.
///
/// # Errors
///
/// If the text is no table of rules: says where, and what is wrong.
pub fn read_styles(text: &str) -> Result<Styles, DrawingError> {
    let table: StylesText = toml::from_str(text).map_err(|error| {
        let at = error.span().map_or(0, |span| span.start).min(text.len());
        let line = text.get(..at).unwrap_or_default().matches('\n').count() + 1;
        DrawingError::Styles { line, message: error.message().to_owned() }
    })?;
    let class = |(name, rule): (String, LineText)| {
        let class = LineClass::from_name(&name).ok_or(DrawingError::Choice {
            word: name,
            expected: "contour, boundary, non-manifold, crease, intersection, line or mesh",
        })?;
        Ok::<_, DrawingError>((class, rule.rule()?))
    };
    let hidden: Result<_, _> = table.hidden.iter().map(LineText::rule).collect();
    let classes: Result<_, _> = table.class.into_iter().map(class).collect();
    let objects: Result<_, _> =
        table.object.into_iter().map(|(name, object)| object.rule(name)).collect();
    Ok(Styles {
        visible: table.visible.rule()?,
        hidden: hidden?,
        classes: classes?,
        outline: table.outline.rule()?,
        objects: objects?,
    })
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StylesText {
    #[serde(default)]
    visible: LineText,
    #[serde(default)]
    hidden: Vec<LineText>,
    #[serde(default)]
    class: BTreeMap<String, LineText>,
    #[serde(default)]
    outline: LineText,
    #[serde(default)]
    object: BTreeMap<String, ObjectText>,
}

/// What may be said of lines.
#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
struct LineText {
    width: Option<String>,
    color: Option<String>,
    line: Option<String>,
    pen: Option<u32>,
}

impl LineText {
    fn rule(&self) -> Result<LineRule, DrawingError> {
        if self.pen == Some(0) {
            return Err(DrawingError::Choice { word: "0".to_owned(), expected: "a pen from 1 on" });
        }
        let width = self.width.as_deref().map(str::parse::<Length>).transpose()?;
        Ok(LineRule {
            width: width.map(Length::millimetres),
            color: self.color.as_deref().map(color).transpose()?,
            dash: self.line.as_deref().map(str::parse::<Dash>).transpose()?,
            pen: self.pen,
        })
    }
}

/// What may be said of objects.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct ObjectText {
    width: Option<String>,
    color: Option<String>,
    line: Option<String>,
    pen: Option<u32>,
    #[serde(default)]
    exclude: bool,
    #[serde(default)]
    see_through: bool,
    crease: Option<f64>,
}

impl ObjectText {
    fn rule(self, name: String) -> Result<ObjectRule, DrawingError> {
        let ObjectText { width, color, line, pen, exclude, see_through, crease } = self;
        if crease.is_some_and(|degrees| !(0.0..=180.0).contains(&degrees)) {
            let word = format!("crease of {name}");
            return Err(DrawingError::Choice { word, expected: "degrees from 0 to 180" });
        }
        let line = LineText { width, color, line, pen }.rule()?;
        Ok(ObjectRule { name, line, exclude, see_through, crease })
    }
}

/// Reads `#rgb` and `#rrggbb`.
fn color(text: &str) -> Result<Color, DrawingError> {
    let refuse = || DrawingError::Choice {
        word: text.to_owned(),
        expected: "a colour as in #d22 or #dd2222",
    };
    let digits = text.strip_prefix('#').filter(|digits| digits.is_ascii()).ok_or_else(refuse)?;
    let channel = |i: usize| match digits.len() {
        3 => u8::from_str_radix(&digits[i..=i], 16).map(|digit| 17 * digit),
        _ => u8::from_str_radix(digits.get(2 * i..2 * i + 2).unwrap_or("-"), 16),
    };
    match (digits.len(), channel(0), channel(1), channel(2)) {
        (3 | 6, Ok(red), Ok(green), Ok(blue)) => Ok(Color([red, green, blue])),
        _ => Err(refuse()),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn every_rule_is_read() {
        let styles = read_styles(
            "[visible]\nwidth = \"0.5mm\"\ncolor = \"#d22\"\n\
             [[hidden]]\nline = \"chain\"\n[[hidden]]\nline = \"dotted\"\n\
             [class.crease]\npen = 4\n\
             [object.\"wheel*\"]\ncolor = \"#102030\"\nsee-through = true\ncrease = 12.5\n",
        )
        .unwrap();
        assert_eq!(styles.visible.width, Some(0.5));
        assert_eq!(styles.visible.color, Some(Color([0xdd, 0x22, 0x22])));
        let dashes: Vec<_> = styles.hidden.iter().map(|rule| rule.dash).collect();
        assert_eq!(dashes, [Some(Dash::Chain), Some(Dash::Dotted)]);
        assert_eq!(styles.classes[0].0, LineClass::Crease);
        assert_eq!(styles.classes[0].1.pen, Some(4));
        let object = &styles.objects[0];
        assert_eq!((&*object.name, object.line.color), ("wheel*", Some(Color([16, 32, 48]))));
        assert!(object.see_through && !object.exclude && object.crease == Some(12.5));
    }

    #[test]
    fn what_is_no_rule_is_refused_with_its_line() {
        for (text, message) in [
            ("[visible]\nwide = 1\n", "2"),
            ("[visible]\ncolor = \"red\"\n", "`red` is no choice here"),
            ("[class.edge]\n", "`edge` is no choice here"),
            ("[object.a]\ncrease = 200\n", "`crease of a` is no choice here"),
            ("[[hidden]]\npen = 0\n", "`0` is no choice here"),
        ] {
            let error = read_styles(text).unwrap_err().to_string();
            assert!(error.contains(message), "{text}: {error}");
        }
    }
}
