//! HPGL for pen plotters of every make.
//!
//! Only the instructions that all of them know: `IN` (begin), `SP` (take a
//! pen), `PU` (go with the pen up), `PD` (go with the pen down). No scaling,
//! no line types, no paper: their meaning differs from one device to the next.
//!
//! - One unit is 0.025 mm; numbers are integers that fit 16 bits; y runs
//!   upwards from the lower left corner of the page.
//! - Layer n takes pen n; after pen 8 comes pen 1 again.
//! - An instruction is at most 240 characters long, for plotters with small
//!   buffers tear longer ones apart. A longer stroke goes on with another
//!   `PD` from where the pen stands.
//! - Every instruction stands on a line of its own, which some devices want
//!   and all accept.

use super::ExportError;
use crate::drawing::{Drawing, Layer};
use crate::run::map_chunks;
use glam::DVec2;

/// Millimetres in one plotter unit.
pub const PLOTTER_UNIT: f64 = 0.025;

/// Plotter units in one millimetre.
const UNITS_PER_MM: f64 = 40.0;

/// The largest coordinate of a 16-bit plotter.
const LARGEST: f64 = 32767.0;

/// How many characters an instruction may have, its semicolon included.
const LONGEST: usize = 240;

/// Pens of a carousel.
const PENS: u32 = 8;

/// How many strokes are written by one piece of work.
const CHUNK: usize = 4096;

/// The drawing as plotter instructions.
///
/// Points are rounded to units, ties to even; moves of no length are left
/// out, and with them strokes that become a single point.
///
/// # Errors
///
/// If a side of the page has more than 32767 units (819 mm), or a stroke
/// leaves the page.
pub fn to_hpgl(drawing: &Drawing) -> Result<String, ExportError> {
    let limit = (drawing.size * UNITS_PER_MM).round();
    if !limit.is_finite() || LARGEST < limit.max_element() {
        return Err(ExportError::PlotterRange {
            width: drawing.size.x,
            height: drawing.size.y,
            units: limit.max_element(),
        });
    }
    let mut text = String::from("IN;\n");
    for (index, layer) in drawing.layers.iter().enumerate() {
        if 0 < index {
            text.push_str("PU;\n");
        }
        text.push_str(&format!("SP{};\n", 1 + layer.number.saturating_sub(1) % PENS));
        for chunk in write_layer(layer, drawing.size.y, limit) {
            text.push_str(&chunk?);
        }
    }
    text.push_str("PU;\nSP0;\n");
    Ok(text)
}

/// The strokes of a layer, chunk by chunk.
fn write_layer(layer: &Layer, height: f64, limit: DVec2) -> Vec<Result<String, ExportError>> {
    map_chunks(layer.strokes.len(), CHUNK, |range| {
        let mut text = String::new();
        let mut units = Vec::new();
        for index in range {
            units.clear();
            for point in layer.strokes.get(index) {
                units.push(to_units(*point, height, limit)?);
            }
            units.dedup();
            push_stroke(&mut text, &units);
        }
        Ok(text)
    })
}

fn to_units(point: DVec2, height: f64, limit: DVec2) -> Result<[i32; 2], ExportError> {
    let unit = |millimetres: f64| (millimetres * UNITS_PER_MM).round_ties_even();
    let (x, y) = (unit(point.x), unit(height - point.y));
    if 0.0 <= x && x <= limit.x && 0.0 <= y && y <= limit.y {
        Ok([x as i32, y as i32])
    } else {
        Err(ExportError::OutsidePage { x: point.x, y: point.y })
    }
}

/// `PU0,0;` and `PD10,0,10,5;`, as many of the latter as are needed.
fn push_stroke(text: &mut String, units: &[[i32; 2]]) {
    let [first, rest @ ..] = units else {
        return;
    };
    if rest.is_empty() {
        return;
    }
    text.push_str(&format!("PU{},{};\n", first[0], first[1]));
    let mut instruction = String::from("PD");
    for [x, y] in rest {
        let point = format!("{x},{y}");
        // One character for the comma, one for the semicolon.
        if LONGEST < instruction.len() + point.len() + 2 {
            text.push_str(&instruction);
            text.push_str(";\n");
            instruction.truncate("PD".len());
        }
        if "PD".len() < instruction.len() {
            instruction.push(',');
        }
        instruction.push_str(&point);
    }
    text.push_str(&instruction);
    text.push_str(";\n");
}
