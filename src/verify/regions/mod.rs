//! The proof of visible regions: areas, owners, borders, one file each.
//!
//! - *area*: the regions overlap nowhere and together are the images of all
//!   faces. Not sums of areas but sets are compared, in one exact overlay of
//!   everything: a place that is in two regions, in a region but in no image,
//!   or in an image but in no region is a difference, however small.
//! - *owner*: samples of an image made by casting rays; the region of the
//!   face that a ray meets first contains the sample, exactly.
//! - *border*: the pieces of lines that regions show, against the visible
//!   pieces of the answer, places compared exactly.
//!
//! What lies between the eye and the near plane neither shows nor hides, for
//! all three.

mod areas;
mod borders;
mod owners;
mod report;

pub use report::{RegionReport, RegionTally};

use super::places;
use crate::kernel::predicates::Policy;
use crate::model::View;
use crate::raster::Samples;
use crate::run::{Cancelled, Run};
use crate::view::{ExactLines, LineQuestion};
use crate::visibility::{RegionFault, RegionOptions, RegionsError, region_lines, visible_regions};
use areas::check_areas;
use borders::check_borders;
use owners::check_owners;

/// Lines or samples per task.
const PART: usize = 128;

/// How thorough a verification of regions is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RegionVerifyOptions {
    /// Up to this many triangles there is one.
    pub up_to: usize,
    /// Samples along the longer side of the image.
    pub image_size: u32,
    /// A mistake to make.
    pub fault: Option<RegionFault>,
}

impl Default for RegionVerifyOptions {
    /// Up to 20 000 triangles; an image of 128 samples.
    fn default() -> Self {
        RegionVerifyOptions { up_to: 20_000, image_size: 128, fault: None }
    }
}

/// Finds what is seen of every face and checks it, and the visible pieces of
/// an answer against the lines that they show.
///
/// Expected O(n log n + k log k) for n triangles and k crossings of all
/// images, hidden ones too.
///
/// # Errors
///
/// If the run is cancelled.
pub fn verify_regions<P: Policy>(
    view: &View,
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    options: &RegionVerifyOptions,
    run: &Run<'_>,
) -> Result<RegionReport, Cancelled> {
    let mut report = RegionReport::default();
    let triangles = question.mesh.triangles().len();
    if triangles > options.up_to {
        report.skipped = Some(format!("{triangles} triangles, more than {}", options.up_to));
        return Ok(report);
    }
    let regions = visible_regions::<P>(question, &RegionOptions { fault: options.fault }, run);
    let regions = match regions {
        Ok(regions) => regions,
        Err(RegionsError::Cancelled(cancelled)) => return Err(cancelled),
        Err(other) => {
            report.skipped = Some(other.to_string());
            return Ok(report);
        }
    };
    run.stage("verify-areas", regions.regions().len() as u64, || {
        check_areas::<P>(question, &regions, &mut report, run);
    });
    run.check()?;
    let count = question.mesh.vertices().len() as u32;
    let samples = Samples::around(question.frame, question.coordinates, count, options.image_size);
    if let Some(samples) = samples {
        report.append(check_owners::<P>(view, question, &regions, &samples, run)?);
    }
    match region_lines::<P>(question, &regions, run) {
        Ok(borders) => report.append(check_borders::<P>(question, answer, &borders, run)?),
        Err(RegionsError::Cancelled(cancelled)) => return Err(cancelled),
        Err(other) => {
            report.border.differ += 1;
            report.describe(format!("border: {other}"));
        }
    }
    Ok(report)
}
