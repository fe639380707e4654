//! Letters as outlines of a font file.
//!
//! TrueType and OpenType outlines, one after the other by their advances,
//! filled by the winding rule. No hinting, no kerning, one line: a caption.
//! There is no font in this package; whoever wants a caption names a file.

use super::canvas::{Canvas, Rgba};
use super::outline::Outline;
use super::polygon::Rule;
use glam::DVec2;
use ttf_parser::{Face, OutlineBuilder};

/// How far a letter may be from its curves, pixels.
const TOLERANCE: f64 = 1.0 / 16.0;

/// A font that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FontError {
    /// It is no font, or a broken one.
    #[error("the font cannot be read: {0}")]
    Broken(String),
}

/// The outlines of a font file.
#[derive(Clone)]
pub struct Font<'d> {
    face: Face<'d>,
}

impl std::fmt::Debug for Font<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Font({} glyphs)", self.face.number_of_glyphs())
    }
}

impl<'d> Font<'d> {
    /// The first font of a file.
    ///
    /// # Errors
    ///
    /// If the bytes are no font.
    pub fn new(bytes: &'d [u8]) -> Result<Self, FontError> {
        let face = Face::parse(bytes, 0).map_err(|error| FontError::Broken(error.to_string()))?;
        Ok(Font { face })
    }

    /// The outline of a line of text, `size` units to the em, with its base
    /// line starting at `at`, y downwards; characters that the font has not
    /// are drawn as it draws such. Returns the outline and the end of the
    /// base line.
    pub fn outline(&self, text: &str, size: f64, at: DVec2, tolerance: f64) -> (Outline, DVec2) {
        let scale = size / f64::from(self.face.units_per_em().max(1));
        let mut pen = Pen { outline: Outline::new(tolerance), at, scale };
        for character in text.chars() {
            let glyph = self.face.glyph_index(character).unwrap_or_default();
            self.face.outline_glyph(glyph, &mut pen);
            let advance = self.face.glyph_hor_advance(glyph).unwrap_or(0);
            pen.at.x += f64::from(advance) * scale;
        }
        (pen.outline, pen.at)
    }

    /// Writes a line of text on a canvas; sizes and places in pixels.
    /// Returns the end of its base line.
    pub fn write(&self, canvas: &mut Canvas, text: &str, size: f64, at: DVec2, ink: Rgba) -> DVec2 {
        let (outline, end) = self.outline(text, size, at, TOLERANCE);
        canvas.paint(outline.contours(), Rule::Winding, ink);
        end
    }

    /// All outlines of the font, `size` units to the em, from the origin.
    pub fn glyphs(&self, size: f64, tolerance: f64) -> impl Iterator<Item = Outline> + '_ {
        let scale = size / f64::from(self.face.units_per_em().max(1));
        (0..self.face.number_of_glyphs()).map(move |glyph| {
            let at = DVec2::new(0.0, size);
            let mut pen = Pen { outline: Outline::new(tolerance), at, scale };
            self.face.outline_glyph(ttf_parser::GlyphId(glyph), &mut pen);
            pen.outline
        })
    }
}

/// Puts the curves of a font, y upwards, onto the page.
struct Pen {
    outline: Outline,
    at: DVec2,
    scale: f64,
}

impl Pen {
    fn place(&self, x: f32, y: f32) -> DVec2 {
        self.at + DVec2::new(f64::from(x), -f64::from(y)) * self.scale
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.outline.move_to(self.place(x, y));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.outline.line_to(self.place(x, y));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.outline.quadratic_to(self.place(x1, y1), self.place(x, y));
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.outline.cubic_to(self.place(x1, y1), self.place(x2, y2), self.place(x, y));
    }

    fn close(&mut self) {}
}
