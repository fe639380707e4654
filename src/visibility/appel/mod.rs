//! Appel's quantitative invisibility, for any triangle soup.
//!
//! The invisibility of a point is the number of sheets in front of it.
//! Along a line it changes only where the line passes behind an *effective*
//! edge, one with different numbers of triangles to its left and to its
//! right in the image, or where it pierces a triangle. So:
//!
//! 1. Count the sheets in front of one end of the line, looking along it
//!    ([`count`]).
//! 2. Find the effective edges in front whose images cross that of the
//!    line, and the triangles that the line pierces ([`events`]).
//! 3. Order these events exactly along the line and add them up ([`sweep`]).
//!
//! Counts are kept twice, for the line moved infinitesimally to its left
//! and to its right in the image. That makes every vertex that is met an
//! ordinary crossing or none, and settles lines exactly behind edges; the
//! larger count is the invisibility. Sheets are counted, not front faces,
//! so nothing is assumed about winding, closedness or manifoldness.
//!
//! Sources: A. Appel, "The notion of quantitative invisibility and the
//! machine rendering of solids", 1967. R. Galimberti and U. Montanari, "An
//! algorithm for hidden line elimination", 1969.
//!
//! Where all that is needed to know is known, which is where many lines are
//! drawn, the count is carried from line to line across vertices, as Appel
//! does, and few lines are counted afresh ([`carry`], [`linked`]).
//!
//! Cost: O(1) expected hierarchy queries per line, plus k log k for k
//! events on a line.

mod carry;
mod count;

mod events;
mod left_out;
mod linked;
mod relevant;
mod sweep;
mod walker;

use crate::kernel::predicates::Policy;
use crate::run::{Cancelled, Counters, Growing, Run, map_chunks};
use crate::view::{Covered, Culling, ExactLines, ExactPiece, LineQuestion, Skips};
use linked::linked_lines;
use std::borrow::Cow;
use std::ops::Range;
use walker::Walker;

/// Deliberate mistakes, to prove that a check can fail. Never set outside
/// of tests of the tests.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// Lines that pierce a face do not notice it.
    ForgetPiercings,
    /// Edges behind the line count like edges in front of it.
    IgnoreDepth,
    /// Lines that pass a vertex of an edge do not cross the edge.
    LoseVertexHits,
    /// Every effective edge hides one sheet, folds too.
    CountFoldsOnce,
    /// Every line begins in the open.
    StartVisible,
}

impl Fault {
    /// All faults.
    pub const ALL: [Fault; 5] = [
        Fault::ForgetPiercings,
        Fault::IgnoreDepth,
        Fault::LoseVertexHits,
        Fault::CountFoldsOnce,
        Fault::StartVisible,
    ];

    /// The name of the fault on a command line.
    pub fn name(self) -> &'static str {
        match self {
            Fault::ForgetPiercings => "forget-piercings",
            Fault::IgnoreDepth => "ignore-depth",
            Fault::LoseVertexHits => "lose-vertex-hits",
            Fault::CountFoldsOnce => "count-folds-once",
            Fault::StartVisible => "start-visible",
        }
    }
}

/// How to run [`appel`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct AppelOptions {
    /// A mistake to make.
    pub fault: Option<Fault>,
    /// What need not be looked at. The answer is the same whatever is skipped.
    pub skips: Skips,
}

/// How many of `lines` one task walks: so many that bookkeeping is little,
/// so few that cores share the work evenly. The same on every machine.
fn part_of(lines: usize) -> usize {
    (lines / 1024).clamp(64, 1024)
}

/// Finds the invisibility of every piece of every line.
///
/// # Errors
///
/// If the run is cancelled or reaches a limit.
pub fn appel<P: Policy>(
    question: &LineQuestion<'_>,
    options: &AppelOptions,
    run: &Run<'_>,
) -> Result<ExactLines, Cancelled> {
    let count = question.lines.len();
    let triangles = match question.has_hierarchy() {
        true => Cow::Borrowed(question.hierarchy()),
        false => {
            let triangles = question.mesh.triangles().len() as u64;
            run.stage("hierarchy", triangles, || relevant::triangles(question))
        }
    };
    run.check()?;
    run.stage("appel", count as u64, || {
        let effective = question.effective_crossings();
        // A mistake shall show.
        let never = options.fault.is_some() || question.culled;
        let culling = if never { Culling::Never } else { options.skips.culling };
        let covered = Covered::find(question, culling, run)?;
        let walker =
            || Walker::<P>::new(question, &effective, &triangles, covered.as_ref(), options);
        match question.contacts.filter(|_| options.skips.carry && question.piercings.is_some()) {
            Some(contacts) => linked_lines(question, &contacts, walker, run),
            None => gather(run, count, |part| {
                run.check()?;
                let mut walker = walker();
                let mut answer = ExactLines::default();
                let (mut met, mut made) = (Growing::new(run, 0).of_crossings(), pieces_of(run));
                for line in part {
                    run.advance(1);
                    if !met.goes_on(walker.events_held()) || !made.goes_on(answer.piece_count()) {
                        break;
                    }
                    walker.walk_unless_left_out(&question.lines[line]);
                    answer.push_line(walker.pieces());
                }
                met.finish(walker.events_held())?;
                made.finish(answer.piece_count())?;
                Ok((answer, walker.counters()))
            }),
        }
    })
}

/// The pieces of one part: they are copied once, when the parts are joined.
fn pieces_of<'r>(run: &'r Run<'r>) -> Growing<'r> {
    Growing::new(run, 2 * size_of::<ExactPiece>())
}

/// Works on the lines in parts and joins the answers.
fn gather(
    run: &Run<'_>,
    lines: usize,
    work: impl Fn(Range<usize>) -> Result<(ExactLines, Counters), Cancelled> + Sync + Send,
) -> Result<ExactLines, Cancelled> {
    let mut counters = Counters::default();
    let mut parts = Vec::new();
    for part in map_chunks(lines, part_of(lines), work) {
        let (lines, counted) = part?;
        parts.push(lines);
        counters.merge(&counted);
    }
    run.merge(&counters);
    Ok(ExactLines::concat(&parts))
}
