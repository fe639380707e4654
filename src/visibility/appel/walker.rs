//! One worker: walks line after line and reuses its memory.

use super::count::FromVertex;
use super::events::Event;
use super::{AppelOptions, Fault, left_out};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Carrier, Cut, Place, Point, Policy, Predicates};
use crate::model::{FeatureLine, LineOrigin};
use crate::run::Counters;
use crate::spatial::{Crossings, Hierarchy, Nearby};
use crate::view::{Covered, ExactPiece, LineQuestion, ProbedLine};

/// Counts on the two sides of a line: the number of sheets in front of it
/// when it is moved infinitesimally to its left or right in the image.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Sides {
    pub(super) left: i32,
    pub(super) right: i32,
}

impl Sides {
    /// The same on both sides.
    pub(super) fn both(count: i32) -> Self {
        Sides { left: count, right: count }
    }

    /// Adds counts side by side.
    pub(super) fn add(&mut self, other: Self) {
        self.left += other.left;
        self.right += other.right;
    }

    /// What is lost, side by side.
    pub(super) fn losses(self) -> Self {
        Sides { left: self.left.min(0), right: self.right.min(0) }
    }

    /// The invisibility: the larger count.
    pub(super) fn invisibility(self) -> u32 {
        // Counts below zero occur only under a measuring policy.
        self.left.max(self.right).max(0).unsigned_abs()
    }
}

/// A line as it is walked.
#[derive(Debug, Clone, Copy)]
pub(super) struct Walk {
    pub(super) carrier: Carrier,
    /// The vertices at the ends, where they are vertices.
    pub(super) vertices: [Option<u32>; 2],
    /// The edge of the mesh, where it is one.
    pub(super) edge: Option<u32>,
    /// Triangles that contain an intersection line by construction.
    pub(super) own: [u32; 2],
    /// Where it may be.
    pub(super) probed: ProbedLine,
    /// Whether the line is cut by the near plane; then the walk starts at
    /// the end in front of it.
    pub(super) cut: bool,
    /// Whether the walk goes from the line's end to its start.
    pub(super) backwards: bool,
}

/// No triangle has this number.
const NONE: u32 = u32::MAX;

/// Walks lines.
pub(super) struct Walker<'q, P: Policy> {
    pub(super) question: &'q LineQuestion<'q>,
    pub(super) effective: &'q Crossings,
    /// View boxes of the triangles that may matter.
    pub(super) triangles: &'q Hierarchy,
    /// What is certainly covered, where that was worth finding.
    covered: Option<&'q Covered>,
    /// Whether lines are left as soon as they are known to be hidden.
    pub(super) leaves_early: bool,
    /// The effective edges that matter now.
    pub(super) nearby: Nearby,
    pub(super) predicates: Predicates<'q, P>,
    pub(super) fault: Option<Fault>,
    pub(super) events: Vec<Event>,
    /// Whether an end of the walk was met in the image by an effective edge.
    pub(super) met_ends: [bool; 2],
    pub(super) pieces: Vec<ExactPiece>,
    pub(super) crossings_tested: u64,
    pub(super) crossings: u64,
    pub(super) piercings: u64,
    pub(super) counted: u64,
    /// The first count's part that all lines from one vertex have in common.
    pub(super) from_vertex: FromVertex,
    pub(super) vertices_counted: u64,
    pub(super) left_early: u64,
    /// Whether so many effective edges lie along the last line that it is worth
    /// asking first whether a triangle hides all of the next.
    pub(super) is_crowded: bool,
    /// Whether convex parts hide their edges at the back.
    knows_convex: bool,
    lines_at_back: u64,
    lines_outside: u64,
    lines_covered: u64,
}

impl<'q, P: Policy> Walker<'q, P> {
    pub(super) fn new(
        question: &'q LineQuestion<'q>,
        effective: &'q Crossings,
        triangles: &'q Hierarchy,
        covered: Option<&'q Covered>,
        options: &AppelOptions,
    ) -> Self {
        Walker {
            question,
            effective,
            triangles,
            covered,
            leaves_early: options.skips.early && !question.hidden_wanted,
            nearby: Nearby::EVERYTHING,
            predicates: Predicates::new(question.points),
            fault: options.fault,
            events: Vec::new(),
            met_ends: [false; 2],
            pieces: Vec::new(),
            crossings_tested: 0,
            crossings: 0,
            piercings: 0,
            counted: 0,
            from_vertex: FromVertex::default(),
            vertices_counted: 0,
            left_early: 0,
            is_crowded: false,
            knows_convex: options.skips.convex
                && options.fault.is_none()
                && !question.hidden_wanted,
            lines_at_back: 0,
            lines_outside: 0,
            lines_covered: 0,
        }
    }

    /// The pieces of the line walked last.
    pub(super) fn pieces(&self) -> impl Iterator<Item = ExactPiece> + '_ {
        self.pieces.iter().copied()
    }

    /// Crossings and piercings met so far.
    pub(super) fn events_held(&self) -> usize {
        (self.crossings + self.piercings) as usize
    }

    /// What was counted so far.
    pub(super) fn counters(&self) -> Counters {
        let mut counters = self.predicates.counters();
        counters.add("crossings-tested", self.crossings_tested);
        counters.add("crossings", self.crossings);
        counters.add("piercings", self.piercings);
        counters.add("first-counts", self.counted);
        counters.add("vertices-counted", self.vertices_counted);
        counters.add("lines-left-early", self.left_early);
        counters.add("lines-at-back", self.lines_at_back);
        counters.add("lines-outside", self.lines_outside);
        counters.add("lines-covered", self.lines_covered);
        counters
    }

    /// Whether a line is not wanted or known to be hidden all along: at the back
    /// of a convex part, or behind what is certainly covered.
    pub(super) fn is_left_out(&mut self, line: &FeatureLine) -> bool {
        if left_out::is_outside(self.question, line) {
            self.lines_outside += 1;
            return true;
        }
        if self.knows_convex && left_out::is_at_back(self.question, line) {
            self.lines_at_back += 1;
            return true;
        }
        let covered = self.covered.is_some_and(|covered| covered.hides(self.question, line));
        self.lines_covered += u64::from(covered);
        covered
    }

    /// Finds the pieces of one line, if it is not known to have none.
    pub(super) fn walk_unless_left_out(&mut self, line: &FeatureLine) {
        if self.is_left_out(line) {
            self.pieces.clear();
        } else {
            self.walk(line);
        }
    }

    /// Finds the pieces of one line, counting afresh at its start.
    pub(super) fn walk(&mut self, line: &FeatureLine) {
        self.pieces.clear();
        if let Some(walk) = self.begin(line) {
            if self.leaves_early && self.fault.is_none() && self.one_triangle_hides(&walk) {
                self.left_early += 1;
                return;
            }
            let first = self.first_count(&walk);
            self.find_events(&walk);
            self.finish(&walk, first);
        }
    }

    /// Collects all events of a walk.
    pub(super) fn find_events(&mut self, walk: &Walk) {
        self.events.clear();
        self.met_ends = [false; 2];
        self.find_crossings(walk);
        self.find_piercings(walk);
    }

    /// Makes pieces of a walk's events and its first count.
    pub(super) fn finish(&mut self, walk: &Walk, first: Sides) {
        if self.leaves_early && self.stays_hidden(first) {
            self.left_early += 1;
            return;
        }
        self.sweep(walk, first);
        if walk.backwards {
            self.turn_pieces();
        }
    }

    /// The walk along a line, unless nothing of it has an image: from an end
    /// in front of the near plane.
    pub(super) fn begin(&self, line: &FeatureLine) -> Option<Walk> {
        let walk = self.whole(line)?;
        if !self.question.points.has_near_plane() {
            return Some(walk);
        }
        let sign = |point| self.predicates.value_sign(Cut::Near, point);
        match walk.carrier.ends.map(sign) {
            // An end on the near plane is the end of the line.
            [Sign::Positive, Sign::Positive | Sign::Zero] | [Sign::Zero, Sign::Positive] => {
                Some(walk)
            }
            [Sign::Positive, Sign::Negative] => Some(Walk { cut: true, ..walk }),
            [Sign::Negative, Sign::Positive] => Some(Walk { cut: true, ..self.turned(&walk) }),
            _ => None,
        }
    }

    /// The geometry of a line, unless its image is a point.
    fn whole(&self, line: &FeatureLine) -> Option<Walk> {
        let question = self.question;
        let carrier = question.carrier(line);
        let vertices = carrier.ends.map(|end| match end {
            Point::Vertex(vertex) => Some(vertex),
            Point::Piercing(_) => None,
        });
        let edge = match line.origin {
            LineOrigin::Edge(edge) => Some(edge),
            _ => None,
        };
        let own = match line.origin {
            LineOrigin::Intersection(index) => question.intersections[index as usize].triangles,
            LineOrigin::Edge(_) | LineOrigin::Stretch(_) | LineOrigin::Loose(_) => [NONE; 2],
        };
        let walk = Walk {
            carrier,
            vertices,
            edge,
            own,
            probed: question.probe(&self.predicates, line),
            cut: false,
            backwards: false,
        };
        (self.has_image(&walk)).then_some(walk)
    }

    /// Whether the image of the line is more than a point.
    fn has_image(&self, walk: &Walk) -> bool {
        if let ([Some(_), Some(_)], [a, b]) = (walk.vertices, walk.probed.ends) {
            let apart = (0..2).any(|i| a.high[i] < b.low[i] || b.high[i] < a.low[i]);
            // Vertices behind the eye have no boxes, and may be one image
            // with one in front: the line passes through the eye.
            if apart && !a.is_empty() && !b.is_empty() {
                return true;
            }
        }
        self.predicates.axis_across(walk.carrier).is_some()
    }

    /// The same walk from the other end.
    pub(super) fn turned(&self, walk: &Walk) -> Walk {
        let [first, last] = walk.vertices;
        Walk {
            carrier: walk.carrier.reversed(),
            vertices: [last, first],
            probed: walk.probed.turned(),
            backwards: !walk.backwards,
            ..*walk
        }
    }

    /// Turns the pieces of a turned walk back.
    fn turn_pieces(&mut self) {
        let turn = |place| match place {
            Place::Start => Place::End,
            Place::End => Place::Start,
            Place::Cut(cut) => Place::Cut(cut),
        };
        self.pieces.reverse();
        for piece in &mut self.pieces {
            *piece = ExactPiece { from: turn(piece.to), to: turn(piece.from), ..*piece };
        }
    }

    /// Whether a triangle has the walked line in its plane by construction.
    #[inline(always)]
    pub(super) fn is_own(&self, walk: &Walk, triangle: u32) -> bool {
        if triangle == walk.own[0] || triangle == walk.own[1] {
            return true;
        }
        let corners = self.question.mesh.triangles()[triangle as usize];
        walk.vertices.iter().all(|end| end.is_some_and(|vertex| corners.contains(&vertex)))
    }

    /// The sign of a cut's plane at one end of the walk; zero by identity
    /// where that end is one of the vertices that span the plane.
    #[inline(always)]
    pub(super) fn sign_at(&self, walk: &Walk, end: usize, cut: Cut) -> Sign {
        if let Some(vertex) = walk.vertices[end] {
            let spanned = match cut {
                Cut::Face(corners) => corners.contains(&vertex),
                Cut::Silhouette(ends) => ends.contains(&vertex),
                Cut::Vertex(..) | Cut::Near | Cut::NearLine(_) => false,
            };
            if spanned {
                return Sign::Zero;
            }
        }
        self.predicates.value_sign(cut, walk.carrier.ends[end])
    }
}
