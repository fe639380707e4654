//! What is written is read again as the same.

use super::{page, read, read_with, shape};
use glam::{DVec2, dvec2};
use proptest::prelude::*;
use umriss::export::{ShapeFormat, ShapeOptions, ShapePage};
use umriss::polygon::clipping::{FillRule, Operation, PlaneShape, Rounded};

fn rounded(rings: Vec<Vec<DVec2>>) -> Rounded {
    PlaneShape::new(&[rings], FillRule::EvenOdd).unwrap().rounded().unwrap()
}

fn again(text: &str) -> Vec<Vec<Vec<DVec2>>> {
    shape(text).rounded().unwrap().polygons
}

#[test]
fn a_page_has_width_height_and_unit() {
    let square = rounded(vec![vec![dvec2(10.0, 20.0), dvec2(60.0, 20.0), dvec2(60.0, 60.0)]]);
    let sized = ShapePage { low: DVec2::ZERO, high: dvec2(100.0, 80.0) };
    let text = ShapeFormat::Svg.write_on(&square, Some(sized)).unwrap();
    assert!(text.contains("width=\"100mm\" height=\"80mm\" viewBox=\"0 0 100 80\">"), "{text}");
    assert_eq!(again(&text), square.polygons);
    // Without a page it is as large as what is on it, and places stay.
    let text = ShapeFormat::Svg.write(&square).unwrap();
    assert!(text.contains("width=\"50mm\" height=\"40mm\" viewBox=\"10 20 50 40\""), "{text}");
    assert_eq!(again(&text), square.polygons);
    let file = read(&text);
    assert_eq!(file.page, Some(ShapePage { low: dvec2(10.0, 20.0), high: dvec2(60.0, 60.0) }));
    // A page of someone else begins at its corner.
    let other = text.replace(" data-origin=\"coordinates\"", "");
    let corners = again(&other)[0][0].clone();
    assert!(corners.contains(&dvec2(0.0, 0.0)), "{corners:?}");
}

#[test]
fn places_are_rounded_where_they_are_converted_or_where_it_is_wished() {
    let third = "<path d='M0 0H33.33333333333333V9z'/>";
    let corner = |text: &str, snap: Option<f64>| {
        let options = ShapeOptions { snap, ..ShapeOptions::default() };
        let file = read_with(text, &options);
        (file.parts[0].polygons[0][0][1].x, file.rounded)
    };
    assert_eq!(corner(&page(third), None), (33.33333333333333, None));
    assert_eq!(corner(&page(third), Some(0.001)), (33.333, Some(0.001)));
    assert_eq!(corner(&page(third), Some(0.25)), (33.25, Some(0.25)));
    assert_eq!(corner(&page(third), Some(3.0)), (33.0, Some(3.0)));
    let moved = page(&format!("<g transform='translate(0.1)'>{third}</g>"));
    assert_eq!(corner(&moved, None), (33.43333, Some(1e-5)));
    assert_eq!(corner(&moved, Some(0.0)), (33.33333333333333 + 0.1, None));
}

proptest! {
    /// Any shape, written in either format, is the same shape again to the
    /// last bit, and xor with itself is empty.
    #[test]
    fn any_shape_is_the_same_again(
        corners in prop::collection::vec((-1e3..1e3_f64, -1e3..1e3_f64), 3..12),
        scale in prop_oneof![Just(1.0), Just(1e-9), Just(1e12), Just(0.1)],
        with_page in any::<bool>(),
    ) {
        let ring = corners.iter().map(|&(x, y)| scale * dvec2(x, y)).collect();
        let first = rounded(vec![ring]);
        let sized = ShapePage { low: DVec2::ZERO, high: dvec2(10.0, 10.0) };
        let text = ShapeFormat::Svg.write_on(&first, with_page.then_some(sized)).unwrap();
        prop_assert_eq!(&again(&text), &first.polygons);
        let geojson = ShapeFormat::GeoJson.write(&first).unwrap();
        let other = ShapeFormat::GeoJson.read(geojson.as_bytes()).unwrap().shape(None).unwrap();
        let rest = PlaneShape::operation(Operation::Xor, &[&shape(&text), &other]).unwrap();
        prop_assert!(rest.polygons().is_empty());
    }
}
