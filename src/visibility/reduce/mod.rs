//! From exact pieces to the lines of a drawing: coincident lines become
//! one, then everything is rounded, once.
//!
//! Where images of several lines lie on one another, the drawing contains
//! that stretch once: visible wins over hidden, fewer sheets over more, then
//! the class of higher precedence, then the nearer line.
//! Overlaps are cut exactly. Pieces that follow one another on one image
//! line without a gap get the same run, so that a drawing can join them
//! into one stroke without asking whether rounded points are collinear.

mod coincident;
mod groups;
mod passing;
mod rivals;
mod rounded;

use crate::kernel::predicates::{Policy, Predicates};
use crate::run::{Cancelled, Counters, Run, concat_map, map_chunks};
use crate::view::{Crossing, ExactLines, LinePiece, LineQuestion, VisibleLines};
use coincident::{Origin, resolve_coincident};
use passing::find_crossings;
use rounded::{RoundedPiece, round_line};

/// Lines that one task rounds.
const PART: usize = 2048;

/// Reduces coincident lines to one and rounds all coordinates to the view
/// frame. Expected O(n log n) for n pieces.
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn reduce<P: Policy>(
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    run: &Run<'_>,
) -> Result<VisibleLines, Cancelled> {
    let (pieces, _) = resolved::<P>(question, answer, false, run)?;
    Ok(drawn(question, pieces, run))
}

/// As [`reduce`], and where lines of the drawing pass in front of others:
/// what halos are made of. Crossings are sorted by their pieces. Expected
/// O(n log n + k) for n pieces and k pairs of pieces with overlapping boxes.
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn reduce_with_crossings<P: Policy>(
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    run: &Run<'_>,
) -> Result<(VisibleLines, Vec<Crossing>), Cancelled> {
    let (pieces, origins) = resolved::<P>(question, answer, true, run)?;
    let crossings = run.stage("crossings", pieces.len() as u64, || {
        find_crossings::<P>(question, &pieces, &origins, run)
    })?;
    Ok((drawn(question, pieces, run), crossings))
}

/// As [`reduce`], and of which piece of the answer each piece of the drawing
/// is part: its line, and its number through all lines.
///
/// # Errors
///
/// If the run is cancelled.
pub(crate) fn reduce_with_origins<P: Policy>(
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    run: &Run<'_>,
) -> Result<(VisibleLines, Vec<[u32; 2]>), Cancelled> {
    let (pieces, origins) = resolved::<P>(question, answer, true, run)?;
    let origins = origins.into_iter().map(|origin| [origin.line, origin.piece]).collect();
    Ok((drawn(question, pieces, run), origins))
}

/// Rounded pieces that do not lie on one another.
fn resolved<P: Policy>(
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    origins_wanted: bool,
    run: &Run<'_>,
) -> Result<(Vec<LinePiece>, Vec<Origin>), Cancelled> {
    let count = answer.piece_count() as u64;
    // Made in parts, then joined.
    let rounded = 2 * count * size_of::<RoundedPiece>() as u64;
    let pieces = run.stage("rounding", count, || {
        run.take(rounded)?;
        let parts = map_chunks(answer.len(), PART, |part| {
            let predicates = Predicates::<P>::new(question.points);
            let count = part.clone().map(|line| answer.line(line).len()).sum();
            let mut pieces = Vec::with_capacity(count);
            run.advance(count as u64);
            for line in part.take_while(|_| !run.is_stopped()) {
                round_line(question, &predicates, line as u32, answer.line(line), &mut pieces);
            }
            (pieces, predicates.counters())
        });
        run.check()?;
        Ok(gather(&parts, run))
    })?;
    let resolved = run.stage("coincident lines", 2 * pieces.len() as u64, || {
        resolve_coincident::<P>(question, &pieces, origins_wanted, run)
    })?;
    run.give_back(rounded);
    Ok(resolved)
}

/// The drawing of all pieces.
fn drawn(question: &LineQuestion<'_>, pieces: Vec<LinePiece>, run: &Run<'_>) -> VisibleLines {
    let objects = question.mesh.objects().iter().map(|object| object.name.clone()).collect();
    run.count("pieces", pieces.len() as u64);
    VisibleLines { frame: *question.frame, objects, pieces, counters: run.counters() }
}

/// Joins the results of parallel parts.
fn gather<T: Copy + Send + Sync>(parts: &[(Vec<T>, Counters)], run: &Run<'_>) -> Vec<T> {
    parts.iter().for_each(|(_, counters)| run.merge(counters));
    let lists: Vec<&[T]> = parts.iter().map(|(list, _)| &list[..]).collect();
    concat_map(&lists, |_, piece| *piece)
}

/// The public form of a piece.
fn line_piece(question: &LineQuestion<'_>, piece: &RoundedPiece) -> LinePiece {
    let line = &question.lines[piece.line as usize];
    let (object, source) = question.source(line);
    LinePiece {
        class: line.class,
        invisibility: piece.invisibility,
        outline: piece.outline,
        points: piece.image,
        depth: piece.depth,
        object,
        source,
        run: piece.run,
    }
}
