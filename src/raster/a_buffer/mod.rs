//! The A-buffer: pixels as lists of fragments with masks of their
//! sub-pixels (Carpenter 1984), and masks of priority where fragments pass
//! through one another (Schilling and Strasser 1993).
//!
//! A pixel is divided into 4 x 4 or 4 x 8 sub-pixels. Each triangle that
//! reaches it leaves one fragment: the mask of the sub-pixels whose centres
//! it covers. Of two fragments A and B, with `O = A & B` and P the mask of
//! the sub-pixels at which B is the nearer one, what is left is
//!
//! ```text
//!   A' = A & ~(O & P)        B' = B & ~(O & ~P)
//! ```
//!
//! Doing this with every pair, in any order, leaves the masks of what is
//! seen. They are apart, so coverage adds up: the bits of all fragments and
//! the free ones are the bits of the pixel. Carpenter guesses the share of
//! either fragment from their ranges of depth; nothing is guessed here.
//!
//! A sub-pixel's centre is a sample like any other. With masks by direct
//! evaluation and no transparency the buffer therefore holds what rays see,
//! bit by bit. Masks from a [table](MaskTable) by the angle and the distance
//! of an edge know the *area* of a pixel better and its points worse; how
//! much worse is bounded there.
//!
//! As each triangle is met once in each pixel, there is nothing to merge.
//! O(triangles + pixels met x bits).

mod block;
mod fragments;
mod masks;
mod preview;
mod shading;
mod table;

pub use fragments::{Fragment, Fragments};
pub use preview::{coverage, preview};
pub use shading::{Paint, Shading};
pub use table::MaskTable;

use super::ItemBuffer;
use super::samples::{Sampled, Samples};
use crate::kernel::predicates::Policy;
use crate::model::View;
use crate::run::{Cancelled, Run, map_chunks};
use crate::view::LineQuestion;

/// How a pixel is divided.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Division {
    /// Four columns and four rows: 16 bits.
    #[default]
    FourByFour,
    /// Four columns and eight rows: 32 bits.
    FourByEight,
}

impl Division {
    /// Columns of a pixel.
    pub fn columns(self) -> u32 {
        4
    }

    /// Rows of a pixel.
    pub fn rows(self) -> u32 {
        match self {
            Division::FourByFour => 4,
            Division::FourByEight => 8,
        }
    }

    /// Sub-pixels of a pixel.
    pub fn bits(self) -> u32 {
        self.columns() * self.rows()
    }

    /// The mask of a whole pixel. The bit of column i and row j is `4 j + i`.
    pub fn full(self) -> u32 {
        u32::MAX >> (u32::BITS - self.bits())
    }
}

/// Where masks come from.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Masks {
    /// Every sub-pixel's centre is held against every edge. Exact.
    #[default]
    Direct,
    /// From a table by angle and distance of each edge.
    Table,
}

/// How an A-buffer is made.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ABufferOptions {
    /// The sub-pixels of a pixel.
    pub division: Division,
    /// Their masks.
    pub masks: Masks,
}

/// The nearest triangle at every sample, where the samples are taken as
/// sub-pixels of pixels that have 4 x 4 of them, masks by direct evaluation.
/// Edge-on triangles are not seen, nor is what lies behind the near plane.
///
/// # Errors
///
/// If the run is cancelled.
pub fn a_buffer<P: Policy>(
    view: &View,
    question: &LineQuestion,
    samples: &Samples,
    run: &Run,
) -> Result<ItemBuffer, Cancelled> {
    let options = ABufferOptions::default();
    let fragments = fragments_over::<P>(view, question, samples, options, run)?;
    let division = options.division;
    let mut items = vec![None; samples.width() as usize * samples.height() as usize];
    for row in 0..fragments.height() {
        for column in 0..fragments.width() {
            for fragment in fragments.of(column, row) {
                for bit in (0..division.bits()).filter(|bit| fragment.mask >> bit & 1 == 1) {
                    let x = column * division.columns() + bit % division.columns();
                    let y = row * division.rows() + bit / division.columns();
                    let index = y as usize * samples.width() as usize + x as usize;
                    items[index] = Some(fragment.triangle);
                }
            }
        }
    }
    Ok(Sampled::new(view, question, samples).buffer(items))
}

/// The visible fragments of every pixel of a grid. Opaque triangles.
///
/// # Errors
///
/// If the run is cancelled.
pub fn visible_fragments<P: Policy>(
    view: &View,
    question: &LineQuestion,
    pixels: &Samples,
    options: ABufferOptions,
    run: &Run,
) -> Result<Fragments, Cancelled> {
    let division = options.division;
    let samples = pixels.divided(division.columns(), division.rows());
    fragments_over::<P>(view, question, &samples, options, run)
}

/// The visible fragments of pixels that are blocks of samples.
fn fragments_over<P: Policy>(
    view: &View,
    question: &LineQuestion,
    samples: &Samples,
    options: ABufferOptions,
    run: &Run,
) -> Result<Fragments, Cancelled> {
    let table = MaskTable::of(options);
    let bands = over_bands(samples, options.division, question, run, |band, _| {
        let sampled = Sampled::new(view, question, band);
        let mut gathered = fragments::Gathered::<P>::new(&sampled, options.division);
        masks::gather(&mut gathered, table.as_ref(), fragments::Gathered::insert_opaque, run)?;
        Ok(gathered.into_fragments(run))
    })?;
    Ok(Fragments::stacked(options.division, samples, bands))
}

/// Calls `work` with the bands of whole pixels that make up a grid of
/// sub-pixels, and with the rows of pixels above each; results in their
/// order. A band has about as many samples as the mesh has vertices, or
/// more, for it holds a copy of both.
fn over_bands<T: Send>(
    samples: &Samples,
    division: Division,
    question: &LineQuestion,
    run: &Run,
    work: impl Fn(&Samples, u32) -> Result<T, Cancelled> + Sync + Send,
) -> Result<Vec<T>, Cancelled> {
    /// Samples of a band at least.
    const LEAST: usize = 1 << 17;
    let (columns, rows) = (samples.width() as usize, samples.height());
    let enough = LEAST.max(question.mesh.vertices().len());
    let pixel_rows = enough.div_ceil(columns.max(1) * division.rows() as usize);
    let part = pixel_rows * division.rows() as usize;
    let results = run.stage("a-buffer", u64::from(rows), || {
        map_chunks(rows as usize, part, |part| {
            run.check()?;
            let units = part.len() as u64;
            let rows = part.start as u32..part.end as u32;
            let above = rows.start / division.rows();
            let result = work(&samples.band(rows), above)?;
            run.advance(units);
            Ok(result)
        })
    });
    results.into_iter().collect()
}
