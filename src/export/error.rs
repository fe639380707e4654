//! What can go wrong between a drawing and a file.

use std::path::PathBuf;

/// A drawing cannot be written, or a written one cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// A format that nobody here has heard of.
    #[error("`{name}` is no output format; expected one of {supported}")]
    UnknownFormat {
        /// The name or extension given.
        name: String,
        /// The formats there are.
        supported: String,
    },
    /// A format that is known, but not written by this build.
    #[error("the output format `{name}` is not supported yet; expected one of {supported}")]
    UnsupportedFormat {
        /// The name or extension given.
        name: String,
        /// The formats there are.
        supported: String,
    },
    /// A file name that does not tell the format.
    #[error("{path}: no extension to tell the output format by; expected one of {supported}")]
    NoExtension {
        /// The file.
        path: PathBuf,
        /// The formats there are.
        supported: String,
    },
    /// A file cannot be written.
    #[error("{path}: {source}")]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// More decimals than a coordinate is exact to.
    #[error("{0} decimals of a millimetre cannot be written; expected 0 to 9")]
    Precision(u8),
    /// Areas over one another, for a pen.
    #[error(
        "{0}: a painted drawing is areas over one another, and only SVG and PNG have areas; \
         expected a drawing of lines"
    )]
    Painted(&'static str),
    /// A page beyond the 16-bit numbers of plotters.
    #[error(
        "HPGL: the page of {width} x {height} mm has {units} plotter units of 0.025 mm along a \
         side; expected at most 32767, that is 819 mm"
    )]
    PlotterRange {
        /// Width of the page, mm.
        width: f64,
        /// Height of the page, mm.
        height: f64,
        /// Plotter units along the longer side.
        units: f64,
    },
    /// A stroke that leaves the page.
    #[error("HPGL: a stroke reaches the point {x}, {y} mm, which is not on the page")]
    OutsidePage {
        /// Distance from the left border of the page, mm.
        x: f64,
        /// Distance from the upper border of the page, mm.
        y: f64,
    },
    /// A page for which the plotter has no sheet.
    #[error(
        "HPGL: the {device} has no sheet for a page of {width} x {height} mm; expected one of \
         {papers}, standing or lying"
    )]
    PlotterPaper {
        /// The plotter.
        device: String,
        /// Width of the page, mm.
        width: f64,
        /// Height of the page, mm.
        height: f64,
        /// The sheets it has.
        papers: String,
    },
    /// A drawing that leaves the hard-clip limits.
    #[error("HPGL: {0}")]
    PlotterLimits(Box<Reach>),
    /// A speed that the plotter has not.
    #[error("HPGL: the {device} cannot draw at {velocity} cm/s; expected {low} to {high}")]
    PlotterVelocity {
        /// The plotter.
        device: String,
        /// The speed asked for, cm/s.
        velocity: f64,
        /// The slowest, cm/s.
        low: f64,
        /// The fastest, cm/s.
        high: f64,
    },
    /// A table of plotters that cannot be read.
    #[error("line {line} of the plotters: {message}")]
    DeviceTable {
        /// Line of the text, counted from 1.
        line: usize,
        /// What is wrong.
        message: String,
    },
    /// A plotter that cannot be.
    #[error("the plotter `{id}`: {message}")]
    Device {
        /// Its name in the table.
        id: String,
        /// What was expected.
        message: &'static str,
    },
    /// A coordinate that JSON has no number for.
    #[error("JSON: line {line} of the drawing has a coordinate that is not finite")]
    NotFinite {
        /// Index of the line, counted from 0.
        line: usize,
    },
    /// A vertex that JSON has no numbers for.
    #[error("JSON: vertex {0} of the model is not finite")]
    NotFiniteVertex(usize),
    /// A frame that JSON has no numbers for.
    #[error("JSON: the frame of the drawing has a coordinate that is not finite")]
    NotFiniteFrame,
    /// JSON that is no drawing.
    #[error("line {line}, column {column}: {message}")]
    Json {
        /// Line of the text, counted from 1.
        line: usize,
        /// Column of the text, counted from 1.
        column: usize,
        /// What is wrong.
        message: String,
    },
    /// A JSON drawing that contradicts itself.
    #[error("line {index} of the drawing: {message}")]
    Line {
        /// Index into `lines`, counted from 0.
        index: usize,
        /// What is wrong, what was expected.
        message: &'static str,
    },
    /// A crossing of lines that are not there.
    #[error("crossing {index} of the drawing: expected two different lines of its {lines}")]
    Crossing {
        /// Index into `crossings`, counted from 0.
        index: usize,
        /// How many lines there are.
        lines: usize,
    },
    /// A JSON drawing of another format.
    #[error("the format is `{0}`; expected `umriss-drawing/1`")]
    DrawingFormat(String),
    /// A JSON drawing in a unit that nobody here has heard of.
    #[error("the unit is `{0}`; expected mm, cm, m or in")]
    Unit(String),
    /// A JSON drawing with the outline of nobody knows what.
    #[error("the outline is that of `{0}`; expected scene or objects")]
    Outline(String),
    /// A JSON drawing with a frame of no known kind.
    #[error("the frame's kind is `{0}`; expected `orthographic` or `perspective`")]
    FrameKind(String),
    /// A picture of no pixels, or of more than can be held.
    #[error("PNG: a picture of {width} x {height} pixels cannot be made; expected 1 to 32767 each")]
    PictureSize {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// The SVG cannot be rendered, or the picture not be encoded.
    #[error("PNG: {0}")]
    Picture(String),
    /// A polygon file that is not what its format wants.
    #[error("line {line}: {message}")]
    Shape {
        /// Line of the text, counted from 1.
        line: usize,
        /// What is wrong, what was expected.
        message: String,
    },
    /// A file name or a name of a format that no polygons go by.
    #[error("`{0}` is no format of polygons; expected geojson, json or svg")]
    ShapeFormat(String),
    /// A format that models are read from, but not written as.
    #[error("models are not written as {0}; expected obj, off, ply, stl or json")]
    ModelFormat(String),
    /// Faces with holes, for a format that has none.
    #[error("{0} has no faces with holes, and this model has; expected json or stl")]
    Holes(&'static str),
    /// A model that is no mesh.
    #[error(transparent)]
    Mesh(#[from] crate::model::MeshError),
    /// Polygons that cannot be numbered, or have no numbers.
    #[error(transparent)]
    Coordinates(#[from] crate::polygon::clipping::ShapeError),
}

/// How far a plotter reaches, and how far a drawing would have it reach.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "with {paper} paper the {device} reaches x {} to {} and y {} to {}, that is {:.2},{:.2} to \
     {:.2},{:.2} mm of the page; the drawing needs {:.2},{:.2} to {:.2},{:.2} mm",
    x[0], x[1], y[0], y[1], from[0], from[1], to[0], to[1],
    drawn_from[0], drawn_from[1], drawn_to[0], drawn_to[1]
)]
pub struct Reach {
    /// The plotter.
    pub device: String,
    /// Its sheet.
    pub paper: String,
    /// The limits along x, plotter units.
    pub x: [f64; 2],
    /// The limits along y, plotter units.
    pub y: [f64; 2],
    /// The upper left corner of what it reaches of the page, mm.
    pub from: [f64; 2],
    /// The lower right corner of it, mm.
    pub to: [f64; 2],
    /// The upper left corner of the drawing, mm.
    pub drawn_from: [f64; 2],
    /// The lower right corner of the drawing, mm.
    pub drawn_to: [f64; 2],
}
