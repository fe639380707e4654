//! The exporters, on whole files.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

#[cfg(all(feature = "svg", feature = "devices"))]
mod devices;
mod fixture;
#[cfg(all(feature = "svg", feature = "json"))]
mod golden;
mod hpgl;
#[cfg(feature = "json")]
mod json;
mod promises;
mod strict_plotter;
#[cfg(feature = "png")]
mod svg;
#[cfg(feature = "svg")]
mod through_vpype;
