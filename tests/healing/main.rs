//! What healing promises: how far things move, that nothing depends on the
//! order of a file, and that what was torn is one again.

#![allow(clippy::unwrap_used)]

mod junctions;
mod promises;
mod scenes;
#[path = "../support/split_mix.rs"]
mod split_mix;
mod torn;
