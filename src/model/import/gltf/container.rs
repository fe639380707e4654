//! The document of a glTF file and, in a GLB file, the chunks around it.

use std::borrow::Cow;
use std::cell::{Cell, OnceCell};

use super::super::error::{Fault, Read, quote};
use super::super::json_places::{Step, line_of, offset_of, place_of};
use super::super::json_words::json_message;
use super::document::{Natural, Root, Word};
use super::files::Surroundings;
use crate::run::Run;

/// A glTF document, with all that is needed to follow its references.
pub(super) struct Document<'a> {
    pub(super) root: Root,
    json: &'a [u8],
    /// Where the JSON stands in a GLB file.
    json_start: Option<usize>,
    /// The binary chunk of a GLB file.
    pub(super) binary: Option<&'a [u8]>,
    pub(super) surroundings: Surroundings<'a>,
    /// The bytes of each buffer, once they are asked for.
    pub(super) buffers: Vec<OnceCell<Cow<'a, [u8]>>>,
    pub(super) run: &'a Run<'a>,
    /// Bytes taken from the run.
    held: Cell<u64>,
}

impl<'a> Document<'a> {
    /// Parses the document; its references are not yet checked.
    pub(super) fn open(
        bytes: &'a [u8],
        surroundings: Surroundings<'a>,
        run: &'a Run<'a>,
        warnings: &mut Vec<String>,
    ) -> Read<Self> {
        let (json, json_start, binary) = if bytes.starts_with(b"glTF") {
            let Chunks { start, json, binary } = chunks(bytes, warnings)?;
            (json, Some(start), binary)
        } else {
            (bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), None, None)
        };
        let mut document = Document {
            root: Root::default(),
            json,
            json_start,
            binary,
            surroundings,
            buffers: Vec::new(),
            run,
            held: Cell::new(0),
        };
        // Of another version nothing else may fit: that is told first.
        let outcome = serde_json::from_slice::<Root>(json);
        document.check_version(outcome.as_ref().ok())?;
        document.root = outcome.map_err(|error| {
            let place = offset_of(json, error.line(), error.column());
            document.fault_at(place, json_message(&error, "glTF 2.0"))
        })?;
        document.buffers = document.root.buffers.iter().map(|_| OnceCell::new()).collect();
        Ok(document)
    }

    /// Whether this is glTF 2.0, given the document if it could be read.
    fn check_version(&self, root: Option<&Root>) -> Read<()> {
        let path = [Step::Key("asset"), Step::Key("version")];
        let version = match root.map(|root| &root.asset.version) {
            Some(Word::Text(version)) => version.clone(),
            Some(Word::Number(version)) => version.to_string(),
            Some(Word::Other(_)) if self.names_its_parts() => "1.0".to_owned(),
            Some(Word::Other(_)) => {
                let message = "the key 'version' is missing, expected glTF 2.0";
                return Err(self.fault(&path, message));
            }
            None => match version_in(self.json) {
                Some(version) => version,
                None if self.names_its_parts() => "1.0".to_owned(),
                // Whatever is wrong with the text is told by its parser.
                None => return Ok(()),
            },
        };
        if version == "2" || version.starts_with("2.") {
            return Ok(());
        }
        let version: String = version.escape_default().take(20).collect();
        Err(self.fault(&path, format!("glTF {version}, expected 2.0")))
    }

    /// Whether nodes and meshes have names instead of numbers, as in glTF 1.0,
    /// which need not say its version.
    fn names_its_parts(&self) -> bool {
        let root = place_of(self.json, &[]);
        ["scenes", "nodes", "meshes"].into_iter().any(|key| {
            let place = place_of(self.json, &[Step::Key(key)]);
            place != root && self.json.get(place) == Some(&b'{')
        })
    }

    /// A number that has to be there.
    pub(super) fn need(
        &self,
        number: Option<Natural>,
        path: &[Step<'_>],
        key: &str,
    ) -> Read<Natural> {
        number.ok_or_else(|| {
            self.fault(path, format!("the key '{key}' is missing, expected a natural number"))
        })
    }

    /// Takes memory from the run. Whoever asks next is told if that is too much.
    pub(super) fn hold(&self, bytes: u64) {
        let _ = self.run.take(bytes);
        self.held(bytes);
    }

    /// Notes that memory was taken from the run.
    pub(super) fn held(&self, bytes: u64) {
        self.held.set(self.held.get().saturating_add(bytes));
    }

    /// A problem at a place of the document.
    pub(super) fn fault(&self, path: &[Step<'_>], message: impl Into<String>) -> Fault {
        self.fault_at(place_of(self.json, path), message)
    }

    fn fault_at(&self, place: usize, message: impl Into<String>) -> Fault {
        match self.json_start {
            Some(start) => Fault::byte(start + place, message),
            None => Fault::line(line_of(self.json, place), message),
        }
    }
}

impl Drop for Document<'_> {
    /// What objects take is counted by whoever keeps them.
    fn drop(&mut self) {
        self.run.give_back(self.held.get());
    }
}

/// The version that a document says, whatever else is in it.
fn version_in(json: &[u8]) -> Option<String> {
    #[derive(serde::Deserialize)]
    struct Head {
        asset: super::document::Asset,
    }
    match serde_json::from_slice::<Head>(json).ok()?.asset.version {
        Word::Text(version) => Some(version),
        Word::Number(version) => Some(version.to_string()),
        Word::Other(_) => None,
    }
}

/// What a GLB file consists of.
struct Chunks<'a> {
    /// Where the JSON stands.
    start: usize,
    json: &'a [u8],
    binary: Option<&'a [u8]>,
}

/// Bytes before the first chunk, and before what is in a chunk.
const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;

/// Lengths should be multiples of four; of those that are not, the next chunk
/// is where its header is found. Chunks of other kinds are passed over, and so
/// is what follows the file's own length.
fn chunks<'a>(bytes: &'a [u8], warnings: &mut Vec<String>) -> Read<Chunks<'a>> {
    let version = number(bytes, 4)?;
    if version != 2 {
        return Err(Fault::byte(4, format!("glTF {version}.0, expected 2.0")));
    }
    let length = number(bytes, 8)? as usize;
    if length < HEADER + CHUNK_HEADER {
        return Err(Fault::byte(8, format!("a length of {length} bytes, expected 20 at least")));
    }
    if let Some(surplus) = bytes.len().checked_sub(length).filter(|&surplus| 0 < surplus) {
        warnings.push(format!("{surplus} bytes after the end are ignored (byte {length})"));
    }
    // Where all chunks are whole, nothing is missing.
    let (whole, bytes) = (length, &bytes[..length.min(bytes.len())]);
    let chunk = |at| chunk(bytes, at, whole);
    let (kind, json) = chunk(HEADER)?;
    if kind != b"JSON" {
        let message = format!("a chunk {}, expected 'JSON'", quote(kind));
        return Err(Fault::byte(HEADER + 4, message));
    }
    let start = HEADER + CHUNK_HEADER;
    let (mut end, mut binary) = (start + json.len(), None);
    while binary.is_none()
        && let Some(next) = next_chunk(bytes, end)
    {
        let (kind, content) = chunk(next)?;
        binary = (kind == b"BIN\0").then_some(content);
        end = next + CHUNK_HEADER + content.len();
    }
    if bytes.len() + 3 < length {
        let left = bytes.len();
        warnings.push(format!("the file has {left} bytes, though its header says {length}"));
    }
    Ok(Chunks { start, json, binary })
}

/// Where the chunk begins that follows one that ends at `end`.
fn next_chunk(bytes: &[u8], end: usize) -> Option<usize> {
    let is_here = bytes.get(end + 4..end + CHUNK_HEADER) == Some(b"BIN\0");
    let next = if is_here { end } else { end.next_multiple_of(4) };
    (next + CHUNK_HEADER <= bytes.len()).then_some(next)
}

/// The kind and content of the chunk whose header stands at `at`, in a file that
/// should have `whole` bytes.
fn chunk(bytes: &[u8], at: usize, whole: usize) -> Read<(&[u8], &[u8])> {
    let length = number(bytes, at)? as usize;
    let kind = bytes.get(at + 4..at + CHUNK_HEADER).unwrap_or_default();
    let rest = bytes.get(at + CHUNK_HEADER..).unwrap_or_default();
    match rest.get(..length) {
        Some(content) => Ok((kind, content)),
        None if bytes.len() < whole => {
            let message = format!("the file ends here, expected {whole} bytes");
            Err(Fault::byte(bytes.len(), message))
        }
        None => {
            let left = rest.len();
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
