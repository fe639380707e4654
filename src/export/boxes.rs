//! Boxes of whole pixels as SVG, one pixel being one unit.

use crate::model::Color;
use std::collections::BTreeMap;
use std::fmt::Write;

/// An SVG of boxes, given as left, top, width and height, over an image of
/// `size`. Boxes of one colour are one path; the borders of those larger
/// than a pixel are drawn.
pub fn boxes_to_svg(size: [u32; 2], boxes: impl IntoIterator<Item = ([u32; 4], Color)>) -> String {
    let [width, height] = size;
    let mut paths: BTreeMap<([u8; 3], bool), String> = BTreeMap::new();
    for ([left, top, width, height], Color(color)) in boxes {
        let is_pixel = width == 1 && height == 1;
        let path = paths.entry((color, is_pixel)).or_default();
        // Writing to a string cannot fail.
        let _ = write!(path, "M{left} {top}h{width}v{height}h-{width}z");
    }
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\">\n<rect width=\"{width}\" height=\"{height}\" \
         fill=\"#ffffff\"/>\n"
    );
    for (([red, green, blue], is_pixel), path) in paths {
        let stroke = if is_pixel { "none" } else { "#787878" };
        let _ = writeln!(
            svg,
            "<path fill=\"#{red:02x}{green:02x}{blue:02x}\" stroke=\"{stroke}\" \
             stroke-width=\"0.25\" d=\"{path}\"/>"
        );
    }
    svg.push_str("</svg>\n");
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_of_a_colour_are_one_path() {
        let boxes = [([0, 0, 4, 2], Color([1, 2, 3])), ([4, 0, 4, 2], Color([1, 2, 3]))];
        let svg = boxes_to_svg([8, 2], boxes);
        assert!(svg.contains("fill=\"#010203\" stroke=\"#787878\""));
        assert!(svg.contains("d=\"M0 0h4v2h-4zM4 0h4v2h-4z\""));
        assert_eq!(svg.matches("<path").count(), 1);
    }
}
