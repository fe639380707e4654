//! Which piece of a drawing passes in front of which other one.
//!
//! Appel, Rohlf and Stein (1979) interrupt a line where another passes in
//! front of it; Franklin and Akman (1987) find the places once and draw
//! haloes of any width from them. These are the places:
//!
//! 1. Pieces whose boxes overlap are candidates, and those whose segments
//!    do not meet within their rounding are dismissed in floats.
//! 2. The lines of the pieces, not the rounded pieces, must have images that
//!    cross: the ends of each lie on different sides of the other. Lines
//!    with one image have no crossing.
//! 3. `[p, q, a, b]` of the ends of both tells which is nearer, as it does
//!    for Appel's events. Where it is zero the lines meet in space, and
//!    neither passes in front of the other.
//!
//! So the order in depth is exact, and whether the crossing lies on the
//! pieces is decided within their rounding, in favour of their ends.

use super::coincident::Origin;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Carrier, Policy, Predicates};
use crate::run::{Cancelled, Growing, Run, map_indexed};
use crate::spatial::{Bounds, Hierarchy, Rounding};
use crate::view::{Crossing, LinePiece, LineQuestion};
use glam::DVec2;

/// All crossings, sorted.
pub(super) fn find_crossings<P: Policy>(
    question: &LineQuestion<'_>,
    pieces: &[LinePiece],
    origins: &[Origin],
    run: &Run<'_>,
) -> Result<Vec<Crossing>, Cancelled> {
    let hierarchy = Hierarchy::new(&boxes(pieces, origins));
    // Each is copied once, when the parts are joined.
    let growing = || Growing::new(run, 2 * size_of::<Crossing>()).of_crossings();
    let found = hierarchy.overlapping_pairs(
        run,
        || (Predicates::<P>::new(question.points), Vec::new(), growing()),
        |(predicates, crossings, growing), a, b| {
            if !growing.goes_on(crossings.len()) {
                return;
            }
            let [first, second] = [a, b].map(|index| origins[index as usize]);
            let images = [a, b].map(|index| pieces[index as usize].points);
            if first.line == second.line || !may_meet(images, first.slack + second.slack) {
                return;
            }
            let carriers =
                [first, second].map(|p| question.carrier(&question.lines[p.line as usize]));
            match passing(predicates, carriers) {
                Some(Passing::FirstInFront) => crossings.push(Crossing { near: a, far: b }),
                Some(Passing::SecondInFront) => crossings.push(Crossing { near: b, far: a }),
                None => {}
            }
        },
    );
    let mut crossings = Vec::new();
    for (predicates, found, mut growing) in found {
        growing.finish(found.len())?;
        run.merge(&predicates.counters());
        crossings.extend(found);
    }
    crossings.sort_unstable();
    run.count("crossings-of-lines", crossings.len() as u64);
    Ok(crossings)
}

/// Boxes of the images of pieces, rounded outward; depth is left open.
fn boxes(pieces: &[LinePiece], origins: &[Origin]) -> Vec<Bounds> {
    let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let points = pieces.iter().flat_map(|piece| piece.points);
    let (low, high) = points.fold(empty, |(low, high), p| (low.min(p), high.max(p)));
    let rounding = Rounding::for_ranges([low.x..high.x, low.y..high.y, 0.0..0.0]);
    let around = |i: usize| {
        let ([a, b], slack) = (pieces[i].points, DVec2::splat(4.0 * origins[i].slack));
        rounding.around((a.min(b) - slack).extend(0.0), (a.max(b) + slack).extend(0.0))
    };
    map_indexed(pieces.len(), around)
}

/// Whether two images that are off by `slack` together meet, as far as
/// floats can tell.
fn may_meet([first, second]: [[DVec2; 2]; 2], slack: f64) -> bool {
    reaches_across(first, second, 4.0 * slack) && reaches_across(second, first, 4.0 * slack)
}

/// Whether the ends of `other` do not clearly lie on one side of the line
/// of `segment`.
fn reaches_across(segment: [DVec2; 2], other: [DVec2; 2], slack: f64) -> bool {
    let along = segment[1] - segment[0];
    let reach = |offset: DVec2| along.abs().element_sum() + offset.abs().element_sum();
    let [first, second] = other.map(|point| {
        let offset = point - segment[0];
        (along.perp_dot(offset), reach(offset) * slack + slack * slack)
    });
    let clearly = |(side, bound): (f64, f64)| {
        if side > bound {
            1
        } else if side < -bound {
            -1
        } else {
            0
        }
    };
    clearly(first) * clearly(second) <= 0
}

/// Which of two lines is nearer where their images cross.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Passing {
    FirstInFront,
    SecondInFront,
}

/// How two lines pass one another, if their images cross in one point and
/// they do not meet in space.
fn passing<P: Policy>(
    predicates: &Predicates<'_, P>,
    [first, second]: [Carrier; 2],
) -> Option<Passing> {
    if first.ends.iter().any(|end| second.ends.contains(end)) {
        return None;
    }
    let beside =
        |of: Carrier, other: Carrier| other.ends.map(|end| predicates.image_side_of_point(of, end));
    let [from, to] = beside(second, first);
    if from == to {
        return None;
    }
    let [c, d] = beside(first, second);
    if c == d {
        return None;
    }
    // Towards which side of the second line the first one runs.
    let onward = if to.is_zero() { -from } else { to };
    match predicates.skew_of_carriers(first, second) {
        Sign::Zero => None,
        skew if skew == onward => Some(Passing::FirstInFront),
        _ => Some(Passing::SecondInFront),
    }
}
