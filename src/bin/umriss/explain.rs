//! `umriss explain`: which line is at a place of a drawing, and what hides it.

use crate::camera_flags::CameraFlags;
use crate::explanation::Facts;
use crate::failure::Failure;
use crate::line_flags::LineFlags;
use crate::model_flags::{ModelFlags, parse_distance};
use crate::models::read_selected;
use crate::object_flags::ObjectFlags;
use crate::outputs::print;
use crate::session::RunFlags;
use clap::Args;
use glam::DVec2;
use std::path::PathBuf;
use umriss::drawing::Styles;
use umriss::exact;
use umriss::model::Soup;
use umriss::run::Run;
use umriss::verify::Explainer;
use umriss::view::VisibleLines;
use umriss::visibility::AppelOptions;

/// The share of a picture's longer side within which a line is at a place.
const NEAR: f64 = 0.01;

const EXAMPLES: &str = "\
Examples:
  umriss explain part.stl --at 12.5,-3
  umriss explain house.obj trees.obj --at 0.2,0.1 --eye 100,-200,80
  umriss explain part.obj --at 0,0 --edges contour,mesh --json";

/// Tell which line is at a place of a drawing, and which faces hide it.
///
/// The place is given in the view frame, as in JSON drawings. The nearest
/// line, visible or hidden, is named with its piece of equal invisibility:
/// where that begins and ends, all faces in front of it, nearest first, and
/// the lines under it in the picture. Where a line lies exactly behind an
/// edge, faces are counted beside it, on the side that has more: left or
/// right, going from its first vertex to its second. Then come the faces at
/// the place itself. Vertices and faces are numbered as in JSON drawings,
/// from 0: vertices in the order of their file, faces in that of their object.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Explain {
    /// Models; - is standard input
    #[arg(value_name = "MODEL", required = true)]
    models: Vec<PathBuf>,
    /// The place in the picture, in the view frame
    #[arg(long, value_name = "U,V", allow_hyphen_values = true, value_parser = parse_place)]
    at: DVec2,
    /// Lines farther away than this, in the view frame, are not at the place [default: a
    /// hundredth of the picture's longer side]
    #[arg(long, value_name = "D", value_parser = parse_distance)]
    within: Option<f64>,
    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    model: ModelFlags,
    #[command(flatten)]
    objects: ObjectFlags,
    #[command(flatten)]
    camera: CameraFlags,
    #[command(flatten)]
    lines: LineFlags,
    #[command(flatten)]
    session: RunFlags,
}

impl Explain {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let facts = self.session.run(|run| self.explain(run))?;
        if self.json {
            let text = serde_json::to_string_pretty(&facts)
                .map_err(|error| Failure::failed(error.to_string()))?;
            print(format!("{text}\n").as_bytes())
        } else {
            print(facts.table().as_bytes())
        }
    }

    fn explain(&self, run: &Run<'_>) -> Result<Facts, Failure> {
        let styles = Styles::default();
        let select = |soups: &mut Vec<Soup>| self.objects.select(soups, &styles);
        let scene = read_selected(&self.models, &self.model, &select, &self.session, run)?;
        let view = self.camera.view(&scene.mesh)?;
        let wishes = self.objects.wishes(&scene.mesh, &self.lines.options(), &styles);
        let prepared = exact::prepare_with_wishes(&scene.mesh, &view, &wishes, run)?;
        let question = prepared.question(true);
        let answer = exact::appel(&question, &AppelOptions::default(), run)?;
        let explainer = Explainer::new(&view, &question, &answer, run)?;
        let explanation = explainer.at(self.at);
        let lines = explainer.lines();
        let within = self.within.unwrap_or_else(|| NEAR * longer_side(lines));
        Ok(Facts::new(self.at, within, lines, &explanation))
    }
}

/// The longer side of the box of all lines.
fn longer_side(lines: &VisibleLines) -> f64 {
    let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let points = lines.pieces.iter().flat_map(|piece| piece.points);
    let (low, high) = points.fold(empty, |(low, high), p| (low.min(p), high.max(p)));
    (high - low).max_element().max(0.0)
}

fn parse_place(text: &str) -> Result<DVec2, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|word| word.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[u, v]) if u.is_finite() && v.is_finite() => Ok(DVec2::new(u, v)),
        _ => Err("expected two numbers, as in 12.5,-3".to_owned()),
    }
}
