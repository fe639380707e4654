//! The finished drawing: a page, its layers, their strokes.

use super::chaining::chain;
use super::cropping::crop;
use super::dashing::dashed;
use super::layering::{LayerPlan, plan};
use super::merging::segments;
use super::placement::Placement;
use super::{DrawingError, DrawingOptions, Hidden, Strokes};
use crate::model::Color;
use crate::run::map_indexed;
use crate::view::VisibleLines;
use glam::DVec2;

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
        for width in [options.visible_width, options.hidden_width] {
            if !PEN_WIDTHS.contains(&width) {
                return Err(DrawingError::PenWidth(width));
            }
        }
        let lines = &*crop(lines, options)?;
        let plans = plan(lines, options);
        let placement = Placement::new(lines, &plans, options)?;
        let layers =
            map_indexed(plans.len(), |i| draw_layer(lines, &plans[i], &placement, options));
        let layers = layers.into_iter().filter(|layer| !layer.strokes.is_empty()).collect();
        Ok(Drawing { size: placement.size, scale: placement.scale, layers })
    }
}

fn draw_layer(
    lines: &VisibleLines,
    plan: &LayerPlan,
    placement: &Placement,
    options: &DrawingOptions,
) -> Layer {
    let solid = chain(&segments(lines, &plan.pieces, placement));
    let strokes = match (plan.hidden, options.hidden) {
        (true, Hidden::Dashed) => dashed(&solid, options.hidden_width),
        _ => solid,
    };
    let width = if plan.hidden { options.hidden_width } else { options.visible_width };
    let style = LineStyle { width, color: Color([0; 3]) };
    Layer { number: plan.number, label: plan.label.clone(), style, strokes }
}

#[cfg(test)]
mod tests;
