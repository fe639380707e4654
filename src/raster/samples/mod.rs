//! What a sample is and what it sees: the definition on which all
//! image-space methods agree, and nothing of how any of them gets there.
//!
//! [`Samples`] is the grid of rays, [`Sampled`] a scene under it, [`Face`] a
//! triangle as affine functions on the grid, and [`Judge`] decides about
//! faces at samples: floats propose, exact signs decide where their bound
//! does not. Ray casting asks the predicates alone and uses no form, so it
//! checks this floor together with all that stands on it.

mod face;
mod form;
mod grid;
mod sampled;

pub use face::{Border, Face, Judge};
pub use form::{Footprint, Form};
pub use grid::Samples;
pub use sampled::{Sampled, depth_on_ray};
