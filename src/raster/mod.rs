//! Image-space references: what is nearest at each sample of an image, and
//! how many sheets lie in front of one point of a line.
//!
//! They are judges. Where another method could share code with them they
//! do not: candidates come from this room's own tree, counts are written
//! afresh, and only the predicates are common ground. Among themselves the
//! methods share what a sample is and sees ([`samples`]) and nothing else;
//! none knows another, and all give the same [`ItemBuffer`], bit by bit.

mod a_buffer;
mod box_tree;
mod front_to_back;
mod horizon_columns;
mod item_buffer;
mod methods;
mod picture;
mod ray_cast;
pub mod samples;
mod scanline;
mod sheets;
mod span_buffer;
#[cfg(test)]
mod tests;
mod warnock;
mod z_buffer;

pub use crate::kernel::predicates::Probe;
pub use a_buffer::{
    ABufferOptions, Division, Fragment, Fragments, MaskTable, Masks, Paint, Shading, a_buffer,
    coverage, preview, visible_fragments,
};
pub use box_tree::BoxTree;
pub use front_to_back::{OrderError, front_to_back};
pub use horizon_columns::{ColumnPieces, ColumnsError, horizon_columns};
pub use item_buffer::ItemBuffer;
pub use methods::{Method, methods};
pub use picture::Show;
pub use ray_cast::{ray_cast, ray_cast_at, ray_hits};
pub use samples::Samples;
pub use scanline::{scanline, spanning};
pub use sheets::SheetCounter;
pub use span_buffer::{Compare, c_buffer, span_buffer, span_buffer_with};
pub use warnock::{Stop, Subdivision, Window, warnock, warnock_vertex, warnock_windows};
pub use z_buffer::z_buffer;
