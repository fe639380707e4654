//! The z-buffer: every triangle in turn, every sample of its box; a sample
//! keeps the nearest so far (Catmull 1974). Which samples a triangle covers
//! is told by three edge functions that grow by a constant with each step
//! to the right (Pineda 1988).
//!
//! A sample on an edge belongs to all triangles at that edge and, as they
//! are equally near there, goes to the first by the tie rule: it is owned
//! exactly once and by the same triangle in any order of drawing, which is
//! what top-left rules are for.
//!
//! What is stored is the proposal of the depth and the face that made it,
//! so that a close comparison can be decided exactly. Bands of rows are
//! independent. O(triangles + samples of their boxes).

use super::ItemBuffer;
use super::samples::{Face, Judge, Sampled, Samples};
use crate::kernel::predicates::Policy;
use crate::model::View;
use crate::run::{Cancelled, Run, map_chunks};
use crate::view::LineQuestion;
use std::ops::Range;

/// Rows per task.
const BAND: usize = 64;

/// The nearest triangle at every sample.
///
/// # Errors
///
/// If the run is cancelled.
pub fn z_buffer<P: Policy>(
    view: &View,
    question: &LineQuestion,
    samples: &Samples,
    run: &Run,
) -> Result<ItemBuffer, Cancelled> {
    let sampled = Sampled::new(view, question, samples);
    let height = samples.height() as usize;
    let faces = sampled.faces::<P>(run)?;
    let bands = run.stage("z-buffer", height as u64, || {
        let bands = map_chunks(height, BAND, |rows| {
            run.check()?;
            let mut band = Band::new(Judge::<P>::new(&sampled), samples.width(), &rows);
            for face in &faces {
                run.check()?;
                band.draw(face);
            }
            run.merge(&band.judge.counters());
            run.advance(rows.len() as u64);
            Ok(band.items())
        });
        bands.into_iter().collect::<Result<Vec<_>, Cancelled>>()
    });
    Ok(sampled.buffer(bands?.concat()))
}

/// What a sample has seen so far.
#[derive(Clone, Copy)]
struct Nearest<'f> {
    face: &'f Face,
    depth: f64,
}

/// Some rows of the buffer.
struct Band<'s, 'f, P: Policy> {
    judge: Judge<'s, P>,
    width: u32,
    rows: [u32; 2],
    buffer: Vec<Option<Nearest<'f>>>,
}

impl<'s, 'f, P: Policy> Band<'s, 'f, P> {
    fn new(judge: Judge<'s, P>, width: u32, rows: &Range<usize>) -> Self {
        let buffer = vec![None; rows.len() * width as usize];
        Band { judge, width, rows: [rows.start as u32, rows.end as u32 - 1], buffer }
    }

    fn items(&self) -> Vec<Option<u32>> {
        self.buffer.iter().map(|nearest| nearest.map(|nearest| nearest.face.triangle)).collect()
    }

    fn draw(&mut self, face: &'f Face) {
        let [first, last] = face.footprint.rows;
        for row in first.max(self.rows[0])..=last.min(self.rows[1]) {
            self.draw_row(face, row);
        }
    }

    /// Steps through the samples of a row until the triangle is left.
    fn draw_row(&mut self, face: &'f Face, row: u32) {
        let [first, last] = face.footprint.columns;
        let borders = face.borders();
        let mut values = [0.0; 4];
        let mut steps = [0.0; 4];
        for (k, border) in borders.iter().enumerate() {
            values[k] = border.form.at([first, row]);
            steps[k] = border.form.right();
        }
        let mut depth = face.depth.at([first, row]);
        let mut entered = false;
        for column in first..=last {
            let at = [column, row];
            if (0..borders.len()).all(|k| self.judge.is_in(face, k, at, values[k])) {
                entered = true;
                self.offer(Nearest { face, depth }, at);
            } else if entered {
                // Convex: what is left does not come back.
                break;
            }
            (0..borders.len()).for_each(|k| values[k] += steps[k]);
            depth += face.depth.right();
        }
    }

    /// Keeps the nearer of what a sample has seen and what it sees now.
    #[inline(always)]
    fn offer(&mut self, new: Nearest<'f>, at: [u32; 2]) {
        let [column, row] = at;
        let index = ((row - self.rows[0]) * self.width + column) as usize;
        let wins = self.buffer[index]
            .is_none_or(|old| self.judge.wins((new.face, new.depth), (old.face, old.depth), at));
        if wins {
            self.buffer[index] = Some(new);
        }
    }
}
