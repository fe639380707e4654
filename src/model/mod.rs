//! Models: what files say ([`Soup`]), read by [`import`].

mod frame;
pub mod import;
mod soup;

pub use frame::{Frame, Projection};
pub use soup::{Color, Faces, Placement, Soup, Unit, UpAxis};
