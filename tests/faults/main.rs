//! Load and faults: limits that stop a run, runs and programs that are
//! cancelled, outputs that cannot be written. Nothing is left behind by any of
//! them.

#![allow(clippy::unwrap_used)]

mod cancelling;
mod crowds;
mod limits;
mod outputs;
#[cfg(unix)]
mod signals;
