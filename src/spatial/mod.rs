//! Boxes and hierarchies: they propose what may meet, they never decide.
//! Every box is rounded outward, so there may be a false "maybe" and never
//! a false "no". What an occlusion map calls hidden is rounded inward: it is.

mod bounds;
mod connected;
mod crossings;
mod group;
mod hierarchy;
mod occlusion;
mod probe;
mod related;

pub use bounds::{Bounds, Rounding};
pub use crossings::{Crossings, Nearby};
pub use group::Group;
pub use hierarchy::Hierarchy;
pub use occlusion::{Grid, OcclusionMap, Placed, cover};
pub use probe::SegmentProbe;
pub use related::Related;
