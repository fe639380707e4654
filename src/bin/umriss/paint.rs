//! `umriss draw --method painter`: faces over one another, back to front.

use crate::failure::Failure;
use clap::Args;
use umriss::drawing::{Drawing, DrawingOptions, Styles, SurfaceOptions};
use umriss::exact;
use umriss::run::Run;
use umriss::view::{LineQuestion, VisibleLines};
use umriss::visibility::{Painter, PainterOptions, painted_image};

/// Why a plotter cannot have it.
pub(crate) const NO_PLOTTER: &str = "\
--method painter: a pen cannot paint over what it drew, expected an SVG or PNG output, or --method \
appel";

/// Why it is no drawing of lines.
pub(crate) const NO_LINES: &str = "\
--method painter: JSON is for visible lines, and painted ones go on behind other faces, expected an \
SVG or PNG output, or --method appel";

/// What no face has.
pub(crate) const LINES_LEFT_OUT: &str = "\
--method painter draws the edges of faces: loose lines and lines in which faces pass through one \
another are left out";

/// A wish for what lines have that are drawn by themselves.
pub(crate) fn lines_only(flag: &str) -> String {
    format!(
        "--method painter: lines are drawn face by face, expected no flags for {flag}, or --method \
         appel"
    )
}

/// How faces are brought into order.
#[derive(Args)]
#[command(next_help_heading = "Lines")]
pub(crate) struct PaintFlags {
    /// How --method painter finds its order: graph (cuts faces only where they are in a cycle),
    /// list (sorts, marks and cuts, as Newell, Newell and Sancha did) or tree (a binary space
    /// partition) [default: graph]
    #[arg(long, value_name = "HOW", value_parser = parse)]
    painter: Option<Painter>,
}

impl PaintFlags {
    /// Without the method there is no order to be found.
    pub(crate) fn refuse(&self) -> Result<(), Failure> {
        match self.painter {
            Some(_) => Err(Failure::usage("--painter needs --method painter")),
            None => Ok(()),
        }
    }

    /// The lines of all faces, and the painted page.
    pub(crate) fn paint(
        &self,
        question: &LineQuestion<'_>,
        options: &DrawingOptions,
        styles: &Styles,
        surfaces: &SurfaceOptions,
        run: &Run<'_>,
    ) -> Result<(VisibleLines, Drawing), Failure> {
        let painter = self.painter.unwrap_or_default();
        let painter = PainterOptions { painter, ..PainterOptions::default() };
        let order = exact::paint_order(question, &painter, run)?;
        let count = order.pieces.len() as u64;
        let (faces, lines) =
            run.stage("painted-image", count, || painted_image(question, &order))?;
        let page = || Drawing::painted(&faces, &lines, options, styles, surfaces);
        let drawing = run.stage("page", count, page)?;
        Ok((lines, drawing))
    }
}

fn parse(name: &str) -> Result<Painter, String> {
    Painter::from_name(name)
        .ok_or_else(|| format!("expected one of {}", Painter::ALL.map(Painter::name).join(", ")))
}
