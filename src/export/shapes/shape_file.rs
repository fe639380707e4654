//! The polygons of a file: parts with fill rules of their own, and what
//! clips them.

use crate::polygon::clipping::{FillRule, Operation, PlaneShape, ShapeError};
use crate::run::Run;
use glam::DVec2;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// What is filled by one rule.
#[derive(Debug, Clone, PartialEq)]
pub struct ShapePart {
    /// Polygons of rings, not closed by a repeated corner.
    pub polygons: Vec<Vec<Vec<DVec2>>>,
    /// The rule.
    pub rule: FillRule,
    /// Outside of this nothing of it is displayed.
    pub clip: Option<ClipId>,
}

/// A clip of a file: a region, perhaps within another clip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ClipId(u32);

/// A region of a file: what shapes leave of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct RegionId(u32);

/// The page of a file, in millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShapePage {
    /// Its upper left corner.
    pub low: DVec2,
    /// Its lower right corner.
    pub high: DVec2,
}

/// The polygons of a file: the union of its parts.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ShapeFile {
    /// One part of a GeoJSON file, one for each shape of an SVG.
    pub parts: Vec<ShapePart>,
    /// The page of an SVG that has a size.
    pub page: Option<ShapePage>,
    /// What was passed over, a sentence for each kind.
    pub warnings: Vec<String>,
    /// Within how many millimetres of curves their chords are, if there are
    /// curves.
    pub flattened: Option<f64>,
    /// The grid that places were rounded to, in millimetres, if they were.
    pub rounded: Option<f64>,
    /// Whether the file does not say how large its page is, so that its
    /// units are pixels, 96 to the inch.
    pub is_in_pixels: bool,
    /// Whether shapes beyond the page were cut off.
    pub is_cut_to_page: bool,
    clips: Vec<(RegionId, Option<ClipId>)>,
    known_clips: FxHashMap<(RegionId, Option<ClipId>), ClipId>,
    regions: Vec<Vec<ShapePart>>,
}

impl ShapePage {
    /// The least page that has both.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        ShapePage { low: self.low.min(other.low), high: self.high.max(other.high) }
    }
}

impl ShapeFile {
    /// The shape of all parts together: each by its own rule, or by one rule
    /// for all rings of the file. Clips keep their own rules.
    ///
    /// # Errors
    ///
    /// Where a coordinate is not finite, or there are too many.
    pub fn shape(&self, rule: Option<FillRule>) -> Result<PlaneShape, ShapeError> {
        self.shape_within(rule, &Run::default())
    }

    /// The same, asking a run whether to go on.
    ///
    /// # Errors
    ///
    /// As [`Self::shape`]; and if the run is cancelled or reaches a limit.
    pub fn shape_within(
        &self,
        rule: Option<FillRule>,
        run: &Run<'_>,
    ) -> Result<PlaneShape, ShapeError> {
        Clips { file: self, shapes: FxHashMap::default(), run }.union(&self.parts, rule)
    }
}

/// Clips, which SVG alone has.
#[cfg(feature = "svg")]
impl ShapeFile {
    pub(super) fn add_region(&mut self, parts: Vec<ShapePart>) -> RegionId {
        self.regions.push(parts);
        RegionId(self.regions.len() as u32 - 1)
    }

    /// Gives a region other parts, before any of it is used.
    pub(super) fn set_region(&mut self, region: RegionId, parts: Vec<ShapePart>) {
        self.regions[region.0 as usize] = parts;
    }

    pub(super) fn add_clip(&mut self, region: RegionId, within: Option<ClipId>) -> ClipId {
        *self.known_clips.entry((region, within)).or_insert_with(|| {
            self.clips.push((region, within));
            ClipId(self.clips.len() as u32 - 1)
        })
    }
}

/// Shapes of clips, made when they are first asked for.
struct Clips<'f, 'r> {
    file: &'f ShapeFile,
    shapes: FxHashMap<ClipId, PlaneShape>,
    run: &'r Run<'r>,
}

impl Clips<'_, '_> {
    /// The union of parts, those of each clip cut by it together.
    fn union(
        &mut self,
        parts: &[ShapePart],
        rule: Option<FillRule>,
    ) -> Result<PlaneShape, ShapeError> {
        let mut groups: BTreeMap<Option<ClipId>, Vec<&ShapePart>> = BTreeMap::new();
        for part in parts {
            groups.entry(part.clip).or_default().push(part);
        }
        let mut shapes = Vec::with_capacity(groups.len());
        for (clip, parts) in groups {
            let shape = self.together(&parts, rule)?;
            shapes.push(match clip {
                None => shape,
                Some(clip) => {
                    self.make(clip)?;
                    self.operation(Operation::Intersection, &[&shape, &self.shapes[&clip]])?
                }
            });
        }
        match shapes.len() {
            1 => Ok(shapes.remove(0)),
            _ => self.operation(Operation::Union, &shapes.iter().collect::<Vec<_>>()),
        }
    }

    /// Parts as if nothing clipped them.
    fn together(
        &self,
        parts: &[&ShapePart],
        rule: Option<FillRule>,
    ) -> Result<PlaneShape, ShapeError> {
        if let (None, [part]) = (rule, parts) {
            return PlaneShape::new(&part.polygons, part.rule);
        }
        if let Some(rule) = rule {
            let all = parts.iter().flat_map(|part| part.polygons.iter().cloned());
            return PlaneShape::new(&all.collect::<Vec<_>>(), rule);
        }
        let shapes = parts.iter().map(|part| PlaneShape::new(&part.polygons, part.rule));
        let shapes = shapes.collect::<Result<Vec<_>, _>>()?;
        self.operation(Operation::Union, &shapes.iter().collect::<Vec<_>>())
    }

    /// Makes the shape of a clip and of all that it is within, the outermost
    /// first.
    fn make(&mut self, clip: ClipId) -> Result<(), ShapeError> {
        let mut chain = Vec::new();
        let mut next = Some(clip);
        while let Some(clip) = next.filter(|clip| !self.shapes.contains_key(clip)) {
            chain.push(clip);
            next = self.file.clips[clip.0 as usize].1;
        }
        for clip in chain.into_iter().rev() {
            let (region, within) = self.file.clips[clip.0 as usize];
            let own = self.union(&self.file.regions[region.0 as usize], None)?;
            let shape = match within {
                None => own,
                Some(within) => {
                    self.operation(Operation::Intersection, &[&own, &self.shapes[&within]])?
                }
            };
            self.shapes.insert(clip, shape);
        }
        Ok(())
    }

    fn operation(
        &self,
        operation: Operation,
        shapes: &[&PlaneShape],
    ) -> Result<PlaneShape, ShapeError> {
        PlaneShape::operation_within(operation, shapes, self.run)
    }
}
