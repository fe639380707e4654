//! Which pieces may lie on one another in the image: groups to be resolved.
//!
//! What matters is which *lines* lie on one image line, for a line may have
//! hundreds of pieces. Lines whose boxes touch and whose images are exactly
//! collinear are gathered into sets, and so are those connected by others.
//! Rounded coordinates only dismiss pairs that are clearly not collinear, with
//! proven slack. The pieces of one set, in order along their image line, fall
//! into groups where none reaches across. Most lines have an image line of
//! their own, and their pieces are a group as they are.

use super::rounded::RoundedPiece;
use crate::kernel::predicates::{Policy, Predicates};
use crate::run::{Cancelled, Run};
use crate::spatial::{Bounds, Hierarchy, Rounding};
use crate::view::LineQuestion;
use glam::{DVec2, Vec3A};
use std::ops::Range;

/// Gathers collinear pieces that touch. Every piece is in one group; groups
/// are ordered by their first piece and sorted within. `pieces` are in the
/// order of their lines. Expected O(n log n).
pub(super) fn groups_of<P: Policy>(
    question: &LineQuestion<'_>,
    pieces: &[RoundedPiece],
    run: &Run<'_>,
) -> Result<Groups, Cancelled> {
    let picture = Picture::of(pieces);
    let spans = Spans::of(pieces);
    let hierarchy = Hierarchy::of(
        spans.len(),
        |span| picture.place(&spans.extent(pieces, span)),
        |span| picture.bounds(&spans.extent(pieces, span)),
    );
    let (sets, found) = hierarchy.connected(
        run,
        || (Predicates::<P>::new(question.points), 0),
        |(predicates, count), a, b| {
            let [first, second] = [a, b].map(|span| spans.extent(pieces, span as usize));
            let collinear = are_collinear(question, predicates, &first, &second);
            *count += u64::from(collinear);
            collinear
        },
    );
    run.check()?;
    for (predicates, count) in found {
        run.merge(&predicates.counters());
        run.count("collinear-lines", count);
    }
    // Of each piece the least one of its group.
    let mut firsts = vec![0; pieces.len()];
    for span in 0..spans.len() {
        let range = spans.range(span);
        firsts[range.clone()].fill(range.start as u32);
    }
    let mut shared = Vec::new();
    for (span, &least) in sets.iter().enumerate().filter(|&(span, &least)| span as u32 != least) {
        shared.push([least, least]);
        shared.push([least, span as u32]);
    }
    shared.sort_unstable();
    shared.dedup();
    for set in shared.chunk_by(|a, b| a[0] == b[0]) {
        run.check()?;
        let members = set.iter().flat_map(|&[_, span]| spans.range(span as usize));
        picture.split(pieces, members.collect(), &mut firsts);
    }
    Ok(Groups::of_firsts(&firsts))
}

/// The pieces of each line that has any.
struct Spans {
    ends: Vec<u32>,
}

impl Spans {
    fn of(pieces: &[RoundedPiece]) -> Self {
        let lines = pieces.chunk_by(|a, b| a.line == b.line);
        let mut end = 0;
        let ends = lines.map(|own| {
            end += own.len() as u32;
            end
        });
        Spans { ends: ends.collect() }
    }

    fn len(&self) -> usize {
        self.ends.len()
    }

    fn range(&self, span: usize) -> Range<usize> {
        let start = if span == 0 { 0 } else { self.ends[span - 1] };
        start as usize..self.ends[span] as usize
    }

    /// From the first piece of a line to its last.
    fn extent(&self, pieces: &[RoundedPiece], span: usize) -> Extent {
        let own = &pieces[self.range(span)];
        let (first, last) = (&own[0], &own[own.len() - 1]);
        Extent {
            line: first.line,
            image: [first.image[0], last.image[1]],
            slack: own.iter().fold(0.0, |most, piece| piece.slack.max(most)),
        }
    }
}

/// A part of a line in the image.
#[derive(Debug, Clone, Copy)]
struct Extent {
    line: u32,
    image: [DVec2; 2],
    /// A bound of the error of what lies on it.
    slack: f64,
}

/// The narrow coordinates of boxes in the image, rounded outward. The third
/// side of a box is the direction: collinear lines agree in that too, and so
/// most pairs of neighbours are never looked at.
struct Picture {
    rounding: Rounding,
}

impl Picture {
    fn of(pieces: &[RoundedPiece]) -> Self {
        let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (low, high) = pieces
            .iter()
            .flat_map(|piece| piece.image)
            .fold(empty, |(low, high), p| (low.min(p), high.max(p)));
        let rounding = Rounding::for_ranges([low.x..high.x, low.y..high.y, -1.0..1.0]);
        Picture { rounding }
    }

    fn bounds(&self, Extent { image: [a, b], slack, .. }: &Extent) -> Bounds {
        let direction = direction_range(*b - *a, *slack);
        let slack = DVec2::splat(*slack);
        let (low, high) = (a.min(*b) - slack, a.max(*b) + slack);
        self.rounding.around(low.extend(direction[0]), high.extend(direction[1]))
    }

    /// Lines that lie on one another have one place, lines from one point
    /// have several.
    fn place(&self, Extent { image: [a, b], slack, .. }: &Extent) -> Vec3A {
        let [low, high] = direction_range(*b - *a, *slack);
        let at = a.min(*b);
        let along = self.rounding.nearest(2, low * 0.5 + high * 0.5);
        Vec3A::new(self.rounding.nearest(0, at.x), self.rounding.nearest(1, at.y), along)
    }

    /// Sorts pieces on one image line along it and notes the first of each
    /// group of those whose boxes touch.
    fn split(&self, pieces: &[RoundedPiece], members: Vec<usize>, firsts: &mut [u32]) {
        let own_box = |member: usize| {
            let RoundedPiece { line, image, slack, .. } = pieces[member];
            self.bounds(&Extent { line, image, slack })
        };
        let mut boxes: Vec<(Bounds, usize)> =
            members.into_iter().map(|member| (own_box(member), member)).collect();
        let all = boxes.iter().fold(Bounds::EMPTY, |sum, (own, _)| sum.union(own));
        let size = all.high - all.low;
        let axis = usize::from(size.x < size.y);
        boxes.sort_unstable_by(|(a, first), (b, second)| {
            a.low[axis].total_cmp(&b.low[axis]).then(first.cmp(second))
        });
        let mut from = 0;
        let mut reach = Bounds::EMPTY;
        let mut note = |group: &[(Bounds, usize)]| {
            let first = group.iter().map(|&(_, member)| member).min();
            for &(_, member) in group {
                firsts[member] = first.unwrap_or(member) as u32;
            }
        };
        for (i, (own, _)) in boxes.iter().enumerate() {
            // Directions of short pieces are not known.
            let touches = (0..2)
                .all(|axis| own.low[axis] <= reach.high[axis] && reach.low[axis] <= own.high[axis]);
            if !touches {
                note(&boxes[from..i]);
                (from, reach) = (i, Bounds::EMPTY);
            }
            reach = reach.union(own);
        }
        note(&boxes[from..]);
    }
}

/// The range of a line's direction, either way along it being the same: a
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
    // Not comparable, for a line that is a point, is all of the range.
    if size > 2.0 * error && middle.abs() + reach < 1.0 {
        [middle - reach, middle + reach]
    } else {
        [-1.0, 1.0]
    }
}

/// Whether the images of two lines lie on one line.
fn are_collinear<P: Policy>(
    question: &LineQuestion<'_>,
    predicates: &Predicates<'_, P>,
    first: &Extent,
    second: &Extent,
) -> bool {
    if clearly_off(first, second) || clearly_off(second, first) {
        return false;
    }
    let [a, b] = [first, second].map(|it| question.carrier(&question.lines[it.line as usize]));
    b.ends.iter().all(|&end| predicates.image_side_of_point(a, end).is_zero())
}

/// Whether an end of `other` is off the line of `extent` by more than
/// rounding can explain.
fn clearly_off(extent: &Extent, other: &Extent) -> bool {
    let [start, end] = extent.image;
    let along = end - start;
    other.image.iter().any(|&point| {
        let offset = point - start;
        let off = along.perp_dot(offset).abs();
        // Ends are off by at most their slack in each coordinate; the
        // product's own roundings are far below.
        let reach = along.abs().element_sum() + offset.abs().element_sum();
        let slack = 4.0 * (extent.slack + other.slack);
        off > reach * slack + slack * slack
    })
}

/// Pieces that have to be looked at together.
pub(super) struct Groups {
    members: Vec<u32>,
    /// End of each group in `members`.
    ends: Vec<u32>,
}

impl Groups {
    pub(super) fn len(&self) -> usize {
        self.ends.len()
    }

    /// How many members some groups have.
    pub(super) fn members_of(&self, groups: Range<usize>) -> usize {
        groups.map(|group| self.get(group).len()).sum()
    }

    pub(super) fn get(&self, group: usize) -> &[u32] {
        let start = if group == 0 { 0 } else { self.ends[group - 1] };
        &self.members[start as usize..self.ends[group] as usize]
    }

    /// The groups of pieces with the same first one, in the order of that;
    /// members in ascending order.
    fn of_firsts(firsts: &[u32]) -> Self {
        let mut ends = Vec::new();
        let mut group_of = vec![0_u32; firsts.len()];
        for (piece, &first) in firsts.iter().enumerate() {
            if first as usize == piece {
                group_of[piece] = ends.len() as u32;
                ends.push(0);
            } else {
                group_of[piece] = group_of[first as usize];
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
        let mut members = vec![0; firsts.len()];
        for (piece, group) in group_of.into_iter().enumerate() {
            let slot = &mut next[group as usize];
            members[*slot as usize] = piece as u32;
            *slot += 1;
        }
        Groups { members, ends }
    }
}
