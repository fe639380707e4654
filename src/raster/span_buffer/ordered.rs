//! The span buffer for faces in a known order: free intervals in an ordered
//! tree, and no depth at all (the "C-buffer" of the games of the 1990s).
//!
//! If every face comes before all those it hides anything of, whatever is
//! still free belongs to the face at hand. A row with nothing free is done,
//! however many faces are left: that is what the order buys. It is an
//! argument, for whoever has a tree or a list of priorities has it already;
//! from an order that is wrong comes a picture that is wrong, and where two
//! faces are equally near at a sample, the first of them owns it.
//!
//! O(spans x log spans).

use super::runs::run_of;
use super::{draw_rows, faces_of_rows};
use crate::kernel::predicates::Policy;
use crate::model::View;
use crate::raster::ItemBuffer;
use crate::raster::samples::{Face, Judge, Sampled, Samples};
use crate::run::{Cancelled, Run};
use crate::view::LineQuestion;
use std::collections::BTreeMap;
use std::ops::Range;

/// What is not yet drawn of a row: the end of each free interval by its
/// start.
struct Free(BTreeMap<u32, u32>);

impl Free {
    fn new(width: u32) -> Self {
        Free((0 < width).then_some((0, width)).into_iter().collect())
    }

    /// Takes what is free of some columns and hands it to `taken`.
    fn take(&mut self, columns: Range<u32>, mut taken: impl FnMut(Range<u32>)) {
        if columns.is_empty() {
            return;
        }
        let before = self.0.range(..columns.start).next_back().map(|(&start, _)| start);
        let first = before.unwrap_or(columns.start);
        let meeting: Vec<Range<u32>> = self
            .0
            .range(first..columns.end)
            .map(|(&start, &end)| start..end)
            .filter(|free| columns.start < free.end)
            .collect();
        for free in meeting {
            self.0.remove(&free.start);
            if free.start < columns.start {
                self.0.insert(free.start, columns.start);
            }
            if columns.end < free.end {
                self.0.insert(columns.end, free.end);
            }
            taken(free.start.max(columns.start)..free.end.min(columns.end));
        }
    }
}

/// The first triangle of `order` at every sample: the nearest one, if each
/// triangle comes before all those that it hides anything of. Triangles
/// that are not named are not drawn.
///
/// # Errors
///
/// If the run is cancelled.
pub fn c_buffer<P: Policy>(
    view: &View,
    question: &LineQuestion,
    samples: &Samples,
    order: &[u32],
    run: &Run,
) -> Result<ItemBuffer, Cancelled> {
    let sampled = Sampled::new(view, question, samples);
    let faces = sampled.faces::<P>(run)?;
    let mut face_of = vec![None; question.mesh.triangles().len()];
    for (face, index) in faces.iter().zip(0..) {
        face_of[face.triangle as usize] = Some(index);
    }
    let named = order.iter().filter_map(|&triangle| *face_of.get(triangle as usize)?);
    let rows = faces_of_rows(&faces, named, samples.height(), run)?;
    let items = draw_rows(samples, run, |part, items| {
        let judge = Judge::<P>::new(&sampled);
        for (row, line) in part.zip(items.chunks_exact_mut(samples.width() as usize)) {
            draw_row(&faces, &rows[row], &judge, row as u32, line);
        }
        run.merge(&judge.counters());
    })?;
    Ok(sampled.buffer(items))
}

/// Gives each sample of a row to the first face that covers it.
fn draw_row<P: Policy>(
    faces: &[Face],
    met: &[u32],
    judge: &Judge<'_, P>,
    row: u32,
    line: &mut [Option<u32>],
) {
    let mut free = Free::new(line.len() as u32);
    for &face in met {
        if free.0.is_empty() {
            return;
        }
        let face = &faces[face as usize];
        free.take(run_of(judge, face, row), |taken| {
            line[taken.start as usize..taken.end as usize].fill(Some(face.triangle));
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn free_intervals_are_handed_out_once() {
        let mut free = Free::new(100);
        let mut take = |columns| {
            let mut taken = Vec::new();
            free.take(columns, |range| taken.push(range));
            taken
        };
        let one = |range: Range<u32>| vec![range];
        assert_eq!(take(10..20), one(10..20));
        assert_eq!(take(30..40), one(30..40));
        assert_eq!(take(15..35), one(20..30));
        assert!(take(15..35).is_empty());
        assert_eq!(take(5..50), [5..10, 40..50]);
        assert_eq!(take(0..100), [0..5, 50..100]);
        assert!(free.0.is_empty());
    }
}
