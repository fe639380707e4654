//! Item buffers as pictures, to be looked at.
//!
//! Colours decide nothing: they are made of what a buffer says after all
//! that was to be decided has been.

use super::{ItemBuffer, Stop, Window};
use crate::model::{Color, Frame, Mesh};

/// Where no triangle is.
const PAPER: Color = Color([255, 255, 255]);

/// What a picture of a buffer shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Show {
    /// A colour for each face.
    Face,
    /// Near is dark, far is light.
    Depth,
    /// Faces lit from behind the viewer's left shoulder.
    Shade,
}

impl Show {
    /// All of them.
    pub const ALL: [Show; 3] = [Show::Face, Show::Depth, Show::Shade];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Show::Face => "face",
            Show::Depth => "depth",
            Show::Shade => "shade",
        }
    }

    /// The colours of a buffer, row by row from the top.
    pub fn colors(self, mesh: &Mesh, frame: &Frame, buffer: &ItemBuffer) -> Vec<Color> {
        let color: Box<dyn Fn(u32, u32, u32) -> Color> = match self {
            Show::Face => Box::new(|triangle, _, _| face_color(mesh.face_of(triangle))),
            Show::Depth => {
                let (near, far) = depths(buffer);
                Box::new(move |_, column, row| {
                    let share = (buffer.depth(column, row) - near) / (far - near);
                    grey(30.0 + 200.0 * if share.is_finite() { share } else { 0.0 })
                })
            }
            Show::Shade => Box::new(|triangle, _, _| shade(mesh, frame, triangle)),
        };
        let pixels =
            (0..buffer.height()).flat_map(|row| (0..buffer.width()).map(move |c| (c, row)));
        pixels
            .map(|(column, row)| {
                buffer.item(column, row).map_or(PAPER, |triangle| color(triangle, column, row))
            })
            .collect()
    }
}

impl Stop {
    /// The colour in which windows of this kind are drawn.
    pub fn color(self) -> Color {
        Color(match self {
            Stop::Empty => [255, 255, 255],
            Stop::Single => [190, 214, 240],
            Stop::Surrounded => [196, 228, 188],
            Stop::Sample => [40, 40, 40],
        })
    }
}

impl Window {
    /// Left, top, width and height in samples.
    pub fn rectangle(&self) -> [u32; 4] {
        let ([left, right], [top, bottom]) = (self.samples.columns, self.samples.rows);
        [left, top, right - left + 1, bottom - top + 1]
    }
}

/// Hues a golden section apart, so that neighbours differ.
fn face_color(face: u32) -> Color {
    let hue = (f64::from(face) * 0.618_033_988_749_895).fract() * 6.0;
    let channel = |offset: f64| {
        let distance = ((hue + offset).rem_euclid(6.0) - 3.0).abs();
        (90.0 + 140.0 * (distance - 1.0).clamp(0.0, 1.0)) as u8
    };
    Color([channel(0.0), channel(4.0), channel(2.0)])
}

/// The least and the greatest depth in a buffer.
fn depths(buffer: &ItemBuffer) -> (f64, f64) {
    let pixels = (0..buffer.height()).flat_map(|row| (0..buffer.width()).map(move |c| (c, row)));
    pixels
        .map(|(column, row)| buffer.depth(column, row))
        .filter(|depth| depth.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(near, far), d| (near.min(d), far.max(d)))
}

fn shade(mesh: &Mesh, frame: &Frame, triangle: u32) -> Color {
    let [a, b, c] = mesh.triangles()[triangle as usize].map(|v| mesh.vertices()[v as usize]);
    let normal = (b - a).cross(c - a).normalize_or_zero();
    // Both sides are lit: nothing says which one is the outer one.
    let normal = if normal.dot(frame.forward) > 0.0 { -normal } else { normal };
    let light = (frame.up * 0.6 - frame.right * 0.5 - frame.forward).normalize();
    let strength = 0.25 + 0.75 * normal.dot(light).max(0.0);
    let Color(base) = mesh.color_of(mesh.face_of(triangle)).unwrap_or(Color([225; 3]));
    Color(base.map(|channel| (f64::from(channel) * strength) as u8))
}

fn grey(value: f64) -> Color {
    Color([value as u8; 3])
}
