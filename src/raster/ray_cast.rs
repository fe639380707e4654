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

use super::item_buffer::tie_order;
use super::{BoxTree, ItemBuffer, Samples};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Points, Policy, Predicates};
use crate::model::{View, ViewCoordinates};
use crate::run::{Cancelled, Run, map_chunks, map_indexed};
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
    let mesh = question.mesh;
    let first = mesh.vertices().len() as u32;
    let count = samples.width() as usize * samples.height() as usize;
    // Samples become vertices behind those of the mesh.
    let mut vertices = mesh.vertices().to_vec();
    vertices.extend(samples.points(0..samples.height()));
    let points = Points::new(&vertices, view.eye, view.near);
    let coordinates = ViewCoordinates::new(&view.frame, &vertices);
    let caster = Caster { question, tree: triangle_tree(question, &coordinates) };
    let parts = run.stage("ray-cast", count as u64, || {
        map_chunks(count, PART, |part| {
            run.check()?;
            let predicates = Predicates::<P>::new(&points);
            let units = part.len() as u64;
            let hits: Vec<_> = part
                .map(|i| {
                    let sample = first + i as u32;
                    let mut area = coordinates.bounds([sample]);
                    area.high[2] = f32::INFINITY;
                    caster.nearest(&predicates, sample, &area)
                })
                .collect();
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
    Ok(ItemBuffer::of_items(view, mesh, samples, hits))
}

/// The boxes of all triangles that can hide something.
pub(super) fn triangle_tree(question: &LineQuestion, coordinates: &ViewCoordinates) -> BoxTree {
    let triangles = question.mesh.triangles();
    let boxes = map_indexed(triangles.len(), |i| {
        if question.facing[i].is_zero() { Bounds::EMPTY } else { coordinates.bounds(triangles[i]) }
    });
    BoxTree::new(boxes)
}

struct Caster<'a, 'q> {
    question: &'a LineQuestion<'q>,
    tree: BoxTree,
}

impl Caster<'_, '_> {
    fn triangle(&self, triangle: u32) -> ([u32; 3], Sign) {
        let corners = self.question.mesh.triangles()[triangle as usize];
        (corners, self.question.facing[triangle as usize])
    }

    /// The triangle that the ray through a sample meets first.
    fn nearest<P: Policy>(
        &self,
        predicates: &Predicates<'_, P>,
        sample: u32,
        area: &Bounds,
    ) -> Option<u32> {
        let mut best: Option<u32> = None;
        self.tree.in_front(area, |triangle| {
            let (corners, facing) = self.triangle(triangle);
            if !covers(predicates, corners, facing, sample)
                || !predicates.meets_in_front(sample, corners, facing)
            {
                return;
            }
            let wins = best.is_none_or(|best| {
                let order = predicates.nearer(sample, (corners, facing), self.triangle(best));
                order == Sign::Positive
                    || (order.is_zero()
                        && tie_order(self.question.mesh, triangle, best) == Ordering::Less)
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
