//! From visible lines to strokes on a page in millimetres.
//!
//! A method answers with pieces of lines in the view frame: u to the right, v
//! upwards, world units or tangents. A pen wants long strokes on a sheet of
//! paper. Between the two lie five steps, one file each:
//!
//! 0. `cropping`: a picture ends at the window asked for, a perspective one at
//!    its field of view.
//! 1. `layering`, with `styles`: every piece goes into a layer, by
//!    visibility, class or object, and by how it looks; pieces that the style
//!    leaves out go nowhere.
//! 2. `placement`: the box of what is drawn decides the scale, and its centre
//!    comes to the centre of the page; y turns downwards. Now that a
//!    millimetre is known, `haloing` interrupts lines behind others, and
//!    `weight` cuts them where their width changes.
//! 3. `merging`: pieces of one exact straight line that follow one another
//!    become one segment.
//! 4. `chaining`, with `joints`: segments that meet become polylines, as long
//!    as the drawing allows.
//!    Joints on a straight line are no points of them. `smoothing`, on
//!    request, leaves out points or fits curves within a tolerance.
//! 5. `dashing`: hidden polylines become dashes, which are real strokes,
//!    because plotters and their programs draw a dash *pattern* solid.
//!
//! 6. `ordering`, on request: the order and the sense in which a pen draws its
//!    strokes; `statistics` says how far it goes.
//!
//! Where regions are given too, `surfaces` fills what is seen of a face and
//! `hatching` covers it with lines.
//!
//! `broad_lines`, on request, makes strokes side by side of lines that are
//! wider than the pen.
//!
//! `painting` is another way altogether: faces over one another, back to front.
//!
//! `cutting`, on request too, cuts strokes to what a plotter reaches.
//!
//! Nothing is decided here: which parts of a line are seen is settled, and
//! floating point only places them. Coordinates are rounded to decimals or
//! plotter units later, once, by the exporter.

mod broad_lines;
mod chaining;
mod cropping;
mod cutting;
mod dash;
mod dashing;
mod error;
mod haloing;
mod hatching;
mod joints;
mod layering;
mod length;
mod merging;
mod options;
mod ordering;
mod page;
mod painting;
mod paper;
mod piece_part;
mod placement;
mod preset;
mod scale;
mod segments;
mod short_strokes;
mod smoothing;
mod statistics;
mod strokes;
#[cfg(feature = "devices")]
mod style_file;
mod styles;
mod surfaces;
mod weight;
mod window;

pub use dash::Dash;
pub use error::DrawingError;
pub use hatching::{Hatch, HatchAnchor, HatchTone};
pub use length::Length;
pub use options::{DrawingOptions, Hidden, HiddenBy, Join, LayerBy};
pub use ordering::Effort;
pub use page::{Content, Drawing, Layer, LayerTags, LineStyle};
pub use painting::PaintedShape;
pub use paper::Paper;
pub use preset::Preset;
pub use scale::Scale;
pub use statistics::{PenStatistics, Speeds};
pub use strokes::{Strokes, is_closed};
#[cfg(feature = "devices")]
pub use style_file::read_styles;
pub use styles::{LineRule, ObjectRule, Styles, matches};
pub use surfaces::{Fill, FilledShape, SurfaceOptions};
pub use weight::{Weight, WeightBy};
pub use window::Window;
