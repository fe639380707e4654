//! `umriss verify`: the proof that a drawing is right.

use crate::camera_flags::CameraFlags;
use crate::failure::Failure;
use crate::line_flags::LineFlags;
use crate::model_flags::ModelFlags;
use crate::models::read_scene;
use crate::outputs::print;
use crate::session::RunFlags;
use clap::Args;
use std::path::PathBuf;
use umriss::kernel::predicates::Exact;
use umriss::run::Run;
use umriss::verify::{Report, VerifyOptions, verify};
use umriss::view::PreparedView;
use umriss::visibility::{AppelOptions, Fault, appel};

const EXAMPLES: &str = "\
Examples:
  umriss verify part.stl
  umriss verify house.obj trees.obj --eye 100,-200,80 --picture differences.png";

/// Prove a drawing: compare it with another method and with an image.
///
/// Every piece is counted afresh, compared with Roberts' method and looked
/// for in an image. Exit code 1 if an exact check differs; the image
/// is no exact check.
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
        let report = self.session.run(|run| self.verify(run))?;
        print(report.to_string().as_bytes())?;
        if report.is_clean() {
            Ok(())
        } else {
            Err(Failure::failed("the checks differ: expected no difference"))
        }
    }

    fn verify(&self, run: &Run<'_>) -> Result<Report, Failure> {
        let scene = read_scene(&self.models, &self.model, &self.session, run)?;
        let view = self.camera.view(&scene.mesh)?;
        let options = self.lines.options();
        let prepared = PreparedView::new::<Exact>(&scene.mesh, &view, &options, run)?;
        let question = prepared.question(true);
        let answer = appel::<Exact>(&question, &AppelOptions { fault: self.fault }, run)?;
        let report = verify::<Exact>(&view, &question, &answer, &VerifyOptions::default(), run)?;
        #[cfg(feature = "png")]
        if let Some(file) = &self.picture {
            let lines = umriss::visibility::reduce::<Exact>(&question, &answer, run)?;
            let segments = report.differences().iter().map(|difference| difference.points);
            let picture = crate::picture::picture(lines, segments, scene.unit)?;
            umriss::export::write_file(file, &picture)?;
        }
        Ok(report)
    }
}

fn parse_fault(name: &str) -> Result<Fault, String> {
    Fault::ALL.into_iter().find(|fault| fault.name() == name).ok_or_else(|| {
        let names = Fault::ALL.map(Fault::name);
        format!("expected one of {}", names.join(", "))
    })
}
