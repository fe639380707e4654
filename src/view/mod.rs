//! The contract: what methods are asked and what they answer.

mod frame;
mod visible_lines;

pub use frame::{Frame, Projection};
pub use visible_lines::{LineClass, LinePiece, LineSource, VisibleLines};
