//! `umriss draw`: from models, or from a drawing computed before, to files.

use crate::camera_flags::CameraFlags;
use crate::failure::Failure;
use crate::line_flags::{LineFlags, Method};
use crate::model_flags::{ModelFlags, UnitName};
use crate::models::{Subject, read_subject};
use crate::outputs::{Computed, OutputFlags};
use crate::page_flags::PageFlags;
use crate::pen_flags::PenFlags;
use crate::plotter_flags::{Plotter, PlotterFlags};
use crate::session::RunFlags;
use crate::stroke_flags::StrokeFlags;
use crate::surface_flags::SurfaceFlags;
use clap::Args;
use std::path::PathBuf;
use umriss::drawing::Drawing;
use umriss::export::DrawingNotes;
use umriss::kernel::predicates::Exact;
use umriss::model::Scene;
use umriss::run::Run;
use umriss::view::{ImageRegions, PreparedView, VisibleLines};
use umriss::visibility::{RegionOptions, image_regions, reduce, visible_regions};

const EXAMPLES: &str = "\
Examples:
  umriss draw part.stl -o part.svg
  umriss draw house.obj trees.obj -o scene.svg -o scene.png --view iso-sw --hidden dashed
  umriss draw part.glb -o part.hpgl --paper a3 --landscape --scale 1:2
  umriss draw part.stl -o part.hpgl --device hp7475a --margin 16mm --order best --speed 10
  umriss draw part.obj -o part.svg --eye 100,-200,80 --target 0,0,10
  umriss draw part.obj -o part.svg --fill shade --light -1,-2,3
  umriss draw part.stl -o part.hpgl -o part.svg --hatch shade --hatch-spacing 0.8mm
  umriss draw part.obj -o part.json
  umriss draw part.json -o part.svg --paper 100x100mm    (restyled, not computed again)
  umriss draw part.json -o detail.svg --frame 10,-5,30,15 --scale 5:1 --paper tight
  cat part.off | umriss draw - -o - --format svg > part.svg";

const NO_HIDDEN_LINES: &str = "\
the drawing was computed without its hidden lines: expected --hidden none, or a drawing that was \
computed with --hidden";

/// Draw models without their hidden lines.
///
/// All models are one scene. A JSON drawing in their place is put on
/// another page without computing it again: the files are the same to the
/// byte as if they were drawn from the models.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Draw {
    /// Models, or one JSON drawing; - is standard input
    #[arg(value_name = "MODEL", required = true)]
    models: Vec<PathBuf>,
    #[command(flatten)]
    outputs: OutputFlags,
    #[command(flatten)]
    model: ModelFlags,
    #[command(flatten)]
    camera: CameraFlags,
    #[command(flatten)]
    lines: LineFlags,
    /// Method that finds visible lines [default: appel]
    #[arg(long, value_enum, value_name = "M", help_heading = "Lines")]
    method: Option<Method>,
    #[command(flatten)]
    surfaces: SurfaceFlags,
    #[command(flatten)]
    page: PageFlags,
    #[command(flatten)]
    strokes: StrokeFlags,
    #[command(flatten)]
    pen: PenFlags,
    #[command(flatten)]
    plotter: PlotterFlags,
    #[command(flatten)]
    session: RunFlags,
}

impl Draw {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let outputs = self.outputs.plan()?;
        self.method.map_or(Ok(()), |method| method.check(self.page.hidden_wanted()))?;
        let plotter = self.plotter.plotter()?;
        let computed = self.session.run(|run| self.draw(&plotter, run))?;
        outputs.write(&computed, &plotter, self.page.precision)
    }

    fn draw(&self, plotter: &Plotter, run: &Run<'_>) -> Result<Computed, Failure> {
        let hidden = self.page.hidden_wanted();
        let mut regions = ImageRegions::default();
        let (lines, notes) = match read_subject(&self.models, &self.model, &self.session, run)? {
            Subject::Scene(scene) => {
                let notes = DrawingNotes { unit: Some(scene.unit), hidden: Some(hidden) };
                let lines;
                (lines, regions) = self.find(&scene, run)?;
                (lines, notes)
            }
            Subject::Drawing(drawing) => {
                let (lines, mut notes) = *drawing;
                self.refuse_flags_of_models()?;
                if hidden && notes.hidden == Some(false) {
                    return Err(Failure::usage(NO_HIDDEN_LINES));
                }
                notes.unit = self.model.unit.map(UnitName::unit).or(notes.unit);
                (lines, notes)
            }
        };
        let pieces = lines.pieces.len() as u64;
        let options = self.strokes.apply(self.page.options(notes.unit.unwrap_or_default()));
        let surfaces = self.surfaces.options();
        let mut drawing = run.stage("page", pieces, || {
            Drawing::with_regions(&lines, &regions, &surfaces, &options)
        })?;
        self.pen.apply(&mut drawing, plotter, &self.session, run);
        Ok(Computed { lines, notes, drawing })
    }

    /// The lines, and what is seen of the surfaces if that is drawn.
    fn find(&self, scene: &Scene, run: &Run<'_>) -> Result<(VisibleLines, ImageRegions), Failure> {
        let view = self.camera.view(&scene.mesh)?;
        let options = self.lines.options();
        let prepared = PreparedView::new::<Exact>(&scene.mesh, &view, &options, run)?;
        let question = prepared.question(self.page.hidden_wanted());
        let regions = match self.surfaces.any() {
            true => Some(visible_regions::<Exact>(&question, &RegionOptions::default(), run)?),
            false => None,
        };
        let method = self.method.unwrap_or(Method::Appel);
        let answer = method.answer(&question, regions.as_ref(), run)?;
        let lines = reduce::<Exact>(&question, &answer, run)?;
        let regions = match &regions {
            Some(regions) => image_regions(&question, regions)?,
            None => ImageRegions::default(),
        };
        Ok((lines, regions))
    }

    /// What a computed drawing has settled cannot be asked for again.
    fn refuse_flags_of_models(&self) -> Result<(), Failure> {
        let settled = [
            ("the camera", self.camera.any()),
            ("--crease and --edges", self.lines.any()),
            ("--method", self.method.is_some()),
            ("--fill and --hatch", self.surfaces.any()),
            ("--weld", self.model.weld.is_some()),
            ("--up-axis", self.model.up_axis.is_some()),
        ];
        match settled.into_iter().find(|(_, given)| *given) {
            Some((flag, _)) => Err(Failure::usage(format!(
                "a computed drawing cannot be computed otherwise: expected a model, or no flags \
                 for {flag}"
            ))),
            None => Ok(()),
        }
    }
}
