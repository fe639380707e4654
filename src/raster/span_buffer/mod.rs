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
//! are proposed by affine forms; samples at which a form is not certain are
//! decided one by one by the exact sign ([`Form`]). Where a side of a
//! triangle runs along the row, the samples covered need not be neighbours,
//! for each is rounded on its own; the triangle then has several spans.
//!
//! O(rows x spans x depth of the groups), after O(triangles + samples).

mod faces;
mod ordered;
mod resolve;

pub use ordered::c_buffer;

use super::{ItemBuffer, Samples};
use crate::kernel::predicates::{Policy, Predicates};
use crate::model::View;
use crate::run::{Cancelled, Run, map_chunks};
use crate::view::LineQuestion;
use faces::{Faces, Rows, Span};
use resolve::Resolver;

#[cfg(doc)]
use crate::kernel::predicates::Form;

/// Rows per task.
const PART: usize = 8;

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
    let faces = Faces::new::<P>(view, question, samples, run)?;
    let rows = faces.rows(0..faces.len() as u32);
    let parts = run.stage("span-buffer", u64::from(samples.height()), || {
        map_chunks(samples.height() as usize, PART, |part| {
            run.check()?;
            let predicates = Predicates::<P>::new(faces.points());
            let mut resolver = Resolver::new(&faces, &predicates, compare);
            let units = part.len() as u64;
            let mut items = vec![None; part.len() * samples.width() as usize];
            for (row, line) in part.zip(items.chunks_exact_mut(samples.width() as usize)) {
                paint_row(&faces, &rows, &mut resolver, row as u32, line);
            }
            run.merge(&predicates.counters());
            run.count("span-cuts-at-crossings", resolver.crossings());
            run.advance(units);
            Ok(items)
        })
    });
    let mut items = Vec::with_capacity(samples.width() as usize * samples.height() as usize);
    for part in parts {
        items.extend(part?);
    }
    Ok(ItemBuffer::of_items(view, question.mesh, samples, items))
}

/// Steps 1 to 3 for one row.
fn paint_row<P: Policy>(
    faces: &Faces,
    rows: &Rows,
    resolver: &mut Resolver<'_, '_, P>,
    row: u32,
    line: &mut [Option<u32>],
) {
    let mut spans: Vec<Span> = Vec::new();
    for &face in rows.of(row) {
        faces.spans(resolver.predicates(), face, row, |columns| {
            spans.push(Span { face, columns });
        });
    }
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
fn write(faces: &Faces, line: &mut [Option<u32>], span: Option<Span>) {
    if let Some(span) = span {
        let triangle = faces.triangle(span.face);
        line[span.columns.start as usize..span.columns.end as usize].fill(Some(triangle));
    }
}
