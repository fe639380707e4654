//! `umriss verify`: the proof that a drawing is right.

use crate::camera_flags::CameraFlags;
use crate::failure::Failure;
use crate::line_flags::LineFlags;
use crate::model_flags::ModelFlags;
use crate::models::read_scene;
use crate::outputs::print;
use crate::sample_grid::{parse_size, samples};
use crate::session::RunFlags;
use clap::Args;
use std::path::PathBuf;
use umriss::kernel::predicates::Exact;
use umriss::run::Run;
use umriss::verify::{CrossCheck, Report, VerifyOptions, cross_check, verify};
use umriss::view::PreparedView;
use umriss::visibility::{AppelOptions, Fault, appel};

const EXAMPLES: &str = "\
Examples:
  umriss verify part.stl
  umriss verify part.stl --all --size 640x480
  umriss verify house.obj trees.obj --eye 100,-200,80 --picture differences.png";

/// Prove a drawing: compare it with another method and with an image.
///
/// Every piece is counted afresh, compared with Roberts' method and looked
/// for in an image; with --all every image-space method is compared with
/// every other. Exit code 1 if an exact check differs; the image is none.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Verify {
    /// Models; - is standard input
    #[arg(value_name = "MODEL", required = true)]
    models: Vec<PathBuf>,
    /// Draw the lines, and all differences in red
    #[cfg(feature = "png")]
    #[arg(long, value_name = "FILE.png")]
    picture: Option<PathBuf>,
    /// Compare every pair of image-space methods too, at every sample
    #[arg(long)]
    all: bool,
    /// Pixels of the images that are compared
    #[arg(long, value_name = "WxH", requires = "all", default_value = "512x512",
          value_parser = parse_size)]
    size: [u32; 2],
    /// Make a mistake on purpose, to see that it is found
    #[arg(long = "break", value_name = "NAME", hide = true, value_parser = parse_fault)]
    fault: Option<Fault>,
    #[command(flatten)]
    model: ModelFlags,
    #[command(flatten)]
    camera: CameraFlags,
    #[command(flatten)]
    lines: LineFlags,
    #[command(flatten)]
    session: RunFlags,
}

impl Verify {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let (report, cross_check) = self.session.run(|run| self.verify(run))?;
        let mut text = report.to_string();
        if let Some(check) = &cross_check {
            text = format!("{text}{check}");
        }
        print(text.as_bytes())?;
        if report.is_clean() && cross_check.is_none_or(|check| check.is_clean()) {
            Ok(())
        } else {
            Err(Failure::failed("the checks differ: expected no difference"))
        }
    }

    fn verify(&self, run: &Run<'_>) -> Result<(Report, Option<CrossCheck>), Failure> {
        let scene = read_scene(&self.models, &self.model, &self.session, run)?;
        let view = self.camera.view(&scene.mesh)?;
        let options = self.lines.options();
        let prepared = PreparedView::new::<Exact>(&scene.mesh, &view, &options, run)?;
        let question = prepared.question(true);
        let answer = appel::<Exact>(&question, &AppelOptions { fault: self.fault }, run)?;
        let report = verify::<Exact>(&view, &question, &answer, &VerifyOptions::default(), run)?;
        let cross_check = match self.all {
            true => {
                let samples = samples(&question, self.size)?;
                Some(cross_check::<Exact>(&view, &question, &samples, run)?)
            }
            false => None,
        };
        #[cfg(feature = "png")]
        if let Some(file) = &self.picture {
            let lines = umriss::visibility::reduce::<Exact>(&question, &answer, run)?;
            let segments = report.differences().iter().map(|difference| difference.points);
            let segments = segments.chain(cross_check.iter().flat_map(CrossCheck::differences));
            let picture = crate::picture::picture(lines, segments, scene.unit)?;
            umriss::export::write_file(file, &picture)?;
        }
        Ok((report, cross_check))
    }
}

fn parse_fault(name: &str) -> Result<Fault, String> {
    Fault::ALL.into_iter().find(|fault| fault.name() == name).ok_or_else(|| {
        let names = Fault::ALL.map(Fault::name);
        format!("expected one of {}", names.join(", "))
    })
}
