//! `umriss verify`: the proof that a drawing is right.

use crate::camera_flags::CameraFlags;
use crate::failure::Failure;
use crate::line_flags::LineFlags;
use crate::model_flags::ModelFlags;
use crate::models::read_scene;
use crate::outputs::print;
#[cfg(feature = "png")]
use crate::overwriting;
use crate::sample_grid::{parse_size, samples};
use crate::session::RunFlags;
use clap::Args;
use std::path::PathBuf;
use umriss::exact;
use umriss::run::Run;
use umriss::verify::{
    CrossCheck, PaintReport, PaintVerifyOptions, RegionReport, RegionVerifyOptions, Report,
    VerifyOptions,
};
use umriss::visibility::{AppelOptions, Fault, PainterFault, RegionFault};

const EXAMPLES: &str = "\
Examples:
  umriss verify part.stl
  umriss verify part.stl --all --size 640x480
  umriss verify house.obj trees.obj --eye 100,-200,80 --picture differences.png";

/// What is to be told where a way of the painter was not checked.
const LEFT_OUT: &str = "\
some ways of the painter were left out, for they take too many cuts: --painting-cuts all checks them";

/// Prove a drawing: compare it with another method and with an image.
///
/// Every piece is counted afresh, compared with Roberts' method and looked
/// for in an image; with --all every image-space method is compared with
/// every other. Up to --regions triangles, what is seen of each face is found
/// too: compared with the images of all faces, with rays, and with the lines;
/// and up to --painting triangles faces are brought into the painter's order,
/// each way, which is compared pair by pair, by areas, and with rays; ways that
/// take more than --painting-cuts cuts are left out, and told.
/// Exit code 1 if an exact check differs; the image is none.
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
    /// Check what is seen of each face up to this many triangles
    #[arg(long, value_name = "N", default_value_t = RegionVerifyOptions::default().up_to)]
    regions: usize,
    /// Check the painter's order of faces up to this many triangles
    #[arg(long, value_name = "N", default_value_t = PaintVerifyOptions::default().up_to)]
    painting: usize,
    /// Leave out ways of the painter that take more than this many cuts: a number, or all to
    /// check every way whatever it takes
    #[arg(long, value_name = "N", value_parser = parse_cuts, default_value = "2500")]
    painting_cuts: CutsFlag,
    /// Make a mistake on purpose, to see that it is found
    #[arg(long = "break", value_name = "NAME", hide = true, value_parser = parse_mistake)]
    mistake: Option<Mistake>,
    #[command(flatten)]
    model: ModelFlags,
    #[command(flatten)]
    camera: CameraFlags,
    #[command(flatten)]
    lines: LineFlags,
    #[command(flatten)]
    session: RunFlags,
}

/// How many cuts the painter may make, if there is a limit.
#[derive(Debug, Clone, Copy)]
struct CutsFlag(Option<usize>);

fn parse_cuts(text: &str) -> Result<CutsFlag, String> {
    match text.trim() {
        "all" => Ok(CutsFlag(None)),
        number => match number.parse() {
            Ok(most) => Ok(CutsFlag(Some(most))),
            Err(_) => Err("expected a number of cuts, or all".to_owned()),
        },
    }
}

/// A mistake in one of the methods.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mistake {
    Lines(Fault),
    Regions(RegionFault),
    Painting(PainterFault),
}

/// Everything that was found.
struct Reports {
    lines: Report,
    regions: RegionReport,
    painting: PaintReport,
    images: Option<CrossCheck>,
}

impl Reports {
    fn is_clean(&self) -> bool {
        self.lines.is_clean()
            && self.regions.is_clean()
            && self.painting.is_clean()
            && self.images.as_ref().is_none_or(CrossCheck::is_clean)
    }
}

impl Verify {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        #[cfg(feature = "png")]
        self.check_picture()?;
        let reports = self.session.run(|run| self.verify(run))?;
        let mut text = format!("{}{}{}", reports.lines, reports.regions, reports.painting);
        if let Some(check) = &reports.images {
            text = format!("{text}{check}");
        }
        print(text.as_bytes())?;
        if reports.painting.rows.iter().any(|row| row.left_out.is_some()) {
            self.session.note(LEFT_OUT);
        }
        if reports.is_clean() {
            Ok(())
        } else {
            Err(Failure::failed("the checks differ: expected no difference"))
        }
    }

    /// The picture is a PNG, and replaces nothing that is read.
    #[cfg(feature = "png")]
    fn check_picture(&self) -> Result<(), Failure> {
        let Some(picture) = &self.picture else { return Ok(()) };
        if !picture.extension().is_some_and(|word| word.eq_ignore_ascii_case("png")) {
            let name = picture.display();
            return Err(Failure::usage(format!("--picture {name}: expected the name of a PNG")));
        }
        let inputs = self.models.iter().chain(&self.camera.camera);
        overwriting::refuse("--picture", [&**picture], inputs.map(PathBuf::as_path))
    }

    fn verify(&self, run: &Run<'_>) -> Result<Reports, Failure> {
        let scene = read_scene(&self.models, &self.model, &self.session, run)?;
        let view = self.camera.view(&scene.mesh)?;
        let options = self.lines.options();
        let prepared = exact::prepare(&scene.mesh, &view, &options, run)?;
        let question = prepared.question(true);
        let fault = match self.mistake {
            Some(Mistake::Lines(fault)) => Some(fault),
            _ => None,
        };
        let answer =
            exact::appel(&question, &AppelOptions { fault, ..AppelOptions::default() }, run)?;
        let lines = exact::verify(&view, &question, &answer, &VerifyOptions::default(), run)?;
        let fault = match self.mistake {
            Some(Mistake::Regions(fault)) => Some(fault),
            _ => None,
        };
        let options = RegionVerifyOptions { up_to: self.regions, fault, ..Default::default() };
        let regions = exact::verify_regions(&view, &question, &answer, &options, run)?;
        let fault = match self.mistake {
            Some(Mistake::Painting(fault)) => Some(fault),
            _ => None,
        };
        let CutsFlag(most_cuts) = self.painting_cuts;
        let options =
            PaintVerifyOptions { up_to: self.painting, most_cuts, fault, ..Default::default() };
        let painting = exact::verify_painting(&view, &question, &options, run)?;
        let images = match self.all {
            true => {
                let samples = samples(&question, self.size)?;
                Some(exact::cross_check(&view, &question, &samples, run)?)
            }
            false => None,
        };
        #[cfg(feature = "png")]
        if let Some(file) = &self.picture {
            let drawn = exact::reduce(&question, &answer, run)?;
            let segments = lines.differences().iter().map(|difference| difference.points);
            let segments = segments.chain(regions.differences());
            let segments = segments.chain(images.iter().flat_map(CrossCheck::differences));
            let picture = crate::picture::picture(drawn, segments, scene.unit)?;
            crate::interrupt::writing(|| umriss::export::write_file(file, &picture))?;
        }
        Ok(Reports { lines, regions, painting, images })
    }
}

fn parse_mistake(name: &str) -> Result<Mistake, String> {
    let (forget, depth) = (RegionFault::ForgetOccluder, PainterFault::DepthOnly);
    if name == forget.name() {
        return Ok(Mistake::Regions(forget));
    }
    if name == depth.name() {
        return Ok(Mistake::Painting(depth));
    }
    let fault = Fault::ALL.into_iter().find(|fault| fault.name() == name);
    fault.map(Mistake::Lines).ok_or_else(|| {
        let names = Fault::ALL.map(Fault::name);
        format!("expected one of {}, {}, {}", names.join(", "), forget.name(), depth.name())
    })
}
