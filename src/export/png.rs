//! A picture of a drawing, for looking at.
//!
//! The SVG is rendered as it stands, so the picture shows what the file says
//! and proves that it can be read.

use super::ExportError;
use crate::model::Color as PixelColor;
use resvg::tiny_skia::{Color, Pixmap, PremultipliedColorU8, Transform};
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

/// An image as a PNG file, given its pixels row by row from the top.
///
/// # Errors
///
/// If the size is out of range or there are not as many pixels.
pub fn pixels_to_png(
    [width, height]: [u32; 2],
    pixels: &[PixelColor],
) -> Result<Vec<u8>, ExportError> {
    let refuse = || ExportError::PictureSize { width, height };
    if LONGEST < width
        || LONGEST < height
        || pixels.len() as u64 != u64::from(width) * u64::from(height)
    {
        return Err(refuse());
    }
    let mut picture = Pixmap::new(width, height).ok_or_else(refuse)?;
    for (pixel, PixelColor([red, green, blue])) in picture.pixels_mut().iter_mut().zip(pixels) {
        // An opaque colour is premultiplied as it is.
        *pixel =
            PremultipliedColorU8::from_rgba(*red, *green, *blue, u8::MAX).ok_or_else(refuse)?;
    }
    picture.encode_png().map_err(|error| ExportError::Picture(error.to_string()))
}
