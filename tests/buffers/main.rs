//! Buffers of spans and of masks against rays: the same triangle at every
//! sample, whatever passes through whatever, lies in one plane with it or
//! ends on a sample.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod masks;
mod models;
#[cfg(feature = "png")]
mod pictures;
mod scenes;
mod spans;
