//! The finished drawing: a page, its layers, their strokes.

use super::chaining::chain;
use super::cropping::crop;
use super::dashing::dashed;
use super::haloing::interrupt;
use super::hatching::hatches;
use super::layering::{LayerPlan, Layering};
use super::merging::{Loose, Merged, join_ends, merge};
use super::placement::Placement;
use super::segments::segments;
use super::short_strokes::long_enough;
use super::smoothing::{Smoothing, smooth};
use super::surfaces::{Light, crop_regions, fills};
use super::weight::Weights;
use super::{
    Dash, DrawingError, DrawingOptions, FilledShape, Join, PaintedShape, Strokes, Styles,
    SurfaceOptions,
};
use crate::model::Color;
use crate::run::{Run, map_indexed};
use crate::view::{Crossing, ImageRegions, LineClass, VisibleLines};
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
    /// What is painted instead of layers and fills, back to front.
    pub painting: Vec<PaintedShape>,
}

/// What is laid out on a page.
#[derive(Debug, Clone, Copy)]
pub struct Content<'a> {
    /// The lines.
    pub lines: &'a VisibleLines,
    /// Which of them passes in front of which; without, there are no halos.
    pub crossings: &'a [Crossing],
    /// What is seen of the surfaces.
    pub regions: &'a ImageRegions,
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
        let content = Content { lines, crossings, regions: &ImageRegions::default() };
        Self::of(&content, options, styles, &SurfaceOptions::default())
    }

    /// As [`Drawing::new`], and below the lines what is seen of the surfaces:
    /// filled, hatched, or both. A hatch has a layer of its own.
    ///
    /// # Errors
    ///
    /// As [`Drawing::new`]; and if the hatch is too fine to be one.
    pub fn with_regions(
        lines: &VisibleLines,
        regions: &ImageRegions,
        surfaces: &SurfaceOptions,
        options: &DrawingOptions,
    ) -> Result<Self, DrawingError> {
        let content = Content { lines, crossings: &[], regions };
        Self::of(&content, options, &Styles::default(), surfaces)
    }

    /// Lays out everything.
    ///
    /// # Errors
    ///
    /// As [`Drawing::with_regions`].
    pub fn of(
        content: &Content<'_>,
        options: &DrawingOptions,
        styles: &Styles,
        surfaces: &SurfaceOptions,
    ) -> Result<Self, DrawingError> {
        Self::of_within(content, options, styles, surfaces, &Run::default())
    }

    /// As [`Drawing::of`], asking a run whether to go on.
    ///
    /// # Errors
    ///
    /// As [`Drawing::of`]; and if the run is cancelled.
    pub fn of_within(
        content: &Content<'_>,
        options: &DrawingOptions,
        styles: &Styles,
        surfaces: &SurfaceOptions,
        run: &Run<'_>,
    ) -> Result<Self, DrawingError> {
        let Content { lines, crossings, regions } = *content;
        let regions = &*crop_regions(lines, regions, options)?;
        let weights = options.weight.map(|weight| Weights::new(lines, &weight));
        let layering = Layering { options, styles, weights: weights.as_ref() };
        let filled = Some(regions).filter(|_| surfaces.any());
        let mut drawn = crop(lines, filled, options)?;
        let mut plans = layering.plan(&drawn);
        let stepped = weights.iter().flat_map(|weights| weights.widths.iter().copied());
        let widths = plans.iter().map(|plan| plan.look.width).chain(stepped);
        let asked = [options.visible_width, options.hidden_width];
        let asked = asked.into_iter().chain(options.outline_width());
        if let Some(width) = asked.chain(widths).find(|w| !PEN_WIDTHS.contains(w)) {
            return Err(DrawingError::PenWidth(width));
        }
        let placement = Placement::new(&drawn, &plans, regions, options)?;
        let merged = {
            let all = match &drawn {
                Cow::Borrowed(_) => Cow::Borrowed(&plans),
                Cow::Owned(_) => Cow::Owned(layering.plan(lines)),
            };
            merge(lines, crossings, &all, &placement, options, run)?
        };
        let (lines, crossings, loose) = match &merged {
            Some(Merged { lines, crossings, loose }) => (lines, &crossings[..], Some(loose)),
            None => (lines, crossings, None),
        };
        if merged.is_some() {
            drawn = crop(lines, filled, options)?;
            plans = layering.plan(&drawn);
        }
        let radius = 0.5 * options.halo.millimetres() / placement.scale;
        if 0.0 < radius && !crossings.is_empty() {
            let seen: Vec<bool> = lines.pieces.iter().map(|piece| layering.draws(piece)).collect();
            let interrupted = interrupt(lines, crossings, &seen, radius, run)?;
            drawn = Cow::Owned(crop(&interrupted, filled, options)?.into_owned());
            plans = layering.plan(&drawn);
        }
        if let Some(weights) = &weights {
            drawn = Cow::Owned(weights.split(&drawn));
            plans = layering.plan(&drawn);
        }
        let lines = &*drawn;
        run.check()?;
        let mut bundles = bundles(lines, &plans, &placement, loose, options);
        let least = options.min_length.millimetres();
        if 0.0 < least {
            leave_out_short(&mut bundles, &plans, least);
        }
        let solid = strokes_of(&bundles, &plans, options);
        // What ended on a line that was left out ends beside one that was not.
        let reach = loose.map_or(0.0, Loose::reach);
        let solid = match (options.fit.millimetres(), options.simplify.millimetres()) {
            (0.0, 0.0) => solid,
            (0.0, tolerance) => smooth(&solid, Smoothing::Simplify, tolerance, reach),
            (tolerance, _) => smooth(&solid, Smoothing::Fit, tolerance, reach),
        };
        run.check()?;
        let finished = map_indexed(plans.len(), |i| finish(&plans[i], &solid[i]));
        run.check()?;
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
        Ok(Drawing {
            size: placement.size,
            scale: placement.scale,
            layers,
            fills,
            painting: Vec::new(),
        })
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

/// What may become strokes together: the segments of a layer, or of one class
/// in it.
struct Bundle {
    /// The place of its layer in the plans.
    plan: usize,
    segments: Vec<[DVec2; 2]>,
    runs: Vec<u32>,
}

/// The pieces of all layers, as they may be joined.
fn bundles(
    lines: &VisibleLines,
    plans: &[LayerPlan],
    placement: &Placement,
    loose: Option<&Loose>,
    options: &DrawingOptions,
) -> Vec<Bundle> {
    let bundle = |plan: usize, pieces: &[u32]| {
        let (mut segments, mut runs) = segments(lines, pieces, placement);
        if let Some(loose) = loose {
            join_ends(&mut segments, &mut runs, loose);
        }
        Bundle { plan, segments, runs }
    };
    let of_plan = |plan: usize| {
        let pieces = &plans[plan].pieces;
        let of_class = |class: LineClass| {
            let own = |piece: &u32| lines.pieces[*piece as usize].class == class;
            let pieces: Vec<u32> = pieces.iter().copied().filter(own).collect();
            bundle(plan, &pieces)
        };
        match options.join {
            Join::All => vec![bundle(plan, pieces)],
            Join::Class => LineClass::ALL.into_iter().map(of_class).collect(),
        }
    };
    map_indexed(plans.len(), of_plan).into_iter().flatten().collect()
}

/// Leaves out strokes that are too short, of visible lines and of hidden ones,
/// whatever layers they are in.
fn leave_out_short(bundles: &mut [Bundle], plans: &[LayerPlan], least: f64) {
    let is_hidden = |bundle: &Bundle| 0 < plans[bundle.plan].tags.level;
    for hidden in [false, true] {
        let own = bundles.iter().filter(|bundle| is_hidden(bundle) == hidden);
        let all: Vec<[DVec2; 2]> = own.flat_map(|bundle| bundle.segments.iter().copied()).collect();
        let kept = long_enough(&all, least);
        let mut rest = &kept[..];
        for bundle in bundles.iter_mut().filter(|bundle| is_hidden(bundle) == hidden) {
            let (own, others) = rest.split_at(bundle.segments.len());
            rest = others;
            let (mut segments, mut runs) = (own.iter(), own.iter());
            bundle.segments.retain(|_| segments.next().is_none_or(|&kept| kept));
            bundle.runs.retain(|_| runs.next().is_none_or(|&kept| kept));
        }
    }
}

/// The long strokes of all layers.
fn strokes_of(bundles: &[Bundle], plans: &[LayerPlan], options: &DrawingOptions) -> Vec<Strokes> {
    let chained = map_indexed(bundles.len(), |i| {
        chain(&bundles[i].segments, &bundles[i].runs, options.junctions)
    });
    let mut layers = vec![Strokes::default(); plans.len()];
    for (bundle, strokes) in bundles.iter().zip(chained) {
        let layer = &mut layers[bundle.plan];
        match layer.is_empty() {
            true => *layer = strokes,
            false => strokes.iter().for_each(|stroke| layer.push(stroke.iter().copied())),
        }
    }
    layers
}

/// The layer of a hatch: after all others in number, below them on paper.
fn hatch_layer(strokes: Strokes, plans: &[LayerPlan], options: &DrawingOptions) -> Layer {
    // Hidden lines have the second layer even where there are none.
    let number = plans.iter().map(|plan| plan.number).fold(2, u32::max) + 1;
    let style = LineStyle { width: options.hidden_width, color: Color([0; 3]) };
    let label = format!("{number}-hatch");
    Layer { number, label, style, strokes, tags: LayerTags::default() }
}

/// A layer of joined strokes in its style.
fn finish(plan: &LayerPlan, solid: &Strokes) -> Layer {
    let look = &plan.look;
    let strokes = match look.dash {
        Dash::Continuous => solid.clone(),
        dash => dashed(&solid.flat(FLATNESS), dash, look.width),
    };
    let style = LineStyle { width: look.width, color: look.color };
    let (label, tags) = (plan.label.clone(), plan.tags.clone());
    Layer { number: plan.number, label, style, strokes, tags }
}

#[cfg(test)]
mod tests;
