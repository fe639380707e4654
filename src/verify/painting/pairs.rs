//! Of each two pieces that overlap in the image, is the nearer one painted
//! later?

use super::{Faces, PaintReport, shadows};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Plane, Policy, Predicates};
use crate::model::View;
use crate::polygon::PlanePolygon;
use crate::raster::Samples;
use crate::raster::samples::Sampled;
use crate::run::{Cancelled, Run};
use crate::spatial::{Bounds, Hierarchy};
use crate::view::{LineQuestion, PaintOrder, PaintedPiece};
use glam::DVec2;

/// Where one piece is painted over another, what is wrong about it.
enum Verdict {
    Apart,
    Right,
    Wrong(&'static str),
}

/// All pairs whose boxes overlap.
pub(super) fn check_pairs<P: Policy>(
    view: &View,
    question: &LineQuestion<'_>,
    faces: &Faces,
    order: &PaintOrder,
    report: &mut PaintReport,
    run: &Run<'_>,
) -> Result<(), Cancelled> {
    let boxes: Vec<Bounds> = order.pieces.iter().map(|piece| faces.bounds(piece)).collect();
    let shadows = shadows(&Predicates::<P>::new(question.points), order);
    // For the tie rule alone, of which images have a definition of their own.
    let none = Samples::about(question.frame, DVec2::ZERO, 1.0, [1, 1], 1.0);
    let sampled = Sampled::new(view, question, &none);
    let pairs = Pairs { question, faces, shadows: &shadows, sampled: &sampled };
    let start = || (Predicates::<P>::new(question.points), 0_u64, Vec::new());
    let found = run.stage("verify-paint-order", boxes.len() as u64, || {
        let hierarchy = Hierarchy::new(&boxes);
        hierarchy.overlapping_pairs(run, start, |(predicates, right, wrong), a, b| {
            if run.is_stopped() {
                return;
            }
            let [earlier, later] = [a.min(b), a.max(b)];
            match pairs.verdict(predicates, order, [earlier as usize, later as usize]) {
                Verdict::Apart => {}
                Verdict::Right => *right += 1,
                Verdict::Wrong(what) => wrong.push((earlier, later, what)),
            }
        })
    });
    run.check()?;
    let mut wrong = Vec::new();
    for (predicates, right, more) in found {
        run.merge(&predicates.counters());
        report.last().order.agree += right;
        wrong.extend(more);
    }
    wrong.sort_unstable();
    report.last().order.differ += wrong.len() as u64;
    for (earlier, later, what) in wrong {
        let [below, above] = [earlier, later].map(|i| order.pieces[i as usize].face);
        report.describe(format!("order: face {above} is painted over face {below}, {what}"));
    }
    Ok(())
}

struct Pairs<'a> {
    question: &'a LineQuestion<'a>,
    faces: &'a Faces,
    shadows: &'a [Vec<(Plane, Sign)>],
    sampled: &'a Sampled<'a>,
}

impl Pairs<'_> {
    fn verdict<P: Policy>(
        &self,
        predicates: &Predicates<'_, P>,
        order: &PaintOrder,
        places: [usize; 2],
    ) -> Verdict {
        let [earlier, later] = places.map(|place| &order.pieces[place]);
        // Most pairs whose boxes overlap are told apart by one plane.
        let [first, second] = places.map(|place| self.shadows[place].iter().copied());
        let polygons = [&earlier.polygon, &later.polygon];
        if PlanePolygon::are_apart(predicates, polygons, first, second) {
            return Verdict::Apart;
        }
        let shadow = self.shadows[places[0]].iter().copied();
        let Some(over) = later.polygon.within(predicates, shadow) else {
            return Verdict::Apart;
        };
        if earlier.face == later.face && earlier.triangle == later.triangle {
            return Verdict::Wrong("and is the same");
        }
        let plane = earlier.polygon.plane().into();
        let signs = || over.corners.iter().map(|corner| predicates.above(plane, corner.point));
        if signs().any(|sign| !sign.is_zero()) {
            // Beyond a plane its functional has the sign of the facing.
            let beyond = predicates.facing(earlier.polygon.face);
            return match signs().any(|sign| sign == beyond) {
                true => Verdict::Wrong("behind which it is"),
                false => Verdict::Right,
            };
        }
        match self.tie_is_right(predicates, [earlier, later], &over, places[0]) {
            true => Verdict::Right,
            false => Verdict::Wrong("which the tie rule prefers"),
        }
    }

    /// Wherever two triangles of pieces in one plane overlap, that of the later
    /// piece is preferred.
    fn tie_is_right<P: Policy>(
        &self,
        predicates: &Predicates<'_, P>,
        [earlier, later]: [&PaintedPiece; 2],
        over: &PlanePolygon,
        place: usize,
    ) -> bool {
        let within = |piece: &PlanePolygon, triangle: u32| {
            let corners = self.question.mesh.triangles()[triangle as usize];
            let facing = predicates.facing(corners);
            piece.within(predicates, PlanePolygon::triangle(corners).shadow(facing))
        };
        // A face that bends is painted triangle by triangle.
        let is_part = |piece: &PaintedPiece, triangle: &u32| {
            let plane = piece.polygon.face;
            let corners = self.question.mesh.triangles()[*triangle as usize];
            corners.iter().all(|x| plane.contains(x) || predicates.plane(plane, *x).is_zero())
        };
        let of = |piece: &'_ PaintedPiece| -> Vec<u32> {
            self.faces.triangles(piece).filter(|triangle| is_part(piece, triangle)).collect()
        };
        let others = of(earlier);
        of(later).into_iter().all(|own| {
            let Some(part) = within(over, own) else { return true };
            others.iter().all(|&other| {
                self.sampled.precedes(own, other)
                    || within(&part, other)
                        .and_then(|part| {
                            part.within(predicates, self.shadows[place].iter().copied())
                        })
                        .is_none()
            })
        })
    }
}
