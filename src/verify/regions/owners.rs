//! Samples of an image made by casting rays: is each in the region of the
//! face that its ray meets first?

use super::PART;
use super::report::RegionReport;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Chart, ImagePoint, Policy, Predicates};
use crate::model::View;
use crate::raster::samples::Sampled;
use crate::raster::{Samples, ray_cast};
use crate::run::{Cancelled, Run, map_chunks};
use crate::view::{LineQuestion, Region, VisibleRegions};

/// Samples of an image against regions.
pub(super) fn check_owners<P: Policy>(
    view: &View,
    question: &LineQuestion<'_>,
    regions: &VisibleRegions,
    samples: &Samples,
    run: &Run<'_>,
) -> Result<RegionReport, Cancelled> {
    let buffer = ray_cast::<P>(view, question, samples, run)?;
    let sampled = Sampled::new(view, question, samples);
    let (width, height) = (samples.width(), samples.height());
    let count = width as usize * height as usize;
    let parts = run.stage("verify-owners", count as u64, || {
        map_chunks(count, PART, |part| {
            run.check()?;
            let predicates = Predicates::<P>::new(sampled.points());
            let mut report = RegionReport::default();
            let Some(chart) = Chart::new(sampled.points()) else {
                return Ok(report);
            };
            for index in part {
                run.check()?;
                run.advance(1);
                let [column, row] = [index as u32 % width, index as u32 / width];
                let Some(triangle) = buffer.item(column, row) else {
                    continue;
                };
                let vertex = sampled.vertex([column, row]);
                let sample = ImagePoint::Vertex(vertex);
                let owner = regions.of_triangle(triangle);
                if owner.is_some_and(|region| contains(&predicates, &chart, region, sample)) {
                    report.owner.agree += 1;
                } else if is_on_edge(&predicates, sampled.triangle(triangle).0, vertex) {
                    report.samples_on_edges += 1;
                } else {
                    report.owner.differ += 1;
                    report.describe(format!(
                        "owner: sample {column} {row} sees triangle {triangle}, its region does \
                         not contain it"
                    ));
                }
            }
            Ok(report)
        })
    });
    let mut report = RegionReport::default();
    for part in parts {
        report.append(part?);
    }
    Ok(report)
}

/// Whether a sample lies on an edge of a triangle. There another face may be
/// as near, which is seen beside the edge.
fn is_on_edge<P: Policy>(predicates: &Predicates<'_, P>, [a, b, c]: [u32; 3], x: u32) -> bool {
    [(a, b), (b, c), (c, a)].into_iter().any(|(p, q)| predicates.side(p, q, x).is_zero())
}

/// Whether a region contains a point or has it on its border: an odd number
/// of its edges run below.
fn contains<P: Policy>(
    predicates: &Predicates<'_, P>,
    chart: &Chart,
    region: &Region,
    point: ImagePoint,
) -> bool {
    let mut inside = false;
    for ring in region.polygons.iter().flat_map(|polygon| &polygon.rings) {
        let mut before = predicates.sweep(chart, ring[0].point, point);
        for (i, corner) in ring.iter().enumerate() {
            let after = match ring.get(i + 1) {
                Some(next) => predicates.sweep(chart, next.point, point),
                None => predicates.sweep(chart, ring[0].point, point),
            };
            if before.is_eq() || after.is_eq() {
                return true;
            }
            if before != after {
                // Directed against the sweep, left is below.
                let side = predicates.beside(chart, corner.line, point);
                let above = if before.is_lt() { side } else { -side };
                match above {
                    Sign::Zero => return true,
                    Sign::Positive => inside = !inside,
                    Sign::Negative => {}
                }
            }
            before = after;
        }
    }
    inside
}
