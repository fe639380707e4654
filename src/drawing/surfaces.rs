//! Surfaces: regions filled with a colour, and how bright it is.
//!
//! What is seen of a face becomes an area on the page. Areas of one colour
//! are one shape, so that no seam can show between them; a hairline of the
//! same colour around it covers the seams that renderers leave between areas
//! of two colours, each of which covers half of a pixel.
//!
//! Brightness is Lambert's (1760), the cosine between the normal and the
//! direction towards the light, but of a light so large that it shines a
//! little around the edge ("wrapped"), so that the dark side has a shape too;
//! and some light comes from everywhere.

use super::hatching::Hatch;
use super::{DrawingError, DrawingOptions, Window};
use crate::model::{Color, Frame};
use crate::polygon::clipping::{FillRule, Operation, PlaneShape};
use crate::run::map_indexed;
use crate::view::{ImageRegion, ImageRegions, VisibleLines};
use glam::{DVec2, DVec3};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::str::FromStr;

/// How surfaces are filled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Fill {
    /// Not at all.
    #[default]
    None,
    /// Each face in its own colour.
    Flat,
    /// In its colour, as bright as the light makes it.
    Shade,
}

/// Reads `none`, `flat`, `shade`.
impl FromStr for Fill {
    type Err = DrawingError;

    fn from_str(text: &str) -> Result<Self, DrawingError> {
        match text {
            "none" => Ok(Fill::None),
            "flat" => Ok(Fill::Flat),
            "shade" => Ok(Fill::Shade),
            _ => {
                Err(DrawingError::Choice { word: text.to_owned(), expected: "none, flat or shade" })
            }
        }
    }
}

/// What is drawn of surfaces, beside their lines.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SurfaceOptions {
    /// How they are filled.
    pub fill: Fill,
    /// How they are hatched, if they are.
    pub hatch: Option<Hatch>,
    /// The direction towards the light, world coordinates; if absent it comes
    /// over the viewer's left shoulder.
    pub light: Option<DVec3>,
}

impl SurfaceOptions {
    /// Whether anything is drawn of surfaces.
    pub(super) fn any(&self) -> bool {
        self.fill != Fill::None || self.hatch.is_some()
    }
}

/// An area of one colour on the page.
#[derive(Debug, Clone, PartialEq)]
pub struct FilledShape {
    /// Its colour.
    pub color: Color,
    /// Closed rings, mm, y downwards, not closed by a repeated corner:
    /// outlines turn one way and their holes the other.
    pub rings: Vec<Vec<DVec2>>,
}

/// The colour of faces to which the file gives none.
const PAPER_GREY: Color = Color([236, 236, 232]);

/// The cosine beyond the edge at which a face is dark.
const WRAP: f64 = 0.35;

/// The share of light that comes from everywhere.
const AMBIENT: f64 = 0.25;

/// How brightly a light shines on faces.
#[derive(Debug, Clone, Copy)]
pub(super) struct Light(DVec3);

impl Light {
    pub(super) fn new(frame: &Frame, options: &SurfaceOptions) -> Self {
        let usual = 0.6 * frame.up - 0.35 * frame.right - 0.7 * frame.forward;
        let wished = options.light.map(DVec3::normalize_or_zero).filter(|l| *l != DVec3::ZERO);
        Light(wished.unwrap_or_else(|| usual.normalize_or_zero()))
    }

    /// From 0 in the dark to 1 in full light.
    pub(super) fn on(self, region: &ImageRegion) -> f64 {
        ((self.0.dot(region.normal) + WRAP) / (1.0 + WRAP)).clamp(0.0, 1.0)
    }
}

/// Areas by colour. Ascending, so dark ones come first.
pub(super) fn fills(
    regions: &ImageRegions,
    light: Light,
    fill: Fill,
    place: impl Fn(DVec2) -> DVec2,
) -> Vec<FilledShape> {
    let mut shapes: BTreeMap<[u8; 3], Vec<Vec<DVec2>>> = BTreeMap::new();
    for region in &regions.regions {
        let color = match fill {
            Fill::None => return Vec::new(),
            fill => shade(region, light, fill).0,
        };
        let rings = region.polygons.iter().flatten();
        let rings = rings.map(|ring| ring.iter().map(|&point| place(point)).collect());
        shapes.entry(color).or_default().extend(rings);
    }
    shapes.into_iter().map(|(color, rings)| FilledShape { color: Color(color), rings }).collect()
}

/// The colour of a region: its own, and as bright as the light makes it if
/// that is asked.
pub(super) fn shade(region: &ImageRegion, light: Light, fill: Fill) -> Color {
    let base = region.color.unwrap_or(PAPER_GREY);
    match fill {
        Fill::None | Fill::Flat => base,
        Fill::Shade => {
            let bright = AMBIENT + (1.0 - AMBIENT) * light.on(region);
            Color(base.0.map(|part| (f64::from(part) * bright).round() as u8))
        }
    }
}

/// The regions as far as they lie in the window of the drawing, cut exactly.
///
/// # Errors
///
/// If a coordinate is not finite.
pub(super) fn crop_regions<'a>(
    lines: &VisibleLines,
    regions: &'a ImageRegions,
    options: &DrawingOptions,
) -> Result<Cow<'a, ImageRegions>, DrawingError> {
    let mut points = regions.regions.iter().flat_map(|r| r.polygons.iter().flatten().flatten());
    if !points.clone().all(|point| point.is_finite()) {
        return Err(DrawingError::NotFinite);
    }
    let Some(window) = options.window_in(&lines.frame) else {
        return Ok(Cow::Borrowed(regions));
    };
    if points.all(|point| window.holds(*point)) {
        return Ok(Cow::Borrowed(regions));
    }
    let cut = map_indexed(regions.regions.len(), |i| {
        let region = &regions.regions[i];
        let parts =
            region.polygons.iter().map(|polygon| crop(polygon, &window, FillRule::Positive));
        let polygons: Vec<_> = parts.collect::<Result<Vec<_>, _>>()?.concat();
        Ok(ImageRegion { polygons, ..region.clone() })
    });
    let cut: Result<Vec<_>, DrawingError> = cut.into_iter().collect();
    let regions_left = cut?.into_iter().filter(|region| !region.polygons.is_empty()).collect();
    Ok(Cow::Owned(ImageRegions { regions: regions_left, anchors: regions.anchors.clone() }))
}

type Rings = Vec<Vec<DVec2>>;

/// What of a polygon, whose rings are read by a rule, lies in a window, cut
/// exactly.
pub(super) fn crop(
    polygon: &Rings,
    window: &Window,
    rule: FillRule,
) -> Result<Vec<Rings>, DrawingError> {
    let corners = || polygon.iter().flatten();
    if corners().all(|point| window.holds(*point)) {
        return Ok(vec![polygon.clone()]);
    }
    let low = corners().fold(DVec2::INFINITY, |low, point| low.min(*point));
    let high = corners().fold(DVec2::NEG_INFINITY, |high, point| high.max(*point));
    if low.cmpge(window.high()).any() || high.cmple(window.low()).any() {
        return Ok(Vec::new());
    }
    let (low, high) = (window.low(), window.high());
    let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    let shape = |rings: &Rings, rule| PlaneShape::new(std::slice::from_ref(rings), rule);
    let both = shape(polygon, rule).and_then(|subject| {
        let frame = shape(&vec![corners.to_vec()], FillRule::Positive)?;
        PlaneShape::operation(Operation::Intersection, &[&subject, &frame])?.rounded()
    });
    // What can go wrong are coordinates that are not finite.
    both.map(|rounded| rounded.polygons).map_err(|_| DrawingError::NotFinite)
}
