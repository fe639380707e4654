//! Borders of regions and visible lines: the same set but for named
//! exceptions.

use super::PART;
use super::places::Places;
use super::report::RegionReport;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Cut, Place, Policy};
use crate::model::LineOrigin;
use crate::raster::{BoxTree, SheetCounter};
use crate::run::{Cancelled, Run, map_chunks};
use crate::view::{ExactLines, ExactPiece, LineQuestion};

/// Borders along lines against visible pieces.
pub(super) fn check_borders<P: Policy>(
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    borders: &ExactLines,
    run: &Run<'_>,
) -> Result<RegionReport, Cancelled> {
    let tree = SheetCounter::<P>::tree(question);
    let count = question.lines.len();
    let parts = run.stage("verify-borders", count as u64, || {
        map_chunks(count, PART, |part| {
            run.check()?;
            let mut worker = Borders {
                question,
                places: Places::<P>::new(question),
                counter: SheetCounter::<P>::new(question, &tree),
                tree: &tree,
                report: RegionReport::default(),
            };
            for line in part {
                run.check()?;
                run.advance(1);
                worker.line(line, answer.line(line), borders.line(line));
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
    question: &'a LineQuestion<'q>,
    places: Places<'a, 'q, P>,
    counter: SheetCounter<'a, 'q, P>,
    tree: &'a BoxTree,
    report: RegionReport,
}

impl<P: Policy> Borders<'_, '_, P> {
    fn line(&mut self, line: usize, pieces: &[ExactPiece], borders: &[ExactPiece]) {
        let visible: Vec<&ExactPiece> =
            pieces.iter().filter(|piece| piece.invisibility == 0).collect();
        let mut ends: Vec<Place> = visible
            .iter()
            .copied()
            .chain(borders)
            .flat_map(|piece| [piece.from, piece.to])
            .collect();
        ends.sort_by(|a, b| self.places.order(line, *a, *b));
        ends.dedup_by(|a, b| self.places.order(line, *a, *b).is_eq());
        let (mut v, mut b) = (0, 0);
        for pair in ends.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            let order = |a, b| self.places.order(line, a, b);
            while v < visible.len() && order(visible[v].to, from).is_le() {
                v += 1;
            }
            while b < borders.len() && order(borders[b].to, from).is_le() {
                b += 1;
            }
            let is_visible = visible.get(v).is_some_and(|piece| order(piece.from, from).is_le());
            let is_border = borders.get(b).is_some_and(|piece| order(piece.from, from).is_le());
            match (is_visible, is_border) {
                (true, true) => self.report.border.agree += 1,
                (true, false) => self.visible_only(line, [from, to]),
                (false, true) => self.border_only(line, [from, to]),
                (false, false) => {}
            }
        }
    }

    /// The faces of a line, and for each on which sides of the line it lies.
    fn own(&self, line: usize) -> Vec<(u32, [bool; 2])> {
        let question = self.question;
        let carrier = self.places.carrier(line);
        let mut own = match question.lines[line].origin {
            LineOrigin::Loose(_) => Vec::new(),
            LineOrigin::Intersection(i) => {
                let pair = question.intersections[i as usize].triangles;
                pair.map(|triangle| (triangle, [true; 2])).to_vec()
            }
            LineOrigin::Edge(edge) => {
                let ends = question.mesh.edges().ends(edge);
                let side = |&triangle: &u32| {
                    let third = question.mesh.third(triangle, ends);
                    let sign = self.places.predicates().image_side(carrier, third);
                    (triangle, [sign == Sign::Positive, sign == Sign::Negative])
                };
                question.mesh.faces_at(edge).iter().map(side).collect()
            }
        };
        own.retain(|(triangle, _)| !question.facing[*triangle as usize].is_zero());
        own
    }

    /// A visible piece at which no region of its faces ends.
    fn visible_only(&mut self, line: usize, places: [Place; 2]) {
        let own = self.own(line);
        let is_crossing = matches!(self.question.lines[line].origin, LineOrigin::Intersection(_));
        // Where one of two crossing faces is seen from the edge, the other
        // is seen on both sides.
        if own.is_empty() || (is_crossing && own.len() < 2) {
            self.report.surplus.faceless += 1;
            return;
        }
        let carrier = self.places.carrier(line);
        let probe = self.counter.probe(carrier, places, 0.5);
        let mut covered = [false; 2];
        for &(triangle, _) in &own {
            let bounds =
                self.question.coordinates.bounds(self.question.mesh.triangles()[triangle as usize]);
            self.tree.in_front(&bounds, |other| {
                let corners = self.question.mesh.triangles()[other as usize];
                let holds = |end| {
                    let sign = self.places.predicates().value_sign(Cut::Face(corners), end);
                    sign.is_zero()
                };
                let foreign = own.iter().all(|(triangle, _)| *triangle != other);
                if foreign && carrier.ends.into_iter().all(holds) {
                    let sides = self.counter.covers(carrier, probe, other);
                    covered[0] |= sides[0];
                    covered[1] |= sides[1];
                }
            });
        }
        let is_covered = |(_, sides): &(u32, [bool; 2])| (0..2).all(|i| !sides[i] || covered[i]);
        if own.iter().all(is_covered) {
            self.report.surplus.on_other_face += 1;
        } else {
            self.differ(line, places, "visible, but no border");
        }
    }

    /// A border on a piece that is not visible.
    fn border_only(&mut self, line: usize, places: [Place; 2]) {
        let carrier = self.places.carrier(line);
        let probe = self.counter.probe(carrier, places, 0.5);
        let sheets = self.counter.count(&self.question.lines[line], probe);
        let own = self.own(line);
        let is_free = |(_, sides): &(u32, [bool; 2])| (0..2).any(|i| sides[i] && sheets[i] == 0);
        if own.iter().any(is_free) {
            self.report.surplus.below_other_line += 1;
        } else {
            self.differ(line, places, "a border, but not visible");
        }
    }

    fn differ(&mut self, line: usize, places: [Place; 2], what: &str) {
        self.report.border.differ += 1;
        self.report.segments.push(self.places.span(line, places));
        let [from, to] = places;
        self.report.describe(format!("border: line {line} from {from:?} to {to:?}: {what}"));
    }
}
