//! `umriss verify`: the proof that a drawing is right.

use crate::camera_flags::CameraFlags;
use crate::failure::Failure;
use crate::line_flags::LineFlags;
use crate::model_flags::ModelFlags;
use crate::models::read_scene;
use crate::session::RunFlags;
use clap::Args;
use std::path::PathBuf;
use umriss::kernel::predicates::Exact;
use umriss::model::View;
use umriss::run::Run;
use umriss::view::{ExactLines, LineQuestion, PreparedView};
use umriss::visibility::{AppelOptions, Fault, appel};

const EXAMPLES: &str = "\
Examples:
  umriss verify part.stl
  umriss verify house.obj trees.obj --eye 100,-200,80 --picture differences.png";

/// Prove a drawing: compare every method with the others and with an image.
///
/// Exit code 1 if there is a difference.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Verify {
    /// Models; - is standard input
    #[arg(value_name = "MODEL", required = true)]
    models: Vec<PathBuf>,
    /// Draw the lines, and differences in red
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
        self.session.run(|run| {
            let scene = read_scene(&self.models, &self.model, &self.session, run)?;
            let view = self.camera.view(&scene.mesh)?;
            let options = self.lines.options();
            let prepared = PreparedView::new::<Exact>(&scene.mesh, &view, &options, run)?;
            let question = prepared.question(true);
            let answer = appel::<Exact>(&question, &AppelOptions { fault: self.fault }, run)?;
            prove(&view, &question, &answer, run)
        })
    }
}

/// Compares the answer with all that is known about it.
fn prove(
    _view: &View,
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    _run: &Run<'_>,
) -> Result<(), Failure> {
    let (pieces, lines) = (answer.piece_count(), question.lines.len());
    Err(Failure::failed(format!(
        "{pieces} pieces of {lines} lines were found, but this build has nothing to compare them \
         with"
    )))
}

fn parse_fault(name: &str) -> Result<Fault, String> {
    Fault::ALL.into_iter().find(|fault| fault.name() == name).ok_or_else(|| {
        let names = Fault::ALL.map(Fault::name);
        format!("expected one of {}", names.join(", "))
    })
}
