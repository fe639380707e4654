//! Warnock's method: a window of the image that is not simple is cut into
//! smaller ones (Warnock 1969).
//!
//! A window is simple, and no longer cut, if
//!
//! 1. no polygon is seen in it, or
//! 2. one polygon alone, inside, across or around it, or
//! 3. a polygon around it hides all others in it, or
//! 4. it is one sample, where the nearest is found by comparing all.
//!
//! Children look only at polygons that their parent did not drop: those
//! outside, and those behind a polygon around the window. `window` has the
//! tests, `subdivision` the two ways to cut.
//!
//! O(sum over windows of polygons not dropped); the tree is deep along
//! outlines and shallow elsewhere.

mod subdivision;
mod window;

pub use self::subdivision::Subdivision;

use self::subdivision::{at_a_corner, in_the_middle};
use self::window::{Relation, relation};
use super::ItemBuffer;
use super::samples::{Face, Footprint, Judge, Sampled, Samples};
use crate::kernel::predicates::Policy;
use crate::model::View;
use crate::run::{Cancelled, Run, map_chunks};
use crate::view::LineQuestion;

/// Windows that are looked at one after the other before the rest are
/// shared out.
const SHARED: usize = 64;

/// Why a window was not cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// Nothing is seen in it.
    Empty,
    /// One polygon alone is.
    Single,
    /// A polygon around it hides all others.
    Surrounded,
    /// It is one sample.
    Sample,
}

/// A leaf of the tree of windows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Window {
    /// Its samples.
    pub samples: Footprint,
    /// Why it is a leaf.
    pub stop: Stop,
}

/// The nearest triangle at every sample, by regular subdivision.
///
/// # Errors
///
/// If the run is cancelled.
pub fn warnock<P: Policy>(
    view: &View,
    question: &LineQuestion,
    samples: &Samples,
    run: &Run,
) -> Result<ItemBuffer, Cancelled> {
    let (items, _) = warnock_windows::<P>(view, question, samples, Subdivision::Regular, run)?;
    Ok(items)
}

/// The nearest triangle at every sample, by subdivision beside corners.
///
/// # Errors
///
/// If the run is cancelled.
pub fn warnock_vertex<P: Policy>(
    view: &View,
    question: &LineQuestion,
    samples: &Samples,
    run: &Run,
) -> Result<ItemBuffer, Cancelled> {
    let (items, _) = warnock_windows::<P>(view, question, samples, Subdivision::Vertex, run)?;
    Ok(items)
}

/// The same with all windows that were not cut, for a picture of them.
///
/// # Errors
///
/// If the run is cancelled.
pub fn warnock_windows<P: Policy>(
    view: &View,
    question: &LineQuestion,
    samples: &Samples,
    subdivision: Subdivision,
    run: &Run,
) -> Result<(ItemBuffer, Vec<Window>), Cancelled> {
    let sampled = Sampled::new(view, question, samples);
    let faces = sampled.faces::<P>(run)?;
    let width = samples.width();
    let count = width as usize * samples.height() as usize;
    let solutions = run.stage("warnock", count as u64, || {
        let mut top = Solver::<P>::new(&sampled, &faces, subdivision);
        let list = (0..faces.len() as u32).map(|face| Entry { face, surrounds: false });
        let mut waiting = vec![(samples.all(), list.collect())];
        while !waiting.is_empty() && waiting.len() < SHARED {
            for (window, list) in std::mem::take(&mut waiting) {
                run.check()?;
                run.advance(0);
                top.step(window, list, &mut waiting);
            }
        }
        run.merge(&top.judge.counters());
        let mut solutions = map_chunks(waiting.len(), 1, |part| {
            run.check()?;
            let mut solver = Solver::<P>::new(&sampled, &faces, subdivision);
            let mut stack = waiting[part].to_vec();
            while let Some((window, list)) = stack.pop() {
                run.check()?;
                run.advance(0);
                solver.step(window, list, &mut stack);
            }
            run.merge(&solver.judge.counters());
            Ok(solver.solution)
        });
        solutions.push(Ok(top.solution));
        solutions.into_iter().collect::<Result<Vec<_>, Cancelled>>()
    })?;
    let mut items = vec![None; count];
    let mut windows = Vec::new();
    for solution in solutions {
        for ([column, row], triangle) in solution.seen {
            items[row as usize * width as usize + column as usize] = Some(triangle);
        }
        windows.extend(solution.windows);
    }
    run.count("warnock-windows", windows.len() as u64);
    Ok((sampled.buffer(items), windows))
}

/// A face that is not outside a window, and whether it surrounds it.
#[derive(Debug, Clone, Copy)]
struct Entry {
    face: u32,
    surrounds: bool,
}

/// A window that has not been looked at, with what its parent left.
type Waiting = (Footprint, Vec<Entry>);

/// What was found.
#[derive(Debug, Default)]
struct Solution {
    windows: Vec<Window>,
    seen: Vec<([u32; 2], u32)>,
}

struct Solver<'s, P: Policy> {
    sampled: &'s Sampled<'s>,
    faces: &'s [Face],
    judge: Judge<'s, P>,
    subdivision: Subdivision,
    solution: Solution,
}

impl<'s, P: Policy> Solver<'s, P> {
    fn new(sampled: &'s Sampled<'s>, faces: &'s [Face], subdivision: Subdivision) -> Self {
        let judge = Judge::new(sampled);
        Solver { sampled, faces, judge, subdivision, solution: Solution::default() }
    }

    /// Solves a simple window; cuts another one and lets its parts wait.
    fn step(&mut self, window: Footprint, mut list: Vec<Entry>, waiting: &mut Vec<Waiting>) {
        list.retain_mut(|entry| {
            // What is around a window is around its parts.
            let relation = match entry.surrounds {
                true => Relation::Surrounding,
                false => relation(&self.judge, &self.faces[entry.face as usize], &window),
            };
            entry.surrounds = relation == Relation::Surrounding;
            relation != Relation::Outside
        });
        match list.as_slice() {
            [] => return self.stop(window, Stop::Empty),
            [one] => {
                self.paint(&window, *one);
                return self.stop(window, Stop::Single);
            }
            _ => {}
        }
        let front = self.front(&window, &list);
        if window.columns[0] == window.columns[1] && window.rows[0] == window.rows[1] {
            // At one sample, whatever is not outside is around.
            front.into_iter().for_each(|front| self.paint(&window, front));
            return self.stop(window, Stop::Sample);
        }
        if let Some(front) = front {
            let face = &self.faces[front.face as usize];
            list.retain(|entry| {
                entry.face == front.face
                    || !self.hides(face, &self.faces[entry.face as usize], &window)
            });
            if list.len() == 1 {
                self.paint(&window, front);
                return self.stop(window, Stop::Surrounded);
            }
        }
        for part in self.cut(&window, &list) {
            waiting.push((part, list.clone()));
        }
    }

    /// Of the polygons around a window the nearest at its first corner.
    fn front(&self, window: &Footprint, list: &[Entry]) -> Option<Entry> {
        let [corner, ..] = window.corners();
        list.iter().copied().filter(|entry| entry.surrounds).reduce(|best, other| {
            let [a, b] = [best, other].map(|entry| &self.faces[entry.face as usize]);
            if self.judge.beats(b, a, corner) { other } else { best }
        })
    }

    fn cut(&self, window: &Footprint, list: &[Entry]) -> Vec<Footprint> {
        let at_a_corner = || {
            let crossing = list.iter().filter(|entry| !entry.surrounds);
            let faces = crossing.map(|entry| &self.faces[entry.face as usize]);
            at_a_corner(window, faces.filter_map(|face| self.sampled.places(face)).flatten())
        };
        match self.subdivision {
            Subdivision::Regular => None,
            Subdivision::Vertex => at_a_corner(),
        }
        .unwrap_or_else(|| in_the_middle(window))
    }

    /// Writes one polygon into a window.
    fn paint(&mut self, window: &Footprint, entry: Entry) {
        let face = &self.faces[entry.face as usize];
        let Some(part) = window.intersection(&face.footprint) else {
            return;
        };
        for row in part.rows[0]..=part.rows[1] {
            for column in part.columns[0]..=part.columns[1] {
                if entry.surrounds || self.judge.covers(face, [column, row]) {
                    self.solution.seen.push(([column, row], face.triangle));
                }
            }
        }
    }

    fn stop(&mut self, samples: Footprint, stop: Stop) {
        self.solution.windows.push(Window { samples, stop });
    }
}
