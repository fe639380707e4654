//! The answer against the judge's, piece by piece and place by place.

use super::places::Places;
use super::report::{Check, Difference, Report};
use super::{PART, VerifyOptions};
use crate::kernel::predicates::Policy;
use crate::run::{Cancelled, Run, map_chunks};
use crate::view::{ExactLines, ExactPiece, LineQuestion};
use crate::visibility::roberts;
use glam::DVec2;
use std::cmp::Ordering;

/// Asks the judge about all lines, or about some if there are too many
/// triangles, and compares.
pub(super) fn compare<P: Policy>(
    question: &LineQuestion,
    answer: &ExactLines,
    options: &VerifyOptions,
    run: &Run,
) -> Result<Report, Cancelled> {
    let all = question.lines.len();
    let lines = if question.mesh.triangles().len() <= options.judge_all_up_to {
        (0..all as u32).collect()
    } else {
        choose(all, options.judged_lines, options.seed)
    };
    let judged = roberts::<P>(question, Some(&lines), run)?;
    let parts = map_chunks(lines.len(), PART, |part| {
        run.check()?;
        let places = Places::<P>::new(question);
        let mut report = Report::default();
        for i in part {
            run.check()?;
            let line = lines[i] as usize;
            compare_line(&places, line, judged.line(i), answer.line(line), &mut report);
        }
        Ok(report)
    });
    let mut report = Report::default();
    for part in parts {
        report.append(part?);
    }
    report.judged = Some((lines.len(), all, options.seed));
    Ok(report)
}

/// `count` of the numbers below `all`, ascending: those whose hash is
/// least. The hash is the finalizer of SplitMix64 (Steele, Lea and Flood
/// 2014).
fn choose(all: usize, count: usize, seed: u64) -> Vec<u32> {
    let hash = |index: u32| {
        let mut z = seed.wrapping_add((u64::from(index) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    let mut lines: Vec<u32> = (0..all as u32).collect();
    lines.sort_by_cached_key(|&line| hash(line));
    lines.truncate(count);
    lines.sort_unstable();
    lines
}

fn compare_line<P: Policy>(
    places: &Places<'_, '_, P>,
    line: usize,
    judged: &[ExactPiece],
    answered: &[ExactPiece],
    report: &mut Report,
) {
    let same = |(a, b): (&ExactPiece, &ExactPiece)| {
        a.invisibility == b.invisibility
            && [(a.from, b.from), (a.to, b.to)].into_iter().all(|(a, b)| {
                a == b || (places.is_on(line, b) && places.order(line, a, b) == Ordering::Equal)
            })
    };
    let paired = || judged.iter().zip(answered);
    if judged.len() == answered.len() && paired().all(same) {
        for piece in judged {
            let [a, b] = places.span(line, [piece.from, piece.to]);
            report.agree(Check::Judge, a.distance(b));
        }
        return;
    }
    let first = paired().position(|pair| !same(pair));
    let at = first.unwrap_or(judged.len().min(answered.len()));
    let show = |pieces: &[ExactPiece]| {
        pieces.get(at).map_or_else(
            || "nothing".to_owned(),
            |piece| {
                format!("{} sheets from {:?} to {:?}", piece.invisibility, piece.from, piece.to)
            },
        )
    };
    let difference = Difference {
        check: Check::Judge,
        line,
        places: None,
        what: format!("piece {at}: the judge says {}, the answer {}", show(judged), show(answered)),
    };
    report.differ(difference, &apart(places, line, judged, answered));
}

/// About where the invisibilities of two lists of pieces differ.
fn apart<P: Policy>(
    places: &Places<'_, '_, P>,
    line: usize,
    judged: &[ExactPiece],
    answered: &[ExactPiece],
) -> Vec<[DVec2; 2]> {
    let spans = |pieces: &[ExactPiece]| -> Vec<(f64, f64, u32)> {
        let valid = pieces
            .iter()
            .filter(|piece| places.is_on(line, piece.from) && places.is_on(line, piece.to));
        valid
            .map(|piece| {
                let [from, to] = [piece.from, piece.to].map(|p| places.parameter(line, p));
                (from, to, piece.invisibility)
            })
            .collect()
    };
    let both = [spans(judged), spans(answered)];
    let mut marks: Vec<f64> = both.iter().flatten().flat_map(|s| [s.0, s.1]).collect();
    marks.sort_by(f64::total_cmp);
    let level = |spans: &[(f64, f64, u32)], at: f64| {
        let span = spans.iter().find(|span| span.0 <= at && at <= span.1);
        span.map(|span| span.2)
    };
    marks
        .windows(2)
        .filter(|pair| pair[0] < pair[1])
        .filter(|pair| {
            let middle = (pair[0] + pair[1]) * 0.5;
            level(&both[0], middle) != level(&both[1], middle)
        })
        .map(|pair| [pair[0], pair[1]].map(|t| places.image_at(line, t)))
        .collect()
}
