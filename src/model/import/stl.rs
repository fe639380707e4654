//! STL (3D Systems, StereoLithography Interface Specification, 1988): facets
//! of three corners, in a binary form and in a text form.
//!
//! The binary form is an 80 byte header, the number of facets, and 50 bytes
//! per facet: normal, three corners, two bytes of whatever. Many binary files
//! begin with the word `solid` that should mark the text form, so the length
//! decides: a file of exactly 84 + 50 n bytes for its own n is binary (no
//! text can be: the n of four printable bytes exceeds half a thousand
//! million). Bytes after the last facet are passed over. Facets are independent, so they are read and decoded in parallel,
//! and the file as a whole is never in memory.
//! Corners are welded here only as far as it saves copies, for good later;
//! normals are not read, because the corners say all that is true.

use std::fs::File;
use std::io::{self, Read as _, Seek, SeekFrom};
use std::ops::Range;
use std::path::Path;

use glam::DVec3;

use super::super::{Faces, Precision, Soup};
use super::error::{Fault, Read};
use super::{Format, Found, stl_text};
use crate::run::{Run, join_lists, map_chunks};

/// Bytes before the first facet.
pub(super) const HEADER: usize = 84;
const FACET: usize = 50;

/// Reads an STL file of either form.
pub(super) fn read(bytes: &[u8], run: &Run<'_>) -> Read<Found> {
    if !is_binary(bytes, bytes.len() as u64) && looks_like_text(bytes) {
        return stl_text::read(bytes, run);
    }
    read_binary(bytes, run)
}

/// Reads a binary file of facets that are all there, given its first bytes,
/// piece by piece.
///
/// # Errors
///
/// The outer one if the file cannot be read.
pub(super) fn read_in_place(path: &Path, head: &[u8], run: &Run<'_>) -> io::Result<Read<Found>> {
    let count = facet_count(head).unwrap_or(0) as usize;
    let soup = soup_of(&Facets::InFile { path, count }, run)?;
    Ok(soup.map(|soup| Found { objects: vec![soup], ..Found::default() }))
}

/// Whether a file of so many bytes, given the first ones, is exactly as long as
/// its number of facets says.
pub(super) fn is_binary(head: &[u8], length: u64) -> bool {
    facet_count(head).is_some_and(|count| binary_length(count) == length)
}

fn facet_count(bytes: &[u8]) -> Option<u32> {
    bytes.get(80..HEADER)?.try_into().ok().map(u32::from_le_bytes)
}

fn binary_length(count: u32) -> u64 {
    HEADER as u64 + FACET as u64 * u64::from(count)
}

/// Text has no control characters near its beginning; a binary file has,
/// in its number of facets at the latest. Names may be in any encoding. What
/// opens like the grammar is text all the same, so that its place is told.
fn looks_like_text(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(512)];
    head.iter().all(|&byte| 0x20 <= byte || (0x09..=0x0d).contains(&byte))
        || Format::from_content(bytes) == Some(Format::Stl)
}

fn read_binary(bytes: &[u8], run: &Run<'_>) -> Read<Found> {
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
        // Whoever wrote none and then some has not come back to count them.
        if count == 0 && FACET as u64 <= surplus {
            let message = format!("{surplus} bytes follow 0 facets, expected the number of facets");
            return Err(Fault::byte(80, message));
        }
        found.warnings.push(format!("{surplus} bytes after the last facet are ignored"));
    }
    let facets = Facets::InMemory(&bytes[HEADER..expected as usize]);
    // What is in memory can be read.
    let soup = soup_of(&facets, run).map_err(|error| Fault::file(error.to_string()))?;
    found.objects.push(soup?);
    Ok(found)
}

/// Facets, wherever they are.
enum Facets<'a> {
    InMemory(&'a [u8]),
    InFile { path: &'a Path, count: usize },
}

impl Facets<'_> {
    fn count(&self) -> usize {
        match self {
            Facets::InMemory(bytes) => bytes.len() / FACET,
            Facets::InFile { count, .. } => *count,
        }
    }

    /// Decodes some of them.
    fn decoded(&self, part: Range<usize>) -> io::Result<Part> {
        let mut decoded = Part::for_facets(part.len());
        let [from, to] = [part.start, part.end].map(|facet| facet * FACET);
        match *self {
            Facets::InMemory(bytes) => decoded.add(bytes[from..to].as_chunks().0, part.start),
            Facets::InFile { path, .. } => {
                let mut file = File::open(path)?;
                file.seek(SeekFrom::Start((HEADER + from) as u64))?;
                let mut buffer = [[0; FACET]; AT_ONCE];
                for first in part.clone().step_by(AT_ONCE) {
                    let facets = &mut buffer[..AT_ONCE.min(part.end - first)];
                    file.read_exact(facets.as_flattened_mut())?;
                    decoded.add(facets, first);
                }
            }
        }
        Ok(decoded)
    }
}

/// Facets that are read from a file at once: so few that they stay in the
/// cache until they are decoded.
const AT_ONCE: usize = 1 << 10;

/// Facets that one task reads and decodes.
const PART: usize = 1 << 15;

/// Slots of the table of vertices seen lately: small enough for the cache of
/// a core, large enough for the facets around a vertex to find it again.
const SLOTS: usize = 1 << 14;

/// An empty slot.
const EMPTY: u32 = u32::MAX;

/// What one task decodes. Most vertices stand in the file six times, close to
/// one another: a table of those seen lately keeps most copies from being made.
/// What it misses is welded with everything else later.
#[derive(Default)]
struct Part {
    seen: Vec<u32>,
    vertices: Vec<DVec3>,
    /// Number of the corner in the file from which each vertex was taken.
    numbers: Vec<u32>,
    corners: Vec<u32>,
    /// What is wrong with the first facet that has a number that is not finite.
    wrong: Option<Fault>,
}

/// Decodes all facets, in parallel.
fn soup_of(facets: &Facets<'_>, run: &Run<'_>) -> io::Result<Read<Soup>> {
    let parts = map_chunks(facets.count(), PART, |part| match run.is_stopped() {
        true => Ok(Part::default()),
        false => facets.decoded(part),
    });
    let mut parts = parts.into_iter().collect::<io::Result<Vec<Part>>>()?;
    if let Some(wrong) = parts.iter_mut().find_map(|part| part.wrong.take()) {
        return Ok(Err(wrong));
    }
    let mut offsets = Vec::with_capacity(parts.len());
    let mut sum = 0;
    for part in &parts {
        offsets.push(sum);
        sum += part.vertices.len() as u32;
    }
    let (mut vertices, mut numbers, mut corners) = (Vec::new(), Vec::new(), Vec::new());
    for part in parts {
        vertices.push(part.vertices);
        numbers.push(part.numbers);
        corners.push(part.corners);
    }
    let vertices = join_lists(vertices, |_, vertex| *vertex);
    let numbers = join_lists(numbers, |_, number| *number);
    let faces = Faces::from_triangles(join_lists(corners, |part, corner| corner + offsets[part]));
    let (vertex_numbers, precision) = (Some(numbers), Precision::Float32);
    Ok(Ok(Soup { vertices, vertex_numbers, precision, faces, ..Soup::default() }))
}

impl Part {
    fn for_facets(count: usize) -> Self {
        // As many vertices as a closed surface has, and some for the border.
        let vertices = count * 5 / 8;
        Part {
            seen: vec![EMPTY; SLOTS],
            vertices: Vec::with_capacity(vertices),
            numbers: Vec::with_capacity(vertices),
            corners: Vec::with_capacity(3 * count),
            wrong: None,
        }
    }

    /// Decodes facets, of which the first has the number `first`.
    fn add(&mut self, facets: &[[u8; FACET]], first: usize) {
        for (facet, bytes) in (first..).zip(facets) {
            let triangle = decode(bytes);
            if self.wrong.is_none() && !triangle.iter().all(|corner| corner.is_finite()) {
                self.wrong = Some(not_finite(facet, &triangle));
            }
            for (i, &corner) in triangle.iter().enumerate() {
                let slot = &mut self.seen[slot_of(corner)];
                let known = self.vertices.get(*slot as usize);
                if known != Some(&corner) {
                    *slot = self.vertices.len() as u32;
                    self.vertices.push(corner);
                    self.numbers.push((3 * facet + i) as u32);
                }
                self.corners.push(*slot);
            }
        }
    }
}

/// The slot of a position. Equal positions have equal bits after adding 0.
fn slot_of(position: DVec3) -> usize {
    let [x, y, z] = (position + DVec3::ZERO).to_array().map(f64::to_bits);
    let mixed = (x.rotate_left(5) ^ y).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(27) ^ z;
    (mixed.wrapping_mul(0xd6e8_feb8_6659_fd93) >> 50) as usize
}

/// The error for a facet with a number that is not finite.
fn not_finite(facet: usize, triangle: &[DVec3; 3]) -> Fault {
    let numbers = triangle.iter().flat_map(|corner| corner.to_array());
    let number = numbers.take_while(|number| number.is_finite()).count();
    let offset = HEADER + FACET * facet + 12 + 4 * number;
    let message = format!("a coordinate of facet {facet} is not finite, expected a finite number");
    Fault::byte(offset, message)
}

fn decode(facet: &[u8; FACET]) -> [DVec3; 3] {
    let number = |at: usize| {
        let bytes = [facet[at], facet[at + 1], facet[at + 2], facet[at + 3]];
        f64::from(f32::from_le_bytes(bytes))
    };
    let corner = |at: usize| DVec3::new(number(at), number(at + 4), number(at + 8));
    [corner(12), corner(24), corner(36)]
}
