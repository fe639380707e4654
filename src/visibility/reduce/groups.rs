//! Which pieces may lie on one another in the image: groups to be resolved.
//!
//! Pieces whose boxes touch and whose images are exactly collinear are one
//! group, and so are those connected by others. Rounded coordinates only
//! dismiss pairs that are clearly not collinear, with proven slack.

use super::rounded::RoundedPiece;
use crate::kernel::predicates::{Policy, Predicates};
use crate::run::{Cancelled, Growing, Run};
use crate::spatial::{Hierarchy, Rounding};
use crate::view::LineQuestion;
use glam::{DVec2, Vec3A};

/// What a pair takes in a list that has room for twice as many.
const PAIR_BYTES: usize = 2 * size_of::<[u32; 2]>();

/// Gathers collinear pieces that touch. Every piece is in one group; groups
/// are ordered by their first piece and sorted within.
pub(super) fn groups_of<P: Policy>(
    question: &LineQuestion<'_>,
    pieces: &[RoundedPiece],
    run: &Run<'_>,
) -> Result<Groups, Cancelled> {
    let hierarchy = image_hierarchy(pieces);
    let found = hierarchy.overlapping_pairs(
        run,
        || (Predicates::<P>::new(question.points), Vec::new(), Growing::new(run, PAIR_BYTES)),
        |(predicates, pairs, growing), a, b| {
            if !growing.goes_on(pairs.len()) {
                return;
            }
            let (first, second) = (&pieces[a as usize], &pieces[b as usize]);
            if first.line == second.line || are_collinear(question, predicates, first, second) {
                pairs.push([a, b]);
            }
        },
    );
    run.check()?;
    let mut parents: Vec<u32> = (0..pieces.len() as u32).collect();
    for (predicates, pairs, mut growing) in found {
        growing.finish(pairs.len())?;
        growing.throw_away();
        run.merge(&predicates.counters());
        run.count("collinear-pairs", pairs.len() as u64);
        for [a, b] in pairs {
            let (a, b) = (root(&mut parents, a), root(&mut parents, b));
            // The smaller number is the root, so groups know their first.
            parents[a.max(b) as usize] = a.min(b);
        }
    }
    Ok(Groups::of_trees(parents))
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

    pub(super) fn get(&self, group: usize) -> &[u32] {
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
