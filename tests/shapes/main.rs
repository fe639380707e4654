//! Files of polygons: what an SVG displays, told by hand and by `usvg`; what
//! is refused and what is told; what is written and read again.

#![allow(clippy::unwrap_used)]

mod displayed;
mod field;
mod judge;
mod lengths;
mod random;
mod refused;
mod written;

use umriss::export::{ShapeFile, ShapeFormat, ShapeOptions};
use umriss::polygon::clipping::{Operation, PlaneShape};

/// An SVG of 100 x 100 mm, a user unit to each.
fn page(content: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" \
         width=\"100mm\" height=\"100mm\" viewBox=\"0 0 100 100\">\n{content}</svg>"
    )
}

fn read(text: &str) -> ShapeFile {
    ShapeFormat::Svg.read(text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn read_with(text: &str, options: &ShapeOptions) -> ShapeFile {
    ShapeFormat::Svg.read_with(text.as_bytes(), options).unwrap()
}

fn shape(text: &str) -> PlaneShape {
    read(text).shape(None).unwrap()
}

fn refusal(text: &str) -> String {
    ShapeFormat::Svg.read(text.as_bytes()).unwrap_err().to_string()
}

/// The area of a shape, from its rounded corners.
fn area(shape: &PlaneShape) -> f64 {
    let rounded = shape.rounded().unwrap();
    let rings = rounded.polygons.iter().flatten();
    let twice = rings.map(|ring| {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>()
    });
    twice.sum::<f64>() / 2.0
}

/// The area that only one of two shapes has.
fn difference(a: &PlaneShape, b: &PlaneShape) -> f64 {
    area(&PlaneShape::operation(Operation::Xor, &[a, b]).unwrap())
}
