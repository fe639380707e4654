//! A picture of a drawing, for looking at.
//!
//! The SVG is rendered as it stands, so the picture shows what the file says
//! and proves that it can be read.

use super::ExportError;
use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{Options, Tree};

/// Width of a preview in pixels unless another is asked for.
pub const PREVIEW_WIDTH: u32 = 1600;

/// The longest side of a picture in pixels.
const LONGEST: u32 = 32767;

/// Renders an SVG document on white paper, `width` pixels wide, as a PNG file.
pub fn to_png(svg: &str, width: u32) -> Result<Vec<u8>, ExportError> {
    let broken = |error: &dyn std::fmt::Display| ExportError::Picture(error.to_string());
    let tree = Tree::from_str(svg, &Options::default()).map_err(|error| broken(&error))?;
    let size = tree.size();
    let scale = width as f32 / size.width();
    let height = (size.height() * scale).round().max(1.0) as u32;
    let refuse = || ExportError::PictureSize { width, height };
    if LONGEST < width || LONGEST < height {
        return Err(refuse());
    }
    let mut picture = Pixmap::new(width, height).ok_or_else(refuse)?;
    picture.fill(Color::WHITE);
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut picture.as_mut());
    picture.encode_png().map_err(|error| broken(&error))
}
