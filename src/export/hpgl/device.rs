//! What a plotter is: its unit, its pens, its sheets and how far it reaches.

use crate::drawing::Speeds;

/// A pen plotter.
#[derive(Debug, Clone, PartialEq)]
pub struct Device {
    /// The name in flags and files.
    pub id: String,
    /// The name in messages.
    pub name: String,
    /// Millimetres in one plotter unit.
    pub unit: f64,
    /// How many pens it takes.
    pub pens: u32,
    /// The slowest and the fastest drawing it can be told, cm/s. Nothing for
    /// a device that is not known.
    pub velocity: Option<[f64; 2]>,
    /// How fast it moves unless it is told otherwise.
    pub speeds: Speeds,
    /// The sheets it takes; none stands for any page, drawn from its lower
    /// left corner.
    pub papers: Vec<DevicePaper>,
}

/// A sheet in a plotter.
#[derive(Debug, Clone, PartialEq)]
pub struct DevicePaper {
    /// The name in messages.
    pub name: String,
    /// Width and height as it lies in the device, mm; x runs along the width.
    pub size: [f64; 2],
    /// The hard-clip limits along x, plotter units.
    pub x: [i32; 2],
    /// The hard-clip limits along y, plotter units.
    pub y: [i32; 2],
    /// Where the unit 0,0 is: mm from the left and from the upper border.
    pub origin: [f64; 2],
    /// Whether the sheet is drawn upside down.
    pub turned: bool,
    /// The number that the instruction `PS` wants, if it is to be sent.
    pub select: Option<u8>,
}

impl Device {
    /// Any plotter: 0.025 mm, eight pens, a page of up to 819 mm that is drawn
    /// from its lower left corner.
    pub fn generic() -> Self {
        Device {
            id: "generic".to_owned(),
            name: "generic plotter".to_owned(),
            unit: super::PLOTTER_UNIT,
            pens: 8,
            velocity: None,
            speeds: Speeds::default(),
            papers: Vec::new(),
        }
    }
}
