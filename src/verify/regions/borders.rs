//! Lines that regions show and visible lines: the same pieces.
//!
//! A face that reaches before the near plane hides lines as a whole, and has a
//! region beyond the plane only. A piece that is hidden by nothing else is
//! counted apart, after all faces were asked once more, each as far as it lies
//! beyond the plane.

use super::PART;
use super::places::Places;
use super::report::RegionReport;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Cut, Place, Policy};
use crate::run::{Cancelled, Run, map_chunks};
use crate::view::{ExactLines, ExactPiece, LineQuestion};

/// Lines as regions show them against the visible pieces of an answer.
pub(super) fn check_borders<P: Policy>(
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    shown: &ExactLines,
    run: &Run<'_>,
) -> Result<RegionReport, Cancelled> {
    let count = question.lines.len();
    let parts = run.stage("verify-borders", count as u64, || {
        map_chunks(count, PART, |part| {
            run.check()?;
            let mut worker =
                Borders { places: Places::<P>::new(question), report: RegionReport::default() };
            for line in part {
                run.check()?;
                run.advance(1);
                worker.line(line, answer.line(line), shown.line(line));
            }
            Ok(worker.report)
        })
    });
    let mut report = RegionReport::default();
    for part in parts {
        report.append(part?);
    }
    Ok(report)
}

struct Borders<'a, 'q, P: Policy> {
    places: Places<'a, 'q, P>,
    report: RegionReport,
}

impl<P: Policy> Borders<'_, '_, P> {
    fn line(&mut self, line: usize, pieces: &[ExactPiece], shown: &[ExactPiece]) {
        let visible: Vec<&ExactPiece> =
            pieces.iter().filter(|piece| piece.invisibility == 0).collect();
        let mut ends: Vec<Place> =
            visible.iter().copied().chain(shown).flat_map(|piece| [piece.from, piece.to]).collect();
        if let Some(end) = ends.iter().find(|end| !self.places.is_on(line, **end)) {
            let what = format!("border: line {line}: {end:?} is no place of it");
            return self.differ(Vec::new(), what);
        }
        ends.sort_by(|a, b| self.places.order(line, *a, *b));
        ends.dedup_by(|a, b| self.places.order(line, *a, *b).is_eq());
        let (mut v, mut s) = (0, 0);
        for pair in ends.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            let order = |a, b| self.places.order(line, a, b);
            while v < visible.len() && order(visible[v].to, from).is_le() {
                v += 1;
            }
            while s < shown.len() && order(shown[s].to, from).is_le() {
                s += 1;
            }
            let is_visible = visible.get(v).is_some_and(|piece| order(piece.from, from).is_le());
            let is_shown = shown.get(s).is_some_and(|piece| order(piece.from, from).is_le());
            let what = match (is_visible, is_shown) {
                (true, true) => {
                    self.report.border.agree += 1;
                    continue;
                }
                (true, false) => "visible, but not shown by regions",
                (false, true) if self.is_free_beyond_near(line, [from, to]) => {
                    self.report.before_near += 1;
                    continue;
                }
                (false, true) => "shown by regions, but not visible",
                (false, false) => continue,
            };
            let span = self.places.span(line, [from, to]);
            let what = format!("border: line {line} from {from:?} to {to:?}: {what}");
            self.differ(vec![span], what);
        }
    }

    /// Whether no face hides a piece, within which nothing changes, with what of
    /// it lies beyond the near plane. O(n).
    fn is_free_beyond_near(&self, line: usize, places: [Place; 2]) -> bool {
        let question = self.places.question();
        if !question.points.has_near_plane() {
            return false;
        }
        let (predicates, carrier) = (self.places.predicates(), self.places.carrier(line));
        let inside = |cut| predicates.between(carrier, places, cut);
        question.mesh.triangles().iter().zip(question.facing).all(|(&[a, b, c], &facing)| {
            let is_behind = !facing.is_zero() && inside(Cut::Face([a, b, c])) == facing;
            // Where the ray through the piece meets the plane of the face.
            if !is_behind || inside(Cut::NearLine([a, b, c])) != -facing {
                return true;
            }
            let mut covers = [true; 2];
            for (edge, third) in [([a, b], c), ([b, c], a), ([c, a], b)] {
                match inside(Cut::Silhouette(edge)) * facing {
                    Sign::Positive => {}
                    Sign::Negative => covers = [false; 2],
                    Sign::Zero => {
                        let left = predicates.image_side(carrier, third) == Sign::Positive;
                        covers = [covers[0] && left, covers[1] && !left];
                    }
                }
            }
            !covers.contains(&true)
        })
    }

    fn differ(&mut self, spans: Vec<[glam::DVec2; 2]>, what: String) {
        self.report.border.differ += 1;
        self.report.segments.extend(spans);
        self.report.describe(what);
    }
}
