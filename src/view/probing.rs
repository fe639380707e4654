//! What a line asks hierarchies with: its box, and those of its ends.

use super::LineQuestion;
use crate::kernel::predicates::{Point, Policy, Predicates};
use crate::model::{FeatureLine, Hinge, LineOrigin, RoughPoint};
use crate::spatial::{Bounds, SegmentProbe};

/// A line in narrow view coordinates, rounded outward.
#[derive(Debug, Clone, Copy)]
pub struct ProbedLine {
    /// The line.
    pub probe: SegmentProbe,
    /// Boxes around its first and last point.
    pub ends: [Bounds; 2],
}

impl ProbedLine {
    /// The same line from its other end.
    #[must_use]
    pub fn turned(self) -> Self {
        let [first, last] = self.ends;
        ProbedLine { ends: [last, first], ..self }
    }

    /// The same line as if it were at any depth.
    #[must_use]
    pub fn of_any_depth(self) -> Self {
        let ProbedLine { probe, ends } = self;
        ProbedLine { probe: probe.of_any_depth(), ends: ends.map(|end| end.of_any_depth()) }
    }
}

impl LineQuestion<'_> {
    /// Where a line may be.
    #[inline]
    pub fn probe<P: Policy>(
        &self,
        predicates: &Predicates<'_, P>,
        line: &FeatureLine,
    ) -> ProbedLine {
        let between = |ends: [u32; 2]| ProbedLine {
            probe: self.coordinates.probe(ends),
            ends: ends.map(|vertex| self.coordinates.bounds([vertex])),
        };
        match line.origin {
            LineOrigin::Edge(edge) => between(self.mesh.edges().ends(edge)),
            LineOrigin::Stretch(index) => between(self.mesh.hinge_ends(Hinge::Stretch(index))),
            LineOrigin::Loose(index) => between(self.mesh.loose_lines()[index as usize]),
            LineOrigin::Intersection(index) => self.probe_intersection(predicates, index),
        }
    }

    /// Between its ends, if floats tell where they are, and else what its two
    /// triangles have in common.
    fn probe_intersection<P: Policy>(
        &self,
        predicates: &Predicates<'_, P>,
        index: u32,
    ) -> ProbedLine {
        let line = &self.intersections[index as usize];
        let ends = line.carrier.ends.map(|end| self.rough_point(predicates, end));
        if let [Some(start), Some(end)] = ends
            && let Some((probe, ends)) = self.coordinates.rough_probe([start, end])
        {
            return ProbedLine { probe, ends };
        }
        let [s, t] =
            line.triangles.map(|own| self.coordinates.bounds(self.mesh.triangles()[own as usize]));
        let (both, nowhere) = (s.intersection(&t), [f32::NAN; 2]);
        ProbedLine { probe: SegmentProbe::new(both, nowhere, nowhere), ends: [both; 2] }
    }

    /// About where a point lies, if floats tell.
    fn rough_point<P: Policy>(
        &self,
        predicates: &Predicates<'_, P>,
        point: Point,
    ) -> Option<RoughPoint> {
        match point {
            Point::Vertex(vertex) => Some(self.coordinates.rough_vertex(vertex)),
            Point::Piercing(piercing) => {
                let share = predicates.share_estimate(piercing)?;
                Some(self.coordinates.rough_between(piercing.edge, share.value, share.bound))
            }
        }
    }
}
