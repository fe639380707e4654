//! Buffers of spans and of masks against rays: the same triangle at every
//! sample, whatever passes through whatever, lies in one plane with it or
//! ends on a sample.

#![allow(clippy::unwrap_used)]

mod masks;
mod models;
mod scenes;
mod spans;
