//! What a long computation is given from outside, as one value: where to
//! count, whom to tell about progress, when to stop, how much to use.
//!
//! There are no globals in this crate. A [`Run`] is made by the caller and
//! lent to every stage; [`Run::default`] counts, reports to nobody and never
//! stops.

mod counters;
mod limits;
mod parallel;
mod progress;
mod reading;
mod sample;

pub use counters::{Counters, StageTime};
pub use limits::{Cancelled, Growing, Limits};
pub use parallel::{
    concat_map, fill_indexed, join_lists, map_chunks, map_indexed, map_parts, map_small, sort_by,
};
pub use progress::{Progress, Run, Silent};
pub use sample::sample;
