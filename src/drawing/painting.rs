//! A drawing that is painted: areas over one another, each with its lines.
//!
//! Faces come from back to front. Each is an area that covers what was there
//! before, and over it go the lines of its own border, so that what is nearer
//! ends with a line and what is behind it ends there too. A pen can do none of
//! this; only formats with areas can.
//!
//! Lines have their looks from the same rules as elsewhere. Where lines are
//! not drawn as a whole, but face by face, there is nothing to join, smooth or
//! interrupt, and no width by depth: wishes for these are passed over.

use super::cropping::{clip, nothing_of};
use super::dashing::dashed;
use super::layering::Layering;
use super::placement::Placement;
use super::styles::Look;
use super::surfaces::{Light, crop, shade};
use super::{
    Dash, Drawing, DrawingError, DrawingOptions, Fill, LineStyle, Strokes, Styles, SurfaceOptions,
    Window,
};
use crate::model::Color;
use crate::polygon::clipping::FillRule;
use crate::run::map_indexed;
use crate::view::{ImageRegion, ImageRegions, PaintedFace, VisibleLines};
use glam::DVec2;

/// An area and the lines over it.
#[derive(Debug, Clone, PartialEq)]
pub struct PaintedShape {
    /// The colour of the area.
    pub color: Color,
    /// Closed rings, mm, y downwards, not closed by a repeated corner; a point
    /// belongs to the area if they turn around it.
    pub rings: Vec<Vec<DVec2>>,
    /// The lines, style by style.
    pub lines: Vec<(LineStyle, Strokes)>,
}

/// The colour of paper: areas hide even where nothing is to be filled.
const PAPER: Color = Color([255; 3]);

impl Drawing {
    /// Lays faces out on a page, back to front, each over those before it.
    /// `faces` refer to pieces of `lines`. O(n).
    ///
    /// # Errors
    ///
    /// If margins, scale or window do not go with the page or the view, or
    /// coordinates are not finite.
    pub fn painted(
        faces: &[PaintedFace],
        lines: &VisibleLines,
        options: &DrawingOptions,
        styles: &Styles,
        surfaces: &SurfaceOptions,
    ) -> Result<Self, DrawingError> {
        let cropped = Cropped::new(faces, lines, options)?;
        let layering = Layering { options, styles, weights: None };
        let plans = layering.plan(&cropped.lines);
        let placement = Placement::new(&cropped.lines, &plans, &cropped.regions, options)?;
        let light = Light::new(&lines.frame, surfaces);
        let mut looks: Vec<Look> = vec![Look::default(); cropped.lines.pieces.len()];
        for plan in &plans {
            plan.pieces.iter().for_each(|&piece| looks[piece as usize] = plan.look);
        }
        let shapes = map_indexed(faces.len(), |i| {
            let region = &cropped.regions.regions[i];
            let place = |&point: &DVec2| placement.apply(point);
            let rings = region.polygons.iter().flatten();
            let pieces = cropped.starts[i]..cropped.starts[i + 1];
            PaintedShape {
                color: match surfaces.fill {
                    Fill::None => PAPER,
                    fill => shade(region, light, fill),
                },
                rings: rings.map(|ring| ring.iter().map(place).collect()).collect(),
                lines: strokes(&cropped.lines, pieces, &looks, &placement),
            }
        });
        let shapes: Vec<PaintedShape> =
            shapes.into_iter().filter(|shape| !shape.rings.is_empty()).collect();
        let shows = |shape: &PaintedShape| surfaces.fill != Fill::None || !shape.lines.is_empty();
        let corners = faces.iter().flat_map(|face| face.region.polygons.iter().flatten());
        let mut corners = corners.flatten().copied().peekable();
        let is_painted = corners.peek().is_some();
        if is_painted && options.window.is_some() && !shapes.iter().any(shows) {
            return Err(nothing_of(corners));
        }
        Ok(Drawing {
            size: placement.size,
            scale: placement.scale,
            layers: Vec::new(),
            fills: Vec::new(),
            painting: shapes,
        })
    }
}

/// What lies in the window of the drawing.
struct Cropped {
    /// One for each face, empty if nothing is left of it.
    regions: ImageRegions,
    lines: VisibleLines,
    /// The first piece of each face.
    starts: Vec<usize>,
}

impl Cropped {
    fn new(
        faces: &[PaintedFace],
        lines: &VisibleLines,
        options: &DrawingOptions,
    ) -> Result<Self, DrawingError> {
        let window = options.window_in(&lines.frame);
        let regions = map_indexed(faces.len(), |i| cropped(&faces[i].region, window.as_ref()));
        let regions: Vec<ImageRegion> = regions.into_iter().collect::<Result<_, _>>()?;
        let mut starts = vec![0];
        let mut kept = Vec::with_capacity(lines.pieces.len());
        for face in faces {
            let own = &lines.pieces[face.lines.start as usize..face.lines.end as usize];
            kept.extend(own.iter().filter_map(|piece| match &window {
                Some(window) => clip(piece, window, lines.frame.projection),
                None => Some(*piece),
            }));
            starts.push(kept.len());
        }
        let lines = VisibleLines {
            frame: lines.frame,
            objects: lines.objects.clone(),
            pieces: kept,
            counters: lines.counters.clone(),
        };
        let regions = ImageRegions { regions, anchors: Vec::new() };
        Ok(Cropped { regions, lines, starts })
    }
}

fn cropped(region: &ImageRegion, window: Option<&Window>) -> Result<ImageRegion, DrawingError> {
    let mut points = region.polygons.iter().flatten().flatten();
    if !points.all(|point| point.is_finite()) {
        return Err(DrawingError::NotFinite);
    }
    let Some(window) = window else { return Ok(region.clone()) };
    // Rings turn as the faces do that they are borders of.
    let parts = region.polygons.iter().map(|polygon| crop(polygon, window, FillRule::NonZero));
    let polygons = parts.collect::<Result<Vec<_>, _>>()?.concat();
    Ok(ImageRegion { polygons, ..region.clone() })
}

/// Pieces as strokes, joined where one begins in the end of the one before.
fn strokes(
    lines: &VisibleLines,
    pieces: std::ops::Range<usize>,
    looks: &[Look],
    placement: &Placement,
) -> Vec<(LineStyle, Strokes)> {
    let mut found: Vec<(Look, Strokes)> = Vec::new();
    let mut stroke: Vec<DVec2> = Vec::new();
    for i in pieces.clone() {
        let [start, end] = lines.pieces[i].points.map(|point| placement.apply(point));
        let goes_on =
            i != pieces.start && looks[i] == looks[i - 1] && stroke.last() == Some(&start);
        if !goes_on {
            if i != pieces.start {
                push(&mut found, looks[i - 1], &mut stroke);
            }
            stroke.push(start);
        }
        stroke.push(end);
    }
    if !pieces.is_empty() {
        push(&mut found, looks[pieces.end - 1], &mut stroke);
    }
    let finished = found.into_iter().map(|(look, strokes)| {
        let style = LineStyle { width: look.width, color: look.color };
        match look.dash {
            Dash::Continuous => (style, strokes),
            dash => (style, dashed(&strokes, dash, look.width)),
        }
    });
    finished.collect()
}

/// Puts a stroke to those of its look.
fn push(found: &mut Vec<(Look, Strokes)>, look: Look, stroke: &mut Vec<DVec2>) {
    let place = found.iter().position(|(other, _)| *other == look).unwrap_or_else(|| {
        found.push((look, Strokes::default()));
        found.len() - 1
    });
    found[place].1.push(stroke.drain(..));
}
