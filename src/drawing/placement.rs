//! From the view frame to the page: one scale, one shift, y turned over.

use super::layering::LayerPlan;
use super::paper::LONGEST;
use super::{DrawingError, DrawingOptions, Paper, Scale};
use crate::view::{ImageRegions, Projection, VisibleLines};
use glam::DVec2;

/// The shortest side of tight paper, mm: a page of nothing is no page.
const SHORTEST: f64 = 1.0;

/// What a drawing may stand over its page, by rounding alone.
const SLACK: f64 = 1.0 + 1e-9;

/// Where image points come to lie on the page.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Placement {
    /// Width and height of the page, mm.
    pub(super) size: DVec2,
    /// Millimetres per unit of the view frame.
    pub(super) scale: f64,
    /// The image point that comes to the centre of the page.
    centre: DVec2,
}

impl Placement {
    /// Places the window, or else the box of all drawn pieces, in the centre
    /// of the page.
    pub(super) fn new(
        lines: &VisibleLines,
        plans: &[LayerPlan],
        regions: &ImageRegions,
        options: &DrawingOptions,
    ) -> Result<Self, DrawingError> {
        let (low, high) = match (bounds(lines, plans, regions)?, options.window) {
            (_, Some(window)) => (window.low(), window.high()),
            (bounds, None) => bounds,
        };
        let extent = high - low;
        let margin = options.margin.millimetres();
        let paper = if options.landscape { options.paper.landscape() } else { options.paper };
        let natural = match lines.frame.projection {
            Projection::Orthographic => options.unit.millimetres(),
            Projection::Perspective => 1.0,
        };
        let room = room(paper, margin)?;
        let scale = match options.scale {
            Scale::Factor(factor) => factor * natural,
            Scale::Ratio(_) if lines.frame.projection == Projection::Perspective => {
                return Err(DrawingError::PerspectiveRatio);
            }
            Scale::Ratio(ratio) => ratio * natural,
            Scale::Fit => match (room, lines.frame.projection) {
                (Some(room), _) => fit(extent, room).unwrap_or(natural),
                (None, Projection::Orthographic) => natural,
                // A perspective view has no true size, so its tight paper
                // is cut out of a sheet of A4.
                (None, Projection::Perspective) => {
                    let room = DVec2::new(210.0, 297.0) - 2.0 * margin;
                    fit(extent, room.max(DVec2::splat(SHORTEST))).unwrap_or(natural)
                }
            },
        };
        let drawn = extent * scale;
        if !(drawn.is_finite() && scale.is_finite()) {
            return Err(DrawingError::NotFinite);
        }
        let size = match paper {
            Paper::Tight => (drawn + 2.0 * margin).max(DVec2::splat(SHORTEST)),
            Paper::Sheet { width, height } => DVec2::new(width, height),
        };
        if LONGEST < size.max_element() {
            return Err(DrawingError::Endless { width: size.x, height: size.y });
        }
        if size.x * SLACK < drawn.x || size.y * SLACK < drawn.y {
            return Err(DrawingError::TooLarge {
                width: drawn.x,
                height: drawn.y,
                page_width: size.x,
                page_height: size.y,
            });
        }
        Ok(Placement { size, scale, centre: 0.5 * low + 0.5 * high })
    }

    /// The place of an image point on the page, mm, never a negative zero.
    pub(super) fn apply(&self, point: DVec2) -> DVec2 {
        let offset = (point - self.centre) * self.scale;
        0.5 * self.size + DVec2::new(offset.x, -offset.y) + DVec2::ZERO
    }
}

/// The box of all drawn pieces and of regions, whose points are finite; a
/// point if there are none.
fn bounds(
    lines: &VisibleLines,
    plans: &[LayerPlan],
    regions: &ImageRegions,
) -> Result<(DVec2, DVec2), DrawingError> {
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for index in plans.iter().flat_map(|plan| &plan.pieces) {
        for point in lines.pieces[*index as usize].points {
            // Minimum and maximum may pass over a NaN, so each is checked.
            if !point.is_finite() {
                return Err(DrawingError::NotFinite);
            }
            low = low.min(point);
            high = high.max(point);
        }
    }
    for point in regions.regions.iter().flat_map(|region| &region.polygons).flatten().flatten() {
        low = low.min(*point);
        high = high.max(*point);
    }
    if low.x > high.x {
        return Ok((DVec2::ZERO, DVec2::ZERO));
    }
    if (high - low).is_finite() { Ok((low, high)) } else { Err(DrawingError::NotFinite) }
}

/// What the margins leave of a sheet; nothing is fixed on tight paper.
fn room(paper: Paper, margin: f64) -> Result<Option<DVec2>, DrawingError> {
    let Paper::Sheet { width, height } = paper else {
        return Ok(None);
    };
    let room = DVec2::new(width, height) - 2.0 * margin;
    if 0.0 < room.min_element() {
        Ok(Some(room))
    } else {
        Err(DrawingError::Margin { margin, width, height })
    }
}

/// The largest scale at which `extent` stays within `room`. A box without
/// width or without height is fitted by its other side; a point, or a box too
/// small for any scale, not at all.
fn fit(extent: DVec2, room: DVec2) -> Option<f64> {
    let scales = [room.x / extent.x, room.y / extent.y];
    let scale = scales[0].min(scales[1]);
    scale.is_finite().then_some(scale)
}
