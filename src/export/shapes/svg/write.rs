//! Polygons as an SVG of paths: a page in millimetres, a user unit to each.

use super::super::number;
use super::super::shape_file::ShapePage;
use super::OWN_ORIGIN;
use crate::polygon::clipping::Rounded;
use glam::DVec2;
use std::fmt::Write;

/// Writes a path for each polygon. The page is the one given, made larger
/// where polygons lie beyond it; without one it is as large as they are.
pub(in super::super) fn write(rounded: &Rounded, page: Option<ShapePage>) -> String {
    let ShapePage { low, high } = page_of(rounded, page);
    let mut text = String::new();
    let (width, height) = (number(width(low.x, high.x)), number(width(low.y, high.y)));
    let _ = write!(
        text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" \
         viewBox=\"{} {} {width} {height}\"",
        number(low.x),
        number(low.y),
    );
    if low != DVec2::ZERO {
        let (name, value) = OWN_ORIGIN;
        let _ = write!(text, " {name}=\"{value}\"");
    }
    text.push_str(">\n");
    for rings in &rounded.polygons {
        text.push_str("<path fill-rule=\"evenodd\" d=\"");
        for ring in rings {
            for (i, corner) in ring.iter().enumerate() {
                let command = if i == 0 { 'M' } else { 'L' };
                let _ = write!(text, "{command}{} {}", number(corner.x), number(corner.y));
            }
            text.push('Z');
        }
        text.push_str("\"/>\n");
    }
    text.push_str("</svg>\n");
    text
}

fn page_of(rounded: &Rounded, page: Option<ShapePage>) -> ShapePage {
    let corners = || rounded.polygons.iter().flatten().flatten().copied();
    let bounds = corners().map(|corner| ShapePage { low: corner, high: corner });
    let whole = bounds.chain(page).reduce(ShapePage::with);
    whole.unwrap_or(ShapePage { low: DVec2::ZERO, high: DVec2::ONE })
}

/// The least width that reaches from one number to another, as doubles are
/// added.
fn width(low: f64, high: f64) -> f64 {
    let mut width = high - low;
    while low + width < high {
        width = width.next_up();
    }
    match width > 0.0 {
        true => width,
        false => 1.0,
    }
}
