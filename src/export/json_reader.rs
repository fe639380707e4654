//! Reads JSON drawings back, so that a computed drawing can be put on another
//! page in another style.
//!
//! Keys that are not known are passed over. What a drawing by another hand
//! may lack is made up for: without `run` in every line, every line is a
//! straight line of its own; without `objects`, the names count in the order
//! in which lines have them.

use super::ExportError;
use super::json::{DrawingNotes, FORMAT, FrameText, LineText, ORTHOGRAPHIC, PERSPECTIVE};
use crate::model::Unit;
use crate::run::Counters;
use crate::view::{
    Crossing, Frame, LineClass, LinePiece, LineSource, OutlineOf, Projection, VisibleLines,
};
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
use serde::Deserialize;
use std::collections::BTreeMap;

/// Reads a JSON drawing.
///
/// Objects with the same name become one: lines know their object by name.
///
/// # Errors
///
/// Names the place in the text if it is no JSON or lacks something, and the
/// line of the drawing if that contradicts itself.
pub fn read_drawing(bytes: &[u8]) -> Result<VisibleLines, ExportError> {
    read_drawing_with_notes(bytes).map(|(lines, _)| lines)
}

/// Reads a JSON drawing and what it says beside its lines.
///
/// # Errors
///
/// As [`read_drawing`].
pub fn read_drawing_with_notes(bytes: &[u8]) -> Result<(VisibleLines, DrawingNotes), ExportError> {
    // The format is looked at first: of another version nothing else may fit.
    let Header { format } = serde_json::from_slice(bytes)?;
    if format != FORMAT {
        return Err(ExportError::DrawingFormat(format));
    }
    let text: DrawingText = serde_json::from_slice(bytes)?;
    let frame = read_frame(&text.frame)?;
    let crossings = text.crossings.map(|pairs| read_crossings(&pairs, text.lines.len()));
    let notes = DrawingNotes {
        unit: read_unit(text.unit)?,
        hidden: text.hidden,
        outline: read_outline(text.outline)?,
        crossings: crossings.transpose()?,
    };
    let mut objects = Objects::new(text.objects);
    let has_runs = text.lines.iter().all(|line| line.run.is_some());
    let mut pieces = Vec::with_capacity(text.lines.len());
    for (index, line) in text.lines.iter().enumerate() {
        let run = line.run.filter(|_| has_runs).unwrap_or(index as u32);
        let object = objects.find(&line.object);
        let piece = read_line(line, object, run);
        pieces.push(piece.map_err(|message| ExportError::Line { index, message })?);
    }
    let mut counters = Counters::default();
    for (name, amount) in text.counters {
        counters.add(name, amount);
    }
    Ok((VisibleLines { frame, objects: objects.names, pieces, counters }, notes))
}

#[derive(Deserialize)]
struct Header {
    format: String,
}

#[derive(Deserialize)]
struct DrawingText<'a> {
    #[serde(borrow)]
    frame: FrameText<'a>,
    unit: Option<&'a str>,
    hidden: Option<bool>,
    outline: Option<&'a str>,
    #[serde(default)]
    objects: Vec<String>,
    #[serde(borrow)]
    lines: Vec<LineText<'a>>,
    crossings: Option<Vec<[u32; 2]>>,
    #[serde(default)]
    counters: BTreeMap<String, u64>,
}

/// The objects so far; the first of a name stands for all of it.
struct Objects {
    names: Vec<String>,
    known: FxHashMap<String, u32>,
}

impl Objects {
    fn new(names: Vec<String>) -> Self {
        let mut known = FxHashMap::default();
        for (index, name) in names.iter().enumerate() {
            known.entry(name.clone()).or_insert(index as u32);
        }
        Objects { names, known }
    }

    fn find(&mut self, name: &str) -> u32 {
        if let Some(index) = self.known.get(name) {
            return *index;
        }
        let index = self.names.len() as u32;
        self.names.push(name.to_owned());
        self.known.insert(name.to_owned(), index);
        index
    }
}

fn read_crossings(pairs: &[[u32; 2]], lines: usize) -> Result<Vec<Crossing>, ExportError> {
    let read = |(index, &[near, far]): (usize, &[u32; 2])| {
        let known = (near as usize) < lines && (far as usize) < lines && near != far;
        known.then_some(Crossing { near, far }).ok_or(ExportError::Crossing { index, lines })
    };
    pairs.iter().enumerate().map(read).collect()
}

fn read_unit(name: Option<&str>) -> Result<Option<Unit>, ExportError> {
    let unit = |name: &str| Unit::from_name(name).ok_or_else(|| ExportError::Unit(name.to_owned()));
    name.map(unit).transpose()
}

fn read_outline(name: Option<&str>) -> Result<Option<OutlineOf>, ExportError> {
    let of = |name: &str| {
        OutlineOf::from_name(name).ok_or_else(|| ExportError::Outline(name.to_owned()))
    };
    name.map(of).transpose()
}

fn read_frame(text: &FrameText) -> Result<Frame, ExportError> {
    let projection = match &*text.kind {
        ORTHOGRAPHIC => Projection::Orthographic,
        PERSPECTIVE => Projection::Perspective,
        other => return Err(ExportError::FrameKind(other.to_owned())),
    };
    Ok(Frame {
        projection,
        origin: DVec3::from_array(text.origin),
        right: DVec3::from_array(text.right),
        up: DVec3::from_array(text.up),
        forward: DVec3::from_array(text.forward),
        shear: DVec2::from_array(text.shear),
        half_height: text.half_height,
    })
}

fn read_line(text: &LineText, object: u32, run: u32) -> Result<LinePiece, &'static str> {
    let class = LineClass::from_name(&text.class).ok_or(
        "unknown `class`; expected contour, boundary, non-manifold, crease, intersection, line \
         or mesh",
    )?;
    if text.visible != (text.invisibility == 0) {
        return Err("`visible` contradicts `invisibility`; expected visible where it is 0");
    }
    if text.outline && !text.visible {
        return Err("a hidden line is part of no `outline`; expected visible, or no outline");
    }
    let source = match (text.edge, text.faces) {
        (Some(vertices), None) => LineSource::Edge(vertices),
        (None, Some(faces)) => LineSource::Faces(faces),
        _ => return Err("expected either `edge` or `faces`"),
    };
    Ok(LinePiece {
        class,
        invisibility: text.invisibility,
        outline: text.outline,
        points: text.points.map(DVec2::from_array),
        depth: text.depth,
        object,
        source,
        run,
    })
}
