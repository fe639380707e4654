//! The document of a glTF file and, in a GLB file, the chunks around it.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::path::Path;

use ::gltf::json::Root;

use super::super::error::{Fault, Read, quote};
use super::super::json_places::{Step, line_of, message_of, place_of};

/// A glTF document, with all that is needed to follow its references.
pub(super) struct Document<'a> {
    pub(super) root: Root,
    json: &'a [u8],
    /// Where the JSON stands in a GLB file.
    json_start: Option<usize>,
    /// The binary chunk of a GLB file.
    pub(super) binary: Option<&'a [u8]>,
    pub(super) folder: Option<&'a Path>,
    /// The bytes of each buffer, once they are asked for.
    pub(super) buffers: Vec<OnceCell<Cow<'a, [u8]>>>,
}

impl<'a> Document<'a> {
    /// Parses the document; its references are not yet checked.
    pub(super) fn open(bytes: &'a [u8], folder: Option<&'a Path>) -> Read<Self> {
        let (json, json_start, binary) = if bytes.starts_with(b"glTF") {
            let Chunks { start, json, binary } = chunks(bytes)?;
            (json, Some(start), binary)
        } else {
            (bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), None, None)
        };
        let root = Root::from_slice(json).map_err(|error| {
            let message = message_of(&error, "glTF 2.0");
            match json_start {
                None => Fault::line(error.line().max(1) as u64, message),
                Some(start) => {
                    let lines = json.split_inclusive(|&byte| byte == b'\n');
                    let before: usize =
                        lines.take(error.line().saturating_sub(1)).map(<[u8]>::len).sum();
                    Fault::byte(start + before + error.column().saturating_sub(1), message)
                }
            }
        })?;
        let buffers = root.buffers.iter().map(|_| OnceCell::new()).collect();
        let document = Document { root, json, json_start, binary, folder, buffers };
        let version = &document.root.asset.version;
        if version != "2" && !version.starts_with("2.") {
            let message = format!("glTF version {}, expected 2.0", quote(version.as_bytes()));
            return Err(document.fault(&[Step::Key("asset"), Step::Key("version")], message));
        }
        Ok(document)
    }

    /// A problem at a place of the document.
    pub(super) fn fault(&self, path: &[Step<'_>], message: impl Into<String>) -> Fault {
        let place = place_of(self.json, path);
        match self.json_start {
            Some(start) => Fault::byte(start + place, message),
            None => Fault::line(line_of(self.json, place), message),
        }
    }
}

/// What a GLB file consists of.
struct Chunks<'a> {
    /// Where the JSON stands.
    start: usize,
    json: &'a [u8],
    binary: Option<&'a [u8]>,
}

fn chunks(bytes: &[u8]) -> Read<Chunks<'_>> {
    let version = number(bytes, 4)?;
    if version != 2 {
        return Err(Fault::byte(4, format!("GLB version {version}, expected 2")));
    }
    let length = number(bytes, 8)? as usize;
    if bytes.len() < length {
        let message = format!("the file ends here, expected {length} bytes");
        return Err(Fault::byte(bytes.len(), message));
    }
    if length < bytes.len() {
        let message = format!("the file goes on here, expected {length} bytes");
        return Err(Fault::byte(length, message));
    }
    let (start, json) = chunk(bytes, 12, b"JSON")?;
    let next = start + json.len().next_multiple_of(4);
    if bytes.len() <= next {
        return Ok(Chunks { start, json, binary: None });
    }
    let (_, binary) = chunk(bytes, next, b"BIN\0")?;
    Ok(Chunks { start, json, binary: Some(binary) })
}

/// The chunk whose header stands at `at`.
fn chunk<'a>(bytes: &'a [u8], at: usize, kind: &[u8; 4]) -> Read<(usize, &'a [u8])> {
    let length = number(bytes, at)? as usize;
    let found = bytes.get(at + 4..at + 8).unwrap_or_default();
    if found != kind {
        let message = format!("a chunk {}, expected {}", quote(found), quote(kind));
        return Err(Fault::byte(at + 4, message));
    }
    let start = at + 8;
    match bytes[start..].get(..length) {
        Some(content) => Ok((start, content)),
        None => {
            let left = bytes.len() - start;
            let message = format!("a chunk of {length} bytes, expected {left} at most");
            Err(Fault::byte(at, message))
        }
    }
}

fn number(bytes: &[u8], at: usize) -> Read<u32> {
    match bytes.get(at..).and_then(|rest| rest.first_chunk()) {
        Some(found) => Ok(u32::from_le_bytes(*found)),
        None => Err(Fault::byte(bytes.len(), "the file ends here, expected a GLB header")),
    }
}
