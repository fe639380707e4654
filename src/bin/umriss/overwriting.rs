//! Outputs that would replace what they are made of.
//!
//! A file is told by what it is, not by its name: links and other ways of
//! writing a path lead to the same file.

use crate::failure::Failure;
use same_file::Handle;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// What a path leads to.
#[derive(PartialEq, Eq)]
enum Identity {
    /// A file that is there.
    File(Handle),
    /// A name in a folder, where nothing is yet.
    Name(PathBuf, OsString),
}

impl Identity {
    /// Nothing for what cannot be replaced, as pipes and devices, and for
    /// folders that are not there.
    fn of(path: &Path) -> Option<Self> {
        match path.metadata() {
            // Opening a pipe would wait for its other end.
            Ok(metadata) if metadata.is_file() => Handle::from_path(path).ok().map(Identity::File),
            Ok(_) => None,
            Err(_) => {
                let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
                let folder = folder.unwrap_or(Path::new(".")).canonicalize().ok()?;
                Some(Identity::Name(folder, path.file_name()?.to_owned()))
            }
        }
    }
}

/// Refuses outputs that are the same file as an input or as an output before
/// them. `-` is no file.
pub(crate) fn refuse<'a>(
    flag: &str,
    outputs: impl IntoIterator<Item = &'a Path>,
    inputs: impl IntoIterator<Item = &'a Path>,
) -> Result<(), Failure> {
    let identities = |path: &'a Path| {
        let identity = if path.as_os_str() == "-" { None } else { Identity::of(path) };
        identity.map(|identity| (path, identity))
    };
    let inputs: Vec<_> = inputs.into_iter().filter_map(identities).collect();
    let mut before: Vec<(&Path, Identity)> = Vec::new();
    for (path, identity) in outputs.into_iter().filter_map(identities) {
        let shown = path.display();
        if let Some((input, _)) = inputs.iter().find(|(_, input)| *input == identity) {
            let input = input.display();
            return Err(Failure::usage(format!(
                "{flag} {shown} would replace {input}, which is read: expected another file"
            )));
        }
        if let Some((other, _)) = before.iter().find(|(_, other)| *other == identity) {
            let other = other.display();
            return Err(Failure::usage(format!(
                "{flag} {shown} is the same file as {flag} {other}: expected another one"
            )));
        }
        before.push((path, identity));
    }
    Ok(())
}
