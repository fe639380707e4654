//! `umriss draw`: from models, or from a drawing computed before, to files.

use crate::camera_flags::CameraFlags;
use crate::failure::Failure;
use crate::line_flags::{LineFlags, Method};
use crate::model_flags::{ModelFlags, UnitName};
use crate::models::{Subject, read_subject};
use crate::object_flags::ObjectFlags;
use crate::outputs::{Computed, OutputFlags, Outputs};
use crate::page_flags::PageFlags;
use crate::paint::{self, PaintFlags};
use crate::pen_flags::PenFlags;
use crate::plotter_flags::{Plotter, PlotterFlags};
use crate::session::RunFlags;
use crate::stroke_flags::StrokeFlags;
use crate::style_flags::StyleFlags;
use crate::surface_flags::SurfaceFlags;
use clap::Args;
use std::path::PathBuf;
use umriss::drawing::{Content, Drawing, DrawingOptions, Effort, Hidden, Preset, Styles, Window};
use umriss::exact;
use umriss::export::{DrawingNotes, OutputFormat};
use umriss::model::{LineOrigin, Scene, Soup, View};
use umriss::run::Run;
use umriss::view::{Crossing, ImageRegions, VisibleLines};
use umriss::visibility::{RegionOptions, image_regions};

const EXAMPLES: &str = "\
Examples:
  umriss draw part.stl -o part.svg
  umriss draw house.obj trees.obj -o scene.svg -o scene.png --view iso-sw --hidden dashed
  umriss draw part.glb -o part.hpgl --paper a3 --landscape --scale 1:2
  umriss draw part.stl -o part.hpgl --device hp7475a --margin 16mm --order best --speed 10
  umriss draw part.obj -o part.svg --eye 100,-200,80 --target 0,0,10
  umriss draw part.obj -o part.svg --fill shade --light -1,-2,3
  umriss draw part.obj -o part.svg --method painter --fill shade
  umriss draw part.stl -o part.hpgl -o part.svg --hatch shade --hatch-spacing 0.8mm
  umriss draw part.obj -o part.json
  umriss draw part.json -o part.svg --paper 100x100mm    (restyled, not computed again)
  umriss draw part.obj -o part.svg --halo 0.8mm --weight 0.7..0.18mm
  umriss draw part.obj -o part.svg --outline 0.7mm
  umriss draw part.json -o detail.svg --frame 10,-5,30,15 --scale 5:1 --paper tight
  cat part.off | umriss draw - -o - --format svg > part.svg";

const NO_HIDDEN_LINES: &str = "\
the drawing was computed without its hidden lines: expected --hidden none, or a drawing that was \
computed with --hidden";

const NO_CROSSINGS: &str = "\
the drawing was computed without its crossings: expected no --halo, or a drawing that was computed \
with --halo";

const NO_OUTLINE: &str = "\
the drawing was computed without its outline: expected no --outline and no rule for it, or a drawing \
that was computed with --outline";

const OPAQUE_ONLY: &str = "\
objects are seen through by lines only: expected no --see-through with --fill, --hatch or --method \
weiler-atherton";

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
    objects: ObjectFlags,
    #[command(flatten)]
    camera: CameraFlags,
    #[command(flatten)]
    lines: LineFlags,
    /// Method that finds visible lines [default: appel]
    #[arg(long, value_enum, value_name = "M", help_heading = "Lines")]
    method: Option<Method>,
    #[command(flatten)]
    paint: PaintFlags,
    #[command(flatten)]
    surfaces: SurfaceFlags,
    #[command(flatten)]
    page: PageFlags,
    #[command(flatten)]
    style: StyleFlags,
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
        let flags = [&self.camera.camera, &self.style.style, &self.plotter.devices];
        let inputs = self.models.iter().chain(flags.into_iter().flatten());
        let outputs = self.outputs.plan(inputs.map(PathBuf::as_path))?;
        let plotter = self.plotter.plotter()?;
        self.refuse_what_is_not_painted(&outputs)?;
        let all_lines = outputs.any(OutputFormat::Json);
        let computed = self.session.run(|run| self.draw(&plotter, all_lines, run))?;
        computed.tell_if_empty(&self.session);
        outputs.write(&computed, &plotter, &self.style.svg(self.page.precision))
    }

    /// `all_lines`, or those that the page shows.
    fn draw(&self, plotter: &Plotter, all_lines: bool, run: &Run<'_>) -> Result<Computed, Failure> {
        let hidden = self.options(&DrawingNotes::default()).hidden != Hidden::None;
        self.method.map_or(Ok(()), |method| method.check(hidden))?;
        let styles = self.style.styles()?;
        let paints = self.method == Some(Method::Painter);
        let select = |soups: &mut Vec<Soup>| self.objects.select(soups, &styles);
        let subject = read_subject(&self.models, &self.model, &select, &self.session, run)?;
        let mut regions = ImageRegions::default();
        let (lines, notes) = match subject {
            Subject::Scene(scene) if paints => return self.paint(&scene, &styles, run),
            Subject::Scene(scene) => {
                let (lines, crossings);
                (lines, crossings, regions) =
                    self.find(&scene, [hidden, all_lines], &styles, run)?;
                let (unit, hidden) = (Some(scene.unit), Some(hidden));
                let outline = self.style.outline_wanted(&styles);
                (lines, DrawingNotes { unit, hidden, outline, crossings })
            }
            Subject::Drawing(drawing) => {
                let (lines, mut notes) = *drawing;
                self.refuse_flags_of_models()?;
                if hidden && notes.hidden == Some(false) {
                    return Err(Failure::usage(NO_HIDDEN_LINES));
                }
                if self.style.crossings_wanted() && notes.crossings.is_none() {
                    return Err(Failure::usage(NO_CROSSINGS));
                }
                if self.style.outline_wanted(&styles).is_some() && notes.outline.is_none() {
                    return Err(Failure::usage(NO_OUTLINE));
                }
                notes.unit = self.model.files.unit.map(UnitName::unit).or(notes.unit);
                (lines, notes)
            }
        };
        let pieces = lines.pieces.len() as u64;
        let options = self.options(&notes);
        let crossings = notes.crossings.as_deref().unwrap_or_default();
        let content = Content { lines: &lines, crossings, regions: &regions };
        let surfaces = self.surfaces.options();
        let page = || Drawing::of_within(&content, &options, &styles, &surfaces, run);
        let mut drawing = run.stage("page", pieces, page)?;
        self.pen.apply(&mut drawing, self.effort(), plotter, &self.session, run)?;
        Ok(Computed { lines, notes, drawing })
    }

    /// What is asked of the page.
    fn options(&self, notes: &DrawingNotes) -> DrawingOptions {
        let page = self.page.options(self.style.base(), notes.unit.unwrap_or_default());
        let options = self.style.apply(self.strokes.apply(page));
        DrawingOptions { junctions: self.pen.orders(self.effort()), ..options }
    }

    /// How strokes are put in order without a flag that says so.
    fn effort(&self) -> Effort {
        self.style.preset.map(Preset::effort).unwrap_or_default()
    }

    /// The lines, their crossings if these are wanted, and what is seen of
    /// the surfaces if that is drawn.
    fn find(
        &self,
        scene: &Scene,
        [hidden, all_lines]: [bool; 2],
        styles: &Styles,
        run: &Run<'_>,
    ) -> Result<(VisibleLines, Option<Vec<Crossing>>, ImageRegions), Failure> {
        let view = self.camera.view(&scene.mesh)?;
        let wishes = self.objects.wishes(&scene.mesh, &self.lines.options(), styles);
        let method = self.method.unwrap_or(Method::Appel);
        let opaque_only = self.surfaces.any() || method == Method::WeilerAtherton;
        if opaque_only && wishes.iter().any(|wish| wish.see_through) {
            return Err(Failure::usage(OPAQUE_ONLY));
        }
        let lines_alone = method == Method::Appel
            && !self.surfaces.any()
            && self.style.outline_wanted(styles).is_none();
        let prepared = match lines_alone && !hidden {
            true => exact::prepare_for_visible_lines(&scene.mesh, &view, &wishes, run)?,
            false => exact::prepare_with_wishes(&scene.mesh, &view, &wishes, run)?,
        };
        let question = prepared.question(hidden);
        let regions = match self.surfaces.any() {
            true => Some(exact::visible_regions(&question, &RegionOptions::default(), run)?),
            false => None,
        };
        let window = self.window(scene, &view, styles);
        if let Some(window) = window.filter(|_| method == Method::Appel && !all_lines) {
            let part = question.within(window.low(), window.high());
            let answer = method.answer(&part, None, run)?;
            let lines = exact::reduce(&part, &answer, run)?;
            // If none is in the window it is told where they all are.
            if lines.pieces.iter().any(|piece| window.shows(piece, view.frame.projection)) {
                return Ok((lines, None, ImageRegions::default()));
            }
        }
        let mut answer = method.answer(&question, regions.as_ref(), run)?;
        if let Some(of) = self.style.outline_wanted(styles) {
            answer = exact::outlined(&question, &answer, of, run)?;
        }
        let (lines, crossings) = if self.style.crossings_wanted() {
            let (lines, crossings) = exact::reduce_with_crossings(&question, &answer, run)?;
            (lines, Some(crossings))
        } else {
            (exact::reduce(&question, &answer, run)?, None)
        };
        let regions = match &regions {
            Some(regions) => image_regions(&question, regions)?,
            None => ImageRegions::default(),
        };
        Ok((lines, crossings, regions))
    }

    /// The part of the image that the page shows, if what lies outside of it
    /// has no part in how that is drawn.
    fn window(&self, scene: &Scene, view: &View, styles: &Styles) -> Option<Window> {
        let notes = DrawingNotes { unit: Some(scene.unit), ..DrawingNotes::default() };
        let options = self.options(&notes);
        // Widths follow the depths of all lines.
        let alone = !self.surfaces.any()
            && self.style.outline_wanted(styles).is_none()
            && !self.style.crossings_wanted()
            && options.weight.is_none();
        options.window_in(&view.frame).filter(|_| alone)
    }

    /// The scene painted back to front.
    fn paint(&self, scene: &Scene, styles: &Styles, run: &Run<'_>) -> Result<Computed, Failure> {
        let view = self.camera.view(&scene.mesh)?;
        let wishes = self.objects.wishes(&scene.mesh, &self.lines.options(), styles);
        if wishes.iter().any(|wish| wish.see_through) {
            return Err(Failure::usage(OPAQUE_ONLY));
        }
        let prepared = exact::prepare_with_wishes(&scene.mesh, &view, &wishes, run)?;
        let question = prepared.question(false);
        let is_of_faces = |origin| matches!(origin, LineOrigin::Edge(_) | LineOrigin::Stretch(_));
        if !question.lines.iter().all(|line| is_of_faces(line.origin)) {
            self.session.note(paint::LINES_LEFT_OUT);
        }
        let notes = DrawingNotes { unit: Some(scene.unit), ..DrawingNotes::default() };
        let (options, surfaces) = (self.options(&notes), self.surfaces.options());
        let (lines, drawing) = self.paint.paint(&question, &options, styles, &surfaces, run)?;
        Ok(Computed { lines, notes, drawing })
    }

    /// A pen cannot paint over what it drew, and lines that are painted over
    /// are not cut where they end.
    fn refuse_what_is_not_painted(&self, outputs: &Outputs<'_>) -> Result<(), Failure> {
        if self.method != Some(Method::Painter) {
            return self.paint.refuse();
        }
        if outputs.any(OutputFormat::Hpgl) {
            return Err(Failure::usage(paint::NO_PLOTTER));
        }
        if outputs.any(OutputFormat::Json) {
            return Err(Failure::usage(paint::NO_LINES));
        }
        let flag = self
            .style
            .of_lines_only()
            .or(self.strokes.any().then_some("--merge, --join, --simplify, --fit and --min-length"))
            .or(self.surfaces.hatches().then_some("--hatch"))
            .or(self.pen.any().then_some("--order and --pen-width"));
        match flag {
            Some(flag) => Err(Failure::usage(paint::lines_only(flag))),
            None => Ok(()),
        }
    }

    /// What a computed drawing has settled cannot be asked for again.
    fn refuse_flags_of_models(&self) -> Result<(), Failure> {
        let settled = [
            ("the camera", self.camera.any()),
            ("--crease, --intersections, --seams and --edges", self.lines.any()),
            ("--method", self.method.is_some()),
            ("--outline-of", self.style.outline_of.is_some()),
            ("objects", self.objects.any()),
            ("--fill and --hatch", self.surfaces.any()),
            ("--weld and --heal", self.model.weld.is_some() || self.model.heal.is_some()),
            ("--up-axis", self.model.files.up_axis.is_some()),
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
