//! STL (3D Systems, StereoLithography Interface Specification, 1988): facets
//! of three corners, in a binary form and in a text form.
//!
//! The binary form is an 80 byte header, the number of facets, and 50 bytes
//! per facet: normal, three corners, two bytes of whatever. Many binary files
//! begin with the word `solid` that should mark the text form, so the length
//! decides: a file of exactly 84 + 50 n bytes for its own n is binary (no
//! text can be: the n of four printable bytes exceeds half a thousand
//! million). Facets are independent, so they are decoded in parallel,
//! straight into place. Corners are not welded here; normals are not read,
//! because the corners say all that is true.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DVec3;

use super::super::{Faces, Soup};
use super::error::{Fault, Read};
use super::{Found, stl_text};
use crate::run::map_indexed;

const HEADER: usize = 84;
const FACET: usize = 50;

/// Reads an STL file of either form.
pub(super) fn read(bytes: &[u8]) -> Read<Found> {
    if !has_binary_length(bytes) && looks_like_text(bytes) {
        return stl_text::read(bytes);
    }
    read_binary(bytes)
}

/// Whether the file is exactly as long as its number of facets says.
pub(super) fn has_binary_length(bytes: &[u8]) -> bool {
    facet_count(bytes).is_some_and(|count| binary_length(count) == bytes.len() as u64)
}

fn facet_count(bytes: &[u8]) -> Option<u32> {
    bytes.get(80..HEADER)?.try_into().ok().map(u32::from_le_bytes)
}

fn binary_length(count: u32) -> u64 {
    HEADER as u64 + FACET as u64 * u64::from(count)
}

/// Text has no control characters near its beginning; a binary file has,
/// in its number of facets at the latest. Names may be in any encoding.
fn looks_like_text(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(512)];
    head.iter().all(|&byte| 0x20 <= byte || (0x09..=0x0d).contains(&byte))
}

fn read_binary(bytes: &[u8]) -> Read<Found> {
    let Some(count) = facet_count(bytes) else {
        let message = format!("the file ends in the header, expected {HEADER} bytes at least");
        return Err(Fault::byte(bytes.len(), message));
    };
    let (expected, actual) = (binary_length(count), bytes.len() as u64);
    if actual < expected {
        let message = format!("the file ends here, expected {expected} bytes for {count} facets");
        return Err(Fault::byte(bytes.len(), message));
    }
    let mut found = Found::default();
    if expected < actual {
        let surplus = actual - expected;
        if FACET as u64 <= surplus {
            let message = format!("{surplus} bytes follow {count} facets, expected the end");
            return Err(Fault::byte(expected as usize, message));
        }
        found.warnings.push(format!("{surplus} bytes after the last facet are ignored"));
    }
    let (facets, _) = bytes[HEADER..expected as usize].as_chunks::<FACET>();
    let vertices = corners(facets)?;
    let corners = map_indexed(vertices.len(), |corner| corner as u32);
    let faces = Faces::from_triangles(corners);
    found.objects.push(Soup { vertices, faces, ..Soup::default() });
    Ok(found)
}

/// The corners of all facets. A number that is not finite only lowers the
/// least offset of such numbers, so the loop needs no way out.
fn corners(facets: &[[u8; FACET]]) -> Read<Vec<DVec3>> {
    let first_wrong = AtomicUsize::new(usize::MAX);
    let triangles = map_indexed(facets.len(), |facet| {
        let triangle = decode(&facets[facet]);
        if !triangle.iter().all(|corner| corner.is_finite()) {
            first_wrong.fetch_min(facet, Ordering::Relaxed);
        }
        triangle
    });
    let facet = first_wrong.into_inner();
    let Some(wrong) = triangles.get(facet) else { return Ok(triangles.into_flattened()) };
    let numbers = wrong.iter().flat_map(|corner| corner.to_array());
    let number = numbers.take_while(|number| number.is_finite()).count();
    let offset = HEADER + FACET * facet + 12 + 4 * number;
    let message = format!("a coordinate of facet {facet} is not finite, expected a finite number");
    Err(Fault::byte(offset, message))
}

fn decode(facet: &[u8; FACET]) -> [DVec3; 3] {
    let number = |at: usize| {
        let bytes = [facet[at], facet[at + 1], facet[at + 2], facet[at + 3]];
        f64::from(f32::from_le_bytes(bytes))
    };
    [12, 24, 36].map(|at| DVec3::new(number(at), number(at + 4), number(at + 8)))
}
