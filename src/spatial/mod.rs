//! Boxes and hierarchies: they propose what may meet, they never decide.
//! Every box is rounded outward, so there may be a false "maybe" and never
//! a false "no".

mod bounds;
mod crossings;
mod group;
mod hierarchy;
mod probe;

pub use bounds::{Bounds, Rounding};
pub use crossings::{Crossings, Nearby};
pub use group::Group;
pub use hierarchy::Hierarchy;
pub use probe::SegmentProbe;
