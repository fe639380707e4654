//! A stretch of a stroke with the feet of the strokes that end on it.
//!
//! A stretch goes through its feet, so they are points of it to begin with,
//! between which it is smoothed. Afterwards most are not needed as points:
//! one that lies on a segment of the stroke that stayed as it was lies on it
//! still. Where feet would be more points than are left out beside them, the
//! stroke stays as it was.

use super::{Foot, Smoothed, fitting, simplify};
use crate::drawing::is_closed;
use glam::DVec2;

/// What a point of a stretch is of the stroke.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    /// A point of it.
    Vertex(usize),
    /// A foot after that point.
    Foot(usize),
}

/// Points of a stroke, feet among them.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Stretch {
    points: Vec<DVec2>,
    places: Vec<Place>,
    /// The number of points of the stroke, if it is closed: the first is the
    /// last too.
    ring: Option<usize>,
}

impl Stretch {
    /// All of a stroke; a closed one from the point `start` on, or from its
    /// first foot.
    pub(super) fn places(stroke: &[DVec2], feet: &[Foot], start: usize, from_foot: bool) -> Self {
        let ring = is_closed(stroke).then_some(stroke.len() - 1);
        let mut points = Vec::with_capacity(stroke.len() + feet.len());
        let mut rest = feet.iter().peekable();
        for (vertex, point) in stroke.iter().enumerate() {
            points.push((*point, Place::Vertex(vertex)));
            while let Some(foot) = rest.next_if(|foot| foot.after == vertex) {
                points.push((foot.point, Place::Foot(vertex)));
            }
        }
        if let Some(count) = ring {
            points.pop();
            let first = |(_, place): &(DVec2, Place)| match place {
                Place::Vertex(vertex) => !from_foot && *vertex == start % count,
                Place::Foot(_) => from_foot,
            };
            let first = points.iter().position(first).unwrap_or(0);
            points.rotate_left(first);
            points.push(points[0]);
        }
        let (points, places) = points.into_iter().unzip();
        Stretch { points, places, ring }
    }

    pub(super) fn len(&self) -> usize {
        self.points.len()
    }

    pub(super) fn point(&self, index: usize) -> DVec2 {
        self.points[index]
    }

    /// Which point of the stroke a point is, if it is no foot.
    pub(super) fn vertex(&self, index: usize) -> Option<usize> {
        match self.places[index] {
            Place::Vertex(vertex) => Some(vertex),
            Place::Foot(_) => None,
        }
    }

    /// The part between two points.
    pub(super) fn part(&self, from: usize, to: usize) -> Self {
        let (points, places) = (self.points[from..=to].into(), self.places[from..=to].into());
        Stretch { points, places, ring: self.ring }
    }

    /// The points after the first that are kept.
    pub(super) fn simplified(&self, tolerance: f64) -> Vec<Smoothed> {
        let mut nodes = Vec::new();
        for [from, to] in self.between_feet() {
            simplify::append(&self.points, [from, to], tolerance, &mut nodes);
        }
        let nodes = self.without_straight_feet(nodes);
        self.without_many_feet(&nodes)
    }

    /// Curves where they fit, and points elsewhere, after the first; nothing
    /// if that would be more points. `ring` says that the ends are one point
    /// without a corner.
    pub(super) fn fitted(&self, ring: bool, tolerance: f64) -> Option<Vec<Smoothed>> {
        let mut nodes = Vec::new();
        for [from, to] in self.between_feet() {
            fitting::append(&self.points, [from, to], ring, tolerance, &mut nodes);
        }
        let nodes = self.without_straight_feet(nodes);
        let written = |node: &Smoothed| if node.bend.is_some() { 3 } else { 1 };
        let vertices = (1..self.len()).filter(|&index| self.vertex(index).is_some()).count();
        (nodes.iter().map(written).sum::<usize>() <= vertices).then_some(nodes)
    }

    /// The parts from foot to foot.
    fn between_feet(&self) -> Vec<[usize; 2]> {
        let last = self.len() - 1;
        let mut stops: Vec<usize> = (1..last).filter(|&i| self.vertex(i).is_none()).collect();
        stops.push(last);
        let starts = [0].into_iter().chain(stops.clone());
        starts.zip(stops).map(Into::into).collect()
    }

    /// Leaves out feet on segments that are as they were.
    fn without_straight_feet(&self, nodes: Vec<Smoothed>) -> Vec<Smoothed> {
        let mut kept: Vec<Smoothed> = Vec::with_capacity(nodes.len());
        for (number, node) in nodes.iter().enumerate() {
            let straight = || {
                let (after, next) = (self.foot_after(node)?, nodes.get(number + 1)?);
                let before = kept.last().map_or(Some(0), |node| node.index);
                let is_on = |index: Option<usize>| index.is_some_and(|i| self.is_on(i, after));
                let straight = node.bend.is_none() && next.bend.is_none();
                (straight && is_on(before) && is_on(next.index)).then_some(())
            };
            if straight().is_none() {
                kept.push(*node);
            }
        }
        kept
    }

    /// Puts back the points between two that are kept if there are more feet
    /// between these.
    fn without_many_feet(&self, nodes: &[Smoothed]) -> Vec<Smoothed> {
        let mut kept = Vec::with_capacity(nodes.len());
        let mut before = 0;
        // A stretch ends in a vertex, or as it begins, in a foot.
        let is_foot = |node: &Smoothed| self.foot_after(node).is_some();
        for block in nodes.split_inclusive(|node| !is_foot(node)) {
            let last = block[block.len() - 1].index.unwrap_or(before);
            let feet = block.len() - 1;
            let vertices = || (before + 1..last).filter(|&index| self.vertex(index).is_some());
            if vertices().count() < feet {
                let node = |index: usize| Smoothed {
                    point: self.points[index],
                    bend: None,
                    index: Some(index),
                };
                kept.extend(vertices().chain([last]).map(node));
            } else {
                kept.extend_from_slice(block);
            }
            before = last;
        }
        kept
    }

    /// The point of the stroke after which a node is a foot, if it is one.
    fn foot_after(&self, node: &Smoothed) -> Option<usize> {
        match self.places[node.index?] {
            Place::Foot(after) => Some(after),
            Place::Vertex(_) => None,
        }
    }

    /// Whether a point lies on the segment after a point of the stroke.
    fn is_on(&self, index: usize, after: usize) -> bool {
        let next = |vertex: usize| self.ring.map_or(vertex + 1, |count| (vertex + 1) % count);
        match self.places[index] {
            Place::Vertex(vertex) => vertex == after || vertex == next(after),
            Place::Foot(other) => other == after,
        }
    }
}
