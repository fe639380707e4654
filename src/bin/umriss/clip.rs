//! `umriss clip`: Boolean operations on polygons.

use crate::failure::Failure;
use crate::input::read_input;
use crate::interrupt::writing;
use crate::outputs::print;
use crate::overwriting;
use crate::session::RunFlags;
use clap::Args;
use std::path::{Path, PathBuf};
use umriss::export::{ExportError, ShapeFormat, write_file};
use umriss::polygon::clipping::{FillRule, Operation, PlaneShape};
use umriss::run::Run;

const EXAMPLES: &str = "\
Examples:
  umriss clip land.geojson lakes.geojson --op difference -o dry.geojson
  umriss clip letters.svg frame.svg --op intersection --fill evenodd -o cut.svg
  umriss clip a.svg b.svg c.svg --op union -o - --format geojson";

/// Combine polygons of GeoJSON and SVG files, exactly.
///
/// Rings may touch, overlap and cross in any way. Every decision is exact;
/// what is written is rounded once and still valid.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Clip {
    /// Files of polygons, geojson, json or svg; - is standard input, with --input-format
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// What to make of them: intersection, union, difference (the first without all others), xor
    /// (what an odd number covers)
    #[arg(long = "op", value_name = "OP", value_parser = parse_operation)]
    operation: Operation,
    /// What is inside: evenodd, nonzero, positive, negative, polygons [default: polygons for
    /// GeoJSON, the path's own rule for SVG]
    #[arg(long, value_name = "RULE", value_parser = parse_rule)]
    fill: Option<FillRule>,
    /// Write the result here; the extension tells the format. With --format, - is standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Format of an output whose name does not tell it: geojson, svg
    #[arg(long, value_name = "F", value_parser = ShapeFormat::from_name)]
    format: Option<ShapeFormat>,
    /// Format of inputs whose names do not tell it: geojson, svg
    #[arg(long, value_name = "F", value_parser = ShapeFormat::from_name)]
    input_format: Option<ShapeFormat>,
    #[command(flatten)]
    session: RunFlags,
}

impl Clip {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let format = format_of(&self.output, self.format, "--output", "--format")?;
        let formats: Result<Vec<_>, _> = self
            .files
            .iter()
            .map(|file| format_of(file, self.input_format, "", "--input-format"))
            .collect();
        let formats = formats?;
        if self.files.iter().filter(|file| is_standard(file)).count() > 1 {
            let message = "- is given twice, but standard input can be read only once";
            return Err(Failure::usage(message));
        }
        let inputs = self.files.iter().map(PathBuf::as_path);
        overwriting::refuse("--output", [&*self.output], inputs)?;
        let text = self.session.run(|run| {
            let count = self.files.len() as u64;
            let shapes = run.stage("reading", count, || {
                let files = self.files.iter().zip(formats);
                let read = files.map(|(file, format)| self.read(file, format, run));
                read.collect::<Result<Vec<_>, _>>()
            })?;
            let shapes: Vec<&PlaneShape> = shapes.iter().collect();
            let operation = || PlaneShape::operation_within(self.operation, &shapes, run);
            let result = run.stage("clipping", count, operation);
            run.check()?;
            let rounded = run.stage("rounding", 1, || result?.rounded());
            Ok(format.write(&rounded.map_err(ExportError::from)?)?)
        })?;
        if is_standard(&self.output) {
            return print(text.as_bytes());
        }
        writing(|| write_file(&self.output, text.as_bytes()))
    }

    fn read(&self, file: &Path, format: ShapeFormat, run: &Run<'_>) -> Result<PlaneShape, Failure> {
        let name = if is_standard(file) { "<stdin>".into() } else { file.display().to_string() };
        let bytes = read_input(Some(file).filter(|file| !is_standard(file)), run)?;
        let file = format.read(&bytes).map_err(|error| match error {
            ExportError::Shape { line, message } => {
                Failure::failed(format!("{name}:{line}: {message}"))
            }
            other => Failure::failed(format!("{name}: {other}")),
        })?;
        file.shape(self.fill).map_err(|error| Failure::failed(format!("{name}: {error}")))
    }
}

fn is_standard(file: &Path) -> bool {
    file.as_os_str() == "-"
}

/// The format of a file: by its name, or as a flag says.
fn format_of(
    file: &Path,
    given: Option<ShapeFormat>,
    prefix: &str,
    flag: &str,
) -> Result<ShapeFormat, Failure> {
    if is_standard(file) {
        return given.ok_or_else(|| Failure::usage(format!("{prefix} - needs {flag}").trim()));
    }
    match (ShapeFormat::from_path(file), given) {
        (Ok(format), _) | (Err(_), Some(format)) => Ok(format),
        (Err(error), None) => Err(Failure::usage(format!("{}: {error}", file.display()))),
    }
}

fn parse_operation(name: &str) -> Result<Operation, String> {
    Operation::ALL.into_iter().find(|operation| operation.name() == name).ok_or_else(|| {
        format!("expected one of {}", Operation::ALL.map(Operation::name).join(", "))
    })
}

fn parse_rule(name: &str) -> Result<FillRule, String> {
    FillRule::ALL
        .into_iter()
        .find(|rule| rule.name() == name)
        .ok_or_else(|| format!("expected one of {}", FillRule::ALL.map(FillRule::name).join(", ")))
}
