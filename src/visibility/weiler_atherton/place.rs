//! Names for places on lines, and what is seen at one place.

use super::RegionsError;
use super::lines::{Line, Worker};
use super::sides::Stop;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Cut, ImageLine, ImagePoint, Place, Point, Policy};
use crate::spatial::Group;
use crate::view::Region;
use std::cell::{Cell, RefCell};

impl<P: Policy> Worker<'_, '_, P> {
    /// The place on a line whose image is a point.
    ///
    /// Of the lines that cross there one is the trace of a plane that cuts
    /// the line. The common line of two other faces' planes is none; but
    /// where such a line is where something ceases to hide what is behind
    /// it, a face ends there, at an edge of its own.
    pub(super) fn place(&self, line: &Line, stop: &Stop<'_>) -> Result<Place, RegionsError> {
        if let Some(place) = stop.place {
            return Ok(place);
        }
        let named = match stop.point {
            ImagePoint::Vertex(vertex) => {
                let axis = self.predicates.axis_across(line.carrier);
                axis.map(|axis| Cut::Vertex(vertex, axis))
            }
            ImagePoint::Crossing(lines) => {
                lines.into_iter().find_map(|other| self.cut(line, other))
            }
        };
        let crossing = || stop.meetings.iter().find_map(|meeting| self.cut(line, meeting.line));
        let edge = || stop.behind.and_then(|region| self.edge_through(line, region, stop.point));
        named.or_else(crossing).or_else(edge).map(Place::Cut).ok_or(RegionsError::Corner)
    }

    /// The plane whose trace in the image is a line that crosses this one.
    fn cut(&self, line: &Line, other: ImageLine) -> Option<Cut> {
        if self.predicates.bend(self.chart, line.image, other).is_zero() {
            return None;
        }
        let holds = |face: [u32; 3]| self.signs_at_ends(line.carrier, face) == [Sign::Zero; 2];
        match other {
            ImageLine::Edge(edge) => Some(Cut::Silhouette(edge)),
            ImageLine::Planes([f, g]) if holds(f) => Some(Cut::Face(g)),
            ImageLine::Planes([f, g]) if holds(g) => Some(Cut::Face(f)),
            ImageLine::Near(face) if holds(face) => Some(Cut::Near),
            ImageLine::Near(face) => Some(Cut::NearLine(face)),
            ImageLine::Planes(_) => None,
        }
    }

    /// The cut by a side of a region's triangles that passes through a point.
    fn edge_through(&self, line: &Line, region: u32, point: ImagePoint) -> Option<Cut> {
        let near = self.question.points.has_near_plane();
        let triangles = self.regions.regions()[region as usize].triangles.clone();
        let corners = triangles.map(|triangle| self.question.mesh.triangles()[triangle as usize]);
        let mut lines = corners.flat_map(|face| {
            let [a, b, c] = face;
            let edges = [[a, b], [b, c], [c, a]].map(ImageLine::Edge);
            edges.into_iter().chain(near.then_some(ImageLine::Near(face)))
        });
        lines.find_map(|other| {
            let passes = self.predicates.beside(self.chart, other, point).is_zero();
            if passes { self.cut(line, other) } else { None }
        })
    }

    /// The region that contains an end of a line, if one does; no border of
    /// any passes there.
    pub(super) fn region_at_base(&self, line: &Line) -> Option<u32> {
        let (question, end) = (self.question, line.carrier.ends[line.base]);
        let point = line.ends[line.base].point;
        let bounds = match end {
            Point::Vertex(vertex) => question.coordinates.bounds([vertex]),
            Point::Piercing(piercing) => question.coordinates.bounds(piercing.edge),
        };
        let bounds = bounds.of_any_depth();
        let found = Cell::new(None);
        let asked = RefCell::new(Vec::new());
        let is_over = || found.get().is_some();
        let may = |group: &Group| if is_over() { 0 } else { group.overlapping(&bounds) };
        question.hierarchy().visit(may, |triangle| {
            if is_over() || !self.may_contain(triangle, end) {
                return;
            }
            let Some(number) = self.regions.index_of_triangle(triangle) else { return };
            let mut asked = asked.borrow_mut();
            if !asked.contains(&number) {
                asked.push(number);
                if self.contains(&self.regions.regions()[number], point) {
                    found.set(Some(number as u32));
                }
            }
        });
        found.get()
    }

    /// Whether the image of a vertex lies in that of a triangle; other points
    /// may.
    fn may_contain(&self, triangle: u32, end: Point) -> bool {
        let facing = self.question.facing[triangle as usize];
        let [a, b, c] = self.question.mesh.triangles()[triangle as usize];
        let Point::Vertex(x) = end else { return !facing.is_zero() };
        let is_outside = |(p, q): (u32, u32)| {
            x != p && x != q && self.predicates.side(p, q, x).is_opposite(facing)
        };
        !facing.is_zero() && ![(a, b), (b, c), (c, a)].into_iter().any(is_outside)
    }

    /// Whether a region contains a point that is on none of its borders: an
    /// odd number of its sides run below.
    fn contains(&self, region: &Region, point: ImagePoint) -> bool {
        let (predicates, chart) = (&self.predicates, self.chart);
        let mut inside = false;
        for ring in region.polygons.iter().flat_map(|polygon| &polygon.rings) {
            let is_before: Vec<bool> = ring
                .iter()
                .map(|corner| predicates.sweep(chart, corner.point, point).is_lt())
                .collect();
            for (i, corner) in ring.iter().enumerate() {
                let [from, to] = [is_before[i], is_before[(i + 1) % ring.len()]];
                if from != to {
                    let side = predicates.beside(chart, corner.line, point);
                    // Directed with the sweep, left is above.
                    inside ^= side == if from { Sign::Positive } else { Sign::Negative };
                }
            }
        }
        inside
    }
}
