//! Where drawings go: files by their extension, standard output by name.
//!
//! Every output is rendered in memory before the first is written, so that
//! whatever cannot be drawn leaves nothing behind.

use crate::failure::Failure;
use crate::interrupt::writing;
use crate::overwriting;
use crate::plotter_flags::Plotter;
use crate::session::RunFlags;
use clap::Args;
use glam::DVec2;
use std::io::{ErrorKind, Write, stdout};
use std::path::{Path, PathBuf};
use umriss::drawing::Drawing;
use umriss::export::{
    DrawingNotes, ExportError, OutputFormat, SvgOptions, to_json_with_notes, to_svg, write_file,
};
use umriss::view::VisibleLines;

/// Flags of commands that draw.
#[derive(Args)]
pub(crate) struct OutputFlags {
    /// Write the drawing here, more than once if wanted; the extension tells the format: svg,
    /// hpgl, plt, json, png. With --format, - is standard output
    #[arg(short, long = "output", value_name = "FILE", required = true)]
    output: Vec<PathBuf>,
    /// Format of outputs whose name does not tell it: svg, hpgl, json, png
    #[arg(long, value_name = "F", value_parser = OutputFormat::from_name)]
    format: Option<OutputFormat>,
}

/// An output and its format.
struct Output<'a> {
    /// Nothing for standard output.
    path: Option<&'a Path>,
    format: OutputFormat,
}

/// What is written.
pub(crate) struct Computed {
    pub(crate) lines: VisibleLines,
    pub(crate) notes: DrawingNotes,
    pub(crate) drawing: Drawing,
}

/// All outputs, checked before anything is computed.
pub(crate) struct Outputs<'a> {
    outputs: Vec<Output<'a>>,
}

impl OutputFlags {
    /// Finds out what is to be written where; none of it may be one of the
    /// files that are read.
    pub(crate) fn plan<'a>(
        &self,
        inputs: impl IntoIterator<Item = &'a Path>,
    ) -> Result<Outputs<'_>, Failure> {
        for (index, path) in self.output.iter().enumerate() {
            if self.output[..index].contains(path) {
                let path = path.display();
                return Err(Failure::usage(format!("--output {path} is given twice")));
            }
        }
        let outputs: Result<_, Failure> =
            self.output.iter().map(|path| self.output(path)).collect();
        let outputs = Outputs { outputs: outputs? };
        let paths: Vec<&Path> = self.output.iter().map(|path| &**path).collect();
        overwriting::refuse("--output", paths, inputs.into_iter().collect::<Vec<_>>())?;
        Ok(outputs)
    }

    fn output<'a>(&self, path: &'a Path) -> Result<Output<'a>, Failure> {
        if path.as_os_str() == "-" {
            let Some(format) = self.format else {
                return Err(Failure::usage("--output - needs --format to say what to write"));
            };
            return Ok(Output { path: None, format });
        }
        let format = match (OutputFormat::from_path(path), self.format) {
            (Ok(format), _) => format,
            (
                Err(ExportError::NoExtension { .. } | ExportError::UnknownFormat { .. }),
                Some(format),
            ) => format,
            (Err(error), _) => return Err(Failure::usage(format!("--output: {error}"))),
        };
        Ok(Output { path: Some(path), format })
    }
}

impl Computed {
    /// Tells the user where there is nothing to see: the outputs are written
    /// all the same, as empty as they are.
    pub(crate) fn tell_if_empty(&self, session: &RunFlags) {
        let Drawing { layers, fills, painting, .. } = &self.drawing;
        if !(layers.is_empty() && fills.is_empty() && painting.is_empty()) {
            return;
        }
        let points = || self.lines.pieces.iter().flat_map(|piece| piece.points);
        if points().next().is_none() {
            session.note("nothing is drawn: no line is in the picture");
            return;
        }
        let low = points().fold(DVec2::INFINITY, DVec2::min);
        let high = points().fold(DVec2::NEG_INFINITY, DVec2::max);
        session.note(&format!(
            "nothing is drawn on the page; the lines reach from {:?},{:?} to {:?},{:?}",
            low.x, low.y, high.x, high.y
        ));
    }
}

impl Outputs<'_> {
    /// Whether some output has this format.
    pub(crate) fn any(&self, format: OutputFormat) -> bool {
        self.outputs.iter().any(|output| output.format == format)
    }

    /// Renders everything, then writes everything.
    pub(crate) fn write(
        &self,
        computed: &Computed,
        plotter: &Plotter,
        svg: &SvgOptions,
    ) -> Result<(), Failure> {
        let mut rendered = Vec::with_capacity(self.outputs.len());
        for output in &self.outputs {
            rendered.push(render(output.format, computed, plotter, svg)?);
        }
        for (output, bytes) in self.outputs.iter().zip(&rendered) {
            match output.path {
                Some(path) => writing(|| write_file(path, bytes))?,
                None => print(bytes)?,
            }
        }
        Ok(())
    }
}

fn render(
    format: OutputFormat,
    computed: &Computed,
    plotter: &Plotter,
    options: &SvgOptions,
) -> Result<Vec<u8>, Failure> {
    let Computed { lines, notes, drawing } = computed;
    let svg = || to_svg(drawing, options);
    match format {
        OutputFormat::Svg => Ok(svg()?.into_bytes()),
        OutputFormat::Hpgl => Ok(plotter.hpgl(drawing)?.into_bytes()),
        OutputFormat::Json => Ok(to_json_with_notes(lines, notes)?),
        OutputFormat::Png => picture(&svg()?),
    }
}

#[cfg(feature = "png")]
fn picture(svg: &str) -> Result<Vec<u8>, Failure> {
    use umriss::export::{PREVIEW_WIDTH, to_png};
    Ok(to_png(svg, PREVIEW_WIDTH)?)
}

#[cfg(not(feature = "png"))]
fn picture(_: &str) -> Result<Vec<u8>, Failure> {
    Err(Failure::usage("this build cannot make pictures, expected one with the feature png"))
}

/// Writes to standard output.
pub(crate) fn print(bytes: &[u8]) -> Result<(), Failure> {
    let mut out = stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Ok(()) => Ok(()),
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Err(Failure::ReaderGone),
        Err(error) => Err(Failure::failed(format!("<stdout>: cannot be written: {error}"))),
    }
}
