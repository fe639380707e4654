//! Reads files and standard input that may have no end.

use crate::failure::Failure;
use std::fs::File;
use std::io::{self, ErrorKind, stdin};
use std::path::Path;
use umriss::run::Run;

/// The name under which standard input goes in messages.
pub(crate) const STANDARD_INPUT: &str = "<stdin>";

/// All bytes of a file, or of standard input where there is no path, as long
/// as `--max-memory` allows for them. Their capacity was taken from the run.
pub(crate) fn read_input(path: Option<&Path>, run: &Run<'_>) -> Result<Vec<u8>, Failure> {
    let read = || match path {
        None => run.read_all(stdin().lock(), 0, u64::MAX),
        Some(path) => {
            let file = File::open(path)?;
            let size = file.metadata()?.len();
            run.read_all(file, size, u64::MAX)
        }
    };
    let bytes = read().map_err(|error| {
        let name = path.map_or(STANDARD_INPUT.to_owned(), |path| path.display().to_string());
        Failure::failed(format!("{name}: cannot be read: {error}"))
    })?;
    run.check()?;
    Ok(bytes)
}

/// A file of settings larger than this is none.
const MOST_OF_SETTINGS: u64 = 1 << 26;

/// All bytes of a file of settings: cameras, styles, plotters, fonts.
pub(crate) fn read_settings(path: &Path) -> io::Result<Vec<u8>> {
    let bytes = Run::default().read_all(File::open(path)?, 0, MOST_OF_SETTINGS + 1)?;
    if MOST_OF_SETTINGS < bytes.len() as u64 {
        return Err(ErrorKind::FileTooLarge.into());
    }
    Ok(bytes)
}

/// The same as text.
pub(crate) fn read_settings_text(path: &Path) -> io::Result<String> {
    io::read_to_string(&*read_settings(path)?)
}
