//! Models: what files say ([`Soup`]), read by [`import`].

pub mod import;
mod soup;

pub use soup::{Color, Faces, Placement, Soup, Unit, UpAxis};
