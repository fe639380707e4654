//! Load and faults: limits that stop a run, runs and programs that are
//! cancelled, inputs without end, outputs that cannot be written. Nothing is left behind by any of
//! them.

#![allow(clippy::unwrap_used)]

mod cancelling;
mod crowds;
mod inputs;
mod limits;
mod outputs;
#[cfg(unix)]
mod signals;
#[path = "../support/split_mix.rs"]
mod split_mix;
