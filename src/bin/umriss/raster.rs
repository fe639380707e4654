//! `umriss raster`: an image of a model by one of the image-space methods.

use crate::camera_flags::CameraFlags;
use crate::failure::Failure;
use crate::finish::FinishFlags;
use crate::interrupt::writing;
use crate::model_flags::ModelFlags;
use crate::models::read_scene;
use crate::outputs::print;
use crate::overwriting;
use crate::sample_grid::{parse_size, samples};
use crate::session::RunFlags;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::path::{Path, PathBuf};
use umriss::exact;
use umriss::export::{OutputFormat, boxes_to_svg, pixels_to_png, to_png, write_file};
use umriss::fill::{Canvas, Pattern};
use umriss::model::{Color, FeatureOptions, View};
use umriss::raster::{
    ABufferOptions, Compare, Method, OrderError, Samples, Shading, Show, Subdivision, coverage,
};
use umriss::run::Run;
use umriss::view::LineQuestion;

const EXAMPLES: &str = "\
Examples:
  umriss raster part.stl -o part.png
  umriss raster teapot.obj --method spanning --size 1024x768 --show depth -o teapot.png
  umriss raster part.stl --method a-buffer --pattern hatch --opacity 0.6 -o glass.png
  umriss raster part.stl --show face --flood 5,5,#d8e8f0 --caption 'part 7' --font sans.ttf -o p.png
  umriss raster part.stl --method warnock --show splits -o windows.svg";

/// Make an image by one of the image-space methods.
///
/// At each pixel's centre the nearest face is found by exact signs, so that
/// all methods give the same image. The reference is ray-cast. Shade by the
/// a-buffer is anti-aliased: 16 sub-pixels, each found that way.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Raster {
    /// Models; - is standard input
    #[arg(value_name = "MODEL", required = true)]
    models: Vec<PathBuf>,
    /// Write the image here; a PNG file, or an SVG file for splits. - is standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// How to find the nearest faces
    #[arg(long, value_name = "M", default_value = "z-buffer", value_parser = method_parser())]
    method: NamedMethod,
    /// Pixels of the image, from 3 to 8192 each way
    #[arg(long, value_name = "WxH", default_value = "512x512", value_parser = parse_size)]
    size: [u32; 2],
    /// What to show: face (a colour for each), depth (near is dark), shade, coverage (how much of
    /// each pixel the a-buffer finds covered), splits (the windows of Warnock's method)
    #[arg(long, value_name = "WHAT", default_value = "shade", value_parser = parse_picture)]
    show: Picture,
    /// How opaque faces are, from 0 to 1: shade by the a-buffer only
    #[arg(long, value_name = "SHARE", value_parser = parse_share)]
    opacity: Option<f32>,
    /// Pattern on the faces: hatch, cross, dots, bricks. Shade by the a-buffer only
    #[arg(long, value_name = "NAME", value_parser = parse_pattern)]
    pattern: Option<Pattern>,
    /// What the pattern stays with
    #[arg(long, value_name = "WHAT", default_value = "page", value_parser = ["page", "object"])]
    pattern_anchor: String,
    /// Where the span-buffer compares spans: start and middle are known to fail, start where
    /// triangles have a common corner, both where they pass through one another
    #[arg(long, value_name = "WHERE", value_parser = parse_compare)]
    compare: Option<Compare>,
    #[command(flatten)]
    finish: FinishFlags,
    #[command(flatten)]
    model: ModelFlags,
    #[command(flatten)]
    camera: CameraFlags,
    #[command(flatten)]
    session: RunFlags,
}

/// A method by its name.
type NamedMethod = (&'static str, Chosen);

#[derive(Clone, Copy)]
enum Chosen {
    /// One that takes any scene.
    Table(Method),
    /// The ordered span buffer, which needs an order from front to back.
    CBuffer,
}

/// All methods by name.
fn named_methods() -> impl Iterator<Item = NamedMethod> {
    let table = exact::image_methods().into_iter();
    table.map(|(name, method)| (name, Chosen::Table(method))).chain([("c-buffer", Chosen::CBuffer)])
}

/// What is shown: something of every method, or what only one has.
#[derive(Clone, Copy, PartialEq)]
enum Picture {
    Buffer(Show),
    Coverage,
    Splits,
}

impl Raster {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let is_svg = self.is_svg()?;
        if self.show == Picture::Splits && self.subdivision().is_none() {
            let method = self.method.0;
            return Err(Failure::usage(format!(
                "--show splits: {method} cuts no windows, expected --method warnock or warnock-vertex"
            )));
        }
        if self.show == Picture::Coverage && !self.is_a_buffer() {
            let method = self.method.0;
            return Err(Failure::usage(format!(
                "--show coverage: {method} sees a pixel's centre only, expected --method a-buffer"
            )));
        }
        if (self.opacity.is_some() || self.pattern.is_some()) && !self.is_preview() {
            return Err(Failure::usage(
                "--opacity, --pattern: expected --method a-buffer with --show shade",
            ));
        }
        if self.compare.is_some() && self.method.0 != "span-buffer" {
            return Err(Failure::usage("--compare: expected --method span-buffer"));
        }
        self.finish.check(self.size)?;
        if is_svg && self.show != Picture::Splits {
            return Err(Failure::usage("--output: only splits are drawn as SVG, expected a PNG"));
        }
        let flags = [&self.camera.camera, &self.finish.font];
        let inputs = self.models.iter().chain(flags.into_iter().flatten());
        overwriting::refuse("--output", [&*self.output], inputs.map(PathBuf::as_path))?;
        let bytes = self.session.run(|run| self.render(is_svg, run))?;
        if self.output == Path::new("-") {
            return print(&bytes);
        }
        writing(|| write_file(&self.output, &bytes))
    }

    /// Whether the image is to be an SVG; otherwise it is a PNG.
    fn is_svg(&self) -> Result<bool, Failure> {
        if self.output == Path::new("-") {
            return Ok(false);
        }
        match OutputFormat::from_path(&self.output) {
            Ok(OutputFormat::Png) => Ok(false),
            Ok(OutputFormat::Svg) => Ok(true),
            _ => {
                let name = self.output.display();
                Err(Failure::usage(format!(
                    "--output {name}: expected the name of a PNG, or of an SVG for --show splits"
                )))
            }
        }
    }

    fn render(&self, is_svg: bool, run: &Run<'_>) -> Result<Vec<u8>, Failure> {
        let mesh = read_scene(&self.models, &self.model, &self.session, run)?.mesh;
        let view = self.camera.view(&mesh)?;
        // No lines are asked for, only what lies where.
        let options = FeatureOptions::default().with_classes(&[]);
        let prepared = exact::prepare(&mesh, &view, &options, run)?;
        let question = prepared.question(false);
        let samples = samples(&question, self.size)?;
        if let (Picture::Splits, Some(subdivision)) = (self.show, self.subdivision()) {
            let (_, windows) =
                exact::warnock_windows(&view, &question, &samples, subdivision, run)?;
            let boxes = windows.iter().map(|window| (window.rectangle(), window.stop.color()));
            let svg = boxes_to_svg(self.size, boxes);
            return if is_svg { Ok(svg.into_bytes()) } else { Ok(to_png(&svg, self.size[0])?) };
        }
        let show = match self.show {
            Picture::Buffer(show) if !self.is_preview() => show,
            _ => {
                let canvas = self.anti_aliased(&view, &question, &samples, run)?;
                let color = |&[red, green, blue, _]: &[u8; 4]| Color([red, green, blue]);
                let colors = canvas.pixels().iter().map(color).collect();
                let colors = self.finish.apply(self.size, colors)?;
                return Ok(pixels_to_png(self.size, &colors)?);
            }
        };
        let buffer = match self.method {
            (_, Chosen::CBuffer) => {
                let order = exact::front_to_back(&question, run).map_err(|error| match error {
                    OrderError::Cancelled(error) => Failure::from(error),
                    _ => Failure::failed(format!("c-buffer: {error}, expected another method")),
                })?;
                exact::c_buffer(&view, &question, &samples, &order, run)?
            }
            (_, Chosen::Table(method)) => match self.compare {
                Some(compare) => exact::span_buffer_with(&view, &question, &samples, compare, run)?,
                None => method(&view, &question, &samples, run)?,
            },
        };
        let colors = show.colors(&mesh, &view.frame, &buffer);
        Ok(pixels_to_png(self.size, &self.finish.apply(self.size, colors)?)?)
    }

    /// What the A-buffer shows.
    fn anti_aliased(
        &self,
        view: &View,
        question: &LineQuestion<'_>,
        samples: &Samples,
        run: &Run<'_>,
    ) -> Result<Canvas, Failure> {
        let options = ABufferOptions::default();
        if self.show == Picture::Coverage {
            let fragments = exact::visible_fragments(view, question, samples, options, run)?;
            return Ok(coverage(&fragments));
        }
        let mut shading = Shading::new(view, question).with_opacity(self.opacity.unwrap_or(1.0));
        if let Some(pattern) = self.pattern.clone() {
            shading = match self.pattern_anchor.as_str() {
                "object" => shading.with_pattern_of_objects(pattern, samples),
                _ => shading.with_pattern(pattern),
            };
        }
        let paint = |triangle, at| shading.paint(triangle, at);
        let canvas = exact::preview(view, question, samples, options, &paint, run)?;
        Ok(canvas.on([255; 3]))
    }

    fn is_a_buffer(&self) -> bool {
        self.method.0 == "a-buffer"
    }

    /// Whether the anti-aliased picture is asked for.
    fn is_preview(&self) -> bool {
        self.is_a_buffer() && self.show == Picture::Buffer(Show::Shade)
    }

    /// How the method cuts windows, if it does.
    fn subdivision(&self) -> Option<Subdivision> {
        match self.method.0 {
            "warnock" => Some(Subdivision::Regular),
            "warnock-vertex" => Some(Subdivision::Vertex),
            _ => None,
        }
    }
}

/// Takes what is in the table.
fn method_parser() -> impl TypedValueParser<Value = NamedMethod> {
    let names = named_methods().map(|(name, _)| name);
    PossibleValuesParser::new(names).try_map(|name| {
        let found = named_methods().find(|(other, _)| *other == name);
        found.ok_or("expected a method of the table")
    })
}

fn parse_picture(name: &str) -> Result<Picture, String> {
    match name {
        "splits" => return Ok(Picture::Splits),
        "coverage" => return Ok(Picture::Coverage),
        _ => {}
    }
    let buffer = Show::ALL.into_iter().find(|show| show.name() == name).map(Picture::Buffer);
    buffer.ok_or_else(|| {
        let names = Show::ALL.map(Show::name).join(", ");
        format!("expected one of {names}, coverage, splits")
    })
}

fn parse_compare(name: &str) -> Result<Compare, String> {
    match name {
        "start" => Ok(Compare::Start),
        "middle" => Ok(Compare::Middle),
        "crossings" => Ok(Compare::Crossings),
        _ => Err("expected start, middle or crossings".to_owned()),
    }
}

fn parse_share(text: &str) -> Result<f32, String> {
    let share = text.parse().ok().filter(|share| (0.0..=1.0).contains(share));
    share.ok_or_else(|| "expected a number from 0 to 1".to_owned())
}

fn parse_pattern(name: &str) -> Result<Pattern, String> {
    Pattern::from_name(name).ok_or_else(|| "expected hatch, cross, dots or bricks".to_owned())
}
