//! HPGL for pen plotters of every make.
//!
//! Only the instructions that all of them know: `IN` (begin), `PS` (which
//! paper, where the device's table asks for it), `VS` (speed, on request), `SP`
//! (take a pen), `PU` (go with the pen up), `PD` (go with the pen down), `PA`
//! and `PR` (absolute and relative numbers). No scaling and no line types:
//! their meaning differs from one device to the next.
//!
//! - A [`Device`] says how large a unit is, where its origin lies on each
//!   sheet, how far it reaches there and how many pens it has; `table` reads
//!   devices from a file. `sheet` brings the page to it.
//! - Numbers are integers. Relative ones are differences of rounded ones, so
//!   that nothing adds up on the way.
//! - What leaves the hard-clip limits is refused, for a plotter would draw
//!   along its limits instead; [`plotter_window`] says what to cut it to.
//! - Layer n takes pen n; after the last pen comes pen 1 again.
//! - An instruction is at most 240 characters long, for plotters with small
//!   buffers tear longer ones apart. A longer stroke goes on with another
//!   `PD` from where the pen stands.
//! - Every instruction stands on a line of its own, which some devices want
//!   and all accept.

mod device;
mod sheet;
#[cfg(feature = "devices")]
mod table;

use super::ExportError;
use crate::drawing::{Drawing, Layer, Window};
use crate::run::map_chunks;
pub use device::{Device, DevicePaper};
use glam::DVec2;
use sheet::Sheet;
#[cfg(feature = "devices")]
pub use table::devices;

/// Millimetres in one plotter unit of the generic device.
pub const PLOTTER_UNIT: f64 = 0.025;

/// How far polylines may be from the curves they stand for, plotter units.
const FLATNESS: f64 = 0.2;

/// How many characters an instruction may have, its semicolon included.
const LONGEST: usize = 240;

/// How many strokes are written by one piece of work.
const CHUNK: usize = 4096;

/// How HPGL is written.
#[derive(Debug, Clone, PartialEq)]
pub struct HpglOptions {
    /// The plotter.
    pub device: Device,
    /// Differences instead of places, which are shorter.
    pub relative: bool,
    /// The speed to draw with, cm/s; the device's own unless it is given.
    pub velocity: Option<f64>,
}

/// The generic device, absolute, at its own speed.
impl Default for HpglOptions {
    fn default() -> Self {
        HpglOptions { device: Device::generic(), relative: false, velocity: None }
    }
}

/// The drawing as instructions for the generic plotter.
///
/// # Errors
///
/// As [`to_hpgl_with`].
pub fn to_hpgl(drawing: &Drawing) -> Result<String, ExportError> {
    to_hpgl_with(drawing, &HpglOptions::default())
}

/// The drawing as instructions for a plotter.
///
/// Points are rounded to units, ties to even; moves of no length are left
/// out, and with them strokes that become a single point.
///
/// # Errors
///
/// If the device has no sheet of the page's size, or does not reach a stroke,
/// or cannot draw at the speed asked for.
pub fn to_hpgl_with(drawing: &Drawing, options: &HpglOptions) -> Result<String, ExportError> {
    if !drawing.painting.is_empty() {
        return Err(ExportError::Painted("HPGL"));
    }
    let drawing = &drawing.flat(FLATNESS * options.device.unit);
    let device = &options.device;
    let sheet = Sheet::new(device, drawing.size)?;
    check_reach(drawing, device, &sheet)?;
    let mut text = String::from("IN;\n");
    if let Some(velocity) = options.velocity {
        check_velocity(device, velocity)?;
        text.push_str(&format!("VS{velocity};\n"));
    }
    if let Some(select) = sheet.select {
        text.push_str(&format!("PS{select};\n"));
    }
    for (index, layer) in drawing.layers.iter().enumerate() {
        if 0 < index {
            text.push_str("PU;\n");
        }
        text.push_str(&format!("SP{};\n", 1 + layer.number.saturating_sub(1) % device.pens));
        write_layer(layer, &sheet, options.relative).iter().for_each(|chunk| text.push_str(chunk));
    }
    text.push_str("PU;\nSP0;\n");
    Ok(text)
}

/// What a plotter reaches of a page of this size, mm; nothing if it has no
/// such sheet.
pub fn plotter_window(device: &Device, page: DVec2) -> Option<Window> {
    Sheet::new(device, page).ok()?.window()
}

fn check_velocity(device: &Device, velocity: f64) -> Result<(), ExportError> {
    let [low, high] = device.velocity.unwrap_or([0.01, 1000.0]);
    if (low..=high).contains(&velocity) {
        return Ok(());
    }
    Err(ExportError::PlotterVelocity { device: device.name.clone(), velocity, low, high })
}

/// Refuses a drawing that the plotter does not reach.
fn check_reach(drawing: &Drawing, device: &Device, sheet: &Sheet) -> Result<(), ExportError> {
    let points = || drawing.layers.iter().flat_map(|layer| layer.strokes.iter().flatten());
    let Some(outside) = points().find(|point| !sheet.reaches(sheet.units(**point))) else {
        return Ok(());
    };
    let (Some(paper), Some(window)) = (&sheet.paper, sheet.window()) else {
        return Err(ExportError::OutsidePage { x: outside.x, y: outside.y });
    };
    let (low, high) = points()
        .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), point| {
            (low.min(*point), high.max(*point))
        });
    Err(ExportError::PlotterLimits(Box::new(super::error::Reach {
        device: device.name.clone(),
        paper: paper.clone(),
        x: [sheet.low.x, sheet.high.x],
        y: [sheet.low.y, sheet.high.y],
        from: window.low().to_array(),
        to: window.high().to_array(),
        drawn_from: low.to_array(),
        drawn_to: high.to_array(),
    })))
}

/// The strokes of a layer, chunk by chunk.
fn write_layer(layer: &Layer, sheet: &Sheet, relative: bool) -> Vec<String> {
    map_chunks(layer.strokes.len(), CHUNK, |range| {
        let mut text = String::new();
        let mut units = Vec::new();
        for index in range {
            units.clear();
            units.extend(layer.strokes.get(index).iter().map(|point| {
                let units = sheet.units(*point);
                [units.x as i32, units.y as i32]
            }));
            units.dedup();
            push_stroke(&mut text, &units, relative);
        }
        text
    })
}

/// `PU0,0;` and `PD10,0,10,5;`, as many of the latter as are needed. Relative
/// strokes stand between `PR` and `PA`.
fn push_stroke(text: &mut String, units: &[[i32; 2]], relative: bool) {
    let [first, _, ..] = units else {
        return;
    };
    text.push_str(&format!("PU{},{};\n", first[0], first[1]));
    if relative {
        text.push_str("PR;\n");
    }
    let mut instruction = String::from("PD");
    for [[x0, y0], [x, y]] in units.array_windows() {
        let point = if relative { format!("{},{}", x - x0, y - y0) } else { format!("{x},{y}") };
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
    text.push_str(if relative { ";\nPA;\n" } else { ";\n" });
}
