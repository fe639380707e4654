//! The JSON drawing, `umriss-drawing/1`: what a method found, before any page.
//!
//! Coordinates are those of the view frame, written with the fewest digits
//! that read back as the same number. Nothing in the file depends on when,
//! where or on how many cores it was made.
//!
//! One line of text per line of the drawing, so that text tools can compare
//! two drawings. Beyond what every reader needs, the file keeps what is lost
//! otherwise: `objects`, all names in the order of the scene; `run`, which
//! pieces are one straight line; `unit`, that of the models, and `hidden`,
//! whether hidden lines were looked for, so that a page made of the file is
//! the page made of the models; `crossings`, if halos were asked for: pairs of
//! lines by their number, the first passing in front of the second; for oblique views `shear`, and for
//! perspective ones `half_height`, the tangent of half the field of view. Where
//! the outer outline was looked for, `outline` says whose, and stands as true in lines that are part of it.

use super::ExportError;
use crate::model::Unit;
use crate::model::import::json_message;
use crate::run::{Counters, map_chunks};
use crate::view::{Crossing, Frame, LinePiece, LineSource, OutlineOf, Projection, VisibleLines};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

/// The value of the key `format`.
pub(super) const FORMAT: &str = "umriss-drawing/1";

/// The kinds of frame by their names.
pub(super) const ORTHOGRAPHIC: &str = "orthographic";
/// The other kind.
pub(super) const PERSPECTIVE: &str = "perspective";

/// How many lines are written by one piece of work.
const CHUNK: usize = 4096;

/// What a page needs to know of a drawing beside its lines; nothing is what
/// drawings by another hand say.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct DrawingNotes {
    /// The unit of the models.
    pub unit: Option<Unit>,
    /// Whether hidden lines were asked for. Where they were not, there are
    /// none, whatever is hidden.
    pub hidden: Option<bool>,
    /// Whose outer outline was looked for. If none was, no line is one.
    pub outline: Option<OutlineOf>,
    /// Where lines pass in front of others, if that was asked for.
    pub crossings: Option<Vec<Crossing>>,
}

/// The lines as a JSON drawing, in UTF-8.
///
/// # Errors
///
/// If a coordinate is not finite, since JSON cannot say so.
pub fn to_json(lines: &VisibleLines) -> Result<Vec<u8>, ExportError> {
    to_json_with_notes(lines, &DrawingNotes::default())
}

/// The lines and what is to be known of them as a JSON drawing, in UTF-8.
///
/// # Errors
///
/// As [`to_json`].
pub fn to_json_with_notes(
    lines: &VisibleLines,
    notes: &DrawingNotes,
) -> Result<Vec<u8>, ExportError> {
    let mut text = Vec::new();
    text.extend_from_slice(b"{\"format\":\"");
    text.extend_from_slice(FORMAT.as_bytes());
    text.extend_from_slice(b"\",\n\"frame\":");
    push(&mut text, &frame_text(&lines.frame)?)?;
    if let Some(unit) = notes.unit {
        text.extend_from_slice(b",\n\"unit\":");
        push(&mut text, &unit.name())?;
    }
    if let Some(hidden) = notes.hidden {
        text.extend_from_slice(b",\n\"hidden\":");
        push(&mut text, &hidden)?;
    }
    if let Some(of) = notes.outline {
        text.extend_from_slice(b",\n\"outline\":");
        push(&mut text, &of.name())?;
    }
    text.extend_from_slice(b",\n\"objects\":");
    push(&mut text, &lines.objects)?;
    text.extend_from_slice(b",\n\"lines\":[");
    for chunk in map_chunks(lines.pieces.len(), CHUNK, |range| write_lines(lines, range)) {
        text.extend_from_slice(&chunk?);
    }
    if let Some(crossings) = &notes.crossings {
        text.extend_from_slice(b"],\n\"crossings\":[");
        let pairs = |range: Range<usize>| write_crossings(&crossings[range.clone()], range.start);
        for chunk in map_chunks(crossings.len(), CHUNK, pairs) {
            text.extend_from_slice(chunk.as_bytes());
        }
    }
    text.extend_from_slice(b"],\n\"counters\":");
    push(&mut text, &counters(&lines.counters))?;
    text.extend_from_slice(b"}\n");
    Ok(text)
}

/// `[near,far]` by the numbers of the lines, eight in a line of text.
fn write_crossings(crossings: &[Crossing], first: usize) -> String {
    let mut text = String::new();
    for (index, crossing) in crossings.iter().enumerate() {
        let before = match first + index {
            0 => "\n",
            place if place % 8 == 0 => ",\n",
            _ => ",",
        };
        text += &format!("{before}[{},{}]", crossing.near, crossing.far);
    }
    text
}

fn write_lines(lines: &VisibleLines, range: Range<usize>) -> Result<Vec<u8>, ExportError> {
    let mut text = Vec::new();
    for index in range {
        let piece = &lines.pieces[index];
        let finite = piece.points.iter().all(|point| point.is_finite())
            && piece.depth.iter().all(|depth| depth.is_finite());
        if !finite {
            return Err(ExportError::NotFinite { line: index });
        }
        text.extend_from_slice(if index == 0 { b"\n" } else { b",\n" });
        let object = lines.objects.get(piece.object as usize).map_or("", String::as_str);
        push(&mut text, &LineText::new(piece, object))?;
    }
    Ok(text)
}

fn push(text: &mut Vec<u8>, value: &impl Serialize) -> Result<(), ExportError> {
    serde_json::to_writer(text, value).map_err(ExportError::from)
}

fn counters(counters: &Counters) -> BTreeMap<&str, u64> {
    counters.iter().collect()
}

impl From<serde_json::Error> for ExportError {
    fn from(error: serde_json::Error) -> Self {
        let (line, column) = (error.line(), error.column());
        ExportError::Json { line, column, message: json_message(&error, "a JSON drawing") }
    }
}

/// A frame as it stands in the file.
#[derive(Serialize, Deserialize)]
pub(super) struct FrameText<'a> {
    #[serde(borrow)]
    pub(super) kind: Cow<'a, str>,
    pub(super) origin: [f64; 3],
    pub(super) right: [f64; 3],
    pub(super) up: [f64; 3],
    pub(super) forward: [f64; 3],
    #[serde(default, skip_serializing_if = "is_zero")]
    pub(super) shear: [f64; 2],
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) half_height: Option<f64>,
}

/// A line as it stands in the file.
#[derive(Serialize, Deserialize)]
pub(super) struct LineText<'a> {
    #[serde(borrow)]
    pub(super) class: Cow<'a, str>,
    pub(super) visible: bool,
    pub(super) invisibility: u32,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(super) outline: bool,
    pub(super) points: [[f64; 2]; 2],
    pub(super) depth: [f64; 2],
    #[serde(borrow)]
    pub(super) object: Cow<'a, str>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) edge: Option<[u32; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) faces: Option<[u32; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) run: Option<u32>,
}

fn is_zero(shear: &[f64; 2]) -> bool {
    *shear == [0.0; 2]
}

fn frame_text(frame: &Frame) -> Result<FrameText<'static>, ExportError> {
    let kind = match frame.projection {
        Projection::Orthographic => ORTHOGRAPHIC,
        Projection::Perspective => PERSPECTIVE,
    };
    let axes = [frame.origin, frame.right, frame.up, frame.forward];
    if !(axes.iter().all(|axis| axis.is_finite()) && frame.shear.is_finite()) {
        return Err(ExportError::NotFiniteFrame);
    }
    let [origin, right, up, forward] = axes.map(|axis| unsigned_zeros(axis.to_array()));
    let shear = unsigned_zeros(frame.shear.to_array());
    Ok(FrameText {
        kind: kind.into(),
        origin,
        right,
        up,
        forward,
        shear,
        half_height: frame.half_height,
    })
}

impl<'a> LineText<'a> {
    fn new(piece: &LinePiece, object: &'a str) -> Self {
        let (edge, faces) = match piece.source {
            LineSource::Edge(vertices) => (Some(vertices), None),
            LineSource::Faces(faces) => (None, Some(faces)),
        };
        LineText {
            class: piece.class.name().into(),
            visible: piece.is_visible(),
            invisibility: piece.invisibility,
            outline: piece.outline,
            points: piece.points.map(|point| unsigned_zeros(point.to_array())),
            depth: unsigned_zeros(piece.depth),
            object: object.into(),
            edge,
            faces,
            run: Some(piece.run),
        }
    }
}

/// A negative zero says nothing about a drawing; it is written as zero.
fn unsigned_zeros<const N: usize>(numbers: [f64; N]) -> [f64; N] {
    numbers.map(|number| number + 0.0)
}
