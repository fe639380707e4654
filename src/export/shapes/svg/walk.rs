//! The way through the tree of elements, as a viewer draws it: groups,
//! instances by `use`, viewports, and what is not displayed.
//!
//! The way is kept on a stack of our own: a file may be nested deeper than
//! the stack of a thread. Only clip paths within clip paths recurse, and
//! these not deeper than [`MOST_NESTED`].

use super::super::shape_file::{ShapeFile, ShapePart};
use super::basic_shapes;
use super::chords::{Accuracy, Chords, MOST_POINTS};
use super::clip_path::{Bounds, Clipped, KnownRegions};
use super::element::{corner, is_for_us, own_transform};
use super::property::{Declared, Property};
use super::source::{Source, line, name, wrong};
use super::style::{is_opaque, reference};
use super::surroundings::Surroundings;
use super::told::Told;
use crate::export::ExportError;
use glam::{DAffine2, DVec2};
use roxmltree::{Node, NodeId};

/// The most elements that are drawn, those of instances counted each time.
const MOST_ELEMENTS: usize = 1 << 22;

/// The most elements that wait on the way.
const MOST_LEVELS: usize = 1 << 17;

/// The most instances, or clip paths, within one another.
pub(super) const MOST_NESTED: usize = 64;

/// What is still to be done.
pub(super) enum Step<'a, 'i> {
    /// An element, and all after it within the same.
    Siblings(Node<'a, 'i>, Surroundings),
    /// One element.
    One(Node<'a, 'i>, Surroundings),
    /// An instance ends.
    LeaveInstance,
    /// An element ends whose clip path depends on its size.
    LeaveBounds(Clipped<'a, 'i>),
}

/// Places that are not on a grid yet.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rounding {
    /// Chords are nowhere farther from their curves, mm.
    pub(super) flatness: f64,
    /// The grid of places that are converted, mm.
    pub(super) converted: Option<f64>,
    /// The grid of places that are written in millimetres.
    pub(super) written: Option<f64>,
}

/// Goes through a document and collects shapes.
pub(super) struct Walker<'s, 'a, 'i> {
    pub(super) source: &'s Source<'a, 'i>,
    rounding: Rounding,
    pub(super) told: &'s mut Told,
    pub(super) file: ShapeFile,
    elements: usize,
    points: usize,
    /// The `use` elements around.
    pub(super) instances: Vec<Node<'a, 'i>>,
    /// The clip paths around.
    pub(super) clip_paths: Vec<NodeId>,
    /// Elements around of which the size is wanted.
    pub(super) bounds: Vec<Bounds>,
    pub(super) known: KnownRegions,
}

impl<'s, 'a, 'i> Walker<'s, 'a, 'i> {
    pub(super) fn new(source: &'s Source<'a, 'i>, rounding: Rounding, told: &'s mut Told) -> Self {
        Walker {
            source,
            rounding,
            told,
            file: ShapeFile::default(),
            elements: 0,
            points: MOST_POINTS,
            instances: Vec::new(),
            clip_paths: Vec::new(),
            bounds: Vec::new(),
            known: KnownRegions::default(),
        }
    }

    /// What an element declares.
    pub(super) fn declared(&self, node: Node<'a, 'i>) -> Result<Declared<'a>, ExportError> {
        Declared::of(node, self.source).ok_or_else(|| {
            let message = "style sheets that take too long, expected simpler selectors";
            wrong(node, message)
        })
    }

    /// The shapes of an element and all within.
    pub(super) fn walk(
        &mut self,
        node: Node<'a, 'i>,
        around: Surroundings,
    ) -> Result<Vec<ShapePart>, ExportError> {
        self.go(node, vec![Step::One(node, around)])
    }

    /// The shapes of all children of an element.
    pub(super) fn children(
        &mut self,
        node: Node<'a, 'i>,
        around: Surroundings,
    ) -> Result<Vec<ShapePart>, ExportError> {
        let mut steps = Vec::new();
        push_children(node, around, &mut steps);
        self.go(node, steps)
    }

    fn go(
        &mut self,
        node: Node<'a, 'i>,
        mut steps: Vec<Step<'a, 'i>>,
    ) -> Result<Vec<ShapePart>, ExportError> {
        let mut parts = Vec::new();
        while let Some(step) = steps.pop() {
            match step {
                Step::Siblings(node, around) => {
                    if let Some(next) = node.next_sibling_element() {
                        steps.push(Step::Siblings(next, around));
                    }
                    self.element(node, &around, &mut steps, &mut parts)?;
                }
                Step::One(node, around) => {
                    self.element(node, &around, &mut steps, &mut parts)?;
                }
                Step::LeaveInstance => drop(self.instances.pop()),
                Step::LeaveBounds(clipped) => self.leave_bounds(&clipped)?,
            }
            if MOST_LEVELS < steps.len() {
                let message =
                    format!("elements within one another, expected {MOST_LEVELS} at most");
                return Err(wrong(node, message));
            }
        }
        Ok(parts)
    }

    fn element(
        &mut self,
        node: Node<'a, 'i>,
        around: &Surroundings,
        steps: &mut Vec<Step<'a, 'i>>,
        parts: &mut Vec<ShapePart>,
    ) -> Result<(), ExportError> {
        let Some(name) = name(node) else { return Ok(()) };
        self.elements += 1;
        if MOST_ELEMENTS < self.elements {
            let message = format!(
                "more than {MOST_ELEMENTS} elements are drawn, those of every <use> counted, \
                 expected fewer"
            );
            return Err(wrong(node, message));
        }
        let is_shape = basic_shapes::is_one(name);
        let is_container = match name {
            "use" => true,
            "g" | "a" | "switch" | "svg" => !around.in_clip_path,
            "symbol" => !around.in_clip_path && around.is_instance,
            _ => false,
        };
        if !is_shape && !is_container {
            self.pass_over(name, node, around)?;
            return Ok(());
        }
        let Some((declared, mut inner)) = self.entered(node, around)? else { return Ok(()) };
        if name == "use" {
            // Its place is a part of its transform: its clip path moves with it.
            let corner = corner(node, &declared, &inner.lengths())?;
            inner.to_page *= DAffine2::from_translation(corner);
        }
        if !self.clip(node, &declared, &mut inner, steps)? {
            return Ok(());
        }
        match name {
            "g" | "a" => push_children(node, inner, steps),
            "svg" if self.is_root(node) => push_children(node, inner, steps),
            "switch" => {
                let mut children = node.children().filter(Node::is_element);
                if let Some(child) = children.find(|child| is_for_us(*child)) {
                    steps.push(Step::One(child, inner));
                }
            }
            "svg" | "symbol" => {
                let size = around.size_of_use;
                if let Some(inner) = self.viewport(node, &declared, inner, size)? {
                    push_children(node, inner, steps);
                }
            }
            "use" => self.instance(node, &declared, inner, steps)?,
            _ => self.shape(node, name, &declared, &inner, parts)?,
        }
        Ok(())
    }

    /// An element's properties, and what it tells those within; nothing
    /// where it is not displayed.
    fn entered(
        &mut self,
        node: Node<'a, 'i>,
        around: &Surroundings,
    ) -> Result<Option<(Declared<'a>, Surroundings)>, ExportError> {
        if !is_for_us(node) {
            return Ok(None);
        }
        let declared = self.declared(node)?;
        let is = |property: Property, word: &str| {
            declared.get(property).is_some_and(|text| text.eq_ignore_ascii_case(word))
        };
        if is(Property::Display, "none") {
            return Ok(None);
        }
        let mut inner = *around;
        (inner.size_of_use, inner.is_instance) = ([None; 2], false);
        inner.style = around.style.of_child(&declared, self.source);
        if !self.is_root(node) {
            let own = own_transform(node, &declared, &inner.lengths(), DVec2::ZERO)?;
            inner.to_page = around.to_page * own;
        }
        // What has no width or no height is not displayed.
        if inner.to_page.matrix2.determinant() == 0.0 {
            return Ok(None);
        }
        if around.in_clip_path {
            return Ok(Some((declared, inner)));
        }
        if declared.get(Property::Opacity).and_then(is_opaque) == Some(false) {
            return Ok(None);
        }
        if self.refers_to(&declared, Property::Mask, "mask") {
            let what = "what is shown through a mask has no outline";
            self.told.add("mask", what, line(node));
            return Ok(None);
        }
        if declared.get(Property::Filter).is_some() && !is(Property::Filter, "none") {
            self.told.add("filter", "shapes are taken as they are without it", line(node));
        }
        Ok(Some((declared, inner)))
    }

    /// Elements that may show something and have no outline here.
    fn pass_over(
        &mut self,
        name: &str,
        node: Node<'a, 'i>,
        around: &Surroundings,
    ) -> Result<(), ExportError> {
        let what = match name {
            "text" | "image" | "foreignObject" | "video" | "audio" | "canvas" | "iframe" => {
                "it has no outline here"
            }
            "animate" | "animateMotion" | "animateTransform" | "set" | "script" => {
                "nothing moves or changes here"
            }
            _ => return Ok(()),
        };
        let displayed = self.entered(node, around)?;
        if displayed.is_some_and(|(_, inner)| inner.style.is_visible) {
            self.told.add(&format!("<{name}>"), what, line(node));
        }
        Ok(())
    }

    fn shape(
        &mut self,
        node: Node<'a, 'i>,
        name: &str,
        declared: &Declared<'a>,
        around: &Surroundings,
        parts: &mut Vec<ShapePart>,
    ) -> Result<(), ExportError> {
        let style = &around.style;
        let is_shown = style.is_visible && (around.in_clip_path || style.fills());
        if style.is_visible && !around.in_clip_path {
            if style.strokes() && (name == "line" || !style.fills()) {
                let what = "lines without a fill have no area";
                self.told.add(&format!("<{name}>"), what, line(node));
            }
            if style.has_markers {
                self.told.add("markers", "they have no outline here", line(node));
            }
        }
        if !is_shown && self.bounds.is_empty() {
            return Ok(());
        }
        let lengths = around.lengths();
        let rings = self
            .outline(around, |chords| basic_shapes::draw(node, name, declared, &lengths, chords))
            .map_err(|message| wrong(node, message))?;
        for bounds in &mut self.bounds {
            rings.iter().flatten().for_each(|&place| bounds.add(place));
        }
        if is_shown && !rings.is_empty() {
            let rule = if around.in_clip_path { style.clip_rule } else { style.fill_rule };
            parts.push(ShapePart { polygons: vec![rings], rule, clip: around.clip });
        }
        Ok(())
    }

    /// The rings of what is drawn, in millimetres of the page.
    pub(super) fn outline(
        &mut self,
        around: &Surroundings,
        draw: impl FnOnce(&mut Chords) -> Result<(), String>,
    ) -> Result<Vec<Vec<DVec2>>, String> {
        let Rounding { flatness, converted, written } = self.rounding;
        let is_written = around.to_page == DAffine2::IDENTITY;
        let grid = if is_written { written } else { converted };
        let mut chords = Chords::new(around.to_page, Accuracy { flatness, grid }, self.points);
        draw(&mut chords)?;
        let (is_curved, rings) = chords.finish();
        self.points -= rings.iter().map(Vec::len).sum::<usize>().min(self.points);
        self.file.flattened = self.file.flattened.or(is_curved.then_some(flatness));
        self.file.rounded = self.file.rounded.or(grid);
        Ok(rings)
    }

    /// Whether this is the outermost element, whose surroundings are those within.
    fn is_root(&self, node: Node<'_, '_>) -> bool {
        node.id() == self.source.root().id()
    }

    /// Whether a property names an element of this kind.
    fn refers_to(&self, declared: &Declared<'a>, property: Property, kind: &str) -> bool {
        let id = declared.get(property).and_then(reference);
        id.and_then(|id| self.source.element(id)).and_then(name) == Some(kind)
    }
}

fn push_children<'a, 'i>(node: Node<'a, 'i>, around: Surroundings, steps: &mut Vec<Step<'a, 'i>>) {
    if let Some(child) = node.first_element_child() {
        steps.push(Step::Siblings(child, around));
    }
}
