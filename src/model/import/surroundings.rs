//! Where the files are that a file refers to.

use std::path::Path;

/// What a file may refer to.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(not(feature = "gltf"), allow(dead_code))]
pub(super) struct Surroundings<'a> {
    /// The folder of the file; without one, all has to be in the file.
    pub(super) folder: Option<&'a Path>,
    /// Whether files that are not in this folder or below may be read too.
    pub(super) allow_outside: bool,
}
