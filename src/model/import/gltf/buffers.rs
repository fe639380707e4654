//! The bytes that a glTF document refers to: in the GLB file itself, in a
//! `data:` URI, or in a file beside the document. Nothing is fetched.

use std::borrow::Cow;
use std::path::Path;

use super::super::error::{Read, quote};
use super::super::json_places::Step;
use super::container::Document;

impl<'a> Document<'a> {
    /// The bytes of a buffer view.
    pub(super) fn view(&self, number: usize) -> Read<&[u8]> {
        let path = [Step::Key("bufferViews"), Step::Item(number)];
        // The callers have looked the view up.
        let view = &self.root.buffer_views[number];
        let buffer = self.buffer(number, view.buffer.value())?;
        let start = view.byte_offset.unwrap_or_default().0;
        let bytes = usize::try_from(start).ok().and_then(|start| buffer.get(start..));
        let length = usize::try_from(view.byte_length.0).ok();
        match bytes.zip(length).and_then(|(bytes, length)| bytes.get(..length)) {
            Some(bytes) => Ok(bytes),
            None => {
                let (length, size) = (view.byte_length.0, buffer.len());
                let message = format!(
                    "{length} bytes from byte {start} on, expected at most the buffer's {size}"
                );
                Err(self.fault(&path, message))
            }
        }
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
        let bytes = self.load(number)?;
        let expected = self.root.buffers[number].byte_length.0;
        if (bytes.len() as u64) < expected {
            let path = [Step::Key("buffers"), Step::Item(number), Step::Key("byteLength")];
            let message = format!("a buffer of {} bytes, expected {expected}", bytes.len());
            return Err(self.fault(&path, message));
        }
        Ok(cell.get_or_init(|| bytes))
    }

    fn load(&self, number: usize) -> Read<Cow<'a, [u8]>> {
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
            let encoded = data.split_once(',').filter(|(kind, _)| kind.ends_with(";base64"));
            let decoded = encoded.and_then(|(_, text)| decode_base64(text.as_bytes()));
            return decoded
                .map(Cow::Owned)
                .ok_or_else(|| fault("a data uri that cannot be decoded, expected base64".into()));
        }
        let shown = quote(uri.as_bytes());
        let relative = decode_percents(uri).filter(|path| Path::new(path).is_relative());
        let Some(relative) = relative.filter(|path| !path.contains([':', '\0'])) else {
            return Err(fault(format!("the uri {shown} is not read, expected a relative path")));
        };
        let Some(folder) = self.folder else {
            return Err(fault(format!("the file {shown} is elsewhere, expected all in one file")));
        };
        let file = folder.join(relative);
        // A device could be read without end.
        if !file.is_file() {
            return Err(fault(format!("the file {shown} does not exist, expected a buffer")));
        }
        let content = std::fs::read(&file);
        content.map(Cow::Owned).map_err(|error| {
            fault(format!("the file {shown} cannot be read ({error}), expected a buffer"))
        })
    }
}

/// `%20` and the like replaced; `None` if the result is no text.
fn decode_percents(uri: &str) -> Option<String> {
    let mut decoded = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let [first, after @ ..] = rest {
        rest = after;
        if *first != b'%' {
            decoded.push(*first);
            continue;
        }
        let digits = std::str::from_utf8(rest.get(..2)?).ok()?;
        decoded.push(u8::from_str_radix(digits, 16).ok()?);
        rest = &rest[2..];
    }
    String::from_utf8(decoded).ok()
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

    #[test]
    fn percents_become_bytes() {
        assert_eq!(decode_percents("a%20b").as_deref(), Some("a b"));
        assert_eq!(decode_percents("a%2"), None);
        assert_eq!(decode_percents("%ff"), None);
    }
}
