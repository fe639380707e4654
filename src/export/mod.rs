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
//! | HPGL | [`Drawing`](crate::drawing::Drawing) | [`to_hpgl`], [`to_hpgl_with`] | table: `devices` |
//! | PNG | the SVG | `to_png` | `png` |
//! | PNG | pixels | `pixels_to_png` | `png` |
//! | SVG | boxes of pixels | [`boxes_to_svg`] | |
//! | JSON | [`VisibleLines`](crate::view::VisibleLines) | `to_json`, `read_drawing` | `json` |
//!
//! Models, lists of [`Soup`](crate::model::Soup), are written by `write_model`.
//! Polygons of the plane, [`Rounded`](crate::polygon::clipping::Rounded), are
//! written as GeoJSON and as SVG paths, and read from GeoJSON and from what an
//! SVG displays: [`ShapeFormat`], [`ShapeFile`].
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
#[cfg(feature = "json")]
mod models;
#[cfg(feature = "png")]
mod png;
#[cfg(any(feature = "json", feature = "svg"))]
mod shapes;
#[cfg(feature = "svg")]
mod svg;

pub use boxes::boxes_to_svg;
pub use error::{ExportError, Reach};
pub use file::write_file;
pub use format::OutputFormat;
#[cfg(feature = "devices")]
pub use hpgl::devices;
pub use hpgl::{
    Device, DevicePaper, HpglOptions, PLOTTER_UNIT, plotter_window, to_hpgl, to_hpgl_with,
};
#[cfg(feature = "json")]
pub use json::{DrawingNotes, to_json, to_json_with_notes};
#[cfg(feature = "json")]
pub use json_reader::{read_drawing, read_drawing_with_notes};
#[cfg(feature = "json")]
pub use models::{ModelFile, write_model};
#[cfg(feature = "png")]
pub use png::{PREVIEW_WIDTH, pixels_to_png, to_png};
#[cfg(any(feature = "json", feature = "svg"))]
pub use shapes::{ClipId, ShapeFile, ShapeFormat, ShapeOptions, ShapePage, ShapePart};
#[cfg(feature = "svg")]
pub use svg::{SvgOptions, SvgProfile, to_svg};
