//! Models from files: the only room that reads them.
//!
//! Every reader turns bytes into [`Soup`]s and nothing more: coordinates as
//! the file says them (correctly rounded to f64, f32 widened), polygons as
//! polygons, nothing welded, nothing repaired, nothing turned. A file is
//! either read whole or refused with one error, the first problem in the
//! order of the file. Files are not trusted: a count is believed only as far
//! as there are bytes to back it, nesting never becomes recursion, and every
//! number and reference is checked here, so that later rooms need not.
//!
//! | format | reader | also takes |
//! | --- | --- | --- |
//! | OBJ | own: polygons and line numbers matter to us | polylines |
//! | STL | own: binary in parallel, text by grammar | several solids |
//! | PLY | own (`ply`); the crate is its judge in the tests | edges, face colours |
//! | OFF | own | face colours |
//! | JSON polygon scene | serde_json (`json`) | holes, colours, objects |
//! | glTF 2.0, GLB | serde_json for the document (`gltf`), own accessors | lines, instances, morph targets |
//!
//! Grids of heights, which become surfaces, have readers of their own:
//! [`read_heights`].

mod error;
mod format;
#[cfg(feature = "gltf")]
mod gltf;
mod heights;
#[cfg(any(feature = "json", feature = "gltf"))]
mod json_places;
mod json_scan;
#[cfg(any(feature = "json", feature = "gltf"))]
mod json_words;
mod obj;
mod off;
mod parts;
#[cfg(feature = "ply")]
mod ply;
#[cfg(feature = "json")]
mod polygon_scene;
mod stl;
mod stl_text;
mod text;
mod text_row;

use std::fs::File;
use std::io::{self, Read as _};
use std::path::Path;

pub use error::ImportError;
pub use format::Format;
pub use heights::{
    HeightFormat, ImportedHeights, read_heights, read_heights_bytes, read_heights_bytes_within,
    read_heights_within,
};
#[cfg(any(feature = "json", feature = "gltf"))]
pub use json_words::json_message;

use super::{Placement, Soup, Unit, UpAxis};
use crate::run::Run;
use error::{Fault, Read};

/// What a file held.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// The format it was read as.
    pub format: Format,
    /// Its objects, in file order.
    pub objects: Vec<Soup>,
    /// What the format prescribes: metres and y up for glTF, otherwise
    /// millimetres and z up. The coordinates are not yet converted.
    pub placement: Placement,
    /// What was passed over, for the user to know. No file name in front.
    pub warnings: Vec<String>,
}

/// How a file is read.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ImportOptions {
    /// The format; where none is given, what the content says, else what the
    /// extension says.
    pub format: Option<Format>,
    /// Whether a file may refer to others that are not in its own folder or
    /// below: for files that are trusted.
    pub allow_outside: bool,
}

/// Reads a file. The format is the one given, else what the content says,
/// else what the extension says. glTF may refer to files in its own folder
/// and below.
///
/// # Errors
///
/// If the file cannot be read, its format is unknown or left out of this
/// build, or the content is not a sound model of that format.
pub fn read_file(path: &Path, format: Option<Format>) -> Result<Imported, ImportError> {
    read_file_within(path, ImportOptions { format, ..ImportOptions::default() }, &Run::default())
}

/// As [`read_file`], asking a run whether to go on and how much memory there
/// is. (The package that reads JSON asks nobody.)
///
/// # Errors
///
/// As [`read_file`]; and if the run is cancelled or reaches a limit.
pub fn read_file_within(
    path: &Path,
    options: ImportOptions,
    run: &Run<'_>,
) -> Result<Imported, ImportError> {
    let format = options.format;
    let name = path.display().to_string();
    let io = |source| ImportError::Io { file: name.clone(), source };
    let metadata = path.metadata().map_err(io)?;
    let size = metadata.len();
    run.check()?;
    // A pipe can be opened once.
    let in_place = match metadata.is_file() {
        true => read_in_place(path, size, format, run).map_err(io)?,
        false => None,
    };
    let outcome = match in_place {
        Some(outcome) => outcome,
        None => {
            let file = File::open(path).map_err(io)?;
            // A pipe has no size, and a device no end.
            let most = most_bytes(format.or_else(|| Format::from_extension(path))) + 1;
            let bytes = run.read_all(file, size, most).map_err(io)?;
            run.check()?;
            let folder = path.parent().unwrap_or(Path::new(""));
            let outcome = read(path, &bytes, options, Some(folder), run);
            run.give_back(bytes.capacity() as u64);
            outcome
        }
    };
    run.check()?;
    let imported = outcome.map_err(|fault| fault.named(&name))?;
    run.take(imported.objects.iter().map(bytes_of).sum())?;
    Ok(imported)
}

/// Reads a file of so many bytes piece by piece on all cores, if it is of a
/// format for which that can be done: binary STL.
fn read_in_place(
    path: &Path,
    length: u64,
    format: Option<Format>,
    run: &Run<'_>,
) -> io::Result<Option<Read<Imported>>> {
    if length < stl::HEADER as u64 {
        return Ok(None);
    }
    let mut head = [0; stl::HEADER];
    File::open(path)?.read_exact(&mut head)?;
    let is_binary_stl = match format {
        Some(Format::Stl) => stl::is_binary(&head, length),
        Some(_) => false,
        None => Format::from_magic(&head, length) == Some(Format::Stl),
    };
    if !is_binary_stl {
        return Ok(None);
    }
    let format = Format::Stl;
    if let Err(fault) = check_size(length, format) {
        return Ok(Some(Err(fault)));
    }
    // What is decoded of it takes about as much.
    if run.take(length).is_err() {
        return Ok(Some(Err(Fault::file("the run is stopped"))));
    }
    let found = stl::read_in_place(path, &head, run)?;
    run.give_back(length);
    Ok(Some(found.map(|found| found.imported(format))))
}

/// What a soup takes.
fn bytes_of(soup: &Soup) -> u64 {
    let numbers = soup.vertex_numbers.as_ref().map_or(0, Vec::len);
    let bytes = soup.vertices.len() * size_of::<glam::DVec3>()
        + numbers * size_of::<u32>()
        + soup.faces.len() * size_of::<[u32; 3]>()
        + soup.lines.len() * size_of::<[u32; 2]>();
    bytes as u64
}

/// Reads a file that is already in memory; `name` is for messages and, where
/// nothing else tells the format, for its extension. Files that a glTF
/// document refers to are refused. Time and memory O(`bytes`), glTF nodes that
/// share a mesh excepted.
///
/// # Errors
///
/// If the format is unknown or left out of this build, or the content is not
/// a sound model of that format.
pub fn read_bytes(
    name: &str,
    bytes: &[u8],
    format: Option<Format>,
) -> Result<Imported, ImportError> {
    read_bytes_within(name, bytes, format, &Run::default())
}

/// As [`read_bytes`], asking a run whether to go on and how much memory there
/// is.
///
/// # Errors
///
/// As [`read_bytes`]; and if the run is cancelled or reaches a limit.
pub fn read_bytes_within(
    name: &str,
    bytes: &[u8],
    format: Option<Format>,
    run: &Run<'_>,
) -> Result<Imported, ImportError> {
    let options = ImportOptions { format, ..ImportOptions::default() };
    let outcome = read(Path::new(name), bytes, options, None, run);
    run.check()?;
    let imported = outcome.map_err(|fault| fault.named(name))?;
    run.take(imported.objects.iter().map(bytes_of).sum())?;
    Ok(imported)
}

/// What a reader finds.
#[derive(Debug, Default)]
struct Found {
    objects: Vec<Soup>,
    warnings: Vec<String>,
}

impl Found {
    fn imported(self, format: Format) -> Imported {
        let Found { objects, warnings } = self;
        Imported { format, objects, placement: placement(format), warnings }
    }
}

/// Reads bytes; without a folder, all that they refer to has to be in them.
fn read(
    name: &Path,
    bytes: &[u8],
    options: ImportOptions,
    folder: Option<&Path>,
    run: &Run<'_>,
) -> Read<Imported> {
    if bytes.trim_ascii().is_empty() {
        return Err(Fault::line(1, "the file is empty, expected a model"));
    }
    let told = options.format.or_else(|| Format::from_content(bytes));
    let Some(format) = told.or_else(|| Format::from_extension(name)) else {
        return Err(Fault::file(
            "the format is unknown, expected OBJ, STL, PLY, OFF, JSON, glTF or GLB",
        ));
    };
    check_size(bytes.len() as u64, format)?;
    let found = match format {
        Format::Obj => obj::read(bytes, run),
        Format::Stl => stl::read(bytes, run),
        Format::Off => off::read(bytes, run),
        Format::Ply => read_ply(bytes, run),
        Format::PolygonScene => read_polygon_scene(bytes),
        Format::Gltf => read_gltf(bytes, folder, options.allow_outside, run),
    }?;
    Ok(found.imported(format))
}

/// The line on which a face begins, counted from 1, in a file of a format
/// whose reader does not note the lines of all faces; `number` counts the faces
/// of the file from 0. O(length of the file).
#[cfg(feature = "json")]
pub fn line_of_face(bytes: &[u8], format: Format, number: u64) -> Option<u64> {
    (format == Format::PolygonScene).then(|| polygon_scene::line_of_face(bytes, number))
}

/// Vertex and corner numbers are 32 bits wide. One of either takes at least
/// one byte of any format, and 50 bytes of binary STL make three.
fn check_size(bytes: u64, format: Format) -> Read<()> {
    let most = most_bytes(Some(format));
    if most < bytes {
        let message = format!("the file is too large, expected {most} bytes at most");
        return Err(Fault::file(message));
    }
    Ok(())
}

/// The size of the largest file of a format.
fn most_bytes(format: Option<Format>) -> u64 {
    if format == Some(Format::Stl) { u64::from(u32::MAX) / 3 * 50 } else { u32::MAX.into() }
}

fn placement(format: Format) -> Placement {
    match format {
        Format::Gltf => Placement { unit: Unit::Metre, up: UpAxis::Y },
        _ => Placement::default(),
    }
}

#[cfg(feature = "ply")]
use ply::read as read_ply;

#[cfg(not(feature = "ply"))]
fn read_ply(_: &[u8], _: &Run<'_>) -> Read<Found> {
    Err(left_out(Format::Ply))
}

#[cfg(feature = "json")]
use polygon_scene::read as read_polygon_scene;

#[cfg(not(feature = "json"))]
fn read_polygon_scene(_: &[u8]) -> Read<Found> {
    Err(left_out(Format::PolygonScene))
}

#[cfg(feature = "gltf")]
use gltf::read as read_gltf;

#[cfg(not(feature = "gltf"))]
fn read_gltf(_: &[u8], _: Option<&Path>, _: bool, _: &Run<'_>) -> Read<Found> {
    Err(left_out(Format::Gltf))
}

#[cfg(not(all(feature = "ply", feature = "json", feature = "gltf")))]
fn left_out(format: Format) -> Fault {
    let name = format.name();
    Fault::file(format!("this build cannot read {name} files, expected one with feature {name}"))
}
