//! The A-buffer as a picture.
//!
//! A pixel's list is walked layer by layer. The layer in front are the
//! visible masks of all fragments. Each of them adds its colour by the share
//! of the pixel that it covers and by its opacity; what it lets through is
//! the same pixel again under its mask alone, without itself (Carpenter's
//! recursion, with layers instead of an order of whole fragments, so that it
//! is right for fragments that pass through one another too).

use super::fragments::{Gathered, Piece};
use super::masks;
use super::{ABufferOptions, Fragments, MaskTable, Paint, over_bands};
use crate::fill::{Canvas, Rgba};
use crate::kernel::predicates::Policy;
use crate::model::View;
use crate::raster::samples::{Sampled, Samples};
use crate::run::{Cancelled, Run};
use crate::view::LineQuestion;

/// The picture of a scene: `paint` says how a triangle looks in the pixel of
/// this column and row. Where nothing covers a pixel wholly its opacity is
/// less than full.
///
/// # Errors
///
/// If the run is cancelled.
pub fn preview<P: Policy>(
    view: &View,
    question: &LineQuestion,
    pixels: &Samples,
    options: ABufferOptions,
    paint: &(dyn Fn(u32, [u32; 2]) -> Paint + Sync),
    run: &Run,
) -> Result<Canvas, Cancelled> {
    let division = options.division;
    let samples = pixels.divided(division.columns(), division.rows());
    let table = MaskTable::of(options);
    let bands = over_bands(&samples, division, question, run, |band, above| {
        let sampled = Sampled::new(view, question, band);
        let mut gathered = Gathered::<P>::new(&sampled, division);
        masks::gather(&mut gathered, table.as_ref(), Gathered::insert, run)?;
        let painter = Painter { gathered: &gathered, paint, above };
        let (lists, width) = gathered.pixels();
        let colours = lists
            .iter()
            .zip(0_u32..)
            .map(|(pieces, i)| painter.pixel(pieces, [i % width, i / width]));
        let colours: Vec<Rgba> = colours.collect();
        run.merge(&gathered.judge().counters());
        Ok(colours)
    })?;
    Ok(Canvas::of_pixels(pixels.width(), bands.concat()))
}

/// The covered share of each pixel as a grey picture, black where all of it
/// is covered.
pub fn coverage(fragments: &Fragments) -> Canvas {
    let bits = fragments.division().bits();
    let pixels = (0..fragments.height()).flat_map(|row| {
        (0..fragments.width()).map(move |column| {
            let covered: u32 =
                fragments.of(column, row).iter().map(|fragment| fragment.mask.count_ones()).sum();
            let grey = (255 * (bits - covered) / bits) as u8;
            [grey, grey, grey, 255]
        })
    });
    Canvas::of_pixels(fragments.width(), pixels.collect())
}

struct Painter<'g, 's, P: Policy> {
    gathered: &'g Gathered<'s, P>,
    paint: &'g (dyn Fn(u32, [u32; 2]) -> Paint + Sync),
    above: u32,
}

impl<P: Policy> Painter<'_, '_, P> {
    /// The colour of a pixel of the band.
    fn pixel(&self, pieces: &[Piece], at: [u32; 2]) -> Rgba {
        let full = self.gathered.division().full();
        let [red, green, blue, opacity] = self.layers(pieces, full, at);
        if opacity <= 0.0 {
            return [0; 4];
        }
        // The sums are premultiplied.
        let byte = |x: f32| (x * 255.0).round().clamp(0.0, 255.0) as u8;
        [byte(red / opacity), byte(green / opacity), byte(blue / opacity), byte(opacity)]
    }

    /// Colour and opacity of what is under a mask, each times the share of
    /// the pixel.
    fn layers(&self, pieces: &[Piece], mask: u32, at: [u32; 2]) -> [f32; 4] {
        let mut front: Vec<Piece> = Vec::new();
        for piece in pieces.iter().filter(|piece| piece.mask & mask != 0) {
            let part = Piece { mask: piece.mask & mask, ..*piece };
            self.gathered.cover(&mut front, at, part);
        }
        let bits = self.gathered.division().bits() as f32;
        let mut sum = [0.0; 4];
        for piece in front {
            let triangle = self.gathered.face(piece.face).triangle;
            let paint = (self.paint)(triangle, [at[0], at[1] + self.above]);
            let share = piece.mask.count_ones() as f32 / bits * paint.opacity;
            let [red, green, blue] = paint.colour;
            let mut add = |colour: [f32; 4], factor: f32| {
                for (sum, part) in sum.iter_mut().zip(colour) {
                    *sum += part * factor;
                }
            };
            add([red, green, blue, 1.0], share);
            if paint.opacity < 1.0 {
                let others: Vec<Piece> =
                    pieces.iter().filter(|other| other.face != piece.face).copied().collect();
                add(self.layers(&others, piece.mask, at), 1.0 - paint.opacity);
            }
        }
        sum
    }
}
