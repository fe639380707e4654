//! Object-space methods: which parts of which lines are visible, exactly.
//!
//! [`appel`] is the product, [`roberts`] the judge; neither imports the
//! other. [`reduce`] turns their common answer into the lines of a drawing.
//! [`visible_lines`] does it all.

mod appel;
mod reduce;
mod roberts;
mod visible_lines;

pub use appel::{AppelOptions, Fault, appel};
pub use reduce::{reduce, reduce_with_crossings};
pub use roberts::roberts;
pub use visible_lines::visible_lines;
