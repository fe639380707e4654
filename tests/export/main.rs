//! The exporters, on whole files.

#![allow(clippy::unwrap_used)]

mod fixture;
#[cfg(all(feature = "svg", feature = "json"))]
mod golden;
mod hpgl;
#[cfg(feature = "json")]
mod json;
#[cfg(feature = "png")]
mod svg;
