//! Object-space methods: which parts of which lines are visible, exactly.
//!
//! [`appel`] is the product, [`roberts`] the judge; neither imports the
//! other. [`outlined`] tells outer outlines from other lines, [`reduce`] turns
//! the common answer into the lines of a drawing. [`visible_lines`] does it
//! all. [`visible_regions`] finds what is seen of each face, [`paint_order`] an
//! order in which faces may be painted over one another. [`floating_horizon`]
//! draws surfaces over a grid, and nothing else, soonest.

mod appel;
mod floating_horizon;
mod outline;
mod painter;
mod reduce;
mod roberts;
mod ties;
mod visible_lines;
mod weiler_atherton;

pub use crate::view::{Culling, Skips};
pub use appel::{AppelOptions, Fault, appel};
pub use floating_horizon::{HorizonError, floating_horizon};
pub use outline::outlined;
pub use painter::{
    PaintTree, Painter, PainterError, PainterFault, PainterOptions, paint_order, painted_image,
};
pub(crate) use reduce::reduce_with_origins;
pub use reduce::{reduce, reduce_with_crossings};
pub use roberts::roberts;
pub use visible_lines::visible_lines;
pub use weiler_atherton::{
    RegionFault, RegionOptions, RegionsError, image_regions, region_lines, visible_regions,
};
