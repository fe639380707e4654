//! Flags that say which models there are and what their numbers mean.

use clap::{Args, ValueEnum};
use umriss::model::import::Format;
use umriss::model::{Soup, Unit, UpAxis};

/// The meaning of model files, and how they become a scene.
#[derive(Args)]
#[command(next_help_heading = "Models")]
pub(crate) struct ModelFlags {
    #[command(flatten)]
    pub(crate) files: FileFlags,
    /// Merge vertices of one object that are closer than this, in the models' unit
    /// [default: only equal ones]
    #[arg(long, value_name = "TOL", value_parser = parse_distance)]
    pub(crate) weld: Option<f64>,
    /// Repair what rounding has torn: vertices go to vertices, edges and planes that are nearer than
    /// this, in the models' unit, or, with auto, than their files tell [default: nothing is repaired]
    #[arg(long, value_name = "TOL|auto", value_parser = parse_heal, conflicts_with = "weld")]
    pub(crate) heal: Option<Heal>,
}

/// The meaning of model files.
#[derive(Args)]
#[command(next_help_heading = "Models")]
pub(crate) struct FileFlags {
    /// Format of the models: obj, stl, ply, off, json or gltf [default: by content, then
    /// extension]
    #[arg(long, value_name = "F", value_parser = parse_format)]
    pub(crate) input_format: Option<Format>,
    /// Read files that a glTF model refers to outside of its own folder too, `../textures.bin` or
    /// `/data/a.bin`: for models that are trusted
    #[arg(long)]
    pub(crate) allow_outside: bool,
    /// Unit of the models' numbers [default: m for glTF, otherwise mm]
    #[arg(long, value_enum)]
    pub(crate) unit: Option<UnitName>,
    /// Axis of the models that points up [default: y for glTF, otherwise z]
    #[arg(long, value_enum)]
    pub(crate) up_axis: Option<AxisName>,
}

/// How far apart is taken for rounding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Heal {
    /// As the files tell.
    Auto,
    /// Less than this, in the models' unit.
    Within(f64),
}

impl Heal {
    /// The distance for objects, as their files have them.
    pub(crate) fn tolerance(self, objects: &[Soup]) -> f64 {
        match self {
            Heal::Auto => {
                let of = |object: &Soup| object.precision.resolution(&object.vertices);
                objects.iter().map(of).fold(0.0, f64::max)
            }
            Heal::Within(distance) => distance,
        }
    }
}

/// A unit by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum UnitName {
    /// Millimetres
    Mm,
    /// Centimetres
    Cm,
    /// Metres
    M,
    /// Inches of 25.4 mm
    In,
}

impl UnitName {
    pub(crate) fn unit(self) -> Unit {
        match self {
            UnitName::Mm => Unit::Millimetre,
            UnitName::Cm => Unit::Centimetre,
            UnitName::M => Unit::Metre,
            UnitName::In => Unit::Inch,
        }
    }
}

/// An axis by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum AxisName {
    /// (x, y, z) of the file is (x, -z, y) of the world
    Y,
    /// Coordinates are taken as they are
    Z,
}

impl AxisName {
    pub(crate) fn axis(self) -> UpAxis {
        match self {
            AxisName::Y => UpAxis::Y,
            AxisName::Z => UpAxis::Z,
        }
    }
}

fn parse_format(name: &str) -> Result<Format, String> {
    Format::from_name(name).ok_or_else(|| "expected obj, stl, ply, off, json or gltf".to_owned())
}

pub(crate) fn parse_heal(text: &str) -> Result<Heal, String> {
    match text.trim() {
        "auto" => Ok(Heal::Auto),
        number => parse_distance(number)
            .map(Heal::Within)
            .map_err(|_| "expected auto or a number greater than 0".to_owned()),
    }
}

/// A finite number greater than zero.
pub(crate) fn parse_distance(text: &str) -> Result<f64, String> {
    let number =
        text.trim().parse().ok().filter(|&number: &f64| number.is_finite() && 0.0 < number);
    number.ok_or_else(|| "expected a number greater than 0".to_owned())
}
