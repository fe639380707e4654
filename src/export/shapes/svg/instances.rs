//! What `use` shows, and windows onto user units of their own: nested `svg`
//! and `symbol` (SVG 2, sections 5.5 and 8.2).

use super::super::shape_file::ShapePart;
use super::element::{corner, length};
use super::property::{Declared, Property};
use super::source::{href, line, wrong};
use super::surroundings::Surroundings;
use super::viewport::{View, fitted, view_box};
use super::walk::{MOST_NESTED, Step, Walker};
use crate::export::ExportError;
use crate::polygon::clipping::FillRule;
use glam::{DAffine2, DVec2, dvec2};
use roxmltree::Node;

impl<'a, 'i> Walker<'_, 'a, 'i> {
    /// What is within a window of its own, `svg` or `symbol`; nothing where
    /// that has no size.
    pub(super) fn viewport(
        &mut self,
        node: Node<'a, 'i>,
        declared: &Declared<'a>,
        mut inner: Surroundings,
        size_of_use: [Option<f64>; 2],
    ) -> Result<Option<Surroundings>, ExportError> {
        let lengths = inner.lengths();
        let corner = corner(node, declared, &lengths)?;
        let own = |property| length(node, declared, property, &lengths);
        let size = dvec2(
            size_of_use[0].or(own(Property::Width)?).unwrap_or(inner.viewport[0]),
            size_of_use[1].or(own(Property::Height)?).unwrap_or(inner.viewport[1]),
        );
        if size.x <= 0.0 || size.y <= 0.0 {
            return Ok(None);
        }
        let overflow = declared.get(Property::Overflow).unwrap_or("hidden");
        if !matches!(overflow, "visible" | "auto") && size.is_finite() {
            let corners = [DVec2::ZERO, size.with_y(0.0), size, size.with_x(0.0)];
            let chords = self.outline(&inner, |chords| {
                chords.move_to(corner)?;
                corners[1..].iter().try_for_each(|&way| chords.line_to(corner + way))
            });
            let rings = chords.map_err(|message| wrong(node, message))?;
            let part = ShapePart { polygons: vec![rings], rule: FillRule::NonZero, clip: None };
            let region = self.file.add_region(vec![part]);
            inner.clip = Some(self.file.add_clip(region, inner.clip));
        }
        match view_box(node)? {
            View::Empty => return Ok(None),
            View::Missing => {
                inner.to_page *= DAffine2::from_translation(corner);
                inner.viewport = size.to_array();
            }
            View::Of(_) if !size.is_finite() => {
                let message =
                    "a viewBox of a page that has no size, expected width and height of <svg>";
                return Err(wrong(node, message));
            }
            View::Of(view) => {
                inner.to_page *= fitted(node, [corner, size], view)?;
                inner.viewport = view[1].to_array();
            }
        }
        Ok(Some(inner))
    }

    /// What a `use` shows.
    pub(super) fn instance(
        &mut self,
        node: Node<'a, 'i>,
        declared: &Declared<'a>,
        mut inner: Surroundings,
        steps: &mut Vec<Step<'a, 'i>>,
    ) -> Result<(), ExportError> {
        let lengths = inner.lengths();
        let link = href(node).unwrap_or_default().trim();
        let Some(id) = link.strip_prefix('#') else {
            if !link.is_empty() {
                self.told.add("<use>", "it shows something from another file", line(node));
            }
            return Ok(());
        };
        let Some(target) = self.source.element(id) else { return Ok(()) };
        let is_within = |inner: &Node<'_, '_>| {
            let (inner, outer) = (inner.range(), target.range());
            outer.start <= inner.start && inner.end <= outer.end
        };
        if is_within(&node) || self.instances.iter().any(is_within) {
            self.told.add("<use>", "it shows itself", line(node));
            return Ok(());
        }
        if self.instances.len() == MOST_NESTED {
            let message = format!("<use> within <use>, expected {MOST_NESTED} levels at most");
            return Err(wrong(node, message));
        }
        inner.size_of_use = [
            length(node, declared, Property::Width, &lengths)?,
            length(node, declared, Property::Height, &lengths)?,
        ];
        inner.is_instance = true;
        inner.style = inner.style.within_use();
        self.instances.push(node);
        steps.push(Step::LeaveInstance);
        steps.push(Step::One(target, inner));
        Ok(())
    }
}
