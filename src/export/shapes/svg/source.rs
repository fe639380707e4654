//! The text of an SVG as a tree of elements, with what is found by name in
//! it: elements by `id`, rules of style sheets.

use super::told::Told;
use crate::export::ExportError;
use roxmltree::{Document, Node, ParsingOptions};
use rustc_hash::FxHashMap;
use simplecss::{AttributeOperator, Element, PseudoClass, Rule, StyleSheet};
use std::cell::Cell;

/// The namespace of SVG.
const SVG: &str = "http://www.w3.org/2000/svg";

/// The namespace of `xlink:href`.
const XLINK: &str = "http://www.w3.org/1999/xlink";

/// How many steps from element to element all selectors together may take.
const PATIENCE: u64 = 1 << 27;

/// The most parts of one selector.
const MOST_PARTS: usize = 64;

/// A document, and what is found by name.
#[derive(Debug)]
pub(super) struct Source<'a, 'i> {
    root: Node<'a, 'i>,
    ids: FxHashMap<&'a str, Node<'a, 'i>>,
    sheet: StyleSheet<'a>,
    patience: Cell<u64>,
}

/// Parses the text. Entities are resolved, as drawing programs write them.
pub(super) fn parse(text: &str) -> Result<Document<'_>, ExportError> {
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|error| {
        // The place is told apart from the message.
        let what = error.to_string().replace(&format!(" at {}", error.pos()), "");
        let message = format!("{what}, expected well-formed XML");
        ExportError::Shape { line: error.pos().row as usize, message }
    })
}

/// An error with the line of an element.
pub(super) fn wrong(node: Node<'_, '_>, message: impl Into<String>) -> ExportError {
    ExportError::Shape { line: line(node), message: message.into() }
}

/// The line of an element.
pub(super) fn line(node: Node<'_, '_>) -> usize {
    node.document().text_pos_at(node.range().start).row as usize
}

impl<'a, 'i> Source<'a, 'i> {
    /// Looks for all names.
    pub(super) fn new(document: &'a Document<'i>, told: &mut Told) -> Result<Self, ExportError> {
        let root = document.root_element();
        if name(root) != Some("svg") {
            let found = root.tag_name().name();
            return Err(wrong(root, format!("<{found}>, expected <svg>")));
        }
        let mut ids = FxHashMap::default();
        let mut sheet = StyleSheet::new();
        for node in root.descendants().filter(Node::is_element) {
            if let Some(id) = node.attribute("id") {
                ids.entry(id).or_insert(node);
            }
            let is_css = matches!(node.attribute("type"), None | Some("" | "text/css"));
            if name(node) == Some("style") && is_css {
                let text = node.text().unwrap_or_default();
                sheet.parse_more(text);
                for rule in ["@import", "@media", "@supports", "@layer"] {
                    if text.contains(rule) {
                        told.add(rule, "a rule of a style sheet that is not followed", line(node));
                    }
                }
            }
        }
        // Matching goes as deep as a selector has parts.
        let is_long = |rule: &Rule<'_>| {
            rule.selector.to_string().split_whitespace().nth(MOST_PARTS).is_some()
        };
        if sheet.rules.iter().any(is_long) {
            let message = format!("a selector of many parts, expected {MOST_PARTS} at most");
            return Err(wrong(root, message));
        }
        Ok(Source { root, ids, sheet, patience: Cell::new(PATIENCE) })
    }

    /// The outermost element.
    pub(super) fn root(&self) -> Node<'a, 'i> {
        self.root
    }

    /// The element of this name.
    pub(super) fn element(&self, id: &str) -> Option<Node<'a, 'i>> {
        self.ids.get(id).copied()
    }

    /// All rules of style sheets, the strongest last.
    pub(super) fn rules(&self) -> &[Rule<'a>] {
        &self.sheet.rules
    }

    /// Whether selectors have not asked for too much yet.
    pub(super) fn is_patient(&self) -> bool {
        self.patience.get() > 0
    }

    fn step(&self) -> bool {
        self.patience.set(self.patience.get().saturating_sub(1));
        self.is_patient()
    }
}

/// The name of an element of SVG. Files without any namespace are taken for
/// SVG too.
pub(super) fn name<'a>(node: Node<'a, '_>) -> Option<&'a str> {
    let is_svg = matches!(node.tag_name().namespace(), None | Some(SVG));
    (node.is_element() && is_svg).then(|| node.tag_name().name())
}

/// What an element refers to: `href`, or the older `xlink:href`.
pub(super) fn href<'a>(node: Node<'a, '_>) -> Option<&'a str> {
    node.attribute("href").or_else(|| node.attribute((XLINK, "href")))
}

/// An element as selectors see it.
#[derive(Clone, Copy)]
pub(super) struct Styled<'s, 'a, 'i> {
    node: Node<'a, 'i>,
    source: &'s Source<'a, 'i>,
}

impl<'s, 'a, 'i> Styled<'s, 'a, 'i> {
    pub(super) fn new(node: Node<'a, 'i>, source: &'s Source<'a, 'i>) -> Self {
        Styled { node, source }
    }

    fn other(self, node: Option<Node<'a, 'i>>) -> Option<Self> {
        node.filter(|_| self.source.step()).map(|node| Styled { node, ..self })
    }
}

impl Element for Styled<'_, '_, '_> {
    fn parent_element(&self) -> Option<Self> {
        self.other(self.node.parent_element())
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        self.other(self.node.prev_sibling_element())
    }

    fn has_local_name(&self, name: &str) -> bool {
        self.source.step() && self.node.tag_name().name() == name
    }

    fn attribute_matches(&self, name: &str, operator: AttributeOperator<'_>) -> bool {
        let matches = |value: &str| match operator {
            // Any white space parts classes.
            AttributeOperator::Contains(word) => {
                value.split_ascii_whitespace().any(|found| found == word)
            }
            _ => operator.matches(value),
        };
        self.source.step() && self.node.attribute(name).is_some_and(matches)
    }

    fn pseudo_class_matches(&self, class: PseudoClass<'_>) -> bool {
        class == PseudoClass::FirstChild && self.node.prev_sibling_element().is_none()
    }
}
