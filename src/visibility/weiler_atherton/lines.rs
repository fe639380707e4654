//! Visible lines from visible regions.
//!
//! On either side of a line, infinitely near to its image, lies a region or
//! nothing. Where that region's face stands in front of the line, all the
//! faces in front of it do not matter, the line is hidden; where it does not,
//! nothing is in front of the line on this side, for the region is of the
//! nearest face. So a line is visible where it is hidden on neither side: the
//! very definition that counts sheets, of which regions know the first.
//!
//! Which regions lie beside a line changes where it meets their sides
//! ([`sides`]), and a line may pierce the face of a region. Most hidden lines
//! are known by less: on the side of a face of its own a visible line has a
//! region in whose plane it lies, of that face or of one that lies upon it.
//!
//! Corners of regions are crossings of image lines; places on a line are
//! cuts of planes in space. Each image line is the trace of such a plane: of
//! an edge and the eye, of the other face where two planes cross, of the eye
//! and what the near plane cuts from another face, or the near plane itself.
//! Places are given such names ([`place`]) only where a piece ends; all else
//! is decided in the image.
//!
//! [`sides`]: super::sides
//! [`place`]: super::place

use super::RegionsError;
use super::borders::Borders;
use super::sides::{Met, Side, Stop};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{
    Approximation, Carrier, Chart, Cut, ImageLine, ImagePoint, Piercing, Place, Point, Policy,
    Predicates, sort_by_predicates,
};
use crate::model::{FeatureLine, LineOrigin};
use crate::run::{Run, map_chunks};
use crate::spatial::{Bounds, Group};
use crate::view::{ExactLines, ExactPiece, LineQuestion, VisibleRegions};
use std::cell::Cell;
use std::cmp::Ordering;

/// Lines per task.
const PART: usize = 128;

/// The visible pieces of the question's lines, as regions show them.
///
/// Expected O((n + k) log n) for n corners of regions and lines, and k
/// crossings of both.
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
    let Some(chart) = Chart::new(question.points) else {
        return Err(RegionsError::NoNearPlane);
    };
    let count = question.lines.len();
    let parts = run.stage("region-borders", count as u64, || {
        let borders = Borders::new::<P>(question, &chart, regions);
        map_chunks(count, PART, |part| {
            run.check()?;
            let predicates = Predicates::<P>::new(question.points);
            let worker = Worker { question, regions, borders: &borders, predicates, chart: &chart };
            let mut lines = ExactLines::default();
            let units = part.len() as u64;
            for line in part {
                run.check()?;
                lines.push_line(worker.pieces(&question.lines[line])?);
            }
            run.merge(&worker.predicates.counters());
            run.advance(units);
            Ok::<_, RegionsError>(lines)
        })
    });
    let parts: Result<Vec<_>, _> = parts.into_iter().collect();
    Ok(ExactLines::concat(&parts?))
}

pub(super) struct Worker<'a, 'q, P: Policy> {
    pub(super) question: &'a LineQuestion<'q>,
    pub(super) regions: &'a VisibleRegions,
    pub(super) borders: &'a Borders<'a>,
    pub(super) predicates: Predicates<'q, P>,
    pub(super) chart: &'a Chart,
}

/// A line and its image, as far as it lies in front of the near plane.
pub(super) struct Line {
    pub(super) carrier: Carrier,
    /// Directed from its start to its end.
    pub(super) image: ImageLine,
    /// Three vertices of a plane in which it lies, which is not edge-on.
    pub(super) plane: [u32; 3],
    /// Its ends, or where the near plane cuts it.
    pub(super) ends: [Stop<'static>; 2],
    /// An end that is not cut off.
    pub(super) base: usize,
    /// Whether the image runs the way of the sweep.
    pub(super) forward: bool,
}

impl<P: Policy> Worker<'_, '_, P> {
    /// The visible pieces of a line.
    fn pieces(&self, line: &FeatureLine) -> Result<Vec<ExactPiece>, RegionsError> {
        if self.regions.regions().is_empty() {
            return Ok(Vec::from_iter(self.whole(self.question.carrier(line))));
        }
        let own = self.own_triangles(line);
        if !own.is_empty() && !self.may_show(line, &own) {
            return Ok(Vec::new());
        }
        let Some(line) = self.line(line) else {
            return Ok(Vec::new());
        };
        let met = self.met_borders(&line);
        let sides = [Sign::Positive, Sign::Negative].map(|side| self.side(&line, side, &met));
        let located = match self.known_beside(&line, &met, &sides) {
            Some(region) => region,
            None => self.region_at_base(&line),
        };
        let mut hidden = Vec::new();
        for side in &sides {
            self.hidden_beside(&line, &met, side, located, &mut hidden);
        }
        let order = |a: &Stop<'_>, b: &Stop<'_>| self.order(&line, a, b);
        sort_by_predicates::<P, _>(&mut hidden, |a, b| order(&a[0], &b[0]));
        let mut pieces = Vec::new();
        let mut push = |from: &Stop<'_>, to: &Stop<'_>| {
            if order(from, to).is_lt() {
                let [from, to] = [self.place(&line, from)?, self.place(&line, to)?];
                pieces.push(ExactPiece { from, to, invisibility: 0, outline: false });
            }
            Ok::<_, RegionsError>(())
        };
        let mut seen_from = line.ends[0];
        for [from, to] in &hidden {
            push(&seen_from, from)?;
            if order(&seen_from, to).is_lt() {
                seen_from = *to;
            }
        }
        push(&seen_from, &line.ends[1])?;
        Ok(pieces)
    }

    /// What of a line lies in front of the near plane, if it has an image.
    fn whole(&self, carrier: Carrier) -> Option<ExactPiece> {
        self.predicates.axis_across(carrier)?;
        let signs = self.near_signs(carrier);
        if !signs.contains(&Sign::Positive) {
            return None;
        }
        let place = |i: usize| match signs[i] {
            Sign::Negative => Place::Cut(Cut::Near),
            _ => [Place::Start, Place::End][i],
        };
        Some(ExactPiece { from: place(0), to: place(1), invisibility: 0, outline: false })
    }

    /// On which side of the near plane its ends lie: without one in front.
    fn near_signs(&self, carrier: Carrier) -> [Sign; 2] {
        match self.question.points.has_near_plane() {
            true => carrier.ends.map(|end| self.predicates.value_sign(Cut::Near, end)),
            false => [Sign::Positive; 2],
        }
    }

    /// The triangles of a line that are not edge-on.
    fn own_triangles(&self, line: &FeatureLine) -> Vec<u32> {
        let has_image = |triangle: &u32| !self.question.facing[*triangle as usize].is_zero();
        let own = self.question.faces_of(line).into_iter().map(|(triangle, _)| triangle);
        own.filter(has_image).collect()
    }

    /// Whether there is a region in whose plane a line lies that has these
    /// triangles: without one it is hidden.
    fn may_show(&self, line: &FeatureLine, own: &[u32]) -> bool {
        let is_seen = |triangle: u32| self.regions.of_triangle(triangle).is_some();
        if own.iter().any(|&triangle| is_seen(triangle)) {
            return true;
        }
        let (question, carrier) = (self.question, self.question.carrier(line));
        let triangle = |triangle: u32| question.mesh.triangles()[triangle as usize];
        let bounds = match (carrier.as_edge(), own) {
            (Some(ends), _) => question.coordinates.bounds(ends),
            (None, [first, others @ ..]) => {
                let around = |one: u32| question.coordinates.bounds(triangle(one));
                let all = around(*first);
                others.iter().fold(all, |all, &other| all.intersection(&around(other)))
            }
            (None, []) => Bounds::ALL,
        };
        let found = Cell::new(false);
        let may = |group: &Group| if found.get() { 0 } else { group.overlapping(&bounds) };
        question.hierarchy().visit(may, |other| {
            if !found.get() && !own.contains(&other) && is_seen(other) {
                let corners = triangle(other);
                found.set(self.signs_at_ends(carrier, corners) == [Sign::Zero; 2]);
            }
        });
        found.get()
    }

    /// On which sides of a plane the ends of a line lie.
    pub(super) fn signs_at_ends(&self, carrier: Carrier, plane: [u32; 3]) -> [Sign; 2] {
        carrier.ends.map(|end| match end {
            Point::Vertex(x) if plane.contains(&x) => Sign::Zero,
            _ => self.predicates.value_sign(Cut::Face(plane), end),
        })
    }

    /// A line with its image, if that is more than a point.
    fn line(&self, line: &FeatureLine) -> Option<Line> {
        let (question, carrier) = (self.question, self.question.carrier(line));
        self.predicates.axis_across(carrier)?;
        let plane = self.plane(line, carrier)?;
        let image = match (carrier.as_edge(), line.origin) {
            (Some([a, b]), _) => ImageLine::Edge([a, b]),
            (None, LineOrigin::Intersection(i)) => {
                let crossing = &question.intersections[i as usize];
                match crossing.along.into_iter().flatten().next() {
                    Some(hinge) => ImageLine::Edge(question.mesh.hinge_ends(hinge)),
                    None => ImageLine::Planes(
                        crossing.triangles.map(|face| question.mesh.triangles()[face as usize]),
                    ),
                }
            }
            (None, _) => return None,
        };
        let signs = self.near_signs(carrier);
        let base = signs.iter().position(|sign| *sign == Sign::Positive)?;
        let mut ends = [0, 1].map(|i| {
            let (point, place) = match signs[i] {
                Sign::Negative => {
                    let near = ImageLine::Near(plane);
                    (self.crossing(image, near), Place::Cut(Cut::Near))
                }
                _ => (self.image_of_end(carrier.ends[i], image), [Place::Start, Place::End][i]),
            };
            point.map(|point| self.stop(point, Some(place)))
        });
        let ends = [ends[0].take()?, ends[1].take()?];
        let forward = self.sweep(&ends[0], &ends[1]).is_lt();
        let runs_along = self.predicates.runs_forward(self.chart, image) == forward;
        let image = if runs_along { image } else { image.reversed() };
        Some(Line { carrier, image, plane, ends, base, forward })
    }

    /// Vertices of a plane through a line that is not edge-on.
    fn plane(&self, line: &FeatureLine, carrier: Carrier) -> Option<[u32; 3]> {
        let triangles = self.question.mesh.triangles();
        if let Some(&own) = self.own_triangles(line).first() {
            return Some(triangles[own as usize]);
        }
        // Any vertex will do whose image is beside the line's.
        let [a, b] = carrier.as_edge()?;
        let region = self.regions.regions().first();
        let corners = region.map_or(&[][..], |region| &region.plane);
        let all = || triangles.iter().flatten();
        let is_beside =
            |x: &&u32| ![a, b].contains(*x) && !self.predicates.side(a, b, **x).is_zero();
        let apex = corners.iter().find(is_beside).or_else(|| all().find(is_beside));
        apex.map(|&apex| [a, b, apex])
    }

    fn image_of_end(&self, end: Point, image: ImageLine) -> Option<ImagePoint> {
        let Point::Piercing(Piercing { edge: [a, b], face }) = end else {
            let Point::Vertex(vertex) = end else { return None };
            return Some(ImagePoint::Vertex(vertex));
        };
        let edge = ImageLine::Edge([a, b]);
        if let Some(point) = self.crossing(edge, image) {
            return Some(point);
        }
        // Where the edge has the image of the line, it meets the face on the
        // trace of any plane through it; where it has that of a point, there.
        let is_beside = |x: &u32| !self.predicates.side(a, b, *x).is_zero();
        match face.into_iter().find(is_beside) {
            Some(apex) => self.crossing(edge, ImageLine::Planes([[a, b, apex], face])),
            None => {
                let side = self.predicates.value_sign(Cut::Near, Point::Vertex(a));
                let vertex = if side == Sign::Positive { a } else { b };
                Some(ImagePoint::Vertex(vertex))
            }
        }
    }

    /// Where two lines of the image cross, if they do.
    pub(super) fn crossing(&self, a: ImageLine, b: ImageLine) -> Option<ImagePoint> {
        match self.predicates.bend(self.chart, a, b) {
            Sign::Positive => Some(ImagePoint::Crossing([a, b])),
            Sign::Negative => Some(ImagePoint::Crossing([b, a])),
            Sign::Zero => None,
        }
    }

    /// A point of a line's image.
    pub(super) fn stop<'e>(&self, point: ImagePoint, place: Option<Place>) -> Stop<'e> {
        let about = self.predicates.approximate(self.chart, point);
        Stop { point, about, place, meetings: &[], behind: None }
    }

    fn sweep(&self, a: &Stop<'_>, b: &Stop<'_>) -> Ordering {
        let about = Approximation::compare(&a.about, &b.about);
        about.unwrap_or_else(|| self.predicates.sweep(self.chart, a.point, b.point))
    }

    /// Which of two points of a line's image comes first.
    pub(super) fn order(&self, line: &Line, a: &Stop<'_>, b: &Stop<'_>) -> Ordering {
        let order = self.sweep(a, b);
        if line.forward { order } else { order.reverse() }
    }

    /// Where a line is hidden by what lies on one of its sides; `located`
    /// lies there if the side has no other answer.
    fn hidden_beside<'e>(
        &self,
        line: &Line,
        met: &[Met<'_>],
        side: &'e Side,
        located: Option<u32>,
        hidden: &mut Vec<[Stop<'e>; 2]>,
    ) {
        let [start, end] = line.ends;
        let regions = self.regions_beside(line, met, side, located);
        let mut from: Stop<'e> = start;
        for (region, to) in regions {
            let to = to.unwrap_or(end);
            if self.order(line, &from, &to).is_lt()
                && let Some(region) = region
            {
                hidden.extend(self.hidden_behind(line, region, [from, to]));
            }
            from = to;
        }
    }

    /// What the face of a region hides of a part of a line beside it.
    fn hidden_behind<'e>(
        &self,
        line: &Line,
        number: u32,
        [mut from, mut to]: [Stop<'e>; 2],
    ) -> Option<[Stop<'e>; 2]> {
        let region = &self.regions.regions()[number as usize];
        // Behind a plane its functional has the sign of the facing.
        let facing = self.question.facing[region.triangles.start as usize];
        let behind = self.signs_at_ends(line.carrier, region.plane).map(|sign| sign * facing);
        (from.behind, to.behind) = (Some(number), Some(number));
        match behind {
            [Sign::Zero | Sign::Negative, Sign::Zero | Sign::Negative] => return None,
            [Sign::Zero | Sign::Positive, Sign::Zero | Sign::Positive] => return Some([from, to]),
            _ => {}
        }
        let cut = Cut::Face(region.plane);
        let [before, after] = behind;
        let Some(pierced) = self.pierced(line, region.plane, cut) else {
            // Before the near plane; what is in front is all on one side.
            return (behind[line.base] == Sign::Positive).then_some([from, to]);
        };
        // Where it does so on a border of the region, that has no other name.
        if before == Sign::Positive && self.order(line, &pierced, &to).is_le() {
            to = pierced;
        }
        if after == Sign::Positive && self.order(line, &from, &pierced).is_le() {
            from = pierced;
        }
        self.order(line, &from, &to).is_lt().then_some([from, to])
    }

    /// Where a line pierces a plane, if not before the near plane.
    fn pierced<'e>(&self, line: &Line, plane: [u32; 3], cut: Cut) -> Option<Stop<'e>> {
        let predicates = &self.predicates;
        let is_cut = line.ends.iter().any(|end| end.place == Some(Place::Cut(Cut::Near)));
        if is_cut {
            let value = |cut| line.carrier.ends.map(|end| predicates.value(cut, end));
            let [near, face] = [value(Cut::Near), value(cut)];
            let order = predicates.order(line.carrier, (Cut::Near, &near), (cut, &face));
            let is_in_front = if line.base == 1 { order.is_lt() } else { order.is_gt() };
            if !is_in_front {
                return None;
            }
        }
        let trace = ImageLine::Planes([line.plane, plane]);
        let point = self.crossing(line.image, trace)?;
        Some(self.stop(point, Some(Place::Cut(cut))))
    }
}
