//! # Umriss: exact hidden-line drawings of 3D models
//!
//! *Umriss* (German: outline, contour) turns polygon models into vector
//! line drawings. Whether a line is hidden is decided by the signs of
//! determinants of the input coordinates, never by a tolerance and never
//! on rounded, projected coordinates.
//!
//! The rooms of the house, ground floor first; each uses only rooms above
//! its own line (`ARCHITECTURE.md` has the map, `tests/layers.rs` checks it):
//!
//! - [`run`]: counters, progress, cancelling and limits, handed down as one value.
//! - [`kernel`]: numbers, points, exact predicates.
//! - [`spatial`]: hierarchies and crossings; they propose, they never decide.
//! - [`polygon`]: clipping, convexity, membership, triangulation of polygons with holes.
//! - [`fill`]: fills of polygons, letters and patterns, as pixels.
//! - [`model`]: files, meshes, scenes, feature edges, grids of heights.
//! - [`view`]: the contract between models, methods and drawings.
//! - [`visibility`]: the object-space methods (Roberts, Appel; Weiler and
//!   Atherton for what is seen of each face; Newell, Newell and Sancha's
//!   painter; Wright's floating horizon for surfaces over a grid).
//! - [`raster`]: the image-space references (ray casting, z-buffer, scan
//!   lines, Warnock's windows).
//! - [`drawing`]: pages, layers, dashes, polylines, fills, hatches.
//! - [`export`]: SVG, HPGL, JSON, PNG.
//! - [`verify`]: every method against the others.
//! - [`exact`]: every method with exact decisions, compiled once: what programs call.

pub mod drawing;
pub mod exact;
pub mod export;
pub mod fill;
pub mod kernel;
pub mod model;
pub mod polygon;
pub mod raster;
pub mod run;
pub mod spatial;
pub mod verify;
pub mod view;
pub mod visibility;

/// The examples of the README, run as tests.
#[cfg(all(doctest, feature = "svg"))]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
