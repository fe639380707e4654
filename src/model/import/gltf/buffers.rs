//! The bytes that a glTF document refers to: in the GLB file itself, in a
//! `data:` URI, or in a file beside the document. Nothing is fetched.

use std::borrow::Cow;

use super::super::error::Read;
use super::super::json_places::Step;
use super::container::Document;
use super::document::{Buffer, BufferView, Natural};
use super::files::{Refusal, decode_percents};

/// Bytes that a buffer may lack: those that round its length up.
const PADDING: u64 = 3;

impl<'a> Document<'a> {
    /// The bytes of a buffer view.
    pub(super) fn view(&self, number: usize) -> Read<&[u8]> {
        let path = [Step::Key("bufferViews"), Step::Item(number)];
        // The callers have looked the view up.
        let view = &self.root.buffer_views[number];
        let buffer = self.need(view.buffer, &path, "buffer")?;
        let length = self.need(view.byte_length, &path, "byteLength")?.0;
        self.check_compression(number, buffer.index())?;
        let buffer = self.buffer(number, buffer.index())?;
        let start = view.byte_offset.map_or(0, |offset| offset.0);
        let end = start.checked_add(length);
        let range = usize::try_from(start).ok().zip(end.and_then(|end| usize::try_from(end).ok()));
        match range.and_then(|(start, end)| buffer.get(start..end)) {
            Some(bytes) => Ok(bytes),
            None => {
                let size = buffer.len();
                let message = format!(
                    "{length} bytes from byte {start} on, expected at most the buffer's {size}"
                );
                Err(self.fault(&path, message))
            }
        }
    }

    /// A compressed view can only be read if its buffer holds its bytes as they
    /// are too.
    fn check_compression(&self, view: usize, buffer: usize) -> Read<()> {
        let Some(name) = self.root.buffer_views[view].extensions.compression() else {
            return Ok(());
        };
        let holds_bytes = |found: &Buffer| {
            let is_in_glb = buffer == 0 && self.binary.is_some();
            !found.extensions.is_fallback() && (found.uri.is_some() || is_in_glb)
        };
        if self.root.buffers.get(buffer).is_some_and(holds_bytes) {
            return Ok(());
        }
        let path = [Step::Key("bufferViews"), Step::Item(view)];
        let message = format!("the mesh is compressed by {name}, expected one that is not");
        Err(self.fault(&path, message))
    }

    fn buffer(&self, view: usize, number: usize) -> Read<&[u8]> {
        let Some(cell) = self.buffers.get(number) else {
            let path = [Step::Key("bufferViews"), Step::Item(view), Step::Key("buffer")];
            let count = self.buffers.len();
            let message = format!("buffer {number} does not exist, expected less than {count}");
            return Err(self.fault(&path, message));
        };
        if let Some(bytes) = cell.get() {
            return Ok(bytes);
        }
        let path = [Step::Key("buffers"), Step::Item(number)];
        let length = self.need(self.root.buffers[number].byte_length, &path, "byteLength")?.0;
        let bytes = self.load(number, length)?;
        if (bytes.len() as u64).saturating_add(PADDING) < length {
            let path = [path[0], path[1], Step::Key("byteLength")];
            let message = format!("a buffer of {} bytes, expected {length}", bytes.len());
            return Err(self.fault(&path, message));
        }
        Ok(cell.get_or_init(|| bytes))
    }

    /// Where the last view of a buffer ends.
    fn end_of_views(&self, buffer: usize) -> u64 {
        let views = self.root.buffer_views.iter();
        let views = views.filter(|view| view.buffer.is_some_and(|own| own.index() == buffer));
        let number = |number: Option<Natural>| number.map_or(0, |number| number.0);
        let end =
            |view: &BufferView| number(view.byte_offset).saturating_add(number(view.byte_length));
        views.map(end).max().unwrap_or(0)
    }

    fn load(&self, number: usize, length: u64) -> Read<Cow<'a, [u8]>> {
        let path = [Step::Key("buffers"), Step::Item(number), Step::Key("uri")];
        let fault = |message: String| self.fault(&path, message);
        let Some(uri) = &self.root.buffers[number].uri else {
            return match self.binary {
                Some(bytes) if number == 0 => Ok(Cow::Borrowed(bytes)),
                _ => {
                    Err(fault("a buffer without content, expected a uri or a binary chunk".into()))
                }
            };
        };
        if let Some(data) = uri.strip_prefix("data:") {
            self.hold(data.len() as u64);
            let decoded = data.split_once(',').and_then(|(kind, text)| {
                let is_base64 = kind.ends_with(";base64");
                if is_base64 { decode_base64(text.as_bytes()) } else { decode_percents(text) }
            });
            return decoded
                .map(Cow::Owned)
                .ok_or_else(|| fault("a data uri that cannot be decoded, expected base64".into()));
        }
        // Some write a length that is too short; nothing is asked for beyond this.
        let most = self.end_of_views(number).max(length);
        match self.surroundings.read(uri, most, self.run) {
            Ok(bytes) => {
                self.held(bytes.capacity() as u64);
                Ok(Cow::Owned(bytes))
            }
            Err(Refusal::Outside(message)) => Err(fault(message).of_outside()),
            Err(Refusal::Unreadable(message)) => Err(fault(message)),
        }
    }
}

/// RFC 4648, section 4; padding may be missing.
fn decode_base64(text: &[u8]) -> Option<Vec<u8>> {
    let end = text.iter().rposition(|&byte| byte != b'=').map_or(0, |last| last + 1);
    let mut decoded = Vec::with_capacity(end / 4 * 3 + 2);
    for group in text[..end].chunks(4) {
        let mut bits = 0_u32;
        for &letter in group {
            bits = bits << 6 | sextet(letter)?;
        }
        match group.len() {
            4 => decoded.extend_from_slice(&bits.to_be_bytes()[1..]),
            3 => decoded.extend_from_slice(&(bits >> 2).to_be_bytes()[2..]),
            2 => decoded.push((bits >> 4) as u8),
            _ => return None,
        }
    }
    Some(decoded)
}

fn sextet(letter: u8) -> Option<u32> {
    Some(u32::from(match letter {
        b'A'..=b'Z' => letter - b'A',
        b'a'..=b'z' => letter - b'a' + 26,
        b'0'..=b'9' => letter - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        _ => return None,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_every_remainder() {
        assert_eq!(decode_base64(b"").as_deref(), Some(&b""[..]));
        assert_eq!(decode_base64(b"Zg==").as_deref(), Some(&b"f"[..]));
        assert_eq!(decode_base64(b"Zm8").as_deref(), Some(&b"fo"[..]));
        assert_eq!(decode_base64(b"Zm9v/+8=").as_deref(), Some(&b"foo\xff\xef"[..]));
        assert_eq!(decode_base64(b"Z"), None);
        assert_eq!(decode_base64(b"Zm9\n"), None);
    }
}
