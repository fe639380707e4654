//! Flags that say what a surface is and which of its lines are drawn.

use crate::failure::Failure;
use crate::input::{STANDARD_INPUT, read_input};
use crate::model_flags::UnitName;
use crate::session::RunFlags;
use clap::{Args, ValueEnum};
use std::path::Path;
use umriss::model::import::{
    HeightFormat, ImportedHeights, read_heights_bytes_within, read_heights_within,
};
use umriss::model::surface::{CurveOptions, Heights, Surface, SurfaceError, SurfaceWithHoles};
use umriss::run::Run;

/// Points along an axis, unless a number is given.
const POINTS: usize = 100;

/// The range of an axis, unless another is given.
const RANGE: [f64; 2] = [-5.0, 5.0];

/// The surface.
#[derive(Args)]
#[command(next_help_heading = "Surface")]
pub(crate) struct GridFlags {
    /// Range of x [default: -5..5; of a file, its own]
    #[arg(long, value_name = "A..B", allow_hyphen_values = true, value_parser = parse_range)]
    x: Option<[f64; 2]>,
    /// Range of z, which points to the viewer of the front view [default: -5..5; of a file, its own]
    #[arg(long, value_name = "A..B", allow_hyphen_values = true, value_parser = parse_range)]
    z: Option<[f64; 2]>,
    /// Points along x, for an expression [default: 100]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..))]
    nx: Option<u32>,
    /// Points along z, for an expression [default: 100]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..))]
    nz: Option<u32>,
    /// Multiply all heights
    #[arg(long, value_name = "S", default_value_t = 1.0, allow_hyphen_values = true,
          value_parser = parse_scale)]
    z_scale: f64,
    /// Stand the surface on walls that end at this height, after scaling
    #[arg(long, value_name = "HEIGHT", allow_hyphen_values = true, value_parser = parse_number)]
    base: Option<f64>,
    /// Curves to draw: those of constant z, of constant x, or both
    #[arg(long, value_enum, value_name = "FAMILY", default_value_t = Family::Both)]
    curves: Family,
    /// Draw every Nth curve only; all of them hide
    #[arg(long, value_name = "N", default_value_t = 1,
          value_parser = clap::value_parser!(u32).range(1..))]
    every: u32,
    /// Leave out the curves at the borders, where --curves and --every do not ask for them
    #[arg(long)]
    no_borders: bool,
    /// Missing heights: refuse them, cut the grid to its largest rectangle without any, or draw
    /// holes where they are
    #[arg(long, value_enum, value_name = "HOW", default_value_t = Missing::Refuse)]
    missing: Missing,
    /// Format of files of heights: csv, asc (ESRI ASCII grid) or png [default: by content, then
    /// extension; txt is csv]
    #[arg(long, value_name = "F", value_parser = parse_format)]
    input_format: Option<HeightFormat>,
    /// Unit of the numbers [default: mm]
    #[arg(long, value_enum)]
    pub(crate) unit: Option<UnitName>,
}

/// Which curves are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Family {
    Z,
    X,
    Both,
}

/// What is done about missing heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Missing {
    Refuse,
    Cut,
    Hole,
}

/// A surface and what it is called.
pub(crate) struct Named {
    pub(crate) name: String,
    pub(crate) ground: Ground,
}

/// A surface, wherever there are heights.
pub(crate) enum Ground {
    Whole(Surface),
    WithHoles(SurfaceWithHoles),
}

impl GridFlags {
    /// Which lines are drawn.
    pub(crate) fn curves(&self) -> CurveOptions {
        CurveOptions {
            constant_z: self.curves != Family::X,
            constant_x: self.curves != Family::Z,
            diagonals: false,
            borders: !self.no_borders,
            every: self.every,
        }
    }

    /// The surfaces of expressions and files.
    pub(crate) fn surfaces(
        &self,
        sources: &[String],
        session: &RunFlags,
        run: &Run<'_>,
    ) -> Result<Vec<Named>, Failure> {
        if sources.iter().filter(|source| *source == "-").count() > 1 {
            let message = "- is given twice, but standard input can be read only once";
            return Err(Failure::usage(message));
        }
        let has_points = self.nx.is_some() || self.nz.is_some();
        if has_points && sources.iter().all(|source| self.is_file(source)) {
            return Err(Failure::usage(
                "--nx and --nz: a file has its own points, expected an expression or neither",
            ));
        }
        sources.iter().map(|source| self.surface(source, session, run)).collect()
    }

    fn surface(&self, source: &str, session: &RunFlags, run: &Run<'_>) -> Result<Named, Failure> {
        let (heights, name, file) = match self.is_file(source) {
            true => {
                let stem = Path::new(source).file_stem();
                let name = stem.map_or("stdin".into(), |stem| stem.to_string_lossy().into_owned());
                let name = if source == "-" { "stdin".to_owned() } else { name };
                (self.read(source, session, run)?, name, Some(source))
            }
            false => (self.expression(source, run)?, source.to_owned(), None),
        };
        let place = |error: SurfaceError| match (file, &error) {
            (
                Some(file),
                SurfaceError::Missing { .. } | SurfaceError::NothingLeft | SurfaceError::NoCells,
            ) => Failure::failed(format!("{file}: {}", advised(&error))),
            (
                None,
                SurfaceError::Missing { .. } | SurfaceError::NothingLeft | SurfaceError::NoCells,
            ) => Failure::failed(format!("'{source}': {}", advised(&error))),
            _ => Failure::usage(error.to_string()),
        };
        let heights = heights.scaled(self.z_scale).map_err(place)?;
        let (missing, points) = (heights.missing(), heights.values().len());
        let ground = match self.missing {
            Missing::Cut if missing > 0 => {
                let (left, cut) = heights.cut_to_complete().map_err(place)?;
                session.note(&format!(
                    "{source}: {missing} of {points} heights are missing: cut to columns {} to {}, \
                     rows {} to {}",
                    cut.columns.start + 1,
                    cut.columns.end,
                    cut.rows.start + 1,
                    cut.rows.end
                ));
                Ground::Whole(Surface::new(left, self.base).map_err(place)?)
            }
            Missing::Hole if missing > 0 => {
                session.note(&format!(
                    "{source}: {missing} of {points} heights are missing: drawn with holes"
                ));
                Ground::WithHoles(SurfaceWithHoles::new(heights, self.base).map_err(place)?)
            }
            _ => Ground::Whole(Surface::new(heights, self.base).map_err(place)?),
        };
        Ok(Named { name, ground })
    }

    /// Whether a source is a file, else it is an expression.
    fn is_file(&self, source: &str) -> bool {
        let path = Path::new(source);
        let known = HeightFormat::from_extension(path).is_some();
        source == "-" || known || self.input_format.is_some() || path.is_file()
    }

    /// The heights of a file; says what is not as it looks.
    fn read(&self, source: &str, session: &RunFlags, run: &Run<'_>) -> Result<Heights, Failure> {
        let found = if source == "-" {
            let bytes = read_input(None, run)?;
            let found = read_heights_bytes_within(STANDARD_INPUT, &bytes, self.input_format, run)?;
            run.give_back(bytes.capacity() as u64);
            found
        } else {
            read_heights_within(Path::new(source), self.input_format, run)?
        };
        let ImportedHeights { heights, warnings, has_places } = found;
        for warning in &warnings {
            session.note(&format!("{source}: {warning}"));
        }
        if self.x.is_none() && self.z.is_none() {
            let is_as_read = has_places && self.z_scale == 1.0;
            if let Some((factor, latitude)) = heights.z_factor_of_degrees().filter(|_| is_as_read) {
                session.note(&format!(
                    "{source}: places look like degrees, heights like metres: --z-scale {factor:.4e} \
                     looks right at latitude {latitude:.1}"
                ));
            }
            return Ok(heights);
        }
        let spread = |axis, range: Option<[f64; 2]>, own: &[f64]| match range {
            Some(range) => Heights::steps(axis, range, own.len()),
            None => Ok(own.to_vec()),
        };
        let xs = spread('x', self.x, heights.xs())?;
        let zs = spread('z', self.z, heights.zs())?;
        Ok(heights.moved(xs, zs)?)
    }

    fn expression(&self, text: &str, run: &Run<'_>) -> Result<Heights, Failure> {
        let count = |number: Option<u32>| number.map_or(POINTS, |number| number as usize);
        // Heights that are kept, and the list that they are collected in.
        let points = count(self.nx).saturating_mul(count(self.nz)) as u64;
        run.take(points.saturating_mul(16))?;
        let xs = Heights::steps('x', self.x.unwrap_or(RANGE), count(self.nx))?;
        let zs = Heights::steps('z', self.z.unwrap_or(RANGE), count(self.nz))?;
        Ok(Heights::of_expression(text, xs, zs)?)
    }
}

/// What to do about missing heights.
fn advised(error: &SurfaceError) -> String {
    match error {
        SurfaceError::Missing { .. } => format!("{error}, or --missing cut or hole"),
        _ => error.to_string(),
    }
}

fn parse_number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|number: &f64| number.is_finite());
    number.ok_or_else(|| "expected a number".to_owned())
}

fn parse_scale(text: &str) -> Result<f64, String> {
    let scale = parse_number(text).ok().filter(|&scale| scale != 0.0);
    scale.ok_or_else(|| "expected a number other than 0".to_owned())
}

fn parse_range(text: &str) -> Result<[f64; 2], String> {
    let ends = text.split_once("..").and_then(|(from, to)| {
        Some([parse_number(from).ok()?, parse_number(to).ok()?]).filter(|[from, to]| from < to)
    });
    ends.ok_or_else(|| "expected two growing numbers, as in -6..6".to_owned())
}

fn parse_format(name: &str) -> Result<HeightFormat, String> {
    HeightFormat::from_name(name).ok_or_else(|| "expected csv, asc or png".to_owned())
}
