//! Clip paths (CSS Masking 1, section 7): outside of them nothing is
//! displayed. They are kept as shapes, to be intersected exactly.

use super::super::shape_file::{RegionId, ShapePart};
use super::element::own_transform;
use super::property::{Declared, Property};
use super::source::{line, name, wrong};
use super::style::{Style, reference};
use super::surroundings::Surroundings;
use super::walk::{MOST_NESTED, Step, Walker};
use crate::export::ExportError;
use glam::{DAffine2, DMat2, DVec2};
use roxmltree::{Node, NodeId};
use rustc_hash::FxHashMap;

/// Regions by clip path, and by the bits of how user units lie on the page
/// and of the viewport's size.
pub(super) type KnownRegions = FxHashMap<(NodeId, [u64; 8]), RegionId>;

/// The size of an element while it is being found.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    from_page: DAffine2,
    low: DVec2,
    high: DVec2,
}

/// An element whose clip path waits for its size.
#[derive(Debug, Clone, Copy)]
pub(super) struct Clipped<'a, 'i> {
    clip_path: Node<'a, 'i>,
    region: RegionId,
    around: Surroundings,
}

impl Bounds {
    fn new(to_page: DAffine2) -> Self {
        Bounds { from_page: to_page.inverse(), low: DVec2::INFINITY, high: DVec2::NEG_INFINITY }
    }

    /// One more place of the page.
    pub(super) fn add(&mut self, place: DVec2) {
        let point = self.from_page.transform_point2(place);
        (self.low, self.high) = (self.low.min(point), self.high.max(point));
    }
}

impl<'a, 'i> Walker<'_, 'a, 'i> {
    /// Adds an element's own clip path to its surroundings. False where
    /// nothing of the element is displayed.
    pub(super) fn clip(
        &mut self,
        node: Node<'a, 'i>,
        declared: &Declared<'a>,
        inner: &mut Surroundings,
        steps: &mut Vec<Step<'a, 'i>>,
    ) -> Result<bool, ExportError> {
        let Some(text) = declared.get(Property::ClipPath) else { return Ok(true) };
        let starts = |word: &str| {
            text.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word))
        };
        if starts("none") || starts("initial") {
            return Ok(true);
        }
        if !starts("url(") {
            let what = "what is clipped by a shape of CSS is left out";
            self.told.add("clip-path", what, line(node));
            return Ok(false);
        }
        let Some(clip_path) = self.clip_path(text) else { return Ok(true) };
        if !self.is_of_size(clip_path) {
            let region = self.region(clip_path, inner, None)?;
            inner.clip = region.map(|region| self.file.add_clip(region, inner.clip)).or(inner.clip);
            return Ok(true);
        }
        if self.bounds.len() == MOST_NESTED {
            let message = format!("clip paths within one another, expected {MOST_NESTED} at most");
            return Err(wrong(node, message));
        }
        let region = self.file.add_region(Vec::new());
        steps.push(Step::LeaveBounds(Clipped { clip_path, region, around: *inner }));
        self.bounds.push(Bounds::new(inner.to_page));
        inner.clip = Some(self.file.add_clip(region, inner.clip));
        Ok(true)
    }

    /// Makes the clip path of an element whose size is known now.
    pub(super) fn leave_bounds(&mut self, clipped: &Clipped<'a, 'i>) -> Result<(), ExportError> {
        let Some(Bounds { low, high, .. }) = self.bounds.pop() else { return Ok(()) };
        // Without a width and a height there is nothing to be in proportion to.
        if !(low.x < high.x && low.y < high.y) {
            return Ok(());
        }
        let size = DAffine2::from_mat2_translation(DMat2::from_diagonal(high - low), low);
        let parts = self.parts_of_region(clipped.clip_path, &clipped.around, Some(size))?;
        self.file.set_region(clipped.region, parts.unwrap_or_default());
        Ok(())
    }

    /// The clip path that a property names, if there is such.
    fn clip_path(&self, text: &str) -> Option<Node<'a, 'i>> {
        let id = reference(text)?;
        self.source.element(id).filter(|node| name(*node) == Some("clipPath"))
    }

    /// Whether a clip path, or one that clips it, is given in proportion to
    /// the size of what it clips.
    fn is_of_size(&self, clip_path: Node<'a, 'i>) -> bool {
        let mut next = Some(clip_path);
        for _ in 0..MOST_NESTED {
            let Some(node) = next else { return false };
            if is_in_proportion(node) {
                return true;
            }
            next = node.attribute("clip-path").and_then(|text| self.clip_path(text));
        }
        false
    }

    /// What a clip path leaves of a page, seen from these surroundings;
    /// nothing where it would clip itself.
    fn region(
        &mut self,
        clip_path: Node<'a, 'i>,
        around: &Surroundings,
        size: Option<DAffine2>,
    ) -> Result<Option<RegionId>, ExportError> {
        let mut bits = [0; 8];
        let numbers = around.to_page.to_cols_array().into_iter().chain(around.viewport);
        bits.iter_mut().zip(numbers).for_each(|(bits, number)| *bits = number.to_bits());
        let key = (clip_path.id(), bits);
        if size.is_none()
            && let Some(region) = self.known.get(&key)
        {
            return Ok(Some(*region));
        }
        let parts = self.parts_of_region(clip_path, around, size)?;
        let region = parts.map(|parts| self.file.add_region(parts));
        if let (None, Some(region)) = (size, region) {
            self.known.insert(key, region);
        }
        Ok(region)
    }

    fn parts_of_region(
        &mut self,
        clip_path: Node<'a, 'i>,
        around: &Surroundings,
        size: Option<DAffine2>,
    ) -> Result<Option<Vec<ShapePart>>, ExportError> {
        if self.clip_paths.contains(&clip_path.id()) {
            self.told.add("clip-path", "it clips itself", line(clip_path));
            return Ok(None);
        }
        if self.clip_paths.len() == MOST_NESTED {
            let message = format!("clip paths within one another, expected {MOST_NESTED} at most");
            return Err(wrong(clip_path, message));
        }
        self.clip_paths.push(clip_path.id());
        let mut inner = *around;
        // What is handed down comes from around the clip path, not from what it clips.
        let mut above: Vec<_> = clip_path.ancestors().filter(Node::is_element).collect();
        above.reverse();
        inner.style = Style::default();
        for node in above {
            inner.style = inner.style.of_child(&self.declared(node)?, self.source);
        }
        inner.clip = None;
        inner.in_clip_path = true;
        let declared = self.declared(clip_path)?;
        if let Some(text) = declared.get(Property::ClipPath)
            && let Some(outer) = self.clip_path(text)
            && let Some(region) = self.region(outer, around, size)?
        {
            inner.clip = Some(self.file.add_clip(region, None));
        }
        let own = own_transform(clip_path, &declared, &inner.lengths(), DVec2::ZERO)?;
        inner.to_page *= own;
        if let (true, Some(size)) = (is_in_proportion(clip_path), size) {
            inner.to_page *= size;
            inner.viewport = [1.0; 2];
        }
        let bounds = std::mem::take(&mut self.bounds);
        let parts = self.children(clip_path, inner)?;
        self.bounds = bounds;
        self.clip_paths.pop();
        Ok(Some(parts))
    }
}

fn is_in_proportion(clip_path: Node<'_, '_>) -> bool {
    clip_path.attribute("clipPathUnits") == Some("objectBoundingBox")
}
