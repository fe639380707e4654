//! Boolean operations on polygons, decided exactly (Weiler and Atherton 1977).
//!
//! Operands are sets of rings: concave, with holes, crossing themselves,
//! touching, with shared vertices and collinear edges, turning either way;
//! a [`FillRule`] says what is inside. What comes out is exact as well: every
//! corner is a corner of the input or the crossing of two lines of the input
//! and is kept as their names, so operations follow one another without loss
//! and without growing degrees.
//!
//! The walk is Weiler's and Atherton's: follow one polygon, turn onto the
//! other where they cross, keep the inside on one side. Their walk derails
//! where vertices lie on edges and edges on edges. Here it is taken on
//! pieces that have been cut at all points where edges meet, each with the
//! exact winding numbers on its two sides (`sweep`), and the turn at a point
//! is read from the exact order of all pieces around it (`borders`).
//!
//! Two doors lead in:
//!
//! - [`Clipper`] works on the [`Points`] of a view, whatever its eye: images of
//!   faces are clipped without being projected. Its lines may also be the
//!   common lines of two faces and cuts of the near plane ([`ImageLine`]).
//! - [`PlaneShape`] owns its coordinates, for polygons of the plane; `geo`'s
//!   polygons go in and come out, rounded so that they are still valid.
//!
//! Results are the same for any order of operands' rings and any first
//! corner: outlines counterclockwise, each followed by its clockwise holes,
//! sorted by their leftmost points; a polygon for each connected area; no
//! corner between collinear edges.
//!
//! [`Points`]: crate::kernel::predicates::Points
//! [`ImageLine`]: crate::kernel::predicates::ImageLine

mod borders;
mod fill;
mod plane;
mod prepare;
mod queue;
mod ring;
mod rings;
mod rounded;
mod separation;
mod status;
mod sweep;

pub use fill::FillRule;
pub use plane::{PlaneShape, ShapeError};
pub use ring::{Corner, Polygon, Ring};
pub use rounded::Rounded;

use crate::kernel::predicates::{Chart, Policy, Predicates};
use crate::run::Run;
use fill::States;
use std::collections::BTreeMap;
use sweep::Sweep;

/// A set of rings and what is inside of it.
#[derive(Debug, Clone, Copy)]
pub struct Operand<'r> {
    polygons: &'r [Polygon],
    rule: FillRule,
    /// Is added to the numbers of all vertices.
    first_vertex: u32,
}

impl<'r> Operand<'r> {
    /// What is inside of these rings by this rule. Only the rule
    /// [`FillRule::Polygons`] keeps polygons apart.
    pub fn new(polygons: &'r [Polygon], rule: FillRule) -> Self {
        Operand { polygons, rule, first_vertex: 0 }
    }

    /// The area of polygons as operations return them.
    pub fn result(polygons: &'r [Polygon]) -> Self {
        Self::new(polygons, FillRule::Positive)
    }
}

/// What to make of operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Operation {
    /// Inside of all.
    Intersection,
    /// Inside of any.
    Union,
    /// Inside of the first and of no other.
    Difference,
    /// Inside of an odd number.
    Xor,
}

impl Operation {
    /// All operations.
    pub const ALL: [Operation; 4] =
        [Operation::Intersection, Operation::Union, Operation::Difference, Operation::Xor];

    /// The name in flags.
    pub fn name(self) -> &'static str {
        match self {
            Operation::Intersection => "intersection",
            Operation::Union => "union",
            Operation::Difference => "difference",
            Operation::Xor => "xor",
        }
    }

    /// Whether a place that is inside of these operands is in the result.
    pub fn accepts(self, inside: &[bool]) -> bool {
        let count = inside.iter().filter(|&&inside| inside).count();
        match self {
            Operation::Intersection => count == inside.len() && count > 0,
            Operation::Union => count > 0,
            Operation::Difference => count == 1 && inside[0],
            Operation::Xor => count % 2 == 1,
        }
    }
}

/// A subject, cut in two by the outline of a clip.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Split {
    /// What of the subject is inside of the clip.
    pub inside: Vec<Polygon>,
    /// The rest.
    pub outside: Vec<Polygon>,
}

/// Clips polygons of a view: exact, and generic over the eye.
///
/// Where the eye is a point, everything must lie in front of the near plane.
#[derive(Debug)]
pub struct Clipper<'a, 'p, P: Policy> {
    predicates: &'a Predicates<'p, P>,
    chart: Chart,
    keep_collinear: bool,
    run: Option<&'a Run<'a>>,
}

impl<'a, 'p, P: Policy> Clipper<'a, 'p, P> {
    /// A clipper for polygons whose corners are named by these points; none
    /// where the eye is a point and there is no near plane.
    pub fn new(predicates: &'a Predicates<'p, P>) -> Option<Self> {
        let chart = Chart::new(predicates.points())?;
        Some(Clipper { predicates, chart, keep_collinear: false, run: None })
    }

    /// Keeps vertices of the input that lie on borders of the result even
    /// where the border goes straight on.
    #[must_use]
    pub fn with_collinear_vertices(mut self, keep: bool) -> Self {
        self.keep_collinear = keep;
        self
    }

    /// Asks a run whether to go on, and tells it what is held in memory.
    /// What a stopped run makes is nothing, and its caller asks the run.
    #[must_use]
    pub fn within(mut self, run: &'a Run<'a>) -> Self {
        self.run = Some(run);
        self
    }

    /// The chart in which positions are decided.
    pub fn chart(&self) -> &Chart {
        &self.chart
    }

    /// Divides the image by what its places are: `label` gets which operands
    /// a place is inside of and says what it is, zero for what is not wanted.
    /// For each other label the connected areas, each a polygon.
    ///
    /// O((n + k) log n) for n edges with k crossings.
    pub fn overlay(
        &self,
        operands: &[Operand<'_>],
        label: &dyn Fn(&[bool]) -> u32,
    ) -> BTreeMap<u32, Vec<Polygon>> {
        let rules = operands.iter().map(|operand| operand.rule).collect();
        let mut states = States::new(rules, label);
        let (ends, edges) = prepare::prepare(self.predicates, &self.chart, operands, &mut states);
        let mut sweep = Sweep::new(self.predicates, &self.chart, &ends, &edges, states);
        let mut growing = self.run.map(sweep::growing);
        let is_done = sweep.run(&mut |pieces| {
            growing.as_mut().is_none_or(|growing| growing.goes_on(pieces as usize))
        });
        if let Some(growing) = growing {
            growing.throw_away();
        }
        if !is_done {
            return BTreeMap::new();
        }
        let mut borders = sweep.borders;
        rings::polygons(self.predicates, &self.chart, &edges, &mut borders, self.keep_collinear)
    }

    /// A Boolean operation on any number of operands.
    pub fn operation(&self, operation: Operation, operands: &[Operand<'_>]) -> Vec<Polygon> {
        let label = |inside: &[bool]| u32::from(operation.accepts(inside));
        self.overlay(operands, &label).remove(&1).unwrap_or_default()
    }

    /// What of a subject is inside of a clip, and what is outside, at once.
    ///
    /// ```
    /// use glam::dvec3;
    /// use umriss::kernel::predicates::{Exact, Eye, Points, Predicates};
    /// use umriss::polygon::clipping::{Clipper, Operand, Polygon};
    ///
    /// // Two triangles in space, seen from above.
    /// let vertices = [
    ///     dvec3(0.0, 0.0, 1.0), dvec3(4.0, 0.0, 2.0), dvec3(0.0, 4.0, 3.0),
    ///     dvec3(1.0, -1.0, 7.0), dvec3(2.0, -1.0, 7.0), dvec3(1.0, 9.0, 7.0),
    /// ];
    /// let points = Points::new(&vertices, Eye::Towards(dvec3(0.0, 0.0, 1.0)), None);
    /// let predicates = Predicates::<Exact>::new(&points);
    /// let clipper = Clipper::new(&predicates).ok_or("no front")?;
    /// let [subject, clip] = [[0, 1, 2], [3, 4, 5]].map(|face| [Polygon::of_vertices([face])]);
    /// let split = clipper.split(Operand::result(&subject), Operand::result(&clip));
    /// assert_eq!(split.inside.len(), 1);
    /// assert_eq!(split.outside.len(), 2);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn split(&self, subject: Operand<'_>, clip: Operand<'_>) -> Split {
        let label = |inside: &[bool]| match inside {
            [true, true] => 1,
            [true, false] => 2,
            _ => 0,
        };
        let mut areas = self.overlay(&[subject, clip], &label);
        Split {
            inside: areas.remove(&1).unwrap_or_default(),
            outside: areas.remove(&2).unwrap_or_default(),
        }
    }
}
