//! What holds for an element after its ancestors have handed theirs down.

use super::length::{Lengths, font_size};
use super::property::{Declared, Property};
use super::source::{Source, href, name};
use crate::polygon::clipping::FillRule;
use roxmltree::Node;
use svgtypes::{FontShorthand, FuncIRI};

/// Paint, as far as it can be seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Paint {
    /// None, or one that is fully transparent.
    Nothing,
    Something,
    /// That of `color`.
    Current,
    /// The fill of the `use` around.
    ContextFill,
    /// The stroke of the `use` around.
    ContextStroke,
}

/// The properties that are handed down.
#[derive(Debug, Clone, Copy)]
pub(super) struct Style {
    fill: Paint,
    stroke: Paint,
    /// Whether fills are not fully transparent.
    fill_opaque: bool,
    stroke_opaque: bool,
    stroke_wide: bool,
    /// Whether `color` is not fully transparent.
    color_seen: bool,
    /// Whether the `use` around fills and strokes.
    context: [bool; 2],
    /// The rule of fills.
    pub(super) fill_rule: FillRule,
    /// The rule of shapes within clip paths.
    pub(super) clip_rule: FillRule,
    /// Whether shapes are shown.
    pub(super) is_visible: bool,
    /// Whether lines have markers.
    pub(super) has_markers: bool,
    /// What one em is, in user units.
    pub(super) font_size: f64,
}

impl Default for Style {
    /// What holds where nothing is said.
    fn default() -> Self {
        Style {
            fill: Paint::Something,
            stroke: Paint::Nothing,
            fill_opaque: true,
            stroke_opaque: true,
            stroke_wide: true,
            color_seen: true,
            context: [false; 2],
            fill_rule: FillRule::NonZero,
            clip_rule: FillRule::NonZero,
            is_visible: true,
            has_markers: false,
            font_size: 16.0,
        }
    }
}

impl Style {
    /// Whether an area of this style is filled.
    pub(super) fn fills(&self) -> bool {
        self.fill_opaque && self.is_seen(self.fill)
    }

    /// Whether a line of this style is drawn.
    pub(super) fn strokes(&self) -> bool {
        self.stroke_opaque && self.stroke_wide && self.is_seen(self.stroke)
    }

    fn is_seen(&self, paint: Paint) -> bool {
        match paint {
            Paint::Nothing => false,
            Paint::Something => true,
            Paint::Current => self.color_seen,
            Paint::ContextFill => self.context[0],
            Paint::ContextStroke => self.context[1],
        }
    }

    /// The style within a `use` of this style.
    #[must_use]
    pub(super) fn within_use(mut self) -> Self {
        self.context = [self.is_seen(self.fill), self.is_seen(self.stroke)];
        self
    }

    /// The style of a child that declares these properties. What cannot be
    /// read is as if it were not there.
    #[must_use]
    pub(super) fn of_child(mut self, declared: &Declared<'_>, source: &Source<'_, '_>) -> Self {
        let usual = Style::default();
        let get = |property| declared.get(property);
        let set = |slot: &mut bool, value: Option<bool>| *slot = value.unwrap_or(*slot);
        let shorthand = get(Property::Font).and_then(|text| FontShorthand::from_str(text).ok());
        let size = get(Property::FontSize).or(shorthand.map(|font| font.font_size));
        if let Some(size) = size.and_then(|text| font_size(text, self.font_size)) {
            self.font_size = size;
        }
        set(&mut self.color_seen, get(Property::Color).and_then(color_seen));
        if let Some(paint) = get(Property::Fill) {
            self.fill = read_paint(paint, usual.fill, source).unwrap_or(self.fill);
        }
        if let Some(paint) = get(Property::Stroke) {
            self.stroke = read_paint(paint, usual.stroke, source).unwrap_or(self.stroke);
        }
        set(&mut self.fill_opaque, get(Property::FillOpacity).and_then(is_opaque));
        set(&mut self.stroke_opaque, get(Property::StrokeOpacity).and_then(is_opaque));
        let lengths = Lengths { viewport: [1.0; 2], font_size: self.font_size };
        let width = |text| lengths.along(Property::StrokeWidth, text).ok().map(|width| width > 0.0);
        set(&mut self.stroke_wide, get(Property::StrokeWidth).and_then(width));
        if let Some(rule) = get(Property::FillRule) {
            self.fill_rule = read_rule(rule).unwrap_or(self.fill_rule);
        }
        if let Some(rule) = get(Property::ClipRule) {
            self.clip_rule = read_rule(rule).unwrap_or(self.clip_rule);
        }
        let visibility = get(Property::Visibility).map(str::to_ascii_lowercase);
        set(
            &mut self.is_visible,
            match visibility.as_deref() {
                Some("visible" | "initial") => Some(true),
                Some("hidden" | "collapse") => Some(false),
                _ => None,
            },
        );
        let markers =
            [Property::Marker, Property::MarkerStart, Property::MarkerMid, Property::MarkerEnd];
        for marker in markers.into_iter().filter_map(get) {
            self.has_markers = reference(marker).is_some();
        }
        self
    }
}

/// Whether an opacity is more than none.
pub(super) fn is_opaque(text: &str) -> Option<bool> {
    if text.eq_ignore_ascii_case("initial") {
        return Some(true);
    }
    let number = text.strip_suffix('%').unwrap_or(text).trim();
    number.parse::<f64>().ok().filter(|value| value.is_finite()).map(|value| value > 0.0)
}

/// The name in `url(#name)`, whatever follows it.
pub(super) fn reference(text: &str) -> Option<&str> {
    let end = text.find(')')?;
    FuncIRI::from_str(&text[..=end]).ok().map(|link| link.0)
}

fn color_seen(text: &str) -> Option<bool> {
    match text.to_ascii_lowercase().as_str() {
        "initial" => Some(true),
        "currentcolor" => None,
        lower => lower.parse::<svgtypes::Color>().ok().map(|color| color.alpha > 0),
    }
}

fn read_rule(text: &str) -> Option<FillRule> {
    match text.to_ascii_lowercase().as_str() {
        "evenodd" => Some(FillRule::EvenOdd),
        "nonzero" | "initial" => Some(FillRule::NonZero),
        _ => None,
    }
}

fn read_paint(text: &str, usual: Paint, source: &Source<'_, '_>) -> Option<Paint> {
    if text.get(..4).is_some_and(|start| start.eq_ignore_ascii_case("url(")) {
        let server = reference(text).and_then(|id| source.element(id));
        if server.is_some_and(|server| paints(server, source)) {
            return Some(Paint::Something);
        }
        // What is painted where there is no such server.
        let fallback = text.split_once(')').map_or("", |(_, fallback)| fallback.trim());
        return match fallback {
            "" => Some(Paint::Nothing),
            fallback => read_paint_of_one_word(fallback, usual),
        };
    }
    read_paint_of_one_word(text, usual)
}

fn read_paint_of_one_word(text: &str, usual: Paint) -> Option<Paint> {
    match text.to_ascii_lowercase().as_str() {
        "none" => Some(Paint::Nothing),
        "currentcolor" => Some(Paint::Current),
        "context-fill" => Some(Paint::ContextFill),
        "context-stroke" => Some(Paint::ContextStroke),
        "initial" => Some(usual),
        _ => color_seen(text).map(|seen| if seen { Paint::Something } else { Paint::Nothing }),
    }
}

/// Whether something is a paint server that paints: gradients do where they,
/// or those they refer to, have a stop.
fn paints(server: Node<'_, '_>, source: &Source<'_, '_>) -> bool {
    const MOST_REFERENCES: usize = 16;
    let mut next = Some(server);
    for _ in 0..MOST_REFERENCES {
        let Some(server) = next else { return false };
        match name(server) {
            Some("pattern") => return true,
            Some("linearGradient" | "radialGradient") => {}
            _ => return false,
        }
        if server.children().any(|child| name(child) == Some("stop")) {
            return true;
        }
        let link = href(server).and_then(|link| link.trim().strip_prefix('#'));
        next = link.and_then(|id| source.element(id));
    }
    false
}
