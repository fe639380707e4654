//! Flags that say which lines are wanted and who finds out what hides them.

use crate::failure::Failure;
use clap::{Args, ValueEnum};
use umriss::exact;
use umriss::model::{FeatureOptions, LineClass};
use umriss::run::Run;
use umriss::view::{ExactLines, LineQuestion, VisibleRegions};
use umriss::visibility::{AppelOptions, RegionOptions};

/// Which edges are lines.
#[derive(Args)]
#[command(next_help_heading = "Lines")]
pub(crate) struct LineFlags {
    /// Folds of more than this are creases [default: 30]
    #[arg(long, value_name = "DEG", value_parser = parse_fold)]
    crease: Option<f64>,
    /// Surfaces that pass through one another at more than this make a line [default: as --crease]
    #[arg(long, value_name = "DEG", value_parser = parse_fold)]
    intersections: Option<f64>,
    /// Draw the borders of objects where two share one and go on smoothly, as groups of one
    /// surface do
    #[arg(long)]
    seams: bool,
    /// Classes to draw, separated by commas: contour, boundary, crease, non-manifold,
    /// intersection, line (OBJ l), mesh (every other edge) [default: all but mesh]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = parse_class)]
    edges: Option<Vec<LineClass>>,
}

impl LineFlags {
    /// Whether any flag was given.
    pub(crate) fn any(&self) -> bool {
        self.crease.is_some() || self.intersections.is_some() || self.seams || self.edges.is_some()
    }

    /// What the library is asked for.
    pub(crate) fn options(&self) -> FeatureOptions {
        let mut options = FeatureOptions::default();
        if let Some(degrees) = self.crease {
            options = options.with_crease_degrees(degrees);
        }
        if let Some(degrees) = self.intersections {
            options = options.with_intersection_degrees(degrees);
        }
        if let Some(classes) = &self.edges {
            options = options.with_classes(classes);
        }
        options.with_seams(self.seams)
    }
}

/// A method that finds visible lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Method {
    /// Quantitative invisibility
    Appel,
    /// Each line against each face that may hide it; slow, to compare with
    Roberts,
    /// The borders of what is seen of each face; visible lines only, and only those of faces
    WeilerAtherton,
    /// Faces over one another, back to front, with their lines; SVG and PNG only
    Painter,
}

impl Method {
    /// Refuses wishes that a method cannot fulfil.
    pub(crate) fn check(self, hidden_wanted: bool) -> Result<(), Failure> {
        match self {
            Method::WeilerAtherton if hidden_wanted => Err(Failure::usage(
                "--method weiler-atherton: regions know nothing of hidden lines, expected \
                 --hidden none or --method appel",
            )),
            Method::Painter if hidden_wanted => Err(Failure::usage(
                "--method painter: what is painted over is gone, expected --hidden none or \
                 --method appel",
            )),
            _ => Ok(()),
        }
    }

    /// Asks the method; `regions` are what is seen of the faces, where that
    /// is known already.
    pub(crate) fn answer(
        self,
        question: &LineQuestion<'_>,
        regions: Option<&VisibleRegions>,
        run: &Run<'_>,
    ) -> Result<ExactLines, Failure> {
        self.check(question.hidden_wanted)?;
        match (self, regions) {
            (Method::Roberts, _) => Ok(exact::roberts(question, None, run)?),
            (Method::WeilerAtherton, Some(regions)) => {
                Ok(exact::region_lines(question, regions, run)?)
            }
            (Method::WeilerAtherton, None) => {
                let options = RegionOptions::default();
                let regions = exact::visible_regions(question, &options, run)?;
                Ok(exact::region_lines(question, &regions, run)?)
            }
            _ => Ok(exact::appel(question, &AppelOptions::default(), run)?),
        }
    }
}

/// Degrees of a fold.
pub(crate) fn parse_fold(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|angle| (0.0..=180.0).contains(angle));
    number.ok_or_else(|| "expected degrees from 0 to 180".to_owned())
}

fn parse_class(name: &str) -> Result<LineClass, String> {
    LineClass::from_name(name.trim()).ok_or_else(|| {
        let names = LineClass::ALL.map(LineClass::name);
        format!("expected some of {}", names.join(","))
    })
}
