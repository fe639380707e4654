//! Lines from the borders of regions.
//!
//! The border of a region runs along the outlines of its own face, along
//! those of faces in front of it, and along common lines with faces that pass
//! through it. A line of the model is drawn where a region of one of its own
//! faces ends at it: each border is then drawn once, by the nearer of the two
//! faces that meet there. Hidden lines are not known to regions, nor are
//! lines without a face, for they bound nothing.
//!
//! Corners of regions are crossings of image lines; places on a line are
//! cuts of planes in space. Each image line is the trace of such a plane: of
//! an edge and the eye, of the other face where two planes cross, of the eye
//! and what the near plane cuts from another face, or the near plane itself.
//! A corner can be named by other lines than those that make it one, where
//! more than two pass through it; the line that the border turns into is one
//! that does, so that is asked too.

use super::RegionsError;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{
    Carrier, Chart, Cut, ImageLine, ImagePoint, Piercing, Place, Point, Policy, Predicates,
    sort_by_predicates,
};
use crate::model::LineOrigin;
use crate::polygon::clipping::Polygon;
use crate::run::{Run, map_chunks};
use crate::view::{ExactLines, ExactPiece, LineQuestion, Region, VisibleRegions};
use std::cmp::Ordering;

/// Lines per task.
const PART: usize = 128;

/// Where the borders of regions run along the question's lines: their
/// visible pieces, but for lines that no region ends at.
///
/// Expected O(n) for n corners of regions.
///
/// # Errors
///
/// If the run is cancelled; if the view is a perspective one without a near
/// plane.
pub fn region_lines<P: Policy>(
    question: &LineQuestion<'_>,
    regions: &VisibleRegions,
    run: &Run<'_>,
) -> Result<ExactLines, RegionsError> {
    let count = question.lines.len();
    let parts = run.stage("region-borders", count as u64, || {
        map_chunks(count, PART, |part| {
            run.check()?;
            let predicates = Predicates::<P>::new(question.points);
            let Some(chart) = Chart::new(question.points) else {
                return Err(RegionsError::NoNearPlane);
            };
            let worker = Worker { question, regions, predicates: &predicates, chart: &chart };
            let mut lines = ExactLines::default();
            let units = part.len() as u64;
            for line in part {
                run.check()?;
                lines.push_line(worker.pieces(line)?);
            }
            run.merge(&predicates.counters());
            run.advance(units);
            Ok(lines)
        })
    });
    let parts: Result<Vec<_>, _> = parts.into_iter().collect();
    Ok(ExactLines::concat(&parts?))
}

struct Worker<'a, 'q, P: Policy> {
    question: &'a LineQuestion<'q>,
    regions: &'a VisibleRegions,
    predicates: &'a Predicates<'q, P>,
    chart: &'a Chart,
}

/// A line as borders may run along it.
struct Line {
    carrier: Carrier,
    image: ImageLine,
    /// Its ends in the image, nothing for those behind the near plane.
    ends: [Option<ImagePoint>; 2],
    /// Whether the image runs the way of the sweep.
    forward: bool,
}

impl<P: Policy> Worker<'_, '_, P> {
    /// The pieces of a line at which regions of its own faces end.
    fn pieces(&self, index: usize) -> Result<Vec<ExactPiece>, RegionsError> {
        let question = self.question;
        let line = &question.lines[index];
        let own: Vec<u32> = match line.origin {
            LineOrigin::Edge(edge) => question.mesh.faces_at(edge),
            LineOrigin::Intersection(i) => question.intersections[i as usize].triangles.to_vec(),
            LineOrigin::Loose(_) => Vec::new(),
        };
        let mut own: Vec<&Region> =
            own.iter().filter_map(|&triangle| self.regions.of_triangle(triangle)).collect();
        own.sort_unstable_by_key(|region| region.triangles.start);
        own.dedup_by_key(|region| region.triangles.start);
        if own.is_empty() {
            return Ok(Vec::new());
        }
        let Some(line) = self.line(question.carrier(line), line.origin) else {
            return Ok(Vec::new());
        };
        let mut spans = Vec::new();
        for region in own {
            for polygon in &region.polygons {
                self.borders(&line, polygon, &mut spans)?;
            }
        }
        let order = |a: Place, b: Place| self.order(line.carrier, a, b);
        sort_by_predicates::<P, _>(&mut spans, |a, b| order(a[0], b[0]));
        let mut merged: Vec<[Place; 2]> = Vec::new();
        for span in spans {
            match merged.last_mut() {
                Some(last) if order(span[0], last[1]).is_le() => {
                    if order(last[1], span[1]).is_lt() {
                        last[1] = span[1];
                    }
                }
                _ => merged.push(span),
            }
        }
        let piece =
            |[from, to]: [Place; 2]| ExactPiece { from, to, invisibility: 0, outline: false };
        Ok(merged.into_iter().map(piece).collect())
    }

    /// A line with its image, if that is more than a point and known.
    fn line(&self, carrier: Carrier, origin: LineOrigin) -> Option<Line> {
        self.predicates.axis_across(carrier)?;
        let question = self.question;
        let image = match (carrier.as_edge(), origin) {
            (Some([a, b]), _) => ImageLine::Edge([a, b]),
            (None, LineOrigin::Intersection(i)) => {
                let faces = question.intersections[i as usize].triangles;
                if faces.iter().any(|&face| question.facing[face as usize].is_zero()) {
                    return None;
                }
                ImageLine::Planes(faces.map(|face| question.mesh.triangles()[face as usize]))
            }
            _ => return None,
        };
        let ends = carrier.ends.map(|end| self.image_of_end(end, image));
        let forward = self.predicates.runs_forward(self.chart, image);
        // Which way the walk goes in the image; planes do not say.
        let along = match (carrier.as_edge(), ends) {
            (Some(_), _) => forward,
            (None, [Some(start), Some(end)]) => {
                self.predicates.sweep(self.chart, start, end).is_lt()
            }
            // Where one end lies behind, the other tells on which side.
            (None, _) => return None,
        };
        Some(Line { carrier, image, ends, forward: along })
    }

    fn image_of_end(&self, end: Point, image: ImageLine) -> Option<ImagePoint> {
        let near = self.question.points.has_near_plane();
        if near && self.predicates.value_sign(Cut::Near, end) == Sign::Negative {
            return None;
        }
        match end {
            Point::Vertex(vertex) => Some(ImagePoint::Vertex(vertex)),
            Point::Piercing(Piercing { edge, face }) => {
                let edge = ImageLine::Edge(edge);
                // An end of an edge that lies in a face is where it meets a
                // side of that face.
                let side = ImageLine::Edge([face[0], face[1]]);
                [image, side].into_iter().find_map(|other| self.crossing(edge, other))
            }
        }
    }

    /// Where two lines cross, if they do.
    fn crossing(&self, a: ImageLine, b: ImageLine) -> Option<ImagePoint> {
        match self.predicates.bend(self.chart, a, b) {
            Sign::Positive => Some(ImagePoint::Crossing([a, b])),
            Sign::Negative => Some(ImagePoint::Crossing([b, a])),
            Sign::Zero => None,
        }
    }

    /// Adds what of a polygon's border lies on a line.
    fn borders(
        &self,
        line: &Line,
        polygon: &Polygon,
        spans: &mut Vec<[Place; 2]>,
    ) -> Result<(), RegionsError> {
        let (predicates, chart) = (self.predicates, self.chart);
        let reversed = line.image.reversed();
        let is_on = |other: ImageLine, point: ImagePoint| {
            other == line.image
                || other == reversed
                || (predicates.bend(chart, line.image, other).is_zero()
                    && predicates.beside(chart, line.image, point).is_zero())
        };
        for ring in &polygon.rings {
            let at = |i: usize| &ring[i % ring.len()];
            for (i, corner) in ring.iter().enumerate() {
                if !is_on(corner.line, corner.point) {
                    continue;
                }
                let before = |a, b| {
                    let order = predicates.sweep(chart, a, b);
                    if line.forward { order } else { order.reverse() }
                };
                let mut low = (corner.point, at(i + ring.len() - 1).line);
                let mut high = (at(i + 1).point, at(i + 1).line);
                if before(high.0, low.0).is_lt() {
                    std::mem::swap(&mut low, &mut high);
                }
                if let Some(start) = line.ends[0].filter(|start| before(low.0, *start).is_lt()) {
                    low.0 = start;
                }
                if let Some(end) = line.ends[1].filter(|end| before(*end, high.0).is_lt()) {
                    high.0 = end;
                }
                if before(low.0, high.0).is_lt() {
                    let [from, to] = [low, high].map(|(point, turn)| self.place(line, point, turn));
                    spans.push([from?, to?]);
                }
            }
        }
        Ok(())
    }

    /// The place on a line whose image is a point on its image, where a
    /// border turns into the line `turn`.
    fn place(
        &self,
        line: &Line,
        point: ImagePoint,
        turn: ImageLine,
    ) -> Result<Place, RegionsError> {
        let is_at = |end: Option<ImagePoint>| {
            end.is_some_and(|end| self.predicates.sweep(self.chart, end, point).is_eq())
        };
        if is_at(line.ends[0]) {
            return Ok(Place::Start);
        }
        if is_at(line.ends[1]) {
            return Ok(Place::End);
        }
        let cut = match point {
            ImagePoint::Vertex(vertex) => {
                self.predicates.axis_across(line.carrier).map(|axis| Cut::Vertex(vertex, axis))
            }
            ImagePoint::Crossing([a, b]) => {
                [a, b, turn].into_iter().find_map(|other| self.cut(line, other))
            }
        };
        cut.map(Place::Cut).ok_or(RegionsError::Corner)
    }

    /// The plane whose trace in the image is a line that crosses this one.
    fn cut(&self, line: &Line, other: ImageLine) -> Option<Cut> {
        if self.predicates.bend(self.chart, line.image, other).is_zero() {
            return None;
        }
        let holds = |face: [u32; 3]| {
            line.carrier.ends.iter().all(|&end| match end {
                Point::Vertex(x) if face.contains(&x) => true,
                _ => self.predicates.value_sign(Cut::Face(face), end).is_zero(),
            })
        };
        match other {
            ImageLine::Edge(edge) => Some(Cut::Silhouette(edge)),
            ImageLine::Planes([f, g]) if holds(f) => Some(Cut::Face(g)),
            ImageLine::Planes([f, g]) if holds(g) => Some(Cut::Face(f)),
            ImageLine::Near(face) if holds(face) => Some(Cut::Near),
            ImageLine::Near(face) => Some(Cut::NearLine(face)),
            ImageLine::Planes(_) => None,
        }
    }

    /// Which of two places of a line comes first.
    fn order(&self, carrier: Carrier, first: Place, second: Place) -> Ordering {
        match (first, second) {
            (Place::Start, Place::Start) | (Place::End, Place::End) => Ordering::Equal,
            (Place::Start, _) | (_, Place::End) => Ordering::Less,
            (_, Place::Start) | (Place::End, _) => Ordering::Greater,
            (Place::Cut(first), Place::Cut(second)) => {
                let value = |cut| carrier.ends.map(|end| self.predicates.value(cut, end));
                let values = [value(first), value(second)];
                self.predicates.order(carrier, (first, &values[0]), (second, &values[1]))
            }
        }
    }
}
