//! Pages and viewports: where user units begin and how long they are
//! (SVG 1.1, chapter 7).

use super::length::{PIXEL, PageLength, page_length};
use super::property::{Declared, Property};
use super::source::wrong;
use crate::export::ExportError;
use glam::{DAffine2, DMat2, DVec2, dvec2};
use roxmltree::Node;
use svgtypes::{Align, AspectRatio, ViewBox, ViewBoxError};

/// A window onto user units.
#[derive(Debug, Clone, Copy)]
pub(super) struct Viewport {
    /// From the user units inside to those outside; to millimetres for the
    /// page.
    pub(super) to_outside: DAffine2,
    /// Width and height, in the user units inside; not a number where there
    /// is none.
    pub(super) size: [f64; 2],
}

/// The outermost viewport.
#[derive(Debug, Clone, Copy)]
pub(super) struct PageView {
    pub(super) viewport: Viewport,
    /// Width and height in millimetres, if the page has a size.
    pub(super) size: Option<DVec2>,
    /// Whether the file says of itself how large a user unit is.
    pub(super) has_unit: bool,
}

/// The viewBox of an element: a corner and a size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum View {
    Missing,
    /// Nothing is displayed in it.
    Empty,
    Of([DVec2; 2]),
}

/// Reads the viewBox of an element.
pub(super) fn view_box(node: Node<'_, '_>) -> Result<View, ExportError> {
    let Some(text) = node.attribute("viewBox") else { return Ok(View::Missing) };
    let expected = "expected four numbers: x, y, width and height";
    let numbers: Vec<_> =
        text.split([' ', ',', '\t', '\n', '\r']).filter(|word| !word.is_empty()).collect();
    match text.parse::<ViewBox>() {
        Ok(ViewBox { x, y, w, h }) if numbers.len() <= 4 => {
            Ok(View::Of([dvec2(x, y), dvec2(w, h)]))
        }
        // A size of zero hides everything; a negative one is an error.
        Err(ViewBoxError::InvalidSize) if !numbers.iter().skip(2).any(|n| n.starts_with('-')) => {
            Ok(View::Empty)
        }
        _ => Err(wrong(node, format!("the viewBox `{text}` cannot be read, {expected}"))),
    }
}

/// How a viewBox lies in a viewport with a corner and a size.
pub(super) fn fitted(
    node: Node<'_, '_>,
    [corner, size]: [DVec2; 2],
    [low, extent]: [DVec2; 2],
) -> Result<DAffine2, ExportError> {
    let aspect = match node.attribute("preserveAspectRatio").map(str::trim) {
        None | Some("") => AspectRatio::default(),
        Some(text) => text.parse().map_err(|_| {
            let message =
                format!("preserveAspectRatio is `{text}`, expected one such as xMidYMid meet");
            wrong(node, message)
        })?,
    };
    let each = size / extent;
    let scale = match aspect.align {
        Align::None => each,
        _ if aspect.slice => DVec2::splat(each.max_element()),
        _ => DVec2::splat(each.min_element()),
    };
    let share = match aspect.align {
        Align::None | Align::XMinYMin => dvec2(0.0, 0.0),
        Align::XMidYMin => dvec2(0.5, 0.0),
        Align::XMaxYMin => dvec2(1.0, 0.0),
        Align::XMinYMid => dvec2(0.0, 0.5),
        Align::XMidYMid => dvec2(0.5, 0.5),
        Align::XMaxYMid => dvec2(1.0, 0.5),
        Align::XMinYMax => dvec2(0.0, 1.0),
        Align::XMidYMax => dvec2(0.5, 1.0),
        Align::XMaxYMax => dvec2(1.0, 1.0),
    };
    let rest = size - extent * scale;
    let matrix = DMat2::from_diagonal(scale);
    Ok(DAffine2::from_mat2_translation(matrix, corner + share * rest - low * scale))
}

/// The page of the outermost element: none where nothing is displayed.
pub(super) fn page(
    root: Node<'_, '_>,
    declared: &Declared<'_>,
) -> Result<Option<PageView>, ExportError> {
    let length = |property: Property| {
        let text = declared.get(property).filter(|text| !text.is_empty());
        let length = text.map_or(Ok(None), page_length);
        let length =
            length.map_err(|message| wrong(root, format!("{} {message}", property.name())))?;
        match length {
            Some(PageLength::Millimetres(length) | PageLength::Percent(length)) if length < 0.0 => {
                let message = format!("{} is negative, expected a length", property.name());
                Err(wrong(root, message))
            }
            length => Ok(length),
        }
    };
    let given = [length(Property::Width)?, length(Property::Height)?];
    let view_box = match view_box(root)? {
        View::Missing => None,
        View::Empty => return Ok(None),
        View::Of(view) => Some(view),
    };
    let own = view_box.map(|[_, extent]| extent.to_array());
    let known = [0, 1].map(|axis| match (given[axis], own) {
        (Some(PageLength::Millimetres(length)), _) => Some(length),
        // Of the viewer's window, which nobody knows: of the viewBox then.
        (Some(PageLength::Percent(share)), Some(own)) => Some(own[axis] * share / 100.0 * PIXEL),
        _ => None,
    });
    let in_proportion = |axis: usize| {
        let own = own?;
        let scale = known[1 - axis].map_or(PIXEL, |length| length / own[1 - axis]);
        Some(own[axis] * scale)
    };
    let size = [0, 1].map(|axis| known[axis].or_else(|| in_proportion(axis)));
    if size.iter().flatten().any(|length| *length == 0.0) {
        return Ok(None);
    }
    let full = match size {
        [Some(width), Some(height)] => Some(dvec2(width, height)),
        _ => None,
    };
    let (to_outside, inside) = match (view_box, full) {
        (Some([low, extent]), Some(size)) => {
            (fitted(root, [DVec2::ZERO, size], [low, extent])?, extent.to_array())
        }
        _ => {
            let inside = size.map(|length| length.map_or(f64::NAN, |length| length / PIXEL));
            (DAffine2::from_scale(DVec2::splat(PIXEL)), inside)
        }
    };
    let has_unit = given.iter().any(|length| matches!(length, Some(PageLength::Millimetres(_))));
    Ok(Some(PageView { viewport: Viewport { to_outside, size: inside }, size: full, has_unit }))
}
