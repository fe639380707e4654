//! The exporters, on whole files.

mod fixture;
#[cfg(all(feature = "svg", feature = "json"))]
mod golden;
mod hpgl;
#[cfg(feature = "json")]
mod json;
#[cfg(feature = "png")]
mod svg;
