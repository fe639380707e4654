//! The proof of a drawing: every answer against the others.
//!
//! An answer is a list of pieces with their invisibility. Four checks, of
//! which no two share code:
//!
//! - *cover*: the pieces are in order, without gap or overlap, maximal, and
//!   reach from one end of each line to the other;
//! - *count*: the sheets in front of one exact point of each piece, counted
//!   afresh (see [`SheetCounter`]);
//! - *judge*: the pieces against those of Roberts' method, places compared
//!   exactly;
//! - *image*: the middle of each piece against an image made by casting
//!   rays. A sample beside the middle proves less, so middles near an edge
//!   are left out and counted.
//!
//! The first three are exact: one difference is one defect. [`cross_check()`]
//! holds the image-space methods against each other, exactly too,
//! [`verify_regions`] what is seen of faces against images and lines, and
//! [`verify_painting`] the painter's orders against planes and images.
//!
//! When a drawing surprises, an [`Explainer`] tells of one place which line is
//! there and which faces hide it.

mod against_image;
mod against_judge;
mod cover;
mod cross_check;
mod explain;
mod painting;
mod places;
mod regions;
mod report;
#[cfg(test)]
mod tests;

pub use cross_check::{Comparison, CrossCheck, cross_check};
pub use explain::{
    CoincidentLine, EndCause, EndThere, Explainer, Explanation, FaceThere, LineThere, Side,
};
pub use painting::{PaintReport, PaintTally, PaintVerifyOptions, PainterRow, verify_painting};
pub use regions::{RegionReport, RegionTally, RegionVerifyOptions, verify_regions};
pub use report::{Check, Difference, DifferenceSegment, Report, Tally};

use crate::kernel::predicates::Policy;
use crate::model::View;
use crate::raster::{Samples, SheetCounter};
use crate::run::{Cancelled, Run, map_chunks};
use crate::view::{ExactLines, ExactPiece, LineQuestion};
use against_image::{ImageCheck, Verdict};
use glam::DVec2;
use places::Places;
use std::cmp::Ordering;

/// Lines per task.
const PART: usize = 128;

/// How thorough a verification is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct VerifyOptions {
    /// Up to this many triangles the judge sees all lines.
    pub judge_all_up_to: usize,
    /// Beyond, the judge sees this many lines.
    pub judged_lines: usize,
    /// What chooses them.
    pub seed: u64,
    /// Pixels along the longer side of the image; 0 leaves it out.
    pub image_size: u32,
}

impl Default for VerifyOptions {
    /// All lines up to 20 000 triangles, else 2000; an image of 1024 pixels.
    fn default() -> Self {
        VerifyOptions { judge_all_up_to: 20_000, judged_lines: 2000, seed: 1963, image_size: 1024 }
    }
}

/// Checks an answer to a question asked for `view`.
///
/// O(lines x triangles) at worst for the judge's share, expected O(n log n)
/// for the rest.
///
/// # Errors
///
/// If the run is cancelled.
pub fn verify<P: Policy>(
    view: &View,
    question: &LineQuestion,
    answer: &ExactLines,
    options: &VerifyOptions,
    run: &Run,
) -> Result<Report, Cancelled> {
    let mut report = Report::default();
    if answer.len() != question.lines.len() {
        let difference = Difference {
            check: Check::Cover,
            line: answer.len().min(question.lines.len()),
            places: None,
            what: format!("expected {} lines, answered {}", question.lines.len(), answer.len()),
        };
        report.differ(difference, &[]);
        return Ok(report);
    }
    let vertices = question.mesh.vertices().len() as u32;
    // Without lines there is nothing to look for in an image.
    let size = if question.lines.is_empty() { 0 } else { options.image_size };
    let samples = Samples::around(&view.frame, question.coordinates, vertices, size);
    let count = question.lines.len();
    let middles = map_chunks(count, PART, |part| {
        let places = Places::<P>::new(question);
        part.map(|line| middles(&places, line, answer.line(line))).collect::<Vec<_>>()
    })
    .concat();
    run.check()?;
    let image = match samples {
        None => None,
        Some(samples) => {
            let points = middles.iter().flatten().flatten().copied();
            // What hides a line is not cut at the near plane.
            let uncut = View { near: None, ..*view };
            Some(ImageCheck::new::<P>(&uncut, question, samples, points, run)?)
        }
    };
    let tree = SheetCounter::<P>::tree(question);
    let parts = run.stage("verify", count as u64, || {
        map_chunks(count, PART, |part| {
            run.check()?;
            let worker = Worker {
                question,
                places: Places::<P>::new(question),
                counter: SheetCounter::<P>::new(question, &tree),
                image: image.as_ref(),
            };
            let mut report = Report::default();
            for line in part {
                run.check()?;
                run.advance(1);
                worker.line(line, answer.line(line), middles[line].as_deref(), &mut report);
            }
            run.merge(&worker.counter.counters());
            Ok(report)
        })
    });
    for part in parts {
        report.append(part?);
    }
    report.append(against_judge::compare::<P>(question, answer, options, run)?);
    Ok(report)
}

/// The image of the middle of each piece of a line; nothing if some piece ends
/// where no place of the line is.
fn middles<P: Policy>(
    places: &Places<'_, '_, P>,
    line: usize,
    pieces: &[ExactPiece],
) -> Option<Vec<DVec2>> {
    let middle = |piece: &ExactPiece| {
        let ends = [piece.from, piece.to];
        let is_on = ends.iter().all(|&end| places.is_on(line, end));
        let [from, to] = is_on.then(|| ends.map(|end| places.parameter(line, end)))?;
        Some(places.image_at(line, (from + to) * 0.5))
    };
    pieces.iter().map(middle).collect()
}

/// Checks the lines of one task.
struct Worker<'a, 'q, P: Policy> {
    question: &'a LineQuestion<'q>,
    places: Places<'a, 'q, P>,
    counter: SheetCounter<'a, 'q, P>,
    image: Option<&'a ImageCheck>,
}

impl<P: Policy> Worker<'_, '_, P> {
    /// `middles` are those of the pieces, if all of them are some.
    fn line(
        &self,
        line: usize,
        pieces: &[ExactPiece],
        middles: Option<&[DVec2]>,
        report: &mut Report,
    ) {
        let whole = middles.map_or_else(Vec::new, |_| self.places.whole(line, pieces));
        match cover::fault(&self.places, line, pieces) {
            None => report.agree(Check::Cover, whole.iter().map(|[a, b]| a.distance(*b)).sum()),
            Some(what) => {
                let difference =
                    Difference { check: Check::Cover, line, places: None, what: what.to_owned() };
                report.differ(difference, &whole);
            }
        }
        // Nothing can be asked about pieces that are none.
        for (piece, middle) in pieces.iter().zip(middles.unwrap_or_default()) {
            self.piece(line, piece, *middle, report);
        }
    }

    fn piece(&self, index: usize, piece: &ExactPiece, middle: DVec2, report: &mut Report) {
        let places = [piece.from, piece.to];
        if self.places.order(index, piece.from, piece.to) != Ordering::Less {
            return;
        }
        let line = &self.question.lines[index];
        let span = self.places.span(index, places);
        let carrier = self.question.carrier(line);
        let probe = self.counter.probe(carrier, places, 0.5);
        let [left, right] = self.counter.count(line, probe);
        let sheets = left.max(right);
        let mut compare = |check, agrees: bool, expected: String| {
            if agrees {
                return report.agree(check, span[0].distance(span[1]));
            }
            let difference = Difference {
                check,
                line: index,
                places: Some(places),
                what: format!("expected {expected}, answered {} sheets", piece.invisibility),
            };
            report.differ(difference, &[span]);
        };
        compare(Check::Count, sheets == piece.invisibility, format!("{sheets} sheets"));
        let Some(image) = self.image else {
            return;
        };
        let hidden = piece.invisibility > 0;
        match image.verdict(&self.counter, self.question, line, probe, middle) {
            Verdict::Hidden => compare(Check::Image, hidden, "a hidden piece".to_owned()),
            Verdict::Visible => compare(Check::Image, !hidden, "a visible piece".to_owned()),
            Verdict::Skipped => report.skip(Check::Image),
        }
    }
}
