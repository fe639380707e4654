//! The proof of painting orders: areas, pairs and owners, one file each.
//!
//! - *area*: the pieces of a face have together the area of the face, as
//!   rationals. Where a near plane cuts faces there is no such sum.
//! - *order*: of each two pieces whose images have an area in common, the later
//!   one is the nearer throughout that area, or lies in one plane with the
//!   other and is preferred by the tie rule. Pieces of one face have none.
//! - *owner*: samples of an image made by casting rays; the piece that is
//!   painted last at a sample is of the face that a ray meets first, exactly.
//!
//! The first two prove the picture wherever one looks, but on borders, and by
//! nothing but the planes of the pieces; the third shares nothing with the
//! painter but its predicates.

mod areas;
mod owners;
mod pairs;
mod report;

pub use report::{PaintReport, PaintTally, PainterRow};

use crate::kernel::predicates::{Policy, Predicates};
use crate::model::View;
use crate::raster::samples::Sampled;
use crate::raster::{Samples, ray_cast};
use crate::run::{Cancelled, Run};
use crate::spatial::Bounds;
use crate::view::{LineQuestion, PaintOrder, PaintedPiece};
use crate::visibility::{Painter, PainterError, PainterFault, PainterOptions, paint_order};
use areas::check_areas;
use owners::check_owners;
use pairs::check_pairs;
use std::ops::Range;

/// Pieces or samples per task.
const PART: usize = 128;

/// How thorough a verification of painting orders is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PaintVerifyOptions {
    /// Up to this many triangles there is one.
    pub up_to: usize,
    /// Ways that take more cuts are left out.
    pub most_cuts: Option<usize>,
    /// Samples along the longer side of the image.
    pub image_size: u32,
    /// A mistake to make.
    pub fault: Option<PainterFault>,
}

impl Default for PaintVerifyOptions {
    /// Up to 20 000 triangles and 2500 cuts; an image of 128 samples.
    fn default() -> Self {
        PaintVerifyOptions { up_to: 20_000, most_cuts: Some(2500), image_size: 128, fault: None }
    }
}

/// Finds the painting order by each of the painter's ways and checks it.
///
/// Expected O(n log n + k) for n pieces and k pairs that overlap in the image.
///
/// # Errors
///
/// If the run is cancelled.
pub fn verify_painting<P: Policy>(
    view: &View,
    question: &LineQuestion<'_>,
    options: &PaintVerifyOptions,
    run: &Run<'_>,
) -> Result<PaintReport, Cancelled> {
    let mut report = PaintReport::default();
    let triangles = question.mesh.triangles().len();
    if triangles > options.up_to {
        report.skipped = Some(format!("{triangles} triangles, more than {}", options.up_to));
        return Ok(report);
    }
    let count = question.mesh.vertices().len() as u32;
    let samples = Samples::around(question.frame, question.coordinates, count, options.image_size);
    let image = match &samples {
        Some(samples) => Some((
            Sampled::new(view, question, samples),
            ray_cast::<P>(view, question, samples, run)?,
        )),
        None => None,
    };
    let faces = Faces::new(question);
    for painter in Painter::ALL {
        let PaintVerifyOptions { most_cuts, fault, .. } = *options;
        let wish = PainterOptions { painter, most_cuts, fault };
        let order = match paint_order::<P>(question, &wish, run) {
            Ok(order) => order,
            Err(PainterError::Cancelled(cancelled)) => return Err(cancelled),
            Err(other @ PainterError::NoNearPlane) => {
                report.skipped = Some(other.to_string());
                return Ok(report);
            }
            Err(PainterError::TooManyCuts(most)) => {
                report.leave_out(painter, most, faces.with_image(question));
                continue;
            }
            Err(other @ PainterError::NoCut) => {
                report.fail(painter, other.to_string());
                continue;
            }
        };
        report.row(painter, &order);
        if !question.points.has_near_plane() {
            check_areas::<P>(question, &faces, &order, &mut report, run)?;
        }
        check_pairs::<P>(view, question, &faces, &order, &mut report, run)?;
        if let Some((sampled, buffer)) = &image {
            check_owners::<P>(sampled, &faces, &order, buffer, &mut report, run)?;
        }
    }
    Ok(report)
}

/// The triangles of each face, and boxes around their images.
struct Faces {
    ranges: Vec<Range<u32>>,
    bounds: Vec<Bounds>,
}

impl Faces {
    fn new(question: &LineQuestion<'_>) -> Self {
        let mesh = question.mesh;
        let mut ranges: Vec<Range<u32>> = Vec::new();
        for triangle in 0..mesh.triangles().len() as u32 {
            let face = mesh.face_of(triangle) as usize;
            if ranges.len() <= face {
                ranges.resize(face + 1, triangle..triangle);
            }
            ranges[face].end = triangle + 1;
        }
        let bounds = |range: &Range<u32>| {
            let boxes = range
                .clone()
                .map(|triangle| question.coordinates.bounds(mesh.triangles()[triangle as usize]));
            let mut all = boxes.fold(Bounds::EMPTY, |all, bounds| all.union(&bounds));
            // Only images are asked about.
            (all.low.z, all.high.z) = (0.0, 0.0);
            all
        };
        let bounds = ranges.iter().map(bounds).collect();
        Faces { ranges, bounds }
    }

    /// How many faces have an image.
    fn with_image(&self, question: &LineQuestion<'_>) -> usize {
        let has_image = |triangle: u32| !question.facing[triangle as usize].is_zero();
        self.ranges.iter().filter(|range| (*range).clone().any(has_image)).count()
    }

    fn triangles(&self, piece: &PaintedPiece) -> Range<u32> {
        self.ranges[piece.face as usize].clone()
    }

    fn bounds(&self, piece: &PaintedPiece) -> Bounds {
        self.bounds[piece.face as usize]
    }
}

/// The planes through the eye and the sides of all pieces, and the signs that
/// they have inside.
fn shadows<P: Policy>(
    predicates: &Predicates<'_, P>,
    order: &PaintOrder,
) -> Vec<Vec<(crate::kernel::predicates::Plane, crate::kernel::numbers::Sign)>> {
    let shadow = |piece: &PaintedPiece| {
        piece.polygon.shadow(predicates.facing(piece.polygon.face)).collect()
    };
    order.pieces.iter().map(shadow).collect()
}

#[cfg(test)]
mod tests;
