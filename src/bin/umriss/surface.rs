//! `umriss surface`: surfaces y = f(x, z) as curves without their hidden
//! parts.

use crate::camera_flags::CameraFlags;
use crate::failure::Failure;
use crate::grid_flags::{GridFlags, Ground, Named};
use crate::model_flags::UnitName;
use crate::outputs::{Computed, OutputFlags};
use crate::page_flags::PageFlags;
use crate::pen_flags::PenFlags;
use crate::plotter_flags::{Plotter, PlotterFlags};
use crate::session::RunFlags;
use crate::stroke_flags::StrokeFlags;
use crate::style_flags::StyleFlags;
use clap::{Args, ValueEnum};
use glam::DVec3;
use std::path::{Path, PathBuf};
use umriss::drawing::{
    Content, Drawing, DrawingOptions, Effort, Hidden, Preset, Styles, SurfaceOptions,
};
use umriss::exact;
use umriss::export::DrawingNotes;
use umriss::model::surface::{Curves, Surface};
use umriss::model::{FeatureOptions, LineClass, Mesh, MeshError, Soup, View};
use umriss::run::Run;
use umriss::view::{
    Crossing, ExactLines, ImageRegions, LineQuestion, ObjectWish, PreparedSurface, VisibleLines,
};
use umriss::visibility::AppelOptions;

const EXAMPLES: &str = "\
Examples:
  umriss surface 'sin(x)*cos(z)' --x -6..6 --z -6..6 --nx 200 --nz 60 -o waves.svg
  umriss surface 'exp(-(x^2+z^2)/8)*3' --curves z --no-borders --direction 0,1,-0.6 -o bell.hpgl
  umriss surface '3*cos(sqrt(x^2+z^2))' --x -9..9 --z -9..9 --base -6 --hidden dashed -o drop.svg
  umriss surface heights.csv --z-scale 2 --view iso-sw -o heights.svg -o heights.json
  umriss surface island.png --z-scale 0.002 --every 8 --eye 500,-900,400 -o island.svg
  umriss surface terrain.asc --missing cut --unit m --halo 0.8mm -o terrain.svg
  umriss surface coast.asc --missing hole --base -50 -o coast.svg
  umriss surface 'sin(x)*cos(z)' '0.4*x' --view iso --layer-by object -o two.svg
  umriss draw heights.json -o small.svg --paper a6         (restyled, not computed again)
  umriss surface --x -2..2 -o bowl.svg -- '-x^2'           (an expression that begins with -)";

const NO_OUTLINE: &str = "\
a floating horizon does not tell the outline: expected no --outline and no rule for it, or --method \
appel";

const NO_COUNTS: &str = "\
a floating horizon does not count what hides a line: expected no --hidden-by, or --method appel";

const NO_HOLES: &str = "\
a floating horizon has no holes: expected --missing cut, or no --method horizon";

const ONE_SURFACE: &str = "\
a floating horizon draws one surface: expected one, or no --method horizon";

/// Draw surfaces y = f(x, z) as curves without their hidden parts.
///
/// A surface is an expression of x and z, or a grid of heights from a file:
/// CSV, ESRI ASCII grid, PNG (grey of 16 bits, or the luminance of colours:
/// 0.2126 red + 0.7152 green + 0.0722 blue). y points up and z to the
/// viewer of the front view: (x, y, z) is (x, -z, y) for the camera.
/// Several surfaces are objects of one picture, with the lines in which
/// they pass through one another.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct SurfaceCommand {
    /// Expressions of x and z, or files of heights; - is standard input
    #[arg(value_name = "EXPR|FILE", required = true)]
    sources: Vec<String>,
    #[command(flatten)]
    outputs: OutputFlags,
    #[command(flatten)]
    grid: GridFlags,
    /// Method that finds visible lines [default: horizon; appel for several surfaces, or one with
    /// holes]
    #[arg(long, value_enum, value_name = "M")]
    method: Option<Method>,
    #[command(flatten)]
    camera: CameraFlags,
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

/// A method for surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Method {
    /// Floating horizon, for eyes that stand beside the surface
    Horizon,
    /// Quantitative invisibility, as umriss draw has it; any eye
    Appel,
}

/// Lines, and their crossings if these are wanted.
type Found = (VisibleLines, Option<Vec<Crossing>>);

impl SurfaceCommand {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let flags = [&self.camera.camera, &self.style.style, &self.plotter.devices];
        let flags = flags.into_iter().flatten().map(PathBuf::as_path);
        let outputs = self.outputs.plan(flags.chain(self.sources.iter().map(Path::new)))?;
        let plotter = self.plotter.plotter()?;
        let computed = self.session.run(|run| self.draw(&plotter, run))?;
        computed.tell_if_empty(&self.session);
        outputs.write(&computed, &plotter, &self.style.svg(self.page.precision))
    }

    fn draw(&self, plotter: &Plotter, run: &Run<'_>) -> Result<Computed, Failure> {
        let styles = self.style.styles()?;
        let options = self.options();
        let hidden = options.hidden != Hidden::None;
        let count = self.sources.len() as u64;
        let surfaces =
            run.stage("heights", count, || self.grid.surfaces(&self.sources, &self.session, run))?;
        let one = match &*surfaces {
            [Named { name, ground: Ground::Whole(surface) }] => Some((name, surface)),
            _ => None,
        };
        let by_horizon = self.by_horizon_alone(one.is_some(), surfaces.len() > 1)?;
        if by_horizon {
            self.check(&options, &styles)?;
        }
        let view = self.camera.camera()?.view(bounds(&surfaces))?;
        let (lines, crossings) = match one.filter(|_| by_horizon) {
            Some((name, surface)) => self.by_horizon(surface, name, &view, hidden, run)?,
            None => self.by_appel(&surfaces, &view, hidden, &styles, run)?,
        };
        let unit = Some(self.grid.unit.map(UnitName::unit).unwrap_or_default());
        let outline = self.style.outline_wanted(&styles);
        let notes = DrawingNotes { unit, hidden: Some(hidden), outline, crossings };
        let crossings = notes.crossings.as_deref().unwrap_or_default();
        let regions = ImageRegions::default();
        let content = Content { lines: &lines, crossings, regions: &regions };
        let surfaces = SurfaceOptions::default();
        let page = || Drawing::of_within(&content, &options, &styles, &surfaces, run);
        let mut drawing = run.stage("page", lines.pieces.len() as u64, page)?;
        self.pen.apply(&mut drawing, self.effort(), plotter, &self.session, run)?;
        Ok(Computed { lines, notes, drawing })
    }

    /// Whether a horizon draws this: if it can, unless the other method is
    /// asked for.
    fn by_horizon_alone(&self, it_can: bool, are_several: bool) -> Result<bool, Failure> {
        match self.method {
            Some(Method::Appel) => Ok(false),
            Some(Method::Horizon) if !it_can => {
                Err(Failure::usage(if are_several { ONE_SURFACE } else { NO_HOLES }))
            }
            _ => Ok(it_can),
        }
    }

    /// Refuses what a horizon does not find.
    fn check(&self, options: &DrawingOptions, styles: &Styles) -> Result<(), Failure> {
        if self.style.outline_wanted(styles).is_some() {
            return Err(Failure::usage(NO_OUTLINE));
        }
        if options.hidden_by.tells_apart() {
            return Err(Failure::usage(NO_COUNTS));
        }
        Ok(())
    }

    fn by_horizon(
        &self,
        surface: &Surface,
        name: &str,
        view: &View,
        hidden: bool,
        run: &Run<'_>,
    ) -> Result<Found, Failure> {
        let prepared = PreparedSurface::new(name, surface, view, &self.grid.curves(), run)
            .map_err(|error| match error {
                MeshError::Cancelled(error) => Failure::from(error),
                _ => Failure::usage(NO_CURVES),
            })?;
        let question = prepared.question(hidden);
        let answer = exact::floating_horizon(&question, run)?;
        self.reduced(&question.lines, &answer, run)
    }

    fn by_appel(
        &self,
        surfaces: &[Named],
        view: &View,
        hidden: bool,
        styles: &Styles,
        run: &Run<'_>,
    ) -> Result<Found, Failure> {
        let curves = self.grid.curves();
        let mut classes = vec![LineClass::Line];
        // Where surfaces pass through one another.
        classes.extend((surfaces.len() > 1).then_some(LineClass::Intersection));
        let of_surfaces = FeatureOptions::default().with_classes(&classes);
        // Walls may stand under borders of any shape: they end in contours.
        classes.push(LineClass::Contour);
        let of_walls = FeatureOptions::default().with_classes(&classes);
        let (mut soups, mut wishes) = (Vec::new(), Vec::new());
        let mut add = |soup: Soup, features| {
            soups.push(soup);
            wishes.push(ObjectWish { features, see_through: false });
        };
        for Named { name, ground } in surfaces {
            match ground {
                Ground::Whole(surface) => {
                    add(surface.soup(name, &Curves::new(surface, &curves)), of_surfaces);
                }
                Ground::WithHoles(surface) => {
                    let (soup, walls) = surface.soups(name, &curves);
                    add(soup, of_surfaces);
                    walls.into_iter().for_each(|walls| add(walls, of_walls));
                }
            }
        }
        let points = soups.iter().map(|soup| soup.vertices.len() as u64).sum();
        let mesh = run.stage("mesh", points, || Mesh::within(soups, None, run))?;
        let prepared = exact::prepare_with_wishes(&mesh, view, &wishes, run)?;
        let question = prepared.question(hidden);
        let mut answer = exact::appel(&question, &AppelOptions::default(), run)?;
        if let Some(of) = self.style.outline_wanted(styles) {
            answer = exact::outlined(&question, &answer, of, run)?;
        }
        self.reduced(&question, &answer, run)
    }

    fn reduced(
        &self,
        question: &LineQuestion<'_>,
        answer: &ExactLines,
        run: &Run<'_>,
    ) -> Result<Found, Failure> {
        if self.style.crossings_wanted() {
            let (lines, crossings) = exact::reduce_with_crossings(question, answer, run)?;
            return Ok((lines, Some(crossings)));
        }
        Ok((exact::reduce(question, answer, run)?, None))
    }

    /// What is asked of the page.
    fn options(&self) -> DrawingOptions {
        let unit = self.grid.unit.map(UnitName::unit).unwrap_or_default();
        let page = self.page.options(self.style.base(), unit);
        let options = self.style.apply(self.strokes.apply(page));
        DrawingOptions { junctions: self.pen.orders(self.effort()), ..options }
    }

    /// How strokes are put in order without a flag that says so.
    fn effort(&self) -> Effort {
        self.style.preset.map(Preset::effort).unwrap_or_default()
    }
}

/// The box around all surfaces.
fn bounds(surfaces: &[Named]) -> (DVec3, DVec3) {
    let each = surfaces.iter().map(|Named { ground, .. }| match ground {
        Ground::Whole(surface) => surface.bounds(),
        Ground::WithHoles(surface) => surface.bounds(),
    });
    let both = |(a, b): (DVec3, DVec3), (c, d): (DVec3, DVec3)| (a.min(c), b.max(d));
    each.reduce(both).unwrap_or_default()
}

/// Every grid has curves of either family.
const NO_CURVES: &str = "there is no curve to draw: expected --curves z, x or both";
