//! The table of hashes of drawings, for this build.
//!
//! `tests/determinism` holds it against builds for tests; `cargo run --release
//! --example determinism` holds it against a build in release, with the models
//! in the folder that `UMRISS_MODELS` names, however large. It fails where one
//! byte of one drawing differs, by 1, 2 or 8 threads.

#![allow(clippy::print_stdout)]

#[path = "../../tests/cameras/mod.rs"]
mod cameras;
#[path = "../../tests/determinism/check.rs"]
mod check;
#[path = "../../tests/determinism/drawings.rs"]
mod drawings;
#[path = "../../tests/determinism/table.rs"]
mod table;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

fn main() -> Outcome<()> {
    check::repository()?;
    check::named_folder()
}
