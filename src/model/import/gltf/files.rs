//! Files that a document refers to.
//!
//! A model may come from anywhere, and what it refers to is read with the
//! rights of whoever draws it. So it reaches only what is in its own folder or
//! below, wherever `..`, absolute paths and symbolic links lead, unless its
//! reader is told to trust it. Nothing is fetched from a network, and what is
//! no plain file is not read: a device would have no end.

use std::fs::{File, Metadata};
use std::path::{Component, Path, PathBuf};

use super::super::error::quote;
use crate::run::Run;

/// Why a file is not read.
#[derive(Debug)]
pub(super) enum Refusal {
    /// It is not below the document's folder.
    Outside(String),
    /// It cannot be.
    Unreadable(String),
}

/// Where the files are that a document refers to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surroundings<'a> {
    /// The folder of the document; without one, all has to be in its file.
    pub(super) folder: Option<&'a Path>,
    /// Whether files that are not in this folder or below may be read too.
    pub(super) allow_outside: bool,
}

impl Surroundings<'_> {
    /// The first `most` bytes of a file; their capacity is taken from the run.
    pub(super) fn read(self, uri: &str, most: u64, run: &Run<'_>) -> Result<Vec<u8>, Refusal> {
        let shown = quote(uri.as_bytes());
        let refuse = |why: &str, expected: &str| {
            Refusal::Unreadable(format!("the file {shown} {why}, expected {expected}"))
        };
        let Some(path) = path_of(uri) else {
            let message = format!("the uri {shown} is not read, expected the path of a file");
            return Err(Refusal::Unreadable(message));
        };
        let Some(folder) = self.folder else {
            return Err(refuse("is elsewhere", "all in one file"));
        };
        let outside = || {
            Refusal::Outside(format!(
                "the file {shown} is not below the model's folder, expected one that is"
            ))
        };
        // Not even looked for: it may be on another machine.
        if path.has_root() && !self.allow_outside {
            return Err(outside());
        }
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let leads_out = path.components().any(|part| part == Component::ParentDir);
        let file = match folder.join(&path).canonicalize() {
            Ok(file) => file,
            // Whether there is such a file is nobody's business.
            Err(_) if leads_out && !self.allow_outside => return Err(outside()),
            Err(_) => return Err(refuse("does not exist", "a buffer")),
        };
        let is_below = folder.canonicalize().is_ok_and(|folder| file.starts_with(folder));
        if !(is_below || self.allow_outside) {
            return Err(outside());
        }
        let Some(size) = file.metadata().ok().filter(Metadata::is_file) else {
            return Err(refuse("is no file", "a buffer"));
        };
        let read = File::open(&file).and_then(|file| run.read_all(file, size.len(), most));
        read.map_err(|error| refuse(&format!("cannot be read ({error})"), "a buffer"))
    }
}

/// The path that a uri gives; `None` if it leads to no file.
fn path_of(uri: &str) -> Option<PathBuf> {
    let encoded = match scheme(uri) {
        None => uri,
        Some(name) if name.eq_ignore_ascii_case("file") => {
            let rest = &uri[name.len() + 1..];
            match rest.strip_prefix("//") {
                Some(rest) => rest.strip_prefix("localhost").unwrap_or(rest),
                None => rest,
            }
        }
        Some(_) => return None,
    };
    let text = String::from_utf8(decode_percents(encoded)?).ok()?;
    let path = PathBuf::from(&text);
    // There, a colon leads to another drive, or to what is behind a file.
    let is_odd = cfg!(windows) && text.contains(':') && !path.is_absolute();
    (!text.contains('\0') && !is_odd).then_some(path)
}

/// The scheme of a uri (RFC 3986, section 3.1). A single letter is a drive.
fn scheme(uri: &str) -> Option<&str> {
    let (name, _) = uri.split_once(':')?;
    let is_part = |byte: u8| byte.is_ascii_alphanumeric() || b"+-.".contains(&byte);
    let is_scheme = name.starts_with(|first: char| first.is_ascii_alphabetic())
        && 1 < name.len()
        && name.bytes().all(is_part);
    is_scheme.then_some(name)
}

/// `%20` and the like replaced; `None` if an escape is none.
pub(super) fn decode_percents(text: &str) -> Option<Vec<u8>> {
    let mut decoded = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let [first, after @ ..] = rest {
        rest = after;
        if *first != b'%' {
            decoded.push(*first);
            continue;
        }
        let digits = rest.get(..2).filter(|digits| digits.iter().all(u8::is_ascii_hexdigit))?;
        let digits = std::str::from_utf8(digits).ok()?;
        decoded.push(u8::from_str_radix(digits, 16).ok()?);
        rest = &rest[2..];
    }
    Some(decoded)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uris_are_paths_or_nothing() {
        let path = |uri: &str| path_of(uri).map(|path| path.display().to_string());
        assert_eq!(path("a%20b.bin").as_deref(), Some("a b.bin"));
        assert_eq!(path("%2e%2E/x.bin").as_deref(), Some("../x.bin"));
        for uri in ["file:///etc/x", "FILE://localhost/etc/x", "file:/etc/x", "/etc/x"] {
            assert_eq!(path(uri).as_deref(), Some("/etc/x"), "{uri}");
        }
        for uri in ["https://a/b.bin", "smb://a/b", "a%2", "a%+1", "a%zz", "a%00b"] {
            assert_eq!(path(uri), None, "{uri}");
        }
    }
}
