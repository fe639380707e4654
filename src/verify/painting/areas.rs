//! Are all faces painted, each place once? By areas, which are rationals.

use super::{Faces, PaintReport};
use crate::kernel::numbers::Fraction;
use crate::kernel::predicates::{Policy, Predicates};
use crate::polygon::PlanePolygon;
use crate::run::{Cancelled, Run};
use crate::view::{LineQuestion, PaintOrder};

/// The areas of all faces that have an image. Others have no pieces.
pub(super) fn check_areas<P: Policy>(
    question: &LineQuestion<'_>,
    faces: &Faces,
    order: &PaintOrder,
    report: &mut PaintReport,
    run: &Run<'_>,
) -> Result<(), Cancelled> {
    let predicates = Predicates::<P>::new(question.points);
    let mut pieces: Vec<Vec<&PlanePolygon>> = vec![Vec::new(); faces.ranges.len()];
    for piece in &order.pieces {
        pieces[piece.face as usize].push(&piece.polygon);
    }
    for (face, (range, pieces)) in faces.ranges.iter().zip(&pieces).enumerate() {
        run.check()?;
        let has_image = |triangle: &u32| !question.facing[*triangle as usize].is_zero();
        let triangles = range.clone().filter(has_image);
        let corners = triangles.map(|triangle| question.mesh.triangles()[triangle as usize]);
        let whole: Vec<PlanePolygon> = corners.map(PlanePolygon::triangle).collect();
        let same = match (whole.as_slice(), pieces.as_slice()) {
            ([], []) => continue,
            // Most faces are triangles that nobody cut.
            ([whole], [piece]) if whole.corners == piece.corners => true,
            _ => {
                let whole = whole.iter().collect::<Vec<_>>();
                total(&predicates, &whole) == total(&predicates, pieces)
            }
        };
        if same {
            report.last().area.agree += 1;
        } else {
            report.last().area.differ += 1;
            report.describe(format!("area: the pieces of face {face} are not all of it"));
        }
    }
    Ok(())
}

fn total<P: Policy>(predicates: &Predicates<'_, P>, polygons: &[&PlanePolygon]) -> [Fraction; 3] {
    let areas: Vec<[Fraction; 3]> =
        polygons.iter().map(|polygon| polygon.doubled_area(predicates)).collect();
    [0, 1, 2].map(|axis| {
        let terms: Vec<Fraction> = areas.iter().map(|area| area[axis].clone()).collect();
        Fraction::sum(&terms)
    })
}
