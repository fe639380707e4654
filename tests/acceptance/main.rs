//! Acceptance: what the methods promise, from the mesh to the drawing.
//!
//! Each file takes one promise of the design: the product equals the judge
//! (`appel`), proposals lose nothing (`crossings`), classes of lines
//! (`features`), borders that lie on one another (`borders`), interpenetration (`intersections`), one line where several
//! coincide (`reduction`), what borders the background (`outline`), what passes in front (`passing`), what hides
//! nothing (`see_through`), what must not matter (`invariances`, `threads`),
//! and scenes that break floating-point programs, looked at once and
//! compared whole ever since (`degenerate`), and what is seen of faces
//! (`regions`), also where they lie in one plane (`flats`).
//!
//! Random scenes come from seeds, which every failure names. `UMRISS_LONG=1`
//! runs a hundred times as many.

mod appel;
mod borders;
mod crossings;
#[cfg(all(feature = "json", feature = "png"))]
mod degenerate;
mod features;
mod flats;
mod intersections;
mod invariances;
mod outline;
mod passing;
mod reduction;
mod regions;
mod scenes;
mod see_through;
#[cfg(all(feature = "json", feature = "svg", feature = "parallel"))]
#[path = "../support/split_mix.rs"]
mod split_mix;
mod threads;
