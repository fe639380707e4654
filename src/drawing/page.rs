//! The finished drawing: a page, its layers, their strokes.

use super::chaining::chain;
use super::cropping::crop;
use super::dashing::dashed;
use super::haloing::interrupt;
use super::layering::{LayerPlan, Layering};
use super::merging::segments;
use super::placement::Placement;
use super::smoothing::{Smoothing, smooth};
use super::weight::Weights;
use super::{Dash, DrawingError, DrawingOptions, Join, Strokes, Styles};
use crate::model::Color;
use crate::run::map_indexed;
use crate::view::{Crossing, LineClass, VisibleLines};
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
}

/// What all strokes of a layer have in common, as far as layers tell it apart.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct LayerTags {
    /// 0 if they are visible; else the level of hidden lines.
    pub level: u32,
    /// Their class.
    pub class: Option<LineClass>,
    /// The name of their object.
    pub object: Option<String>,
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
    /// What they are.
    pub tags: LayerTags,
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
        Self::styled(lines, &[], options, &Styles::default())
    }

    /// As [`Drawing::new`], with rules for how lines look, and with the
    /// crossings of the lines, without which there are no halos.
    ///
    /// # Errors
    ///
    /// As [`Drawing::new`].
    pub fn styled(
        lines: &VisibleLines,
        crossings: &[Crossing],
        options: &DrawingOptions,
        styles: &Styles,
    ) -> Result<Self, DrawingError> {
        let weights = options.weight.map(|weight| Weights::new(lines, &weight));
        let layering = Layering { options, styles, weights: weights.as_ref() };
        let mut drawn = crop(lines, options)?;
        let mut plans = layering.plan(&drawn);
        let stepped = weights.iter().flat_map(|weights| weights.widths.iter().copied());
        let widths = plans.iter().map(|plan| plan.look.width).chain(stepped);
        let asked = [options.visible_width, options.hidden_width];
        if let Some(width) = asked.into_iter().chain(widths).find(|w| !PEN_WIDTHS.contains(w)) {
            return Err(DrawingError::PenWidth(width));
        }
        let placement = Placement::new(&drawn, &plans, options)?;
        let radius = 0.5 * options.halo.millimetres() / placement.scale;
        if 0.0 < radius && !crossings.is_empty() {
            let seen: Vec<bool> = lines.pieces.iter().map(|piece| layering.draws(piece)).collect();
            let interrupted = interrupt(lines, crossings, &seen, radius);
            drawn = Cow::Owned(crop(&interrupted, options)?.into_owned());
            plans = layering.plan(&drawn);
        }
        if let Some(weights) = &weights {
            drawn = Cow::Owned(weights.split(&drawn));
            plans = layering.plan(&drawn);
        }
        let lines = &*drawn;
        let solid = map_indexed(plans.len(), |i| join(lines, &plans[i], &placement, options));
        let solid = match (options.fit.millimetres(), options.simplify.millimetres()) {
            (0.0, 0.0) => solid,
            (0.0, tolerance) => smooth(&solid, Smoothing::Simplify, tolerance),
            (tolerance, _) => smooth(&solid, Smoothing::Fit, tolerance),
        };
        let finished = plans.iter().zip(solid).map(|(plan, solid)| finish(plan, solid));
        let layers = finished.filter(|layer| !layer.strokes.is_empty()).collect();
        Ok(Drawing { size: placement.size, scale: placement.scale, layers })
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
    // What is smoothed stays where it meets others.
    let smoothed = 0.0 < options.fit.millimetres().max(options.simplify.millimetres());
    let joined = |pieces: &[u32]| {
        let (segments, runs) = segments(lines, pieces, placement);
        chain(&segments, &runs, smoothed)
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

/// A layer of joined strokes in its style.
fn finish(plan: &LayerPlan, solid: Strokes) -> Layer {
    let look = &plan.look;
    let strokes = match look.dash {
        Dash::Continuous => solid,
        dash => dashed(&solid.flat(FLATNESS), dash, look.width),
    };
    let style = LineStyle { width: look.width, color: look.color };
    let (label, tags) = (plan.label.clone(), plan.tags.clone());
    Layer { number: plan.number, label, style, strokes, tags }
}

#[cfg(test)]
mod tests;
