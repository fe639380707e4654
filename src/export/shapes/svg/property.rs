//! The properties that decide what of an element is area, and what an
//! element says of them itself (Cascading Style Sheets; SVG 2, chapter 6).
//!
//! An attribute is weaker than every rule of a style sheet, these are weaker
//! than the `style` attribute, and all are weaker than what is `!important`.

use super::source::{Source, Styled};
use roxmltree::Node;
use simplecss::DeclarationTokenizer;

/// A property that is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Property {
    ClipPath,
    ClipRule,
    Color,
    Cx,
    Cy,
    Display,
    Fill,
    FillOpacity,
    FillRule,
    Filter,
    Font,
    FontSize,
    Height,
    Marker,
    MarkerEnd,
    MarkerMid,
    MarkerStart,
    Mask,
    Opacity,
    Overflow,
    R,
    Rx,
    Ry,
    Stroke,
    StrokeOpacity,
    StrokeWidth,
    Transform,
    TransformOrigin,
    Visibility,
    Width,
    X,
    Y,
}

/// The names of all properties, in their order, which is that of the alphabet.
const NAMES: [&str; 32] = [
    "clip-path",
    "clip-rule",
    "color",
    "cx",
    "cy",
    "display",
    "fill",
    "fill-opacity",
    "fill-rule",
    "filter",
    "font",
    "font-size",
    "height",
    "marker",
    "marker-end",
    "marker-mid",
    "marker-start",
    "mask",
    "opacity",
    "overflow",
    "r",
    "rx",
    "ry",
    "stroke",
    "stroke-opacity",
    "stroke-width",
    "transform",
    "transform-origin",
    "visibility",
    "width",
    "x",
    "y",
];

impl Property {
    /// What the property is called.
    pub(super) fn name(self) -> &'static str {
        NAMES[self as usize]
    }
}

/// What an element says of itself, by rules or attributes.
#[derive(Debug, Clone)]
pub(super) struct Declared<'a> {
    values: [Option<Value<'a>>; NAMES.len()],
}

#[derive(Debug, Clone, Copy)]
struct Value<'a> {
    text: &'a str,
    is_important: bool,
}

impl<'a> Declared<'a> {
    /// What holds for an element; nothing where style sheets ask too much.
    pub(super) fn of<'i>(node: Node<'a, 'i>, source: &Source<'a, 'i>) -> Option<Self> {
        let mut declared = Declared { values: [None; NAMES.len()] };
        for attribute in node.attributes().filter(|attribute| attribute.namespace().is_none()) {
            // The shorthands are no attributes.
            if !matches!(attribute.name(), "font" | "marker") {
                declared.set(attribute.name(), attribute.value(), false);
            }
        }
        for rule in source.rules() {
            if rule.selector.matches(&Styled::new(node, source)) {
                for declaration in &rule.declarations {
                    declared.set(declaration.name, declaration.value, declaration.important);
                }
            }
        }
        if let Some(style) = node.attribute("style") {
            for declaration in DeclarationTokenizer::from(style) {
                declared.set(declaration.name, declaration.value, declaration.important);
            }
        }
        source.is_patient().then_some(declared)
    }

    /// The value of a property; nothing for what it would be anyway.
    pub(super) fn get(&self, property: Property) -> Option<&'a str> {
        let text = self.values[property as usize]?.text;
        let keywords = ["inherit", "unset", "revert", "revert-layer"];
        (!keywords.iter().any(|keyword| text.eq_ignore_ascii_case(keyword))).then_some(text)
    }

    fn set(&mut self, name: &str, text: &'a str, is_important: bool) {
        let Ok(index) = NAMES.binary_search(&name) else { return };
        let slot = &mut self.values[index];
        if is_important || slot.is_none_or(|value| !value.is_important) {
            *slot = Some(Value { text: text.trim(), is_important });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found_by_their_place_in_the_alphabet() {
        assert!(NAMES.is_sorted());
        assert_eq!(Property::Y as usize, NAMES.len() - 1);
        for property in [Property::ClipPath, Property::Font, Property::Ry, Property::Width] {
            assert_eq!(NAMES.binary_search(&property.name()), Ok(property as usize));
        }
        assert_eq!(Property::StrokeWidth.name(), "stroke-width");
    }
}
