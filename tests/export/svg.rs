//! SVG as other programs see it.

use crate::fixture::cube;
use roxmltree::Document;
use umriss::drawing::{Drawing, DrawingOptions, Hidden, LayerBy};
use umriss::export::{ExportError, SvgOptions, to_png, to_svg};

const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

fn dashed(layer_by: LayerBy) -> Drawing {
    let options = DrawingOptions { hidden: Hidden::Dashed, layer_by, ..DrawingOptions::default() };
    Drawing::new(&cube(), &options).unwrap()
}

#[test]
fn layers_are_top_level_groups_in_the_order_of_painting() {
    let text = to_svg(&dashed(LayerBy::Visibility), &SvgOptions::default()).unwrap();
    let document = Document::parse(&text).unwrap();
    let root = document.root_element();
    assert_eq!(root.attribute("width"), Some("210mm"));
    assert_eq!(root.attribute("viewBox"), Some("0 0 210 297"));
    let groups: Vec<_> = root.children().filter(|node| node.has_tag_name("g")).collect();
    let labels: Vec<_> = groups.iter().map(|group| group.attribute((INKSCAPE, "label"))).collect();
    assert_eq!(labels, [Some("2-hidden"), Some("1-visible")]);
    for group in &groups {
        assert_eq!(group.attribute((INKSCAPE, "groupmode")), Some("layer"));
        assert_eq!(group.attribute("fill"), Some("none"));
        let paths: Vec<_> = group.children().filter(|node| node.is_element()).collect();
        assert_eq!(paths.len(), 1);
        let attributes: Vec<_> = paths[0].attributes().map(|a| a.name()).collect();
        assert_eq!(attributes, ["d"]);
    }
}

#[test]
fn names_that_are_no_xml_are_made_so() {
    let mut lines = cube();
    lines.objects[0] = "a\"'<&>\u{1}\u{ffff}z".into();
    let options = DrawingOptions { layer_by: LayerBy::Object, ..DrawingOptions::default() };
    let drawing = Drawing::new(&lines, &options).unwrap();
    let command = Some("umriss --view \u{1b}<iso>".to_owned());
    let text = to_svg(&drawing, &SvgOptions { command, ..SvgOptions::default() }).unwrap();
    let document = Document::parse(&text).unwrap();
    let group = document.descendants().find(|node| node.has_tag_name("g")).unwrap();
    assert_eq!(group.attribute((INKSCAPE, "label")), Some("1-a\"'<&>\u{fffd}\u{fffd}z"));
    let source = document.descendants().find(|node| node.tag_name().name() == "source").unwrap();
    assert_eq!(source.text(), Some("umriss --view \u{fffd}<iso>"));
}

#[test]
fn precision_is_a_number_of_decimals() {
    let drawing = dashed(LayerBy::Visibility);
    let write = |precision| to_svg(&drawing, &SvgOptions { precision, ..SvgOptions::default() });
    assert!(matches!(write(10), Err(ExportError::Precision(10))));
    assert!(write(9).unwrap().len() > write(1).unwrap().len());
    let whole = write(0).unwrap();
    let data = whole.split("d=\"").nth(1).unwrap().split('"').next().unwrap();
    assert!(!data.contains('.'));
}

#[test]
fn a_preview_is_dark_on_white_and_of_the_size_asked_for() {
    let text = to_svg(&dashed(LayerBy::Class), &SvgOptions::default()).unwrap();
    let png = to_png(&text, 420).unwrap();
    let picture = header_size(&png);
    assert_eq!(picture, (420, 594));
    assert!(matches!(to_png(&text, 0), Err(ExportError::PictureSize { width: 0, .. })));
    assert!(matches!(to_png(&text, 40_000), Err(ExportError::PictureSize { .. })));
    assert!(matches!(to_png("<svg", 10), Err(ExportError::Picture(_))));
}

/// Width and height from the header of a PNG file.
fn header_size(png: &[u8]) -> (u32, u32) {
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    let number = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    (number(16), number(20))
}
