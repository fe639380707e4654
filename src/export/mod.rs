//! Drawings as files, one file of code per format.
//!
//! An exporter computes no geometry. It knows its unit, its axes and its
//! syntax, and it rounds: here, once, every coordinate becomes a decimal or a
//! plotter unit. The same drawing always gives the same bytes; no file holds
//! a date, a time or the name of a machine.
//!
//! | format | from | function | feature |
//! | --- | --- | --- | --- |
//! | SVG | [`Drawing`](crate::drawing::Drawing) | `to_svg` | `svg` |
//! | HPGL | [`Drawing`](crate::drawing::Drawing) | [`to_hpgl`] | |
//! | PNG | the SVG | `to_png` | `png` |
//! | PNG | pixels | `pixels_to_png` | `png` |
//! | SVG | boxes of pixels | [`boxes_to_svg`] | |
//! | JSON | [`VisibleLines`](crate::view::VisibleLines) | `to_json`, `read_drawing` | `json` |
//!
//! [`OutputFormat`] is the table of formats by extension and by name, and
//! [`write_file`] makes files appear whole or not at all.

mod boxes;
#[cfg(feature = "svg")]
mod decimal;
mod error;
mod file;
mod format;
mod hpgl;
#[cfg(feature = "json")]
mod json;
#[cfg(feature = "json")]
mod json_reader;
#[cfg(feature = "png")]
mod png;
#[cfg(feature = "svg")]
mod svg;

pub use boxes::boxes_to_svg;
pub use error::ExportError;
pub use file::write_file;
pub use format::OutputFormat;
pub use hpgl::{PLOTTER_UNIT, to_hpgl};
#[cfg(feature = "json")]
pub use json::to_json;
#[cfg(feature = "json")]
pub use json_reader::read_drawing;
#[cfg(feature = "png")]
pub use png::{PREVIEW_WIDTH, pixels_to_png, to_png};
#[cfg(feature = "svg")]
pub use svg::{SvgOptions, to_svg};
