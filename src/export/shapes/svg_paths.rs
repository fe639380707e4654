//! SVG as a format of polygons: paths of straight lines, and polygons.
//!
//! Coordinates are those of the elements; the y axis points down on the
//! screen, which only matters for the positive and the negative rule. What
//! would have to be rounded to be read is refused: transforms and curves.

use super::path_data::{points, rings};
use super::{ShapeFile, ShapePart, number};
use crate::export::ExportError;
use crate::polygon::clipping::{FillRule, Rounded};
use glam::DVec2;
use roxmltree::{Document, Node};
use std::fmt::Write;

/// Elements whose content is not drawn where it stands.
const NOT_DRAWN: [&str; 7] =
    ["defs", "clipPath", "mask", "pattern", "symbol", "marker", "metadata"];

/// Elements that fill an area and are not read.
const REFUSED: [&str; 6] = ["rect", "circle", "ellipse", "text", "image", "use"];

/// Reads a file: a part for each path.
pub(super) fn read(bytes: &[u8]) -> Result<ShapeFile, ExportError> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = 1 + bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count();
        ExportError::Shape { line, message: "this is no text, expected UTF-8".to_owned() }
    })?;
    let document = Document::parse(text).map_err(|error| ExportError::Shape {
        line: error.pos().row as usize,
        message: error.to_string(),
    })?;
    let mut file = ShapeFile::default();
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(wrong(root, format!("<{}>, expected <svg>", root.tag_name().name())));
    }
    read_element(root, &mut file)?;
    Ok(file)
}

fn wrong(node: Node<'_, '_>, message: String) -> ExportError {
    let line = node.document().text_pos_at(node.range().start).row as usize;
    ExportError::Shape { line, message }
}

fn read_element(node: Node<'_, '_>, file: &mut ShapeFile) -> Result<(), ExportError> {
    let name = node.tag_name().name();
    if NOT_DRAWN.contains(&name) {
        return Ok(());
    }
    if REFUSED.contains(&name) {
        return Err(wrong(
            node,
            format!("<{name}> cannot be clipped, expected <path> or <polygon>"),
        ));
    }
    if node.has_attribute("transform") {
        let message = "a transform would have to be rounded, expected coordinates without one";
        return Err(wrong(node, message.to_owned()));
    }
    let data = |name| node.attribute(name).unwrap_or_default();
    let found = match name {
        "path" => Some(rings(data("d"))),
        "polygon" | "polyline" => Some(points(data("points")).map(|ring| vec![ring])),
        _ => None,
    };
    if let Some(rings) = found {
        let rings = rings.map_err(|message| wrong(node, message))?;
        file.parts.push(ShapePart { polygons: vec![rings], rule: rule(node) });
    }
    node.children().filter(Node::is_element).try_for_each(|child| read_element(child, file))
}

/// The rule of an element: its own, or that of the nearest around it.
fn rule(node: Node<'_, '_>) -> FillRule {
    let of = |node: Node<'_, '_>| {
        let style = node.attribute("style").unwrap_or_default();
        let mut styles = style.split(';').filter_map(|entry| entry.split_once(':'));
        let styled = styles.find(|(name, _)| name.trim() == "fill-rule");
        let value = styled.map(|(_, value)| value).or(node.attribute("fill-rule"))?;
        match value.trim() {
            "evenodd" => Some(FillRule::EvenOdd),
            "nonzero" => Some(FillRule::NonZero),
            _ => None,
        }
    };
    node.ancestors().find_map(of).unwrap_or(FillRule::NonZero)
}

/// Writes a path for each polygon.
pub(super) fn write(rounded: &Rounded) -> String {
    let corners = || rounded.polygons.iter().flatten().flatten();
    let low = corners().copied().reduce(DVec2::min).unwrap_or_default();
    let high = corners().copied().reduce(DVec2::max).unwrap_or(DVec2::ONE);
    let mut text = String::new();
    let [x, y, width, height] = [low.x, low.y, high.x - low.x, high.y - low.y].map(number);
    let _ = writeln!(
        text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{x} {y} {width} {height}\">"
    );
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
