//! Which pieces lie on one another in the image, and which of them is drawn.
//!
//! Pieces whose boxes touch and whose images are exactly collinear are
//! gathered into groups. A group is one image line; its ends are ordered
//! exactly along it, and between two neighbouring ends the best piece there
//! is drawn. Rounded coordinates only dismiss pairs that are clearly not
//! collinear and order ends that are clearly apart, both with proven slack.

use super::line_piece;
use super::rounded::RoundedPiece;
use crate::kernel::predicates::{Carrier, Place, Policy, Predicates};
use crate::run::{Run, concat_map, map_chunks};
use crate::spatial::{Hierarchy, Rounding};
use crate::view::{LinePiece, LineQuestion};
use glam::{DVec2, Vec3A};
use std::cmp::Ordering;
use std::collections::BTreeSet;

/// Where a piece comes from: what it takes to ask predicates about it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Origin {
    /// Index of its line.
    pub(super) line: u32,
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
) -> (Vec<LinePiece>, Vec<Origin>) {
    let groups = groups_of::<P>(question, pieces, run);
    let resolved = map_chunks(groups.len(), PART, |part| {
        let predicates = Predicates::<P>::new(question.points);
        let origins = origins_wanted.then(|| Vec::with_capacity(part.len()));
        let mut found = Resolved { pieces: Vec::with_capacity(part.len()), origins, runs: 0 };
        for group in part {
            found.add(question, &predicates, pieces, groups.get(group));
        }
        (found, predicates.counters())
    });
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
    (concat_map(&lists, renumbered), concat_map(&origins, |_, origin| *origin))
}

/// Groups that one task resolves.
const PART: usize = 2048;

/// What becomes of some groups.
struct Resolved {
    pieces: Vec<LinePiece>,
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
    ) {
        let piece = |index: u32| pieces[index as usize];
        match group {
            [] => {}
            // Most pieces lie on no other.
            [alone] => self.append(question, [RoundedPiece { run: 0, ..piece(*alone) }]),
            [first, others @ ..]
                if others.iter().all(|&other| piece(other).line == piece(*first).line) =>
            {
                self.append(question, follow_line(pieces, group));
            }
            _ => {
                self.append(question, ImageLine::new(question, predicates, pieces, group).resolve())
            }
        }
    }

    /// Appends a group's pieces, whose runs are numbered from 0.
    fn append(
        &mut self,
        question: &LineQuestion<'_>,
        group: impl IntoIterator<Item = RoundedPiece>,
    ) {
        let first = self.runs;
        for piece in group {
            self.runs = self.runs.max(first + piece.run + 1);
            let run = first + piece.run;
            if let Some(origins) = &mut self.origins {
                origins.push(Origin { line: piece.line, slack: piece.slack });
            }
            self.pieces.push(line_piece(question, &RoundedPiece { run, ..piece }));
        }
    }
}

/// Pieces that have to be looked at together.
struct Groups {
    members: Vec<u32>,
    /// End of each group in `members`.
    ends: Vec<u32>,
}

impl Groups {
    fn len(&self) -> usize {
        self.ends.len()
    }

    fn get(&self, group: usize) -> &[u32] {
        let start = if group == 0 { 0 } else { self.ends[group - 1] };
        &self.members[start as usize..self.ends[group] as usize]
    }

    /// The trees of `parents`, in the order of their roots, which are their
    /// smallest members; members in ascending order.
    fn of_trees(mut parents: Vec<u32>) -> Self {
        let mut ends = Vec::with_capacity(parents.len());
        let mut group_of = vec![0_u32; parents.len()];
        for piece in 0..parents.len() {
            let root = root(&mut parents, piece as u32) as usize;
            if root == piece {
                group_of[piece] = ends.len() as u32;
                ends.push(0);
            } else {
                group_of[piece] = group_of[root];
            }
            ends[group_of[piece] as usize] += 1;
        }
        let mut next = Vec::with_capacity(ends.len());
        let mut sum = 0;
        for end in &mut ends {
            next.push(sum);
            sum += *end;
            *end = sum;
        }
        let mut members = vec![0; parents.len()];
        for (piece, group) in group_of.into_iter().enumerate() {
            let slot = &mut next[group as usize];
            members[*slot as usize] = piece as u32;
            *slot += 1;
        }
        Groups { members, ends }
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

/// Gathers collinear pieces that touch. Every piece is in one group; groups
/// are ordered by their first piece and sorted within.
fn groups_of<P: Policy>(
    question: &LineQuestion<'_>,
    pieces: &[RoundedPiece],
    run: &Run<'_>,
) -> Groups {
    let hierarchy = image_hierarchy(pieces);
    let found = hierarchy.overlapping_pairs(
        || (Predicates::<P>::new(question.points), Vec::new()),
        |(predicates, pairs), a, b| {
            let (first, second) = (&pieces[a as usize], &pieces[b as usize]);
            if first.line == second.line || are_collinear(question, predicates, first, second) {
                pairs.push([a, b]);
            }
        },
    );
    let mut parents: Vec<u32> = (0..pieces.len() as u32).collect();
    for (predicates, pairs) in found {
        run.merge(&predicates.counters());
        run.count("collinear-pairs", pairs.len() as u64);
        for [a, b] in pairs {
            let (a, b) = (root(&mut parents, a), root(&mut parents, b));
            // The smaller number is the root, so groups know their first.
            parents[a.max(b) as usize] = a.min(b);
        }
    }
    Groups::of_trees(parents)
}

/// The root of a tree of parents, halving the path on the way.
fn root(parents: &mut [u32], mut node: u32) -> u32 {
    while parents[node as usize] != node {
        parents[node as usize] = parents[parents[node as usize] as usize];
        node = parents[node as usize];
    }
    node
}

/// Boxes of the pieces in the image, rounded outward. The third side of a
/// box is the direction of the piece: collinear pieces agree in that too, and
/// so most pairs of neighbours are never looked at.
fn image_hierarchy(pieces: &[RoundedPiece]) -> Hierarchy {
    let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (low, high) = pieces
        .iter()
        .flat_map(|piece| piece.image)
        .fold(empty, |(low, high), p| (low.min(p), high.max(p)));
    let rounding = Rounding::for_ranges([low.x..high.x, low.y..high.y, -1.0..1.0]);
    let bounds = |i: usize| {
        let [a, b] = pieces[i].image;
        let slack = DVec2::splat(pieces[i].slack);
        let direction = direction_range(b - a, pieces[i].slack);
        let (low, high) = (a.min(b) - slack, a.max(b) + slack);
        rounding.around(low.extend(direction[0]), high.extend(direction[1]))
    };
    let place = |i: usize| {
        let start = pieces[i].image[0];
        Vec3A::new(rounding.nearest(0, start.x), rounding.nearest(1, start.y), 0.0)
    };
    Hierarchy::of(pieces.len(), place, bounds)
}

/// The range of a piece's direction, either way along it being the same: a
/// number from -1 to 1 that grows with the angle over half a turn. `along`
/// may be off by twice `slack` in each coordinate. All of the range where
/// the direction is not known, or is near the one at which it starts anew.
fn direction_range(along: DVec2, slack: f64) -> [f64; 2] {
    /// Turns the start of the range away from the directions of drawings.
    const TURN: DVec2 = DVec2::new(0.540_302_305_868_139_8, 0.841_470_984_807_896_5);
    let turned = TURN.rotate(along);
    let turned = if turned.x < 0.0 { -turned } else { turned };
    let size = turned.x + turned.y.abs();
    // Turning lets an error grow to at most 1.5 times in each coordinate;
    // the quotient changes by at most the errors over the size.
    let error = 8.0 * slack;
    let middle = turned.y / size;
    let reach = error / (size - error) + 16.0 * f64::EPSILON;
    // Not comparable, for a piece that is a point, is all of the range.
    if size > 2.0 * error && middle.abs() + reach < 1.0 {
        [middle - reach, middle + reach]
    } else {
        [-1.0, 1.0]
    }
}

/// Whether the images of two pieces lie on one line.
fn are_collinear<P: Policy>(
    question: &LineQuestion<'_>,
    predicates: &Predicates<'_, P>,
    first: &RoundedPiece,
    second: &RoundedPiece,
) -> bool {
    if clearly_off(first, second) || clearly_off(second, first) {
        return false;
    }
    let [a, b] = [first, second].map(|p| question.carrier(&question.lines[p.line as usize]));
    b.ends.iter().all(|&end| predicates.image_side_of_point(a, end).is_zero())
}

/// Whether an end of `other` is off the line of `piece` by more than
/// rounding can explain.
fn clearly_off(piece: &RoundedPiece, other: &RoundedPiece) -> bool {
    let [start, end] = piece.image;
    let along = end - start;
    other.image.iter().any(|&point| {
        let offset = point - start;
        let off = along.perp_dot(offset).abs();
        // Ends are off by at most their slack in each coordinate; the
        // product's own roundings are far below.
        let reach = along.abs().element_sum() + offset.abs().element_sum();
        let slack = 4.0 * (piece.slack + other.slack);
        off > reach * slack + slack * slack
    })
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
}

/// The pieces of one image line, to be resolved.
struct ImageLine<'a, P: Policy> {
    predicates: &'a Predicates<'a, P>,
    reference: Carrier,
    axis: u8,
    /// Roughly along the reference in the image.
    direction: DVec2,
    pieces: Vec<RoundedPiece>,
    /// Best first.
    rank: Vec<u32>,
    stops: Vec<Stop>,
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
        let mut line = ImageLine {
            predicates,
            reference,
            axis: predicates.axis_across(reference).unwrap_or(0),
            direction: to - from,
            rank: ranks(question, &pieces),
            stops: Vec::with_capacity(2 * pieces.len()),
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
        });
        if self.compare(&stops[0], &stops[1]) == Ordering::Greater {
            stops[0].begins = false;
            stops[1].begins = true;
        }
        self.stops.extend(stops);
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
        self.predicates.order_along_image(
            self.reference,
            self.axis,
            (a.carrier, a.place),
            (b.carrier, b.place),
        )
    }

    /// Draws each stretch once.
    fn resolve(mut self) -> Vec<RoundedPiece> {
        let mut stops = std::mem::take(&mut self.stops);
        stops.sort_by(|a, b| self.compare(a, b));
        let mut active: BTreeSet<(u32, u32)> = BTreeSet::new();
        let mut result: Vec<RoundedPiece> = Vec::new();
        let mut drawn: Option<(u32, Stop)> = None;
        let mut run = 0;
        for group in stops.chunk_by(|a, b| self.compare(a, b) == Ordering::Equal) {
            for stop in group {
                let entry = (self.rank[stop.piece as usize], stop.piece);
                if stop.begins {
                    active.insert(entry);
                } else {
                    active.remove(&entry);
                }
            }
            let best = active.first().map(|&(_, piece)| piece);
            if best != drawn.map(|(piece, _)| piece) {
                let stop = representative(group);
                if let Some((piece, from)) = drawn {
                    result.push(self.stretch(piece, &from, &stop, run));
                    run += u32::from(best.is_none());
                }
                drawn = best.map(|piece| (piece, stop));
            }
        }
        // Pieces come out line by line, as they went in.
        result.sort_by_key(|piece| piece.line);
        result
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
        let along = piece.image[1] - piece.image[0];
        let t = ((stop.image - piece.image[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let [near, far] = piece.depth;
        if self.perspective {
            // The inverse of the depth is linear in a perspective image.
            1.0 / ((1.0 - t) / near + t / far)
        } else {
            near + (far - near) * t
        }
    }
}

fn length(piece: &RoundedPiece) -> f64 {
    piece.image[0].distance(piece.image[1])
}

/// The stop whose rounded point stands for all stops of one place: a vertex
/// if there is one, for other lines end in it too.
fn representative(group: &[Stop]) -> Stop {
    let key = |stop: &Stop| matches!(stop.place, Place::Cut(_));
    let order = |a: &&Stop, b: &&Stop| {
        key(a)
            .cmp(&key(b))
            .then(a.image.x.total_cmp(&b.image.x))
            .then(a.image.y.total_cmp(&b.image.y))
            .then(a.depth.total_cmp(&b.depth))
    };
    group.iter().min_by(order).copied().unwrap_or(group[0])
}

/// The rank of each piece: which one is drawn where several coincide.
fn ranks(question: &LineQuestion<'_>, pieces: &[RoundedPiece]) -> Vec<u32> {
    let corners = |piece: &RoundedPiece| {
        let carrier = question.carrier(&question.lines[piece.line as usize]);
        carrier.as_edge().map(|[a, b]| match question.points.compare(a, b) {
            Ordering::Greater => [b, a],
            _ => [a, b],
        })
    };
    let mut order: Vec<u32> = (0..pieces.len() as u32).collect();
    order.sort_by(|&a, &b| {
        let (x, y) = (&pieces[a as usize], &pieces[b as usize]);
        let class = |piece: &RoundedPiece| question.lines[piece.line as usize].class;
        let geometry = match (corners(x), corners(y)) {
            (Some([a, b]), Some([c, d])) => {
                question.points.compare(a, c).then(question.points.compare(b, d))
            }
            (x, y) => y.is_some().cmp(&x.is_some()),
        };
        x.invisibility
            .cmp(&y.invisibility)
            .then(class(x).cmp(&class(y)))
            .then(geometry)
            .then(x.line.cmp(&y.line))
    });
    let mut ranks = vec![0; pieces.len()];
    for (rank, &piece) in order.iter().enumerate() {
        ranks[piece as usize] = rank as u32;
    }
    ranks
}
