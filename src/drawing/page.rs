//! The finished drawing: a page, its layers, their strokes.

use super::chaining::chain;
use super::cropping::crop;
use super::dashing::dashed;
use super::hatching::hatches;
use super::layering::{LayerPlan, plan};
use super::merging::segments;
use super::placement::Placement;
use super::smoothing::{Smoothing, smooth};
use super::surfaces::{Light, crop_regions, fills};
use super::{DrawingError, DrawingOptions, FilledShape, Hidden, Join, Strokes, SurfaceOptions};
use crate::model::Color;
use crate::run::map_indexed;
use crate::view::{ImageRegions, LineClass, VisibleLines};
use glam::DVec2;
use std::borrow::Cow;

/// Strokes on a page, ready to be written in any format.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// Width and height of the page, mm.
    pub size: DVec2,
    /// Millimetres of paper for one unit of the view frame.
    pub scale: f64,
    /// The layers in the order in which they are painted: hidden ones first,
    /// so that visible lines lie on top. Layers without a stroke are left out.
    pub layers: Vec<Layer>,
    /// Areas below all layers, in the order in which they are painted.
    pub fills: Vec<FilledShape>,
}

/// Strokes of one pen.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// Counted from 1, visible layers before hidden ones: the pen.
    pub number: u32,
    /// Number and name, as in `1-visible`.
    pub label: String,
    /// How every stroke of the layer looks.
    pub style: LineStyle,
    /// The strokes.
    pub strokes: Strokes,
}

/// How a line looks. Dashes are not part of it: they are strokes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineStyle {
    /// Width of the line, mm.
    pub width: f64,
    /// Colour of the line.
    pub color: Color,
}

/// How far dashes may be from the curves they stand for, mm.
const FLATNESS: f64 = 0.005;

/// Pen widths that can be drawn, mm.
const PEN_WIDTHS: std::ops::RangeInclusive<f64> = 0.01..=100.0;

impl Drawing {
    /// Lays `lines` out on a page.
    ///
    /// The order of strokes follows the order of pieces; layers are worked
    /// out side by side. Takes time linear in the number of pieces, except
    /// where many lines meet in one point.
    ///
    /// # Errors
    ///
    /// If widths, margins, scale or window do not go with the page or the
    /// view, or coordinates are not finite.
    pub fn new(lines: &VisibleLines, options: &DrawingOptions) -> Result<Self, DrawingError> {
        let (regions, surfaces) = (ImageRegions::default(), SurfaceOptions::default());
        Self::with_regions(lines, &regions, &surfaces, options)
    }

    /// Lays lines out on a page, and below them what is seen of the surfaces:
    /// filled, hatched, or both. A hatch has a layer of its own.
    ///
    /// # Errors
    ///
    /// As [`Self::new`]; and if the hatch is too fine to be one.
    pub fn with_regions(
        lines: &VisibleLines,
        regions: &ImageRegions,
        surfaces: &SurfaceOptions,
        options: &DrawingOptions,
    ) -> Result<Self, DrawingError> {
        for width in [options.visible_width, options.hidden_width] {
            if !PEN_WIDTHS.contains(&width) {
                return Err(DrawingError::PenWidth(width));
            }
        }
        let regions = &*crop_regions(lines, regions, options)?;
        let lines = &*crop(lines, options)?;
        let plans = plan(lines, options);
        let placement = Placement::new(lines, &plans, regions, options)?;
        let solid = map_indexed(plans.len(), |i| join(lines, &plans[i], &placement, options));
        let solid = match (options.fit.millimetres(), options.simplify.millimetres()) {
            (0.0, 0.0) => solid,
            (0.0, tolerance) => smooth(&solid, Smoothing::Simplify, tolerance),
            (tolerance, _) => smooth(&solid, Smoothing::Fit, tolerance),
        };
        let finished = map_indexed(plans.len(), |i| finish(&plans[i], &solid[i], options));
        let light = Light::new(&lines.frame, surfaces);
        let place = |point| placement.apply(point);
        let mut hatched = Vec::new();
        if let Some(hatch) = &surfaces.hatch {
            let mut strokes = hatches(regions, light, hatch, placement.size, &place)?;
            strokes.retain_longer(options.min_length.millimetres());
            hatched.push(hatch_layer(strokes, &plans, options));
        }
        let layers = hatched.into_iter().chain(finished);
        let layers = layers.filter(|layer| !layer.strokes.is_empty()).collect();
        let fills = fills(regions, light, surfaces.fill, place);
        Ok(Drawing { size: placement.size, scale: placement.scale, layers, fills })
    }

    /// The same drawing with polylines nowhere farther than `flatness`
    /// millimetres from its curves.
    pub fn flat(&self, flatness: f64) -> Cow<'_, Drawing> {
        if self.layers.iter().all(|layer| matches!(layer.strokes.flat(1.0), Cow::Borrowed(_))) {
            return Cow::Borrowed(self);
        }
        let mut flat = self.clone();
        for layer in &mut flat.layers {
            layer.strokes = layer.strokes.flat(flatness).into_owned();
        }
        Cow::Owned(flat)
    }
}

/// The pieces of a layer as long strokes.
fn join(
    lines: &VisibleLines,
    plan: &LayerPlan,
    placement: &Placement,
    options: &DrawingOptions,
) -> Strokes {
    let joined = |pieces: &[u32]| {
        let (segments, runs) = segments(lines, pieces, placement);
        chain(&segments, &runs)
    };
    let mut strokes = match options.join {
        Join::All => joined(&plan.pieces),
        Join::Class => {
            let mut all = Strokes::default();
            for class in LineClass::ALL {
                let of_class = |piece: &u32| lines.pieces[*piece as usize].class == class;
                let pieces: Vec<u32> = plan.pieces.iter().copied().filter(of_class).collect();
                joined(&pieces).iter().for_each(|stroke| all.push(stroke.iter().copied()));
            }
            all
        }
    };
    strokes.retain_longer(options.min_length.millimetres());
    strokes
}

/// The layer of a hatch: after all others in number, below them on paper.
fn hatch_layer(strokes: Strokes, plans: &[LayerPlan], options: &DrawingOptions) -> Layer {
    // Hidden lines have the second layer even where there are none.
    let number = plans.iter().map(|plan| plan.number).fold(2, u32::max) + 1;
    let style = LineStyle { width: options.hidden_width, color: Color([0; 3]) };
    Layer { number, label: format!("{number}-hatch"), style, strokes }
}

/// A layer of joined strokes in its style.
fn finish(plan: &LayerPlan, solid: &Strokes, options: &DrawingOptions) -> Layer {
    let strokes = match (plan.hidden, options.hidden) {
        (true, Hidden::Dashed) => dashed(&solid.flat(FLATNESS), options.hidden_width),
        _ => solid.clone(),
    };
    let width = if plan.hidden { options.hidden_width } else { options.visible_width };
    let style = LineStyle { width, color: Color([0; 3]) };
    Layer { number: plan.number, label: plan.label.clone(), style, strokes }
}

#[cfg(test)]
mod tests;
