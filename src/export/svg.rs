//! SVG as plotter programs and Inkscape read it.
//!
//! - One user unit is one millimetre: width and height in mm, the view box in
//!   the same numbers.
//! - Every layer is a top-level group that Inkscape shows as a layer and vpype
//!   reads as a pen by the number its label begins with. No group surrounds
//!   them, since programs that look only at the top would see one layer.
//! - The style stands on the group; all strokes of a layer are one path of
//!   many subpaths, which is the quickest to read and the shortest to write.
//! - Dashes have been strokes since `drawing`; there is no dash pattern.
//!
//! That is the profile for plotters. The one for the web adds to each group
//! what its lines are: classes (`visible` or `hidden`, `behind-2`, and the class
//! of line), the name of the object, and an `id` made of both, for style
//! sheets and scripts.
//!
//! The document is built with the crate `svg`; only the path data, nearly all
//! of the text, is written by hand, in chunks on all cores.

use super::ExportError;
use super::decimal::DecimalGrid;
use crate::drawing::{Drawing, Layer, LayerTags, Strokes, is_closed};
use crate::model::Color;
use crate::run::map_chunks;
use ::svg::Document;
use ::svg::node::Text;
use ::svg::node::element::{Element, Group, Path};
use glam::DVec2;

/// How many strokes are written by one piece of work.
const CHUNK: usize = 4096;

/// Width of the hairline around an area, mm: it covers the seam that
/// renderers leave between two areas that share a border.
const SEAM: f64 = 0.1;

/// The same where something else may show through the seam.
const SEAM_OVER_PAINT: f64 = 0.2;

/// How an SVG is written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SvgOptions {
    /// Decimals of a millimetre, 0 to 9.
    pub precision: u8,
    /// The command that made the drawing, noted in the metadata.
    pub command: Option<String>,
    /// Who it is for.
    pub profile: SvgProfile,
}

/// Who an SVG is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SvgProfile {
    /// Plotters and their programs: style on groups, nothing else.
    #[default]
    Plot,
    /// Browsers: groups also have classes and ids.
    Web,
}

impl SvgProfile {
    /// The profile called `plot` or `web`.
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "plot" => Some(SvgProfile::Plot),
            "web" => Some(SvgProfile::Web),
            _ => None,
        }
    }
}

impl Default for SvgOptions {
    fn default() -> Self {
        SvgOptions { precision: 3, command: None, profile: SvgProfile::Plot }
    }
}

/// The drawing as an SVG document.
///
/// Points that fall together when rounded are written once; a stroke that
/// becomes a single point is left out.
pub fn to_svg(drawing: &Drawing, options: &SvgOptions) -> Result<String, ExportError> {
    let grid =
        DecimalGrid::new(options.precision).ok_or(ExportError::Precision(options.precision))?;
    let (width, height) = (grid.format(drawing.size.x), grid.format(drawing.size.y));
    let mut document = Document::new()
        .set("width", format!("{width}mm"))
        .set("height", format!("{height}mm"))
        .set("viewBox", format!("0 0 {width} {height}"))
        .set("xmlns:inkscape", "http://www.inkscape.org/namespaces/inkscape")
        .add(metadata(options));
    let mut ids = Vec::new();
    if !drawing.fills.is_empty() {
        document = document.add(fills(drawing, grid));
    }
    if !drawing.painting.is_empty() {
        document = document.add(painting(drawing, grid));
    }
    for layer in &drawing.layers {
        let group = match options.profile {
            SvgProfile::Plot => group(layer, grid),
            SvgProfile::Web => tagged(group(layer, grid), layer, &mut ids),
        };
        document = document.add(group);
    }
    let mut text = document.to_string();
    text.push('\n');
    Ok(text)
}

/// All areas, one path for each colour, in a layer of their own.
fn fills(drawing: &Drawing, grid: DecimalGrid) -> Group {
    let group = Group::new()
        .set("id", "fill")
        .set("inkscape:groupmode", "layer")
        .set("inkscape:label", "0-fill")
        .set("stroke-width", SEAM)
        .set("stroke-linejoin", "round");
    drawing.fills.iter().fold(group, |group, shape| {
        let color = hexadecimal(shape.color);
        let path = Path::new().set("fill", color.clone()).set("stroke", color);
        group.add(path.set("d", ring_data(&shape.rings, grid)))
    })
}

/// Areas over one another, each followed by its lines.
fn painting(drawing: &Drawing, grid: DecimalGrid) -> Group {
    let group = Group::new()
        .set("id", "paint")
        .set("inkscape:groupmode", "layer")
        .set("inkscape:label", "0-paint")
        .set("stroke-linecap", "round")
        .set("stroke-linejoin", "round");
    drawing.painting.iter().fold(group, |group, shape| {
        let fill = hexadecimal(shape.color);
        let data = ring_data(&shape.rings, grid);
        let area = Path::new().set("fill", fill.clone()).set("stroke", fill);
        let group = group.add(area.set("stroke-width", SEAM_OVER_PAINT).set("d", data));
        shape.lines.iter().fold(group, |group, (style, strokes)| {
            let path = Path::new().set("fill", "none").set("stroke", hexadecimal(style.color));
            let path = path.set("stroke-width", style.width);
            group.add(path.set("d", stroke_data(strokes, grid)))
        })
    })
}

fn hexadecimal(color: Color) -> String {
    let [red, green, blue] = color.0;
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Closed rings as subpaths.
fn ring_data(rings: &[Vec<DVec2>], grid: DecimalGrid) -> String {
    let chunks = map_chunks(rings.len(), CHUNK, |range| {
        let (mut text, mut rounded) = (String::new(), Vec::new());
        for ring in &rings[range] {
            let closed: Vec<DVec2> = ring.iter().chain(ring.first()).copied().collect();
            push_stroke(&mut text, &closed, grid, &mut rounded);
        }
        text
    });
    chunks.concat()
}

fn group(layer: &Layer, grid: DecimalGrid) -> Group {
    Group::new()
        .set("id", format!("layer{}", layer.number))
        .set("inkscape:groupmode", "layer")
        .set("inkscape:label", allowed(&layer.label))
        .set("fill", "none")
        .set("stroke", hexadecimal(layer.style.color))
        .set("stroke-width", layer.style.width)
        .set("stroke-linecap", "round")
        .set("stroke-linejoin", "round")
        .add(Path::new().set("d", path_data(layer, grid)))
}

/// The group with what its lines are.
fn tagged(group: Group, layer: &Layer, ids: &mut Vec<String>) -> Group {
    let LayerTags { level, class, object } = &layer.tags;
    let mut classes = vec![if *level == 0 { "visible" } else { "hidden" }.to_owned()];
    classes.extend((1 < *level).then(|| format!("behind-{level}")));
    classes.extend(class.map(|class| class.name().to_owned()));
    let object = object.as_deref().map(|name| if name.is_empty() { "object" } else { name });
    let mut words: Vec<String> = object.map(word).into_iter().collect();
    words.extend(class.map(|class| class.name().to_owned()));
    words.extend(classes.iter().take(if 1 < *level { 2 } else { 1 }).cloned());
    let mut id = words.join(".");
    if ids.contains(&id) {
        id += &format!(".{}", layer.number);
    }
    ids.push(id.clone());
    let group = group.set("id", id).set("class", classes.join(" "));
    match object {
        Some(name) => group.set("data-object", allowed(name)),
        None => group,
    }
}

/// A name with nothing in it that an id may not have.
fn word(name: &str) -> String {
    name.replace(|c: char| !(c.is_alphanumeric() || c == '-' || c == '_'), "_")
}

/// All strokes of a layer as subpaths.
fn path_data(layer: &Layer, grid: DecimalGrid) -> String {
    stroke_data(&layer.strokes, grid)
}

fn stroke_data(strokes: &Strokes, grid: DecimalGrid) -> String {
    let chunks = map_chunks(strokes.len(), CHUNK, |range| {
        let mut text = String::new();
        let mut rounded = Vec::new();
        for index in range {
            match strokes.bends(index) {
                [] => push_stroke(&mut text, strokes.get(index), grid, &mut rounded),
                bends => push_curves(&mut text, strokes.get(index), bends, grid),
            }
        }
        text
    });
    chunks.concat()
}

/// `M0 0L10 0L10 5Z`; `rounded` is scratch space.
fn push_stroke(
    text: &mut String,
    stroke: &[DVec2],
    grid: DecimalGrid,
    rounded: &mut Vec<[i64; 2]>,
) {
    rounded.clear();
    rounded.extend(stroke.iter().map(|point| [grid.round(point.x), grid.round(point.y)]));
    rounded.dedup();
    if rounded.len() < 2 {
        return;
    }
    let closed = is_closed(stroke);
    if closed {
        rounded.pop();
    }
    for (index, [x, y]) in rounded.iter().enumerate() {
        text.push(if index == 0 { 'M' } else { 'L' });
        grid.push(text, *x);
        text.push(' ');
        grid.push(text, *y);
    }
    if closed {
        text.push('Z');
    }
}

/// `M0 0C1 0 2 1 2 2L5 5`.
fn push_curves(
    text: &mut String,
    stroke: &[DVec2],
    bends: &[Option<[DVec2; 2]>],
    grid: DecimalGrid,
) {
    let round = |point: DVec2| [grid.round(point.x), grid.round(point.y)];
    let mut push = |letter: char, point: [i64; 2]| {
        text.push(letter);
        grid.push(text, point[0]);
        text.push(' ');
        grid.push(text, point[1]);
    };
    let nodes: Vec<_> = stroke.iter().map(|point| round(*point)).collect();
    let bends: Vec<_> = bends.iter().map(|bend| bend.map(|controls| controls.map(round))).collect();
    let moves = |to: usize| match bends[to] {
        Some(controls) => controls != [nodes[to]; 2] || nodes[to - 1] != nodes[to],
        None => nodes[to - 1] != nodes[to],
    };
    if !(1..nodes.len()).any(moves) {
        return;
    }
    push('M', nodes[0]);
    for to in (1..nodes.len()).filter(|to| moves(*to)) {
        if let Some([one, other]) = bends[to] {
            push('C', one);
            push(' ', other);
            push(' ', nodes[to]);
        } else {
            push('L', nodes[to]);
        }
    }
    if is_closed(stroke) {
        text.push('Z');
    }
}

/// Who made the drawing and how, in the words of Dublin Core; no date.
fn metadata(options: &SvgOptions) -> Element {
    let mut work = element("rdf:Description", &[("rdf:about", "")]);
    let program = concat!("umriss ", env!("CARGO_PKG_VERSION"));
    let notes = [("dc:creator", Some(program)), ("dc:source", options.command.as_deref())];
    for (name, note) in notes {
        if let Some(note) = note {
            let mut line = element(name, &[]);
            line.get_children_mut().push(Box::new(Text::new(allowed(note))));
            work.get_children_mut().push(Box::new(line));
        }
    }
    let mut description = element(
        "rdf:RDF",
        &[
            ("xmlns:rdf", "http://www.w3.org/1999/02/22-rdf-syntax-ns#"),
            ("xmlns:dc", "http://purl.org/dc/elements/1.1/"),
        ],
    );
    description.get_children_mut().push(Box::new(work));
    let mut metadata = element("metadata", &[]);
    metadata.get_children_mut().push(Box::new(description));
    metadata
}

fn element(name: &str, attributes: &[(&str, &str)]) -> Element {
    let mut element = Element::new(name);
    for (name, value) in attributes {
        element.get_attributes_mut().insert((*name).to_owned(), (*value).into());
    }
    element
}

/// The text with what XML 1.0 has no character for marked as replaced.
fn allowed(text: &str) -> String {
    let forbidden = |c: char| {
        (c < ' ' && !matches!(c, '\t' | '\n' | '\r')) || matches!(c, '\u{fffe}' | '\u{ffff}')
    };
    text.replace(forbidden, "\u{fffd}")
}
