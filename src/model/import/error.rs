//! What goes wrong with a model file, and where.
//!
//! Readers know positions but not file names: they return a [`Fault`], and
//! the door of this room puts the name in front of it.

use crate::run::Cancelled;
use std::fmt::{self, Display, Formatter};
use std::io;

use thiserror::Error;

/// Why a model could not be read. Its text begins with the file's name and,
/// where there is one, the position: `FILE:LINE: ...` in text,
/// `FILE: byte N: ...` in binary data, bytes counted from 0 and lines from 1.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ImportError {
    /// The file, or a file it refers to, could not be read at all.
    #[error("{file}: cannot be read: {source}")]
    Io {
        /// The file's name as the caller gave it.
        file: String,
        /// What the operating system says.
        source: io::Error,
    },
    /// A text file is wrong at a line.
    #[error("{file}:{line}: {message}")]
    Line {
        /// The file's name as the caller gave it.
        file: String,
        /// The line, counted from 1.
        line: u64,
        /// What is wrong, what was expected.
        message: String,
    },
    /// A binary file is wrong at a byte.
    #[error("{file}: byte {byte}: {message}")]
    Byte {
        /// The file's name as the caller gave it.
        file: String,
        /// The offset of the byte, counted from 0.
        byte: u64,
        /// What is wrong, what was expected.
        message: String,
    },
    /// A file refers to another that is not in its folder or below, and was
    /// not allowed to.
    #[error("{place}: {message}")]
    Outside {
        /// The file's name as the caller gave it, and the place in it.
        place: String,
        /// What is wrong, what was expected.
        message: String,
    },
    /// The file as a whole is not for us: its format is unknown or left out
    /// of this build.
    #[error("{file}: {message}")]
    Format {
        /// The file's name as the caller gave it.
        file: String,
        /// What is wrong, what was expected.
        message: String,
    },
    /// The run was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// A problem and its place, still without the name of the file.
#[derive(Debug)]
pub(super) struct Fault {
    place: Place,
    message: String,
    /// Whether this is about a file that is out of bounds.
    is_of_outside: bool,
}

#[derive(Debug)]
enum Place {
    Line(u64),
    Byte(u64),
    File,
}

/// As it stands behind the name of a file.
impl Display for Place {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Place::Line(line) => write!(f, ":{line}"),
            Place::Byte(byte) => write!(f, ": byte {byte}"),
            Place::File => Ok(()),
        }
    }
}

/// What a reader returns.
pub(super) type Read<T> = Result<T, Fault>;

impl Fault {
    /// A problem in line `line`, counted from 1.
    pub(super) fn line(line: u64, message: impl Into<String>) -> Self {
        Fault::at(Place::Line(line), message.into())
    }

    /// A problem at byte `byte`, counted from 0.
    pub(super) fn byte(byte: usize, message: impl Into<String>) -> Self {
        Fault::at(Place::Byte(byte as u64), message.into())
    }

    /// A problem of the whole file.
    pub(super) fn file(message: impl Into<String>) -> Self {
        Fault::at(Place::File, message.into())
    }

    fn at(place: Place, message: String) -> Self {
        Fault { place, message, is_of_outside: false }
    }

    /// The same as a problem of a file that is out of bounds.
    #[cfg(feature = "gltf")]
    pub(super) fn of_outside(self) -> Self {
        Fault { is_of_outside: true, ..self }
    }

    /// The same problem in line `line` of a text of which it saw only a part.
    pub(super) fn in_line(self, line: u64) -> Self {
        Fault { place: Place::Line(line), ..self }
    }

    /// The error for the caller.
    pub(super) fn named(self, file: &str) -> ImportError {
        let Fault { place, message, is_of_outside } = self;
        let file = file.to_owned();
        match place {
            _ if is_of_outside => ImportError::Outside { place: format!("{file}{place}"), message },
            Place::Line(line) => ImportError::Line { file, line, message },
            Place::Byte(byte) => ImportError::Byte { file, byte, message },
            Place::File => ImportError::Format { file, message },
        }
    }
}

/// A piece of a file for a message: in quotes, printable, not too long.
pub(super) fn quote(token: &[u8]) -> String {
    const LONGEST: usize = 40;
    let (shown, more) =
        if token.len() <= LONGEST { (token, "") } else { (&token[..LONGEST], "...") };
    format!("'{}{more}'", shown.escape_ascii())
}
