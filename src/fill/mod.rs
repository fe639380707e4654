//! Fills of the plane: polygons, outlines of letters, patterns and floods,
//! as samples of a small picture.
//!
//! These are tools of two dimensions. Vertices are snapped to 1/256 of a
//! pixel, once, and from there on everything is exact in 64-bit integers; a
//! pixel is filled if its centre is inside. A centre on an edge belongs to
//! the polygon right of the edge, or below it where the edge is level, so
//! polygons side by side share no pixel and leave none out. (Samples of
//! scenes are decided elsewhere, on what was not snapped.)
//!
//! - [`fill_polygon`]: edge table and active edges, by [`Rule`]; each edge's
//!   starts of spans by integer increments (Swanson and Thayer 1986);
//! - [`fill_triangle`]: edge functions (Pineda 1988);
//! - [`flag_fill`] and [`xor_fill`]: the same fill by two other ways, which
//!   check the first;
//! - [`flood`]: what is connected with a seed;
//! - [`Pattern`]: repeated over the page, or with an object;
//! - [`Outline`] and [`Font`]: curves and letters.

mod canvas;
mod edges;
mod flags;
mod flood;
mod outline;
mod pattern;
mod polygon;
#[cfg(feature = "text")]
mod text;
mod triangle;

pub use canvas::{Canvas, Rgba};
pub use edges::SpanStarts;
pub use flags::flag_fill;
pub use flood::{Connected, flood};
pub use outline::Outline;
pub use pattern::{Anchor, Pattern};
pub use polygon::{Contours, Rule, SUBPIXELS, fill_polygon};
#[cfg(feature = "text")]
pub use text::{Font, FontError};
pub use triangle::{fill_triangle, xor_fill};
