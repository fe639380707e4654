//! The same drawing, byte by byte: for every number of threads, in debug and
//! in release, today and after the next change.
//!
//! `hashes.txt` has a line for each drawing: the number of its pieces and two
//! FNV-1a hashes of the JSON drawing as `umriss draw -o x.json` writes it, one
//! of everything up to the counters, which is the drawing, and one of the
//! counters, which tell how it was found. So a shortcut that saves work is
//! seen to change the second and nothing else. The models are those in
//! `examples/models`, from the front, from the top, isometric, from a direction
//! that is nobody's, and in perspective; for small models every edge and the
//! hidden parts too. Each is drawn by 1, 2 and 8 threads.
//!
//! There is one table for all builds. Rust neither contracts nor reorders
//! operations on floats, and sums whose order matters are made of parts of
//! fixed sizes. What may differ is the mathematical library, which differs
//! between systems, not between builds: `tan` of the field of view, which
//! stands in the frame of a perspective drawing, `cos` of a crease angle,
//! rounded to few bits, and `log2`, of which only the whole part is used.
//! Powers of two by `powi` are exact however they are made.
//! `cargo run --release --example determinism` compares a build in release with
//! the same tables.
//!
//! `UMRISS_BLESS=1` writes the table anew; look at what has changed before
//! keeping it: where pieces are as many as before, digits changed.
//!
//! `named_folder.txt` is a second table, of the models in the folder that
//! `UMRISS_MODELS` names, with the cameras in its folder `cameras`: builds for
//! tests draw those of up to 20 000 triangles, builds in release all. A row
//! names the content of the model's file by its hash, so models that the table
//! does not know are compared between numbers of threads, and told.

#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "../cameras/mod.rs"]
mod cameras;
mod check;
mod drawings;
mod program;
mod table;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

#[test]
fn drawings_are_those_of_the_table_for_every_number_of_threads() -> Outcome<()> {
    check::repository()
}

#[test]
fn models_of_the_named_folder_are_drawn_as_in_their_table() -> Outcome<()> {
    check::named_folder()
}
