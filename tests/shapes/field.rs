//! Small files as programs and people write them, with their right values.

use super::{area, difference};
use umriss::export::{ShapeFile, ShapeFormat};
use umriss::polygon::clipping::PlaneShape;

fn file(name: &str) -> ShapeFile {
    let path = format!("tests/field/{name}");
    let format = ShapeFormat::from_path(path.as_ref()).unwrap();
    format.read(&std::fs::read(&path).unwrap()).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn shape(name: &str) -> PlaneShape {
    file(name).shape(None).unwrap()
}

#[test]
fn a_square_in_millimetres_and_in_pixels_is_one_square() {
    let (a, b) = (shape("svg/a_mm.svg"), shape("svg/b_px.svg"));
    assert_eq!(area(&a), 2500.0);
    assert_eq!(difference(&a, &b), 0.0);
    assert_eq!(a.rounded().unwrap(), b.rounded().unwrap());
}

#[test]
fn only_what_is_displayed_is_area() {
    assert_eq!(area(&shape("svg/hidden.svg")), 2500.0);
}

#[test]
fn transforms_and_rectangles_are_read() {
    let pixel = 25.4 / 96.0_f64;
    for (name, expected) in [("emptytr", 200.0), ("tr0", 200.0), ("rect", 600.0)] {
        let found = area(&shape(&format!("svg/{name}.svg"))) / pixel.powi(2);
        assert!((found - expected).abs() < 0.01, "{name}: {found}");
    }
}

#[test]
fn geojson_with_a_byte_order_mark_and_with_points() {
    assert_eq!(area(&shape("bom.geojson")), 100.0);
    let mixed = file("mixed.geojson");
    assert_eq!(area(&mixed.shape(None).unwrap()), 100.0);
    assert_eq!(mixed.warnings, ["passed over: Point, it has no area (1)"]);
}

/// A hole is a hole where holes overlap too: two of 25 with 4 in common.
#[test]
fn holes_that_overlap_are_one_hole() {
    assert_eq!(area(&shape("overlapping_holes.geojson")), 100.0 - (25.0 + 25.0 - 4.0));
}
