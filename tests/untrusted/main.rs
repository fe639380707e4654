//! Files that nobody wrote with good intent: cut off at every byte, with
//! counts that lie, nested deeply, with numbers of hundreds of digits. Each is
//! read or refused with one error that names it, and never takes much memory.
//!
//! `tests/malformed` and `tests/fuzz_seeds` have the words of the errors and
//! random mutations; here memory is counted too, by an allocator of this
//! test's own.

#![allow(clippy::unwrap_used)]

#[cfg(feature = "gltf")]
mod files;
#[cfg(all(feature = "ply", feature = "gltf", feature = "json", feature = "png"))]
mod lies;
#[cfg(all(feature = "gltf", feature = "png"))]
mod limits;
mod nesting;
mod numbers;
#[cfg(all(feature = "ply", feature = "gltf", feature = "json", feature = "png"))]
mod truncated;

use cap::Cap;
use std::alloc::System;
use umriss::model::import::{Format, HeightFormat, read_bytes, read_heights_bytes};
use umriss::model::{Scene, SceneOptions, Soup};

/// Counts what is allocated by all tests of this file together.
#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// More than all files here may take together, far less than what they claim.
const MOST: usize = 256 << 20;

/// What a file is read as.
#[derive(Debug, Clone, Copy)]
enum Kind {
    Model(Format),
    Heights(HeightFormat),
    #[cfg(feature = "json")]
    Drawing,
}

/// Reads a file as what it is meant to be and as what it looks like; an error
/// names it, and what is read can be used.
fn read(kind: Kind, bytes: &[u8]) -> Result<(), String> {
    let outcome = match kind {
        Kind::Model(format) => {
            let _ = model(bytes, None);
            model(bytes, Some(format))
        }
        Kind::Heights(format) => {
            let read = read_heights_bytes("file", bytes, Some(format));
            let heights = read.map(|found| found.heights);
            let sound = |heights: umriss::model::surface::Heights| {
                assert_eq!(heights.values().len(), heights.xs().len() * heights.zs().len());
            };
            heights.map(sound).map_err(|error| error.to_string())
        }
        #[cfg(feature = "json")]
        Kind::Drawing => match umriss::export::read_drawing_with_notes(bytes) {
            Ok(_) => Ok(()),
            Err(error) => Err(format!("file:{error}")),
        },
    };
    if let Err(error) = &outcome {
        assert!(error.starts_with("file:"), "{error}");
        assert!(error.len() < 600, "{error}");
    }
    assert!(ALLOCATOR.max_allocated() < MOST, "{kind:?} took too much memory");
    outcome
}

fn model(bytes: &[u8], format: Option<Format>) -> Result<(), String> {
    let imported = read_bytes("file", bytes, format).map_err(|error| error.to_string())?;
    imported.objects.iter().for_each(assert_sound);
    // There may be nothing to draw; there must be no panic.
    let _ = Scene::new(imported.objects, &SceneOptions::default());
    Ok(())
}

fn assert_sound(soup: &Soup) {
    assert!(soup.vertices.iter().all(|vertex| vertex.is_finite()));
    let names_a_vertex = |number: &u32| (*number as usize) < soup.vertices.len();
    assert!(soup.faces.corners().iter().all(names_a_vertex));
    assert!(soup.lines.as_flattened().iter().all(names_a_vertex));
}
