//! Grids of heights from files: tables of numbers, ESRI ASCII grids, and
//! images.
//!
//! The first row of a file is the farthest from the viewer of the front view,
//! as north is on a map, so z grows from row to row. Places are column and
//! row, counted from 0, where the file says nothing else.

mod csv;
mod esri;
mod layout;
#[cfg(feature = "png")]
mod png;

use super::ImportError;
use super::error::{Fault, Read};
use super::text::Text;
use crate::model::surface::Heights;
use crate::run::Run;
use std::fs::File;
use std::path::Path;

/// Heights as a file has them.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedHeights {
    /// The grid.
    pub heights: Heights,
    /// What was passed over or taken for something else than it looks like, a
    /// sentence for each.
    pub warnings: Vec<String>,
    /// Whether the file says where its heights are, along x and z.
    pub has_places: bool,
}

/// A format of heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum HeightFormat {
    /// A table of numbers, a row to a line.
    Csv,
    /// ESRI ASCII grid.
    Esri,
    /// An image: grey values, or the luminance of colours.
    Png,
}

impl HeightFormat {
    /// Every format.
    pub const ALL: [HeightFormat; 3] = [HeightFormat::Csv, HeightFormat::Esri, HeightFormat::Png];

    /// What the format is called: its usual extension.
    pub fn name(self) -> &'static str {
        match self {
            HeightFormat::Csv => "csv",
            HeightFormat::Esri => "asc",
            HeightFormat::Png => "png",
        }
    }

    /// The format of a name or extension, in small or capital letters. Tables
    /// go by the names of all texts.
    pub fn from_name(name: &str) -> Option<Self> {
        const TEXTS: [&str; 3] = ["txt", "tsv", "dat"];
        if TEXTS.iter().any(|text| name.eq_ignore_ascii_case(text)) {
            return Some(HeightFormat::Csv);
        }
        Self::ALL.into_iter().find(|format| name.eq_ignore_ascii_case(format.name()))
    }

    /// The format that the extension of a file's name says.
    pub fn from_extension(path: &Path) -> Option<Self> {
        path.extension().and_then(|extension| extension.to_str()).and_then(Self::from_name)
    }

    /// The format that the bytes themselves say, if they say it clearly.
    pub fn from_content(bytes: &[u8]) -> Option<Self> {
        if bytes.starts_with(b"\x89PNG") {
            return Some(HeightFormat::Png);
        }
        let word = Text::new(bytes).word_across_lines()?;
        esri::is_key(word).then_some(HeightFormat::Esri)
    }
}

/// Reads a grid of heights. The format is the one given, else what the
/// content says, else what the extension says.
///
/// # Errors
///
/// If the file cannot be read, its format is unknown or left out of this
/// build, or the content is not a sound grid of that format. Missing heights
/// are no error here.
pub fn read_heights(
    path: &Path,
    format: Option<HeightFormat>,
) -> Result<ImportedHeights, ImportError> {
    read_heights_within(path, format, &Run::default())
}

/// As [`read_heights`], asking a run how much memory there is.
///
/// # Errors
///
/// As [`read_heights`]; and if the run is cancelled or reaches a limit.
pub fn read_heights_within(
    path: &Path,
    format: Option<HeightFormat>,
    run: &Run<'_>,
) -> Result<ImportedHeights, ImportError> {
    let name = path.display().to_string();
    let read = || {
        let file = File::open(path)?;
        let size = file.metadata()?.len();
        // Rows of text are numbered with less, pixels too.
        run.read_all(file, size, u32::MAX.into())
    };
    let bytes = read().map_err(|source| ImportError::Io { file: name.clone(), source })?;
    run.check()?;
    let heights = read_heights_bytes_within(&name, &bytes, format, run);
    run.give_back(bytes.capacity() as u64);
    heights
}

/// Reads a grid that is already in memory; `name` is for messages and, where
/// nothing else tells the format, for its extension. Time and memory
/// O(`bytes`), images O(pixels).
///
/// # Errors
///
/// As [`read_heights`].
pub fn read_heights_bytes(
    name: &str,
    bytes: &[u8],
    format: Option<HeightFormat>,
) -> Result<ImportedHeights, ImportError> {
    read_heights_bytes_within(name, bytes, format, &Run::default())
}

/// As [`read_heights_bytes`], asking a run how much memory there is: a few
/// bytes of an image may be very many heights.
///
/// # Errors
///
/// As [`read_heights_bytes`]; and if the run is cancelled or reaches a limit.
pub fn read_heights_bytes_within(
    name: &str,
    bytes: &[u8],
    format: Option<HeightFormat>,
    run: &Run<'_>,
) -> Result<ImportedHeights, ImportError> {
    let outcome = read(Path::new(name), bytes, format, run);
    run.check()?;
    let found = outcome.map_err(|fault| fault.named(name))?;
    run.take(bytes_of(&found.heights))?;
    Ok(found)
}

/// What a grid takes.
fn bytes_of(heights: &Heights) -> u64 {
    ((heights.xs().len() + heights.zs().len() + heights.values().len()) * size_of::<f64>()) as u64
}

fn read(
    name: &Path,
    bytes: &[u8],
    format: Option<HeightFormat>,
    run: &Run<'_>,
) -> Read<ImportedHeights> {
    if bytes.trim_ascii().is_empty() {
        return Err(Fault::line(1, "the file is empty, expected heights"));
    }
    let told = format.or_else(|| HeightFormat::from_content(bytes));
    match told.or_else(|| HeightFormat::from_extension(name)) {
        Some(HeightFormat::Csv) => csv::read(bytes),
        Some(HeightFormat::Esri) => esri::read(bytes),
        Some(HeightFormat::Png) => read_png(bytes, run),
        None => Err(Fault::file("the format is unknown, expected CSV, ESRI ASCII grid or PNG")),
    }
}

#[cfg(feature = "png")]
use png::read as read_png;

#[cfg(not(feature = "png"))]
fn read_png(_: &[u8], _: &Run<'_>) -> Read<ImportedHeights> {
    Err(Fault::file("this build cannot read png files, expected one with feature png"))
}

/// Heights at columns and rows, of an image.
#[cfg(feature = "png")]
fn on_columns_and_rows(columns: usize, values: Vec<f64>) -> Read<Heights> {
    let steps = |count: usize| (0..count).map(|i| i as f64).collect();
    let rows = values.len() / columns.max(1);
    Heights::new(steps(columns), steps(rows), values).map_err(|e| Fault::file(e.to_string()))
}
