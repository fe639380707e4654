//! What is added to an image when it is done: colours poured over areas, and
//! a caption.

use crate::failure::Failure;
use crate::input::read_settings;
use clap::Args;
use glam::DVec2;
use std::path::PathBuf;
use umriss::fill::{Canvas, Connected, Font, flood};
use umriss::model::Color;

/// Pixels between a caption and the borders of the image.
const MARGIN: f64 = 8.0;

#[derive(Args)]
pub(crate) struct FinishFlags {
    /// Pour a colour over all that is connected with a pixel and of its colour; columns and rows
    /// count from 0 at the upper left. More than once if wanted
    #[arg(long, value_name = "COLUMN,ROW,#RRGGBB", value_parser = parse_flood)]
    flood: Vec<Flood>,
    /// What connects pixels for --flood: sides, or corners too
    #[arg(long, value_name = "WHAT", default_value = "sides", value_parser = ["sides", "corners"])]
    connected: String,
    /// Write this below, at the left
    #[arg(long, value_name = "TEXT", requires = "font")]
    caption: Option<String>,
    /// Font file of the caption: TrueType or OpenType
    #[arg(long, value_name = "FILE", requires = "caption")]
    pub(crate) font: Option<PathBuf>,
    /// Pixels to the em of the caption
    #[arg(long, value_name = "PIXELS", default_value_t = 16.0, value_parser = parse_size)]
    caption_size: f64,
}

/// A colour and where it is poured.
#[derive(Debug, Clone, Copy)]
struct Flood {
    at: [u32; 2],
    color: Color,
}

impl FinishFlags {
    /// Refuses what does not go with an image of this size.
    pub(crate) fn check(&self, size: [u32; 2]) -> Result<(), Failure> {
        match self.flood.iter().find(|flood| (0..2).any(|i| size[i] <= flood.at[i])) {
            None => Ok(()),
            Some(Flood { at: [column, row], .. }) => Err(Failure::usage(format!(
                "--flood {column},{row}: expected a pixel of an image of {} x {}",
                size[0], size[1]
            ))),
        }
    }

    /// Adds what the flags ask for.
    pub(crate) fn apply(
        &self,
        size @ [width, _]: [u32; 2],
        mut pixels: Vec<Color>,
    ) -> Result<Vec<Color>, Failure> {
        let connected = match self.connected.as_str() {
            "corners" => Connected::ByCorners,
            _ => Connected::BySides,
        };
        for &Flood { at, color } in &self.flood {
            flood(&mut pixels, width, at, color, connected);
        }
        match (&self.caption, &self.font) {
            (Some(caption), Some(path)) => {
                let name = path.display();
                let bytes = read_settings(path)
                    .map_err(|error| Failure::failed(format!("{name}: {error}")))?;
                let font = Font::new(&bytes)
                    .map_err(|error| Failure::failed(format!("{name}: {error}")))?;
                Ok(self.write(&font, caption, size, &pixels))
            }
            _ => Ok(pixels),
        }
    }

    fn write(&self, font: &Font, text: &str, size: [u32; 2], pixels: &[Color]) -> Vec<Color> {
        let [width, height] = size;
        let opaque = pixels.iter().map(|&Color([red, green, blue])| [red, green, blue, 255]);
        let mut canvas = Canvas::of_pixels(width, opaque.collect());
        let at = DVec2::new(MARGIN, f64::from(height) - MARGIN);
        font.write(&mut canvas, text, self.caption_size, at, [0, 0, 0, 255]);
        canvas.pixels().iter().map(|&[red, green, blue, _]| Color([red, green, blue])).collect()
    }
}

fn parse_flood(text: &str) -> Result<Flood, String> {
    let parsed = || {
        let mut parts = text.split(',');
        let [column, row, color] = [parts.next()?, parts.next()?, parts.next()?];
        let digits = color.strip_prefix('#').filter(|digits| digits.len() == 6)?;
        let [_, red, green, blue] = u32::from_str_radix(digits, 16).ok()?.to_be_bytes();
        let at = [column.parse().ok()?, row.parse().ok()?];
        parts.next().is_none().then_some(Flood { at, color: Color([red, green, blue]) })
    };
    parsed().ok_or_else(|| "expected a column, a row and a colour like 10,20,#ffeecc".to_owned())
}

fn parse_size(text: &str) -> Result<f64, String> {
    let size = text.parse().ok().filter(|size: &f64| (1.0..=1024.0).contains(size));
    size.ok_or_else(|| "expected a number from 1 to 1024".to_owned())
}
