//! All regions and all images in one exact overlay.

use super::report::{DESCRIBED, RegionReport, RegionTally};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Chart, Cut, ImageLine, ImagePoint, Point, Policy, Predicates};
use crate::polygon::clipping::{Clipper, Corner, FillRule, Operand, Polygon};
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
    let images: Vec<Polygon> = (0..question.mesh.triangles().len())
        .filter_map(|triangle| image(question, &predicates, clipper.chart(), triangle))
        .collect();
    let all: Vec<Polygon> =
        regions.regions().iter().flat_map(|region| region.polygons.iter().cloned()).collect();
    let odd = Operand::new(&all, FillRule::EvenOdd);
    let any = Operand::new(&all, FillRule::Positive);
    let images = Operand::new(&images, FillRule::Positive);
    let differs = |inside: &[bool]| u32::from(inside.iter().any(|&one| one != inside[0]));
    let defects = clipper.overlay(&[odd, any, images], &differs);
    let defects = defects.get(&1).map_or(&[][..], Vec::as_slice);
    report.area =
        RegionTally { agree: regions.regions().len() as u64, differ: defects.len() as u64 };
    for defect in defects.iter().take(DESCRIBED) {
        report.describe(format!("area: {:?}", defect.outline()));
    }
}

/// The image of a triangle as far as it lies in front of the near plane.
fn image<P: Policy>(
    question: &LineQuestion<'_>,
    predicates: &Predicates<'_, P>,
    chart: &Chart,
    triangle: usize,
) -> Option<Polygon> {
    let [a, b, c] = question.mesh.triangles()[triangle];
    let face = match question.facing[triangle] {
        Sign::Zero => return None,
        Sign::Positive => [a, b, c],
        Sign::Negative => [a, c, b],
    };
    // Without a near plane all is in front.
    let signs = face.map(|corner| predicates.value_sign(Cut::Near, Point::Vertex(corner)));
    if !signs.contains(&Sign::Positive) {
        return None;
    }
    let edge = |i: usize| ImageLine::Edge([face[i], face[(i + 1) % 3]]);
    let sign = |i: usize| signs[i % 3];
    let near = ImageLine::Near(face);
    // What is in front lies left of the edges and of the cut, so a ring turns
    // left where it goes from one to the other.
    let cut = (0..3).find(|&i| sign(i).is_opposite(sign(i + 1))).map_or(near, |i| {
        let turned = predicates.bend(chart, edge(i), near) == sign(i);
        if turned { near } else { near.reversed() }
    });
    let mut ring = Vec::new();
    for (i, vertex) in face.into_iter().enumerate() {
        let corner = |line| Corner { point: ImagePoint::Vertex(vertex), line };
        let crossing =
            |lines: [ImageLine; 2]| Corner { point: ImagePoint::Crossing(lines), line: lines[1] };
        match (sign(i), sign(i + 1)) {
            (Sign::Negative, Sign::Positive) => ring.push(crossing([cut, edge(i)])),
            (Sign::Negative, _) => {}
            (Sign::Positive, Sign::Negative) => {
                ring.extend([corner(edge(i)), crossing([edge(i), cut])]);
            }
            (Sign::Zero, Sign::Negative) => ring.push(corner(cut)),
            _ => ring.push(corner(edge(i))),
        }
    }
    Some(Polygon { rings: vec![ring] })
}
