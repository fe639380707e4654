//! SVG as a format of polygons: what a viewer displays as filled, in
//! millimetres of the page, from its upper left corner; y points down.
//!
//! A file is read the way `usvg` reads it, the library that the previews are
//! drawn with; it is the judge in the tests. But `usvg` keeps coordinates
//! and transforms in floats of 32 bits: a square of 50 mm in millimetres and
//! one in pixels differ by 1e-6 mm there, and so do two shapes of one file
//! that share an edge under different transforms. Clipping is exact, so such
//! differences become slivers. Here all numbers are doubles; XML, selectors,
//! lengths, colours and viewBoxes are read by the libraries that `usvg` uses
//! itself. What is converted is rounded once, to a grid that is told
//! ([`chords`]).
//!
//! Displayed is what is filled by anything that is not fully transparent,
//! within its clip paths, viewports and the page. Colours do not matter, nor
//! what is painted over what. Text, images and markers have no outline here,
//! strokes have no area, what is seen through a mask is left out; all of that
//! is told by name ([`told`]).

mod basic_shapes;
mod chords;
mod clip_path;
mod element;
mod instances;
mod length;
mod path_data;
mod property;
mod source;
mod style;
mod surroundings;
mod told;
mod transform;
mod viewport;
mod walk;
mod write;

use super::shape_file::{ShapeFile, ShapePage, ShapePart};
use super::{ShapeOptions, line_of};
use crate::export::ExportError;
use crate::polygon::clipping::FillRule;
use chords::on_grid;
use element::own_transform;
use glam::{DAffine2, DMat2, DVec2, dvec2};
use length::{Lengths, PIXEL};
use property::{Declared, Property};
use roxmltree::Node;
use source::{Source, parse};
use style::Style;
use surroundings::Surroundings;
use told::Told;
use walk::{Rounding, Walker};

pub(super) use write::write;

/// An attribute of files of our own: places are the coordinates, wherever
/// the corner of the page is.
const OWN_ORIGIN: (&str, &str) = ("data-origin", "coordinates");

/// Reads a file: a part for each shape.
pub(super) fn read(bytes: &[u8], options: &ShapeOptions) -> Result<ShapeFile, ExportError> {
    if bytes.starts_with(&[0x1f, 0x8b]) {
        let message = "the file is compressed (svgz), expected the SVG itself, as gunzip writes it";
        return Err(ExportError::Shape { line: 1, message: message.to_owned() });
    }
    let text = std::str::from_utf8(bytes).map_err(|error| ExportError::Shape {
        line: line_of(bytes, error.valid_up_to()),
        message: "this is no text, expected UTF-8".to_owned(),
    })?;
    let document = parse(text)?;
    let mut told = Told::default();
    let source = Source::new(&document, &mut told)?;
    let rounding = Rounding {
        flatness: options.flatness,
        converted: options.grid_of_converted(),
        written: options.grid_of_written(),
    };
    let mut walker = Walker::new(&source, rounding, &mut told);
    let parts = displayed(&mut walker, options)?;
    let mut file = walker.file;
    file.parts = parts;
    file.warnings = told.sentences();
    Ok(file)
}

/// All shapes of a document that are displayed on its page.
fn displayed(
    walker: &mut Walker<'_, '_, '_>,
    options: &ShapeOptions,
) -> Result<Vec<ShapePart>, ExportError> {
    let root = walker.source.root();
    let declared = walker.declared(root)?;
    let Some(mut page) = viewport::page(root, &declared)? else { return Ok(Vec::new()) };
    let mut corner = DVec2::ZERO;
    let (name, value) = OWN_ORIGIN;
    if root.attribute(name) == Some(value) {
        corner = -page.viewport.to_outside.translation;
        page.viewport.to_outside.translation = DVec2::ZERO;
    }
    // A page is converted like all that is on it.
    if let Some(grid) = options.grid_of_converted()
        && page.viewport.to_outside.matrix2 != DMat2::IDENTITY
    {
        page.size = page.size.map(|size| dvec2(on_grid(size.x, grid), on_grid(size.y, grid)));
    }
    walker.file.page = page.size.map(|size| ShapePage { low: corner, high: corner + size });
    walker.file.is_in_pixels = !page.has_unit;
    let mut around = Surroundings::of_page(page.viewport);
    around.to_page = transform_of_page(root, &declared, page.size)? * around.to_page;
    let parts = walker.walk(root, around)?;
    let shows_beyond = matches!(declared.get(Property::Overflow), Some("visible" | "auto"));
    match walker.file.page {
        Some(page) if !options.off_page && !shows_beyond => {
            Ok(on_page(&mut walker.file, parts, page))
        }
        _ => Ok(parts),
    }
}

/// The transform of the whole page, about its middle: of millimetres.
fn transform_of_page(
    root: Node<'_, '_>,
    declared: &Declared<'_>,
    size: Option<DVec2>,
) -> Result<DAffine2, ExportError> {
    let size = size.map_or(DVec2::NAN, |size| size / PIXEL);
    let lengths = Lengths { viewport: size.to_array(), font_size: Style::default().font_size };
    let middle = if size.is_finite() { size / 2.0 } else { DVec2::ZERO };
    let own = own_transform(root, declared, &lengths, middle)?;
    Ok(DAffine2::from_mat2_translation(own.matrix2, own.translation * PIXEL))
}

/// What of the parts lies on a page. Those that lie on it wholly stay as
/// they are.
fn on_page(file: &mut ShapeFile, parts: Vec<ShapePart>, page: ShapePage) -> Vec<ShapePart> {
    let ShapePage { low, high } = page;
    let corners = vec![low, dvec2(high.x, low.y), high, dvec2(low.x, high.y)];
    let mut region = None;
    let mut kept = Vec::with_capacity(parts.len());
    for mut part in parts {
        let places = || part.polygons.iter().flatten().flatten();
        let is_inside = |place: &DVec2| low.cmple(*place).all() && place.cmple(high).all();
        if places().all(is_inside) {
            kept.push(part);
            continue;
        }
        file.is_cut_to_page |= part.clip.is_none();
        let least = places().copied().fold(DVec2::INFINITY, DVec2::min);
        let greatest = places().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
        if least.cmplt(high).all() && low.cmplt(greatest).all() {
            let rectangle = ShapePart {
                polygons: vec![vec![corners.clone()]],
                rule: FillRule::NonZero,
                clip: None,
            };
            let region = *region.get_or_insert_with(|| file.add_region(vec![rectangle]));
            part.clip = Some(file.add_clip(region, part.clip));
            kept.push(part);
        }
    }
    kept
}
