//! `umriss raster`: an image of a model by one of the image-space methods.

use crate::camera_flags::CameraFlags;
use crate::failure::Failure;
use crate::model_flags::ModelFlags;
use crate::models::read_scene;
use crate::outputs::print;
use crate::sample_grid::{parse_size, samples};
use crate::session::RunFlags;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::path::{Path, PathBuf};
use umriss::export::{boxes_to_svg, pixels_to_png, to_png, write_file};
use umriss::kernel::predicates::Exact;
use umriss::model::FeatureOptions;
use umriss::raster::{Method, Show, Subdivision, methods, warnock_windows};
use umriss::run::Run;
use umriss::view::PreparedView;

const EXAMPLES: &str = "\
Examples:
  umriss raster part.stl -o part.png
  umriss raster teapot.obj --method spanning --size 1024x768 --show depth -o teapot.png
  umriss raster part.stl --method warnock --show splits -o windows.svg";

/// Make an image by one of the image-space methods.
///
/// At each pixel's centre the nearest face is found by exact signs, so that
/// all methods give the same image. The reference is ray-cast.
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
    /// What to show: face (a colour for each), depth (near is dark), shade, splits (the windows of
    /// Warnock's method)
    #[arg(long, value_name = "WHAT", default_value = "shade", value_parser = parse_picture)]
    show: Picture,
    #[command(flatten)]
    model: ModelFlags,
    #[command(flatten)]
    camera: CameraFlags,
    #[command(flatten)]
    session: RunFlags,
}

/// A line of the table of methods.
type NamedMethod = (&'static str, Method);

/// What is shown: something of every method, or what only one has.
#[derive(Clone, Copy, PartialEq)]
enum Picture {
    Buffer(Show),
    Splits,
}

impl Raster {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let is_svg = self.output.extension().is_some_and(|extension| extension == "svg");
        if self.show == Picture::Splits && self.subdivision().is_none() {
            let method = self.method.0;
            return Err(Failure::usage(format!(
                "--show splits: {method} cuts no windows, expected --method warnock or warnock-vertex"
            )));
        }
        if is_svg && self.show != Picture::Splits {
            return Err(Failure::usage("--output: only splits are drawn as SVG, expected a PNG"));
        }
        let bytes = self.session.run(|run| self.render(is_svg, run))?;
        if self.output == Path::new("-") {
            return print(&bytes);
        }
        Ok(write_file(&self.output, &bytes)?)
    }

    fn render(&self, is_svg: bool, run: &Run<'_>) -> Result<Vec<u8>, Failure> {
        let mesh = read_scene(&self.models, &self.model, &self.session, run)?.mesh;
        let view = self.camera.view(&mesh)?;
        // No lines are asked for, only what lies where.
        let options = FeatureOptions::default().with_classes(&[]);
        let prepared = PreparedView::new::<Exact>(&mesh, &view, &options, run)?;
        let question = prepared.question(false);
        let samples = samples(&question, self.size)?;
        if let (Picture::Splits, Some(subdivision)) = (self.show, self.subdivision()) {
            let (_, windows) =
                warnock_windows::<Exact>(&view, &question, &samples, subdivision, run)?;
            let boxes = windows.iter().map(|window| (window.rectangle(), window.stop.color()));
            let svg = boxes_to_svg(self.size, boxes);
            return if is_svg { Ok(svg.into_bytes()) } else { Ok(to_png(&svg, self.size[0])?) };
        }
        let show = match self.show {
            Picture::Buffer(show) => show,
            Picture::Splits => Show::Shade,
        };
        let (_, method) = self.method;
        let buffer = method(&view, &question, &samples, run)?;
        Ok(pixels_to_png(self.size, &show.colors(&mesh, &view.frame, &buffer))?)
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
    let names = methods::<Exact>().into_iter().map(|(name, _)| name);
    PossibleValuesParser::new(names).try_map(|name| {
        let found = methods::<Exact>().into_iter().find(|(other, _)| *other == name);
        found.ok_or("expected a method of the table")
    })
}

fn parse_picture(name: &str) -> Result<Picture, String> {
    let buffer = Show::ALL.into_iter().find(|show| show.name() == name).map(Picture::Buffer);
    buffer.or((name == "splits").then_some(Picture::Splits)).ok_or_else(|| {
        let names = Show::ALL.map(Show::name).join(", ");
        format!("expected one of {names}, splits")
    })
}
