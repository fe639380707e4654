//! Flags that say how a pen goes about its drawing.

use crate::failure::Failure;
use crate::plotter_flags::Plotter;
use crate::session::RunFlags;
use clap::Args;
use umriss::drawing::{Drawing, DrawingError, Effort, Length, PenStatistics};
use umriss::run::Run;

/// The way of the pen.
#[derive(Args)]
#[command(next_help_heading = "Pen")]
pub(crate) struct PenFlags {
    /// Order of strokes, so that the pen travels little between them: keep, greedy, best, a
    /// number of steps to improve it, or a time as in 2s, which depends on the machine
    /// [default: keep]
    #[arg(long, value_name = "HOW", value_parser = str::parse::<Effort>)]
    order: Option<Effort>,
    /// Width of the pen: wider lines are drawn as strokes side by side, around and around, so
    /// that one pen draws lines of any width
    #[arg(long, value_name = "L", value_parser = parse_width)]
    pen_width: Option<Length>,
}

impl PenFlags {
    /// Whether any flag was given.
    pub(crate) fn any(&self) -> bool {
        self.order.is_some() || self.pen_width.is_some()
    }

    /// Whether the strokes are put in order, if `default` is what is done
    /// without a flag.
    pub(crate) fn orders(&self, default: Effort) -> bool {
        self.order.unwrap_or(default) != Effort::Keep
    }

    /// Makes strokes that the pen can draw, puts them in order and counts
    /// what drawing them takes.
    pub(crate) fn apply(
        &self,
        drawing: &mut Drawing,
        default: Effort,
        plotter: &Plotter,
        session: &RunFlags,
        run: &Run<'_>,
    ) -> Result<(), Failure> {
        if let Some(width) = self.pen_width {
            drawing.broaden(width.millimetres());
        }
        let effort = self.order.unwrap_or(default);
        if let Effort::Time(_) = effort {
            session.note("--order with a time depends on the machine: another run may differ");
        }
        let strokes = drawing.layers.iter().map(|layer| layer.strokes.len() as u64).sum();
        run.stage("pen order", strokes, || drawing.order_within(effort, run))?;
        count(&PenStatistics::of(drawing), plotter, run);
        Ok(())
    }
}

/// The width of a pen.
fn parse_width(text: &str) -> Result<Length, String> {
    let length: Length = text.parse().map_err(|error: DrawingError| error.to_string())?;
    match length.millimetres() {
        0.01..=100.0 => Ok(length),
        _ => Err("expected 0.01 mm to 100 mm".to_owned()),
    }
}

fn count(pen: &PenStatistics, plotter: &Plotter, run: &Run<'_>) {
    run.count("pen-strokes", pen.strokes as u64);
    run.count("pen-down-mm", pen.drawn.round() as u64);
    run.count("pen-up-mm", pen.pen_up.round() as u64);
    run.count("pen-seconds", pen.seconds(&plotter.speeds()).round() as u64);
}
