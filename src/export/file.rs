//! Files that appear whole or not at all.
//!
//! The bytes go into a new file beside the target, which then takes the
//! target's place in one step of the file system. Whoever looks sees the old
//! file or the new one, never half of one; if anything fails, the new file is
//! removed. What is no plain file (a device, a pipe) cannot be replaced and is
//! written to directly. A file that may not be written to is not replaced
//! either, though its folder would allow that.

use super::ExportError;
use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// How many names are tried for the file beside the target.
const NAMES: u32 = 1000;

/// Writes `bytes` to `path`, replacing what was there.
///
/// A symbolic link keeps pointing where it points; its target is replaced.
/// An existing file keeps its permissions.
///
/// # Errors
///
/// If the file cannot be written, or is there and read-only.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), ExportError> {
    replace(path, bytes).map_err(|source| ExportError::File { path: path.to_owned(), source })
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let existing = match path.metadata() {
        Ok(metadata) if metadata.is_file() => Some(metadata),
        Ok(metadata) if metadata.is_dir() => return Err(ErrorKind::IsADirectory.into()),
        Ok(_) => return OpenOptions::new().write(true).open(path)?.write_all(bytes),
        Err(error) if error.kind() == ErrorKind::NotFound => None,
        Err(error) => return Err(error),
    };
    let target = match &existing {
        Some(metadata) => {
            may_be_written(path, metadata)?;
            path.canonicalize()?
        }
        None => path.to_owned(),
    };
    let (file, draft) = Draft::create(&target)?;
    let written = fill(file, bytes, existing.map(|metadata| metadata.permissions()));
    written.and_then(|()| draft.publish(&target))
}

/// Whether a file is meant to be changed, and by whoever runs this.
fn may_be_written(path: &Path, metadata: &Metadata) -> io::Result<()> {
    if metadata.permissions().readonly() {
        return Err(ErrorKind::PermissionDenied.into());
    }
    OpenOptions::new().write(true).open(path).map(drop)
}

fn fill(mut file: File, bytes: &[u8], permissions: Option<std::fs::Permissions>) -> io::Result<()> {
    file.write_all(bytes)?;
    if let Some(permissions) = permissions {
        file.set_permissions(permissions)?;
    }
    Ok(())
}

/// A file that is removed unless it is published.
struct Draft {
    path: PathBuf,
    published: bool,
}

impl Draft {
    /// A new file in the folder of `target`.
    fn create(target: &Path) -> io::Result<(File, Self)> {
        let name = target.file_name().ok_or(ErrorKind::InvalidInput)?;
        for attempt in 0..NAMES {
            let mut own = std::ffi::OsString::from(".");
            own.push(name);
            own.push(format!(".{}-{attempt}.part", std::process::id()));
            let path = target.with_file_name(own);
            match OpenOptions::new().write(true).create_new(true).open(&path) {
                Ok(file) => {
                    return Ok((file, Draft { path, published: false }));
                }
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
            }
        }
        Err(ErrorKind::AlreadyExists.into())
    }

    fn publish(mut self, target: &Path) -> io::Result<()> {
        std::fs::rename(&self.path, target)?;
        self.published = true;
        Ok(())
    }
}

impl Drop for Draft {
    fn drop(&mut self) {
        if !self.published {
            // The error that brought us here is the one worth telling.
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use std::fs;

    fn names(folder: &Path) -> Vec<std::ffi::OsString> {
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()).collect()
    }

    #[test]
    fn a_file_is_made_and_replaced_and_nothing_else_left() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.svg");
        write_file(&path, b"first, and longer").unwrap();
        write_file(&path, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(names(folder.path()), ["out.svg"]);
    }

    #[test]
    fn a_failure_leaves_the_folder_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("taken");
        fs::create_dir(&target).unwrap();
        let error = write_file(&target, b"bytes").unwrap_err();
        assert!(error.to_string().starts_with(&target.display().to_string()));
        assert!(write_file(&folder.path().join("missing/out.svg"), b"bytes").is_err());
        assert_eq!(names(folder.path()), ["taken"]);
    }

    #[test]
    fn an_unpublished_draft_is_removed() {
        let folder = tempfile::tempdir().unwrap();
        let (file, draft) = Draft::create(&folder.path().join("out.svg")).unwrap();
        drop((file, draft));
        assert!(names(folder.path()).is_empty());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_keeps_pointing_at_the_file_that_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, "old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write_file(&link, b"new").unwrap();
        assert_eq!(fs::read(&file).unwrap(), b"new");
        assert!(link.symlink_metadata().unwrap().is_symlink());
    }

    #[test]
    fn a_read_only_file_stays_as_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("kept.svg");
        fs::write(&path, "kept").unwrap();
        let mut permissions = path.metadata().unwrap().permissions();
        permissions.set_readonly(true);
        fs::set_permissions(&path, permissions).unwrap();
        let error = write_file(&path, b"new").unwrap_err().to_string();
        assert_eq!(error, format!("{}: permission denied", path.display()));
        assert_eq!(fs::read(&path).unwrap(), b"kept");
        assert_eq!(names(folder.path()), ["kept.svg"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_device_is_written_to_and_stays_a_device() {
        let null = Path::new("/dev/null");
        write_file(null, b"bytes").unwrap();
        assert!(!null.metadata().unwrap().is_file());
    }
}
