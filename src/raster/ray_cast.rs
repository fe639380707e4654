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

use super::{BoxTree, ItemBuffer, Samples};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Eye, Points, Policy, Predicates};
use crate::model::{View, ViewCoordinates};
use crate::run::{Cancelled, Run, map_chunks, map_indexed};
use crate::spatial::Bounds;
use crate::view::LineQuestion;
use glam::DVec3;
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
    let (width, height) = (samples.width(), samples.height());
    let count = width as usize * height as usize;
    // Samples become vertices behind those of the mesh.
    let mut vertices = mesh.vertices().to_vec();
    vertices.extend((0..count as u32).map(|i| samples.point(i % width, i / width)));
    let points = Points::new(&vertices, view.eye, view.near);
    let coordinates = ViewCoordinates::new(&view.frame, &vertices);
    let caster =
        Caster { question, view, tree: triangle_tree(question, &coordinates), vertices: &vertices };
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
                    let hit = caster.nearest(&predicates, sample, &area);
                    (hit, caster.depth(sample, hit))
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
    Ok(ItemBuffer::new(width, hits))
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
    view: &'a View,
    tree: BoxTree,
    vertices: &'a [DVec3],
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
                    || (order.is_zero() && self.rank(triangle, best) == Ordering::Less)
            });
            if wins {
                best = Some(triangle);
            }
        });
        best
    }

    /// Compares triangles by what they are, not by where the file has them.
    fn rank(&self, s: u32, t: u32) -> Ordering {
        let mesh = self.question.mesh;
        let corners = |triangle: u32| {
            let mut corners = mesh.triangles()[triangle as usize]
                .map(|corner| mesh.vertices()[corner as usize].to_array());
            corners.sort_unstable_by(compare);
            corners
        };
        let name = |triangle| &mesh.objects()[mesh.object_of_triangle(triangle) as usize].name;
        let (a, b) = (corners(s), corners(t));
        let by_corner = a.iter().zip(&b).map(|(a, b)| compare(a, b));
        by_corner
            .fold(Ordering::Equal, Ordering::then)
            .then_with(|| name(s).cmp(name(t)))
            .then(s.cmp(&t))
    }

    /// Depth of the point that a sample sees, rounded.
    fn depth(&self, sample: u32, hit: Option<u32>) -> f64 {
        let Some(triangle) = hit else {
            return f64::INFINITY;
        };
        let [a, b, c] = self.triangle(triangle).0.map(|v| self.vertices[v as usize]);
        let x = self.vertices[sample as usize];
        let normal = (b - a).cross(c - a);
        let ray = match self.view.eye {
            Eye::At(eye) => eye - x,
            Eye::Towards(direction) => direction,
        };
        let along = normal.dot(a - x) / normal.dot(ray);
        self.view.frame.depth(x + ray * along)
    }
}

fn compare(a: &[f64; 3], b: &[f64; 3]) -> Ordering {
    a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
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
