//! All regions and all images in one exact overlay.

use super::report::{DESCRIBED, RegionReport, RegionTally};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Cut, Point, Policy, Predicates};
use crate::polygon::clipping::{Clipper, FillRule, Operand, Polygon};
use crate::run::Run;
use crate::view::{LineQuestion, VisibleRegions};

/// One overlay of all regions and all images.
pub(super) fn check_areas<P: Policy>(
    question: &LineQuestion<'_>,
    regions: &VisibleRegions,
    report: &mut RegionReport,
    run: &Run<'_>,
) {
    let predicates = Predicates::<P>::new(question.points);
    let Some(clipper) = Clipper::new(&predicates) else {
        return;
    };
    let clipper = clipper.within(run);
    let near = question.points.has_near_plane();
    let is_in_front = |&corner: &u32| {
        !near || predicates.value_sign(Cut::Near, Point::Vertex(corner)) == Sign::Positive
    };
    let mut images = Vec::new();
    for (corners, facing) in question.mesh.triangles().iter().zip(question.facing) {
        // What lies behind the eye for certain has an empty box.
        if facing.is_zero() || (near && question.coordinates.bounds(*corners).is_empty()) {
            continue;
        }
        report.near_faces |= !corners.iter().all(is_in_front);
        let [a, b, c] = *corners;
        let corners = if *facing == Sign::Positive { [a, b, c] } else { [a, c, b] };
        images.push(Polygon::of_vertices([corners]));
    }
    let all: Vec<Polygon> =
        regions.regions().iter().flat_map(|region| region.polygons.iter().cloned()).collect();
    let odd = Operand::new(&all, FillRule::EvenOdd);
    let any = Operand::new(&all, FillRule::Positive);
    let differs = |inside: &[bool]| u32::from(inside.iter().any(|&one| one != inside[0]));
    let defects = if report.near_faces {
        clipper.overlay(&[odd, any], &differs)
    } else {
        clipper.overlay(&[odd, any, Operand::new(&images, FillRule::Positive)], &differs)
    };
    let defects = defects.get(&1).map_or(&[][..], Vec::as_slice);
    report.area =
        RegionTally { agree: regions.regions().len() as u64, differ: defects.len() as u64 };
    for defect in defects.iter().take(DESCRIBED) {
        report.describe(format!("area: {:?}", defect.outline()));
    }
}
