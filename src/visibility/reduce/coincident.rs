//! Which pieces lie on one another in the image, and which of them is drawn.
//!
//! A group (`groups`) is one image line; its ends are ordered exactly along
//! it, and between two neighbouring ends the best piece there is drawn.
//! Rounded coordinates only order ends that are clearly apart.
//!
//! Of lines of one class the nearest is drawn, for it is the one that other
//! lines pass behind. Two segments with one image lie in a plane with the
//! eye; the ends of their common stretch, each the end of one of them, are
//! held against the other one's line in that plane. If each is nearer at one
//! end, the segments cross in space, and their coordinates decide.
//!
//! What becomes of visible pieces does not depend on whether hidden ones are
//! there too: they come out in the order of their lines and along these, and
//! their ends are rounded as those of visible pieces. So a drawing whose
//! hidden lines are left out is the one without them.

use super::groups::groups_of;
use super::line_piece;
use super::rivals::{Depths, Rivals, Tier};
use super::rounded::RoundedPiece;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Carrier, Place, Policy, Predicates, sort_by_predicates};
use crate::model::{LineClass, LineOrigin};
use crate::run::{Cancelled, Run, concat_map, map_chunks, map_indexed, sort_by};
use crate::view::{LinePiece, LineQuestion};
use glam::DVec2;
use std::cmp::Ordering;

/// Where a piece comes from: what it takes to ask predicates about it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Origin {
    /// Index of its line.
    pub(super) line: u32,
    /// Which piece of the answer it is part of, numbered through all lines.
    pub(super) piece: u32,
    /// A bound of the error of its image.
    pub(super) slack: f64,
}

/// Cuts overlapping pieces so that each stretch of an image line is drawn
/// once, and numbers the runs. Beside the pieces, their origins if wanted.
pub(super) fn resolve_coincident<P: Policy>(
    question: &LineQuestion<'_>,
    pieces: &[RoundedPiece],
    origins_wanted: bool,
    run: &Run<'_>,
) -> Result<(Vec<LinePiece>, Vec<Origin>), Cancelled> {
    let groups = groups_of::<P>(question, pieces, run)?;
    // Made in parts, joined, and perhaps brought into another order.
    let each = 3 * size_of::<LinePiece>() + usize::from(origins_wanted) * size_of::<Origin>();
    run.take((pieces.len() * each) as u64)?;
    let resolved = map_chunks(groups.len(), PART, |part| {
        let predicates = Predicates::<P>::new(question.points);
        let count = groups.members_of(part.clone());
        let origins = origins_wanted.then(|| Vec::with_capacity(count));
        let (drawn, indices) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut found = Resolved { pieces: drawn, indices, origins, runs: 0 };
        for group in part.take_while(|_| !run.is_stopped()) {
            run.advance(groups.get(group).len() as u64);
            found.add(question, &predicates, pieces, groups.get(group), run);
        }
        (found, predicates.counters())
    });
    run.check()?;
    let mut runs = 0;
    let mut first_runs = Vec::with_capacity(resolved.len());
    for (found, counters) in &resolved {
        first_runs.push(runs);
        runs += found.runs;
        run.merge(counters);
    }
    let lists: Vec<&[LinePiece]> = resolved.iter().map(|(found, _)| &found.pieces[..]).collect();
    let renumbered =
        |part: usize, piece: &LinePiece| LinePiece { run: first_runs[part] + piece.run, ..*piece };
    let origins = resolved.iter().filter_map(|(found, _)| found.origins.as_deref());
    let origins: Vec<&[Origin]> = origins.collect();
    let indices: Vec<&[u32]> = resolved.iter().map(|(found, _)| &found.indices[..]).collect();
    let indices = concat_map(&indices, |_, index| *index);
    let (pieces, origins) =
        (concat_map(&lists, renumbered), concat_map(&origins, |_, origin| *origin));
    if indices.is_sorted() {
        return Ok((pieces, origins));
    }
    let mut order: Vec<[u32; 2]> = indices.into_iter().zip(0..).map(Into::into).collect();
    sort_by(&mut order, Ord::cmp);
    Ok((reordered(&pieces, &order), reordered(&origins, &order)))
}

/// A list, which may be empty, in an order of its indices.
fn reordered<T: Copy + Send + Sync>(list: &[T], order: &[[u32; 2]]) -> Vec<T> {
    map_indexed(order.len().min(list.len()), |i| list[order[i][1] as usize])
}

/// Groups that one task resolves.
const PART: usize = 2048;

/// What becomes of some groups.
struct Resolved {
    pieces: Vec<LinePiece>,
    /// For each of them the index of the piece that it is part of.
    indices: Vec<u32>,
    /// One for each piece, if wanted.
    origins: Option<Vec<Origin>>,
    /// Runs are numbered from 0 to this.
    runs: u32,
}

impl Resolved {
    fn add<P: Policy>(
        &mut self,
        question: &LineQuestion<'_>,
        predicates: &Predicates<'_, P>,
        pieces: &[RoundedPiece],
        group: &[u32],
        run: &Run<'_>,
    ) {
        let piece = |index: u32| pieces[index as usize];
        match group {
            [] => {}
            // Most pieces lie on no other.
            [alone] => self.append(question, [(*alone, RoundedPiece { run: 0, ..piece(*alone) })]),
            [first, others @ ..]
                if others.iter().all(|&other| piece(other).line == piece(*first).line) =>
            {
                let followed = follow_line(pieces, group);
                self.append(question, group.iter().copied().zip(followed));
            }
            _ => {
                let parts = ImageLine::new(question, predicates, pieces, group).resolve(run);
                let parts = parts.into_iter().map(|(member, part)| (group[member as usize], part));
                self.append(question, parts);
            }
        }
    }

    /// Appends a group's pieces, whose runs are numbered from 0.
    fn append(
        &mut self,
        question: &LineQuestion<'_>,
        group: impl IntoIterator<Item = (u32, RoundedPiece)>,
    ) {
        let first = self.runs;
        for (index, piece) in group {
            self.indices.push(index);
            self.runs = self.runs.max(first + piece.run + 1);
            let run = first + piece.run;
            if let Some(origins) = &mut self.origins {
                origins.push(Origin { line: piece.line, piece: index, slack: piece.slack });
            }
            self.pieces.push(line_piece(question, &RoundedPiece { run, ..piece }));
        }
    }
}

/// Pieces of one line only: nothing overlaps, gaps end runs.
fn follow_line(pieces: &[RoundedPiece], group: &[u32]) -> Vec<RoundedPiece> {
    let mut result: Vec<RoundedPiece> = Vec::with_capacity(group.len());
    for &index in group {
        let piece = pieces[index as usize];
        let run = match result.last() {
            Some(last) if last.places[1] == piece.places[0] => last.run,
            Some(last) => last.run + 1,
            None => 0,
        };
        result.push(RoundedPiece { run, ..piece });
    }
    result
}

/// A place on the image line: an end of a piece.
#[derive(Clone, Copy)]
struct Stop {
    carrier: Carrier,
    place: Place,
    image: DVec2,
    depth: f64,
    slack: f64,
    piece: u32,
    /// Whether the piece begins here, along the reference.
    begins: bool,
    /// Whether the piece is hidden.
    hidden: bool,
}

/// The pieces of one image line, to be resolved.
struct ImageLine<'a, P: Policy> {
    predicates: &'a Predicates<'a, P>,
    /// An axis that the line runs across, and in which sense.
    axis: u8,
    sense: Sign,
    /// Roughly along the reference in the image.
    direction: DVec2,
    pieces: Vec<RoundedPiece>,
    /// Best first, but for depth.
    rank: Vec<u32>,
    stops: Vec<Stop>,
    /// For each piece its ends, in their order along the reference.
    ends: Vec<[Stop; 2]>,
    /// For each piece whether it runs against the reference.
    against: Vec<bool>,
    /// For each piece its class.
    classes: Vec<LineClass>,
    perspective: bool,
}

impl<'a, P: Policy> ImageLine<'a, P> {
    fn new(
        question: &LineQuestion<'_>,
        predicates: &'a Predicates<'a, P>,
        all: &[RoundedPiece],
        group: &[u32],
    ) -> Self {
        let pieces: Vec<RoundedPiece> = group.iter().map(|&i| all[i as usize]).collect();
        let carrier = |piece: &RoundedPiece| question.carrier(&question.lines[piece.line as usize]);
        let longest =
            pieces.iter().max_by(|a, b| length(a).total_cmp(&length(b))).unwrap_or(&pieces[0]);
        let reference = carrier(longest);
        let [from, to] = longest.image;
        let axis = predicates.axis_across(reference).unwrap_or(0);
        let mut line = ImageLine {
            predicates,
            axis,
            sense: predicates.sense_across(reference, axis),
            direction: to - from,
            rank: ranks(question, &pieces),
            stops: Vec::with_capacity(2 * pieces.len()),
            ends: Vec::with_capacity(pieces.len()),
            against: Vec::with_capacity(pieces.len()),
            classes: pieces.iter().map(|piece| class_of(question, piece)).collect(),
            perspective: question.points.is_perspective(),
            pieces,
        };
        for piece in 0..line.pieces.len() {
            line.add_stops(carrier(&line.pieces[piece]), piece as u32);
        }
        line
    }

    fn add_stops(&mut self, carrier: Carrier, index: u32) {
        let piece = &self.pieces[index as usize];
        let mut stops = [0, 1].map(|end| Stop {
            carrier,
            place: piece.places[end],
            image: piece.image[end],
            depth: piece.depth[end],
            slack: piece.slack,
            piece: index,
            begins: end == 0,
            hidden: 0 < piece.invisibility,
        });
        if self.compare(&stops[0], &stops[1]) == Ordering::Greater {
            stops[0].begins = false;
            stops[1].begins = true;
        }
        self.against.push(stops[1].begins);
        self.stops.extend(stops);
        if stops[1].begins {
            stops.reverse();
        }
        self.ends.push(stops);
    }

    /// Orders two stops along the reference.
    fn compare(&self, a: &Stop, b: &Stop) -> Ordering {
        if a.carrier == b.carrier && a.place == b.place {
            return Ordering::Equal;
        }
        let gap = (a.image - b.image).dot(self.direction);
        let reach = self.direction.abs().element_sum();
        // The direction runs along the common line up to slack, so the
        // product has the sign of the order unless it is this small.
        if gap.abs() > 8.0 * (a.slack + b.slack) * reach + f64::MIN_POSITIVE {
            return if gap < 0.0 { Ordering::Less } else { Ordering::Greater };
        }
        let [a, b] = [a, b].map(|stop| (stop.carrier, stop.place));
        self.predicates.order_across(self.axis, self.sense, a, b)
    }

    /// Draws each stretch once: parts of pieces with the indices of these,
    /// in their order and along them. Where many pieces lie on one another it
    /// takes long, and ends early once `asked` is stopped.
    fn resolve(mut self, asked: &Run<'_>) -> Vec<(u32, RoundedPiece)> {
        let mut stops = std::mem::take(&mut self.stops);
        sort_by_predicates::<P, _>(&mut stops, |a, b| self.compare(a, b));
        let mut active = Rivals::default();
        let mut result: Vec<(u32, RoundedPiece)> = Vec::new();
        let mut drawn: Option<((u32, bool), Stop)> = None;
        let mut outlines = 0;
        let mut run = 0;
        for group in stops.chunk_by(|a, b| self.compare(a, b) == Ordering::Equal) {
            if asked.is_stopped() {
                break;
            }
            for stop in group {
                let own = i32::from(self.pieces[stop.piece as usize].outline);
                outlines += if stop.begins { own } else { -own };
            }
            let those = |begin: bool| group.iter().filter(move |stop| stop.begins == begin);
            those(false).for_each(|stop| active.remove(stop.piece, &self));
            those(true).for_each(|stop| active.add(stop.piece, &self));
            // What begins and ends in one place, as an inexact policy sees it.
            those(false).for_each(|stop| active.remove(stop.piece, &self));
            // What is an outline to any of the lines is one.
            let best = active.best(&self).map(|piece| (piece, outlines > 0));
            if best != drawn.map(|(piece, _)| piece) {
                if let Some(((piece, outline), from)) = drawn {
                    let stretch = self.stretch(piece, &from, &self.stop_of(piece, group), run);
                    result.push((piece, RoundedPiece { outline, ..stretch }));
                    run += u32::from(best.is_none());
                }
                drawn = best.map(|best| (best, self.stop_of(best.0, group)));
            }
        }
        // Pieces come out as they went in.
        result.sort_by_key(|(piece, _)| *piece);
        for parts in result.chunk_by_mut(|(one, _), (other, _)| one == other) {
            if self.against[parts[0].0 as usize] {
                parts.reverse();
            }
        }
        result
    }

    /// On which side in depth one piece lies of another, at the beginning and
    /// at the end of what they have in common: positive is nearer.
    fn nearness(&self, piece: u32, other: u32) -> [Sign; 2] {
        let [x, y] = [piece, other].map(|piece| &self.ends[piece as usize]);
        let nearer = |stop: &Stop, line: Carrier| {
            self.predicates.nearer_than(line, self.axis, (stop.carrier, stop.place))
        };
        // It begins with the later begin and ends with the earlier end.
        [(0, Ordering::Less), (1, Ordering::Greater)].map(|(end, outside)| {
            let (x, y) = (&x[end], &y[end]);
            if self.compare(x, y) == outside { -nearer(y, x.carrier) } else { nearer(x, y.carrier) }
        })
    }

    /// The stop where a piece ends that stands for all stops of one place.
    fn stop_of(&self, piece: u32, group: &[Stop]) -> Stop {
        representative(group, 0 < self.pieces[piece as usize].invisibility)
    }

    /// The stretch of a piece between two stops, in the sense of its line.
    fn stretch(&self, piece: u32, from: &Stop, to: &Stop, run: u32) -> RoundedPiece {
        let piece = self.pieces[piece as usize];
        let mut ends = [from, to].map(|stop| (stop.place, stop.image, self.depth_at(&piece, stop)));
        if (to.image - from.image).dot(piece.image[1] - piece.image[0]) < 0.0 {
            ends.reverse();
        }
        RoundedPiece {
            places: ends.map(|end| end.0),
            image: ends.map(|end| end.1),
            depth: ends.map(|end| end.2),
            run,
            ..piece
        }
    }

    /// The depth of a piece where a stop lies on its image.
    fn depth_at(&self, piece: &RoundedPiece, stop: &Stop) -> f64 {
        if let Some(end) = (0..2).find(|&end| piece.image[end] == stop.image) {
            return piece.depth[end];
        }
        let t = share_along(piece.image, stop.image);
        let [near, far] = piece.depth;
        if self.perspective {
            // The inverse of the depth is linear in a perspective image.
            1.0 / ((1.0 - t) / near + t / far)
        } else {
            near + (far - near) * t
        }
    }
}

impl<P: Policy> Depths for ImageLine<'_, P> {
    fn tier(&self, piece: u32) -> Tier {
        (self.pieces[piece as usize].invisibility, self.classes[piece as usize])
    }

    fn rank(&self, piece: u32) -> u32 {
        self.rank[piece as usize]
    }

    fn compare(&self, one: u32, other: u32) -> Option<Ordering> {
        let [first, last] = self.nearness(one, other);
        if first.is_opposite(last) {
            return None;
        }
        let farther = Ordering::from(-first.or(last));
        Some(farther.then(self.rank(one).cmp(&self.rank(other))))
    }

    fn hides(&self, one: u32, other: u32) -> bool {
        let [first, last] = self.nearness(one, other);
        !first.is_opposite(last) && first.or(last) == Sign::Positive
    }
}

/// How much of a segment of the image lies before a point of it, from 0 to 1. A
/// piece may be so short that its ends are rounded to one place, and the point
/// to another: then nothing does.
fn share_along([from, to]: [DVec2; 2], point: DVec2) -> f64 {
    // In a unit of the segment's own, for squares of tiny lengths vanish.
    let unit = (to - from).abs().max_element();
    let (along, offset) = ((to - from) / unit, (point - from) / unit);
    let share = offset.dot(along) / along.length_squared();
    if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) }
}

fn length(piece: &RoundedPiece) -> f64 {
    piece.image[0].distance(piece.image[1])
}

/// The stop whose rounded point stands for all stops of one place, or of the
/// visible pieces there: a vertex if there is one, for other lines end in it
/// too.
fn representative(group: &[Stop], hidden: bool) -> Stop {
    let key = |stop: &Stop| matches!(stop.place, Place::Cut(_));
    let order = |a: &&Stop, b: &&Stop| {
        key(a)
            .cmp(&key(b))
            .then(a.image.x.total_cmp(&b.image.x))
            .then(a.image.y.total_cmp(&b.image.y))
            .then(a.depth.total_cmp(&b.depth))
    };
    group.iter().filter(|stop| hidden || !stop.hidden).min_by(order).copied().unwrap_or(group[0])
}

fn class_of(question: &LineQuestion<'_>, piece: &RoundedPiece) -> LineClass {
    question.lines[piece.line as usize].class
}

/// The rank of each piece: which one is drawn where several coincide and
/// none of them is nearer. Ties
/// are broken by what does not depend on the order of faces and vertices, as
/// far as the drawing shows it.
fn ranks(question: &LineQuestion<'_>, pieces: &[RoundedPiece]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..pieces.len() as u32).collect();
    order.sort_by(|&a, &b| {
        let (x, y) = (&pieces[a as usize], &pieces[b as usize]);
        x.invisibility
            .cmp(&y.invisibility)
            .then(class_of(question, x).cmp(&class_of(question, y)))
            .then_with(|| compare_sources(question, x.line, y.line))
            .then(x.line.cmp(&y.line))
    });
    let mut ranks = vec![0; pieces.len()];
    for (rank, &piece) in order.iter().enumerate() {
        ranks[piece as usize] = rank as u32;
    }
    ranks
}

/// Edges by their positions, before intersection lines by their objects. (An
/// intersection line may be carried by an inner edge of a triangulation,
/// which is not part of the geometry.)
fn compare_sources(question: &LineQuestion<'_>, x: u32, y: u32) -> Ordering {
    let objects = |line: u32| match question.lines[line as usize].origin {
        LineOrigin::Intersection(index) => {
            let triangles = question.intersections[index as usize].triangles;
            Some(triangles.map(|triangle| question.mesh.object_of_triangle(triangle)))
        }
        _ => None,
    };
    let ends = |line: u32| {
        let carrier = question.carrier(&question.lines[line as usize]);
        carrier.as_edge().map(|[a, b]| match question.points.compare(a, b) {
            Ordering::Greater => [b, a],
            _ => [a, b],
        })
    };
    match (objects(x), objects(y)) {
        (None, None) => match (ends(x), ends(y)) {
            (Some([a, b]), Some([c, d])) => {
                question.points.compare(a, c).then(question.points.compare(b, d))
            }
            (x, y) => y.is_some().cmp(&x.is_some()),
        },
        (x, y) => x.cmp(&y),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_numbers_however_short_a_segment_is() {
        let share = |to: DVec2, point: DVec2| share_along([DVec2::ZERO, to], point);
        assert_eq!(share(DVec2::new(4.0, 0.0), DVec2::new(1.0, 7.0)), 0.25);
        assert_eq!(share(DVec2::X, DVec2::NEG_X), 0.0);
        assert_eq!(share(DVec2::X, DVec2::new(9.0, 1.0)), 1.0);
        assert_eq!(share(DVec2::ZERO, DVec2::ZERO), 0.0);
        assert_eq!(share(DVec2::ZERO, DVec2::new(1e-17, -1e-17)), 0.0);
        assert_eq!(share(DVec2::splat(4e-300), DVec2::splat(1e-300)), 0.25);
    }
}
