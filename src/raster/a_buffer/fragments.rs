//! Lists of fragments, and which of them are seen.

use super::Division;
use super::block::bits;
use crate::kernel::predicates::Policy;
use crate::raster::samples::{Face, Judge, Sampled, Samples};
use crate::run::Run;

/// Sub-pixels of one pixel that belong to one triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fragment {
    /// The triangle of the mesh.
    pub triangle: u32,
    /// Its sub-pixels: the bit of column i and row j is `4 j + i`.
    pub mask: u32,
}

/// The visible fragments of all pixels of an image. Masks of one pixel are
/// apart from one another.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fragments {
    division: Division,
    width: u32,
    height: u32,
    ends: Vec<usize>,
    fragments: Vec<Fragment>,
}

impl Fragments {
    /// Bands of pixels, the upper ones first, as one image.
    pub(super) fn stacked(
        division: Division,
        samples: &Samples,
        bands: Vec<Vec<Vec<Fragment>>>,
    ) -> Self {
        let (mut ends, mut fragments) = (Vec::new(), Vec::new());
        for pixel in bands.into_iter().flatten() {
            fragments.extend(pixel);
            ends.push(fragments.len());
        }
        Fragments {
            division,
            width: samples.width().div_ceil(division.columns()),
            height: samples.height().div_ceil(division.rows()),
            ends,
            fragments,
        }
    }

    /// How the pixels are divided.
    pub fn division(&self) -> Division {
        self.division
    }

    /// Columns.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The fragments of a pixel, in no particular order; none beside the
    /// image.
    pub fn of(&self, column: u32, row: u32) -> &[Fragment] {
        if self.width <= column || self.height <= row {
            return &[];
        }
        let index = row as usize * self.width as usize + column as usize;
        let start = if index == 0 { 0 } else { self.ends[index - 1] };
        &self.fragments[start..self.ends[index]]
    }
}

/// A fragment of a face of a band.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub(super) face: u32,
    pub(super) mask: u32,
}

/// The fragments of a band of pixels, as they come in.
pub(super) struct Gathered<'s, P: Policy> {
    sampled: &'s Sampled<'s>,
    judge: Judge<'s, P>,
    division: Division,
    width: u32,
    faces: Vec<Face>,
    pixels: Vec<Vec<Piece>>,
}

impl<'s, P: Policy> Gathered<'s, P> {
    pub(super) fn new(sampled: &'s Sampled<'s>, division: Division) -> Self {
        let samples = sampled.samples();
        let width = samples.width().div_ceil(division.columns());
        let height = samples.height().div_ceil(division.rows());
        let pixels = vec![Vec::new(); width as usize * height as usize];
        let judge = Judge::new(sampled);
        Gathered { sampled, judge, division, width, faces: Vec::new(), pixels }
    }

    pub(super) fn sampled(&self) -> &'s Sampled<'s> {
        self.sampled
    }

    pub(super) fn judge(&self) -> &Judge<'s, P> {
        &self.judge
    }

    pub(super) fn division(&self) -> Division {
        self.division
    }

    pub(super) fn set_faces(&mut self, faces: Vec<Face>) {
        self.faces = faces;
    }

    pub(super) fn face(&self, index: u32) -> &Face {
        &self.faces[index as usize]
    }

    /// The pieces of every pixel, row by row, with the width of a row.
    pub(super) fn pixels(&self) -> (&[Vec<Piece>], u32) {
        (&self.pixels, self.width)
    }

    fn pixel(&mut self, [column, row]: [u32; 2]) -> &mut Vec<Piece> {
        &mut self.pixels[row as usize * self.width as usize + column as usize]
    }

    /// Adds a fragment to a pixel's list.
    pub(super) fn insert(&mut self, pixel: [u32; 2], face: u32, mask: u32) {
        self.pixel(pixel).push(Piece { face, mask });
    }

    /// Adds a fragment and drops what is not seen any more.
    pub(super) fn insert_opaque(&mut self, pixel: [u32; 2], face: u32, mask: u32) {
        let mut seen = std::mem::take(self.pixel(pixel));
        self.cover(&mut seen, pixel, Piece { face, mask });
        *self.pixel(pixel) = seen;
    }

    /// Leaves of a list of pieces that are apart, and one more, what is
    /// seen of either.
    pub(super) fn cover(&self, seen: &mut Vec<Piece>, pixel: [u32; 2], mut piece: Piece) {
        seen.retain_mut(|old| {
            let overlap = old.mask & piece.mask;
            if overlap != 0 {
                let priority = self.priority(piece.face, old.face, pixel, overlap);
                old.mask &= !priority;
                piece.mask &= !(overlap & !priority);
            }
            old.mask != 0
        });
        if piece.mask != 0 {
            seen.push(piece);
        }
    }

    /// The bits of `overlap` at which the first face is the nearer one.
    fn priority(&self, first: u32, second: u32, pixel: [u32; 2], overlap: u32) -> u32 {
        let (first, second) = (self.face(first), self.face(second));
        let origin = [pixel[0] * self.division.columns(), pixel[1] * self.division.rows()];
        bits(overlap).fold(0, |mask, bit| {
            let at = [origin[0] + (bit & 3), origin[1] + (bit >> 2)];
            mask | u32::from(self.judge.beats(first, second, at)) << bit
        })
    }

    /// The fragments, for triangles instead of faces.
    pub(super) fn into_fragments(self, run: &Run) -> Vec<Vec<Fragment>> {
        run.merge(&self.judge.counters());
        let fragment = |piece: Piece| {
            let triangle = self.faces[piece.face as usize].triangle;
            Fragment { triangle, mask: piece.mask }
        };
        self.pixels.into_iter().map(|pixel| pixel.into_iter().map(fragment).collect()).collect()
    }
}
