//! The span buffer: each line of samples as a list of spans that do not
//! overlap (S-buffer, in the tradition of Watkins 1970 and Romney 1970).
//!
//! 1. The triangles of a row give spans: runs of samples that they cover.
//! 2. Every span is cut at every other span's ends, so that spans are equal
//!    or apart.
//! 3. Of each group of equal spans one is kept, and neighbours of the same
//!    triangle are joined. Each sample is then written once.
//!
//! As it is usually told, step 3 keeps the span that is nearest at its
//! *start*. That fails twice, see [`Compare`]: spans that begin at a common
//! vertex are equally near there, and faces that pass through one another
//! change places inside a group. The repair cuts at the crossings too.
//!
//! A span is a set of whole samples. Its ends, and where two spans cross,
//! are proposed by forms and decided by signs, see [`runs`].
//!
//! O(rows x spans x depth of the groups), after O(triangles + samples).

mod ordered;
mod resolve;
mod runs;

pub use ordered::c_buffer;

use super::ItemBuffer;
use super::samples::{Face, Judge, Sampled, Samples};
use crate::kernel::predicates::Policy;
use crate::model::View;
use crate::run::{Cancelled, Run, map_chunks};
use crate::view::LineQuestion;
use resolve::Resolver;
use runs::run_of;
use std::ops::Range;

/// Rows per task.
const PART: usize = 8;

/// Consecutive samples of a row that a face covers.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Span {
    /// Index of the face.
    face: u32,
    columns: Range<u32>,
}

/// Where the spans of a group are compared.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Compare {
    /// At their first sample, as first published. Wrong for triangles with a
    /// common vertex there, and for those that pass through one another.
    Start,
    /// At their middle sample: wrong only for those that pass through one
    /// another.
    Middle,
    /// Everywhere: the group is cut where two of its planes cross. Right.
    #[default]
    Crossings,
}

/// The nearest triangle at every sample, by the repaired span buffer.
/// Edge-on triangles are not seen, nor is what lies behind the near plane.
///
/// # Errors
///
/// If the run is cancelled.
pub fn span_buffer<P: Policy>(
    view: &View,
    question: &LineQuestion,
    samples: &Samples,
    run: &Run,
) -> Result<ItemBuffer, Cancelled> {
    span_buffer_with::<P>(view, question, samples, Compare::Crossings, run)
}

/// [`span_buffer`] with a choice where spans are compared: to be seen
/// failing.
///
/// # Errors
///
/// If the run is cancelled.
pub fn span_buffer_with<P: Policy>(
    view: &View,
    question: &LineQuestion,
    samples: &Samples,
    compare: Compare,
    run: &Run,
) -> Result<ItemBuffer, Cancelled> {
    let sampled = Sampled::new(view, question, samples);
    let faces = sampled.faces::<P>(run)?;
    let rows = faces_of_rows(&faces, 0..faces.len() as u32, samples.height(), run)?;
    let items = draw_rows(samples, run, |part, items| {
        let mut resolver = Resolver::new(&faces, Judge::<P>::new(&sampled), compare);
        for (row, line) in part.zip(items.chunks_exact_mut(samples.width() as usize)) {
            if run.is_stopped() {
                break;
            }
            draw_row(&faces, &rows[row], &mut resolver, row as u32, line);
        }
        run.merge(&resolver.judge().counters());
        run.count("span-cuts-at-crossings", resolver.crossings());
    })?;
    Ok(sampled.buffer(items))
}

/// Which faces may be met in which row, each row in the order of `order`.
fn faces_of_rows(
    faces: &[Face],
    order: impl Iterator<Item = u32>,
    height: u32,
    run: &Run,
) -> Result<Vec<Vec<u32>>, Cancelled> {
    let reach = |face: &Face| u64::from(face.footprint.rows[1] - face.footprint.rows[0]) + 1;
    // Lists may have room for twice as many.
    run.take(2 * size_of::<u32>() as u64 * faces.iter().map(reach).sum::<u64>())?;
    let mut rows = vec![Vec::new(); height as usize];
    for face in order {
        let [first, last] = faces[face as usize].footprint.rows;
        for row in &mut rows[first as usize..=last as usize] {
            row.push(face);
        }
    }
    Ok(rows)
}

/// Lets `draw` fill the rows of an image, part by part.
fn draw_rows(
    samples: &Samples,
    run: &Run,
    draw: impl Fn(Range<usize>, &mut [Option<u32>]) + Sync + Send,
) -> Result<Vec<Option<u32>>, Cancelled> {
    let (width, height) = (samples.width() as usize, samples.height() as usize);
    let parts = run.stage("span-buffer", height as u64, || {
        map_chunks(height, PART, |part| {
            run.check()?;
            let units = part.len() as u64;
            let mut items = vec![None; part.len() * width];
            draw(part, &mut items);
            run.advance(units);
            Ok(items)
        })
    });
    let parts: Vec<_> = parts.into_iter().collect::<Result<_, _>>()?;
    Ok(parts.concat())
}

/// Steps 1 to 3 for one row.
fn draw_row<P: Policy>(
    faces: &[Face],
    met: &[u32],
    resolver: &mut Resolver<'_, P>,
    row: u32,
    line: &mut [Option<u32>],
) {
    let span = |&face: &u32| {
        let columns = run_of(resolver.judge(), &faces[face as usize], row);
        (!columns.is_empty()).then_some(Span { face, columns })
    };
    let mut spans: Vec<Span> = met.iter().filter_map(span).collect();
    spans.sort_unstable_by_key(|span| (span.columns.start, span.face));
    let mut cuts: Vec<u32> =
        spans.iter().flat_map(|span| [span.columns.start, span.columns.end]).collect();
    cuts.sort_unstable();
    cuts.dedup();
    let mut waiting = spans.into_iter().peekable();
    let mut group: Vec<Span> = Vec::new();
    let mut joined: Option<Span> = None;
    for cut in cuts.windows(2) {
        group.retain(|span| span.columns.end > cut[0]);
        while let Some(span) = waiting.next_if(|span| span.columns.start == cut[0]) {
            group.push(span);
        }
        for piece in resolver.nearest(&group, cut[0]..cut[1], row) {
            match &mut joined {
                Some(last)
                    if last.face == piece.face && last.columns.end == piece.columns.start =>
                {
                    last.columns.end = piece.columns.end;
                }
                _ => write(faces, line, joined.replace(piece.clone())),
            }
        }
    }
    write(faces, line, joined);
}

/// Writes the samples of a span.
fn write(faces: &[Face], line: &mut [Option<u32>], span: Option<Span>) {
    if let Some(span) = span {
        let triangle = faces[span.face as usize].triangle;
        line[span.columns.start as usize..span.columns.end as usize].fill(Some(triangle));
    }
}
