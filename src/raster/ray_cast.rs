//! Ray casting: one exact ray through each sample, the nearest hit wins
//! (Appel 1968).
//!
//! A ray through sample x hits a triangle if x is inside the triangle's
//! three silhouette planes, borders included: three signs. Which of two
//! hits is nearer is the sign of a polynomial too, see
//! [`Predicates::nearer`]. Equal depths go to the triangle with the least
//! sorted corner coordinates, then to the object with the lesser name: the
//! order of the file decides nothing.
//!
//! O(samples x (log n + hits)).

use super::samples::{Sampled, Samples};
use super::{BoxTree, ItemBuffer};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Policy, Predicates, sort_by_predicates};
use crate::model::{View, ViewCoordinates};
use crate::run::{Cancelled, Run, map_chunks};
use crate::spatial::Bounds;
use crate::view::LineQuestion;
use std::cmp::Ordering;

/// Samples per task.
const PART: usize = 1024;

/// The nearest triangle at every sample. Edge-on triangles are not seen,
/// nor is what lies behind the near plane.
///
/// # Errors
///
/// If the run is cancelled.
pub fn ray_cast<P: Policy>(
    view: &View,
    question: &LineQuestion,
    samples: &Samples,
    run: &Run,
) -> Result<ItemBuffer, Cancelled> {
    let sampled = Sampled::new(view, question, samples);
    let width = samples.width();
    let count = width as usize * samples.height() as usize;
    let cell = |i: usize| [i as u32 % width, i as u32 / width];
    let hits = cast::<P>(view, question, &sampled, (count, cell), run)?;
    Ok(sampled.buffer(hits))
}

/// The nearest triangle at some samples, named by column and row: what
/// [`ray_cast`] finds there.
///
/// # Errors
///
/// If the run is cancelled.
pub fn ray_cast_at<P: Policy>(
    view: &View,
    question: &LineQuestion<'_>,
    samples: &Samples,
    cells: &[[u32; 2]],
    run: &Run<'_>,
) -> Result<Vec<Option<u32>>, Cancelled> {
    let sampled = Sampled::of_some(view, question, samples, cells.iter().copied());
    cast::<P>(view, question, &sampled, (cells.len(), |i| cells[i]), run)
}

/// Casts a ray through each sample of some, which are given by their number
/// and their columns and rows.
fn cast<P: Policy>(
    view: &View,
    question: &LineQuestion<'_>,
    sampled: &Sampled<'_>,
    (count, cell): (usize, impl Fn(usize) -> [u32; 2] + Sync + Send),
    run: &Run<'_>,
) -> Result<Vec<Option<u32>>, Cancelled> {
    // Boxes of rays and of triangles must be rounded alike.
    let first = question.mesh.vertices().len();
    let mut vertices = question.mesh.vertices().to_vec();
    vertices.extend((0..count).map(|i| {
        let [column, row] = cell(i);
        sampled.samples().point(column, row)
    }));
    let coordinates = ViewCoordinates::new(&view.frame, &vertices);
    let caster = Caster { sampled, tree: BoxTree::of_triangles(question, &coordinates) };
    let parts = run.stage("ray-cast", count as u64, || {
        map_chunks(count, PART, |part| {
            run.check()?;
            let predicates = Predicates::<P>::new(sampled.points());
            let units = part.len() as u64;
            let hits: Vec<_> = part
                .take_while(|_| !run.is_stopped())
                .map(|i| {
                    let sample = (first + i) as u32;
                    let mut area = coordinates.bounds([sample]);
                    area.high[2] = f32::INFINITY;
                    caster.nearest(&predicates, sample, &area)
                })
                .collect();
            run.check()?;
            run.merge(&predicates.counters());
            run.count("rays-cast", units);
            run.advance(units);
            Ok(hits)
        })
    });
    let mut hits = Vec::with_capacity(count);
    for part in parts {
        hits.extend(part?);
    }
    Ok(hits)
}

/// All triangles that the ray through one sample meets, nearest first, with
/// the depth of each in world units, rounded. Borders of triangles belong to
/// them; edge-on triangles are not met, nor is what lies behind the near
/// plane. O(n) for n triangles.
pub fn ray_hits<P: Policy>(
    view: &View,
    question: &LineQuestion<'_>,
    samples: &Samples,
    sample: [u32; 2],
) -> Vec<(u32, f64)> {
    let sampled = Sampled::new(view, question, samples);
    let predicates = Predicates::<P>::new(sampled.points());
    let vertex = sampled.vertex(sample);
    let is_met = |&triangle: &u32| {
        let (corners, facing) = sampled.triangle(triangle);
        !facing.is_zero()
            && covers(&predicates, corners, facing, vertex)
            && predicates.meets_in_front(vertex, corners, facing)
    };
    let mut hits: Vec<u32> = (0..question.mesh.triangles().len() as u32).filter(is_met).collect();
    sort_by_predicates::<P, _>(&mut hits, |&a, &b| {
        let [first, second] = [a, b].map(|triangle| sampled.triangle(triangle));
        let nearer = predicates.nearer(vertex, first, second);
        let tie = || match a == b {
            true => Ordering::Equal,
            false if sampled.precedes(a, b) => Ordering::Less,
            false => Ordering::Greater,
        };
        Ordering::from(-nearer).then_with(tie)
    });
    hits.into_iter().map(|triangle| (triangle, sampled.depth(sample, triangle))).collect()
}

struct Caster<'a> {
    sampled: &'a Sampled<'a>,
    tree: BoxTree,
}

impl Caster<'_> {
    /// The triangle that the ray through a sample meets first.
    fn nearest<P: Policy>(
        &self,
        predicates: &Predicates<'_, P>,
        sample: u32,
        area: &Bounds,
    ) -> Option<u32> {
        let mut best: Option<u32> = None;
        self.tree.in_front(area, |triangle| {
            let (corners, facing) = self.sampled.triangle(triangle);
            if !covers(predicates, corners, facing, sample)
                || !predicates.meets_in_front(sample, corners, facing)
            {
                return;
            }
            let wins = best.is_none_or(|best| {
                let other = self.sampled.triangle(best);
                let order = predicates.nearer(sample, (corners, facing), other);
                order == Sign::Positive
                    || (order.is_zero() && self.sampled.precedes(triangle, best))
            });
            if wins {
                best = Some(triangle);
            }
        });
        best
    }
}

/// Whether the closed image of a triangle contains that of a vertex.
fn covers<P: Policy>(
    predicates: &Predicates<'_, P>,
    [a, b, c]: [u32; 3],
    facing: Sign,
    x: u32,
) -> bool {
    [(a, b), (b, c), (c, a)].into_iter().all(|(p, q)| predicates.side(p, q, x) != -facing)
}
