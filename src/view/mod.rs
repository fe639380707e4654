//! The contract between models, methods and drawings: what a method is
//! asked ([`LineQuestion`]) and what it answers ([`ExactLines`], rounded
//! and reduced to [`VisibleLines`]), [`VisibleRegions`] or a [`PaintOrder`].
//! The lines of a grid of heights are asked for by a [`SurfaceQuestion`].

mod covered;
mod crossing;
mod exact_lines;
mod outline;
mod painting;
mod prepare;
mod probing;
mod question;
mod regions;
mod skips;
mod surface;
mod visible_lines;
mod wishes;

pub use crate::model::{Frame, LineClass, Projection};
pub(crate) use covered::Covered;
pub use crossing::Crossing;
pub use exact_lines::{ExactLines, ExactPiece};
pub use outline::OutlineOf;
pub use painting::{PaintOrder, PaintedFace, PaintedPiece};
pub use prepare::PreparedView;
pub use probing::ProbedLine;
pub use question::{Contacts, LineQuestion};
pub use regions::{ImageRegion, ImageRegions, Region, VisibleRegions};
pub use skips::{Culling, Skips};
pub use surface::{PreparedSurface, SurfaceQuestion};
pub use visible_lines::{LinePiece, LineSource, VisibleLines};
pub use wishes::ObjectWish;
