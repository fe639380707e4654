//! Image-space references: what is nearest at each sample of an image, and
//! how many sheets lie in front of one point of a line.
//!
//! They are judges. Where another method could share code with them they
//! do not: candidates come from this room's own tree, counts are written
//! afresh, and only the predicates are common ground.

mod box_tree;
mod item_buffer;
mod ray_cast;
mod samples;
mod sheets;
mod span_buffer;
#[cfg(test)]
mod tests;

pub use box_tree::BoxTree;
pub use item_buffer::ItemBuffer;
pub use ray_cast::ray_cast;
pub use samples::Samples;
pub use sheets::{Probe, SheetCounter};
pub use span_buffer::{Compare, c_buffer, span_buffer, span_buffer_with};
