//! Elements with an outline (SVG 1.1, chapters 8 and 9).

use super::chords::{Arc, Chords};
use super::length::Lengths;
use super::path_data;
use super::property::{Declared, Property};
use glam::{DMat2, DVec2, dvec2};
use roxmltree::Node;
use std::f64::consts::TAU;

/// Whether elements of this name have an outline.
pub(super) fn is_one(name: &str) -> bool {
    matches!(name, "path" | "rect" | "circle" | "ellipse" | "polygon" | "polyline" | "line")
}

/// Draws the outline of an element; what has no area may be left out.
pub(super) fn draw(
    node: Node<'_, '_>,
    name: &str,
    declared: &Declared<'_>,
    lengths: &Lengths,
    chords: &mut Chords,
) -> Result<(), String> {
    let given = |property: Property| {
        let text = declared.get(property).filter(|text| !text.eq_ignore_ascii_case("auto"));
        let length = text.map(|text| lengths.along(property, text)).transpose();
        length.map_err(|message| format!("{}: {message}", property.name()))
    };
    let or_zero = |property: Property| Ok::<f64, String>(given(property)?.unwrap_or(0.0));
    // One radius stands for both; a negative one is as if it were not there.
    let radii = || {
        let radius = |property| Ok::<_, String>(given(property)?.filter(|radius| 0.0 <= *radius));
        let (x, y) = (radius(Property::Rx)?, radius(Property::Ry)?);
        Ok::<DVec2, String>(dvec2(x.or(y).unwrap_or(0.0), y.or(x).unwrap_or(0.0)))
    };
    match name {
        "path" => match node.attribute("d").map(str::trim) {
            None | Some("none") => Ok(()),
            Some(data) => path_data::draw(data, chords),
        },
        "polygon" | "polyline" => {
            path_data::draw_points(node.attribute("points").unwrap_or_default(), chords)
        }
        "rect" => {
            let corner = dvec2(or_zero(Property::X)?, or_zero(Property::Y)?);
            let size = dvec2(or_zero(Property::Width)?, or_zero(Property::Height)?);
            match 0.0 < size.x && 0.0 < size.y {
                true => rectangle(corner, size, radii()?.min(size / 2.0), chords),
                false => Ok(()),
            }
        }
        "circle" | "ellipse" => {
            let center = dvec2(or_zero(Property::Cx)?, or_zero(Property::Cy)?);
            let radii = match name {
                "circle" => DVec2::splat(or_zero(Property::R)?),
                _ => radii()?,
            };
            match 0.0 < radii.x && 0.0 < radii.y {
                true => chords.ellipse(center, radii),
                false => Ok(()),
            }
        }
        _ => Ok(()),
    }
}

/// A rectangle with round corners, clockwise on the screen.
fn rectangle(low: DVec2, size: DVec2, radii: DVec2, chords: &mut Chords) -> Result<(), String> {
    let high = low + size;
    if radii.x == 0.0 || radii.y == 0.0 {
        chords.move_to(low)?;
        for corner in [dvec2(high.x, low.y), high, dvec2(low.x, high.y)] {
            chords.line_to(corner)?;
        }
        chords.close();
        return Ok(());
    }
    let (left, right) = (low.x + radii.x, high.x - radii.x);
    let (top, bottom) = (low.y + radii.y, high.y - radii.y);
    let corners = [
        (dvec2(right, low.y), dvec2(right, top), dvec2(high.x, top)),
        (dvec2(high.x, bottom), dvec2(right, bottom), dvec2(right, high.y)),
        (dvec2(left, high.y), dvec2(left, bottom), dvec2(low.x, bottom)),
        (dvec2(low.x, top), dvec2(left, top), dvec2(left, low.y)),
    ];
    chords.move_to(dvec2(left, low.y))?;
    for (quarter, (from, center, to)) in corners.into_iter().enumerate() {
        chords.line_to(from)?;
        let start = TAU / 4.0 * (quarter as f64 - 1.0);
        let axes = DMat2::from_diagonal(radii);
        chords.arc_to(&Arc { center, axes, start, sweep: TAU / 4.0 }, to)?;
    }
    chords.close();
    Ok(())
}
