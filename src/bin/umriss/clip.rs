//! `umriss clip`: Boolean operations on polygons.

use crate::failure::Failure;
use crate::input::read_input;
use crate::interrupt::writing;
use crate::outputs::print;
use crate::overwriting;
use crate::session::RunFlags;
use clap::Args;
use std::path::{Path, PathBuf};
use umriss::drawing::{DrawingError, Length};
use umriss::export::{ExportError, ShapeFile, ShapeFormat, ShapeOptions, ShapePage, write_file};
use umriss::polygon::clipping::{FillRule, Operation, PlaneShape};
use umriss::run::Run;

const EXAMPLES: &str = "\
Examples:
  umriss clip land.geojson lakes.geojson --op difference -o dry.geojson
  umriss clip letters.svg frame.svg --op intersection --fill evenodd -o cut.svg
  umriss clip drawing.svg --op union --flatness 0.001mm -o outlines.svg
  umriss clip a.svg b.svg c.svg --op union -o - --format geojson

What is inside of rings that cross themselves or one another:
  In GeoJSON what is inside of the first ring of a polygon, and of none of its holes, each by
  even-odd: so an odd number of times. Polygons may overlap.
  In SVG what the shape's own fill-rule says, nonzero unless the file says evenodd.
  --fill gives all rings one rule.

SVG is read as it is displayed: what is filled, within clip paths and the page; paths, rectangles,
circles, ellipses, polygons, use, symbols, transforms, style sheets. Places become millimetres from
the upper left corner of the page, y down. Where <svg> has no width and height its units are
pixels, 96 to the inch. What is passed over is told.";

/// Combine polygons of GeoJSON and SVG files, exactly.
///
/// Rings may touch, overlap and cross in any way. Every decision is exact;
/// what is written is rounded once and still valid. SVG is written in
/// millimetres; GeoJSON's numbers are taken for millimetres beside it.
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
    /// GeoJSON, the shape's own rule for SVG]
    #[arg(long, value_name = "RULE", value_parser = parse_rule)]
    fill: Option<FillRule>,
    /// Curves of SVG become lines that are nowhere farther from them
    #[arg(long, value_name = "L", default_value = "0.005mm", value_parser = parse_flatness)]
    flatness: Length,
    /// Round places of SVG to multiples of this; 0 not at all [default: 0.00001mm for what units or
    /// transforms convert; what is written in millimetres stays as it is]
    #[arg(long, value_name = "L", value_parser = parse_length)]
    snap: Option<Length>,
    /// Take what lies off an SVG's page too
    #[arg(long)]
    off_page: bool,
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
            let files = run.stage("reading", count, || {
                let files = self.files.iter().zip(formats);
                let read = files.map(|(file, format)| self.read(file, format, run));
                read.collect::<Result<Vec<_>, _>>()
            })?;
            let page = files.iter().filter_map(|(_, file)| file.page).reduce(ShapePage::with);
            let shapes = run.stage("shapes", count, || {
                let shape = |(name, file): &(String, ShapeFile)| {
                    let shape = file.shape_within(self.fill, run);
                    run.check()?;
                    shape.map_err(|error| Failure::failed(format!("{name}: {error}")))
                };
                files.iter().map(shape).collect::<Result<Vec<_>, _>>()
            })?;
            drop(files);
            let shapes: Vec<&PlaneShape> = shapes.iter().collect();
            let operation = || PlaneShape::operation_within(self.operation, &shapes, run);
            let result = run.stage("clipping", count, operation);
            run.check()?;
            let rounded = run.stage("rounding", 1, || result?.rounded());
            Ok(format.write_on(&rounded.map_err(ExportError::from)?, page)?)
        })?;
        if is_standard(&self.output) {
            return print(text.as_bytes());
        }
        writing(|| write_file(&self.output, text.as_bytes()))
    }

    fn read(
        &self,
        file: &Path,
        format: ShapeFormat,
        run: &Run<'_>,
    ) -> Result<(String, ShapeFile), Failure> {
        let name = if is_standard(file) { "<stdin>".into() } else { file.display().to_string() };
        let bytes = read_input(Some(file).filter(|file| !is_standard(file)), run)?;
        let options = ShapeOptions {
            flatness: self.flatness.millimetres(),
            snap: self.snap.map(Length::millimetres),
            off_page: self.off_page,
        };
        let file = format.read_with(&bytes, &options).map_err(|error| match error {
            ExportError::Shape { line, message } => {
                Failure::failed(format!("{name}:{line}: {message}"))
            }
            other => Failure::failed(format!("{name}: {other}")),
        })?;
        self.tell(&name, &file);
        Ok((name, file))
    }

    /// What is passed over, and what is no longer as it was written.
    fn tell(&self, name: &str, file: &ShapeFile) {
        let note = |message: &str| self.session.note(&format!("{name}: {message}"));
        file.warnings.iter().for_each(|warning| note(warning));
        if file.is_cut_to_page
            && let Some(ShapePage { low, high }) = file.page
        {
            let [width, height] = (high - low).to_array().map(short);
            note(&format!(
                "what lies off the page of {width} x {height} mm is left out; --off-page takes it"
            ));
        }
        if file.is_in_pixels {
            note("the page has no size, so its units are pixels, 96 to the inch");
        }
        if let Some(flatness) = file.flattened {
            note(&format!("curves are lines within {flatness} mm of them (--flatness)"));
        }
        if let Some(grid) = file.rounded {
            note(&format!("places are rounded to {grid} mm (--snap)"));
        }
    }
}

/// A size for reading.
fn short(millimetres: f64) -> f64 {
    (millimetres * 1000.0).round() / 1000.0
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
    if file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("svgz")) {
        let message =
            "compressed SVG is neither read nor written, expected svg, as gunzip makes it";
        return Err(Failure::usage(format!("{}: {message}", file.display())));
    }
    match (ShapeFormat::from_path(file), given) {
        (Ok(format), _) | (Err(_), Some(format)) => Ok(format),
        (Err(error), None) => Err(Failure::usage(format!("{}: {error}", file.display()))),
    }
}

fn parse_length(text: &str) -> Result<Length, DrawingError> {
    text.parse()
}

fn parse_flatness(text: &str) -> Result<Length, String> {
    let length: Length = text.parse().map_err(|error: DrawingError| error.to_string())?;
    match length.millimetres() > 0.0 {
        true => Ok(length),
        false => Err("expected a length of more than 0".to_owned()),
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
