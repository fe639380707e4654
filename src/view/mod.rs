//! The contract: what methods are asked and what they answer.

mod visible_lines;

pub use crate::model::{Frame, Projection};
pub use visible_lines::{LineClass, LinePiece, LineSource, VisibleLines};
