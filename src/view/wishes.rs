//! What is wished of single objects.

use super::LineQuestion;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Points, Policy, Predicates};
use crate::model::{
    EffectiveEdge, FeatureLine, FeatureOptions, Features, LineClass, LineOrigin, Mesh,
};
use crate::run::{Run, map_chunks};

/// How one object is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ObjectWish {
    /// Which of its edges are lines.
    pub features: FeatureOptions,
    /// Whether it hides nothing. Its own lines are drawn as ever.
    pub see_through: bool,
}

/// Lines by the wishes for their objects, effective edges of those that hide.
/// `facing` of triangles that hide nothing becomes zero, as if edge-on.
/// O(n) for each different wish.
pub(super) fn find<P: Policy>(
    mesh: &Mesh,
    points: &Points,
    facing: &mut [Sign],
    wishes: &[ObjectWish],
    run: &Run<'_>,
) -> Features {
    let mut different: Vec<FeatureOptions> = Vec::new();
    for wish in wishes {
        if !different.contains(&wish.features) {
            different.push(wish.features);
        }
    }
    let mut features = Features::default();
    for (index, options) in different.iter().enumerate() {
        let found = Features::find::<P>(mesh, points, facing, options, run);
        let own = |line: &FeatureLine| wishes[object_of(mesh, line) as usize].features == *options;
        features.lines.extend(found.lines.into_iter().filter(own));
        if index == 0 {
            features.effective = found.effective;
        }
    }
    if 1 < different.len() {
        features.lines.sort_by_key(|line| line.origin);
    }
    if wishes.iter().any(|wish| wish.see_through) {
        for (triangle, facing) in facing.iter_mut().enumerate() {
            if wishes[mesh.object_of_triangle(triangle as u32) as usize].see_through {
                *facing = Sign::Zero;
            }
        }
        features.effective = EffectiveEdge::find(mesh, facing);
    }
    features
}

/// Intersection lines that are wished for by one of the objects that cross.
/// O(n).
pub(super) fn crossings<P: Policy>(
    question: &LineQuestion<'_>,
    wishes: &[ObjectWish],
    run: &Run<'_>,
) -> Vec<FeatureLine> {
    /// Lines that one task looks at.
    const PART: usize = 1 << 12;
    let crossings = question.intersections;
    let parts = map_chunks(crossings.len(), PART, |part| {
        let predicates = Predicates::<P>::new(question.points);
        let is_wanted = |index: &usize| {
            let crossing = &crossings[*index];
            let object = |i: usize| question.mesh.object_of_triangle(crossing.triangles[i]);
            let [first, second] = [0, 1].map(|i| &wishes[object(i) as usize].features);
            let wanted = |options: &FeatureOptions| {
                options.wants(LineClass::Intersection)
                    && crossing.is_fold(question.mesh, &predicates, options)
            };
            wanted(first) || (second != first && wanted(second))
        };
        let line = |index: usize| FeatureLine {
            origin: LineOrigin::Intersection(index as u32),
            class: LineClass::Intersection,
        };
        let lines: Vec<FeatureLine> = part.filter(is_wanted).map(line).collect();
        (lines, predicates.counters())
    });
    parts.iter().for_each(|(_, counters)| run.merge(counters));
    parts.into_iter().flat_map(|(lines, _)| lines).collect()
}

fn object_of(mesh: &Mesh, line: &FeatureLine) -> u32 {
    mesh.object_of_vertex(line.origin.names(mesh).map_or(0, |[vertex, _]| vertex))
}
