//! Object-space methods: which parts of which lines are visible, exactly.
//!
//! [`appel`] is the product, `roberts` the judge; neither imports the
//! other. [`reduce`] turns their common answer into the lines of a drawing.

mod appel;
mod reduce;

pub use appel::{AppelOptions, Fault, appel};
pub use reduce::reduce;
