//! Which part of one triangle hides another.
//!
//! For two triangles whose images overlap, the first is nearer throughout,
//! or the second, or they lie in one plane and the tie rule decides, or they
//! pass through one another: then the common line of their planes divides
//! the image of either into a nearer and a farther part. All of this is read
//! from the signs of corners against planes.

use super::outline::NearSide;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{ImageLine, Policy, Predicates};
use crate::model::Mesh;
use crate::visibility::ties::precedes;

/// What of another triangle lies in front of this one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Hiding {
    /// Nothing that matters.
    Nothing,
    /// All of it, wherever the images overlap.
    Whole,
    /// All of it, and its image covers this one's.
    Everything,
    /// What lies left of this line.
    LeftOf(ImageLine),
}

/// A triangle that is not edge-on and lies in front of the near plane, at
/// least partly.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sheet {
    pub(super) triangle: u32,
    pub(super) corners: [u32; 3],
    pub(super) facing: Sign,
    pub(super) side: NearSide,
}

/// How two closed images lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Overlap {
    /// They have no area in common.
    Apart,
    /// The second covers the first.
    Covered,
    /// They may have an area in common.
    Maybe,
}

/// What of `other` hides `subject`.
pub(super) fn hiding<P: Policy>(
    predicates: &Predicates<'_, P>,
    mesh: &Mesh,
    subject: &Sheet,
    other: &Sheet,
) -> Hiding {
    // Where a corner may lie behind the eye, sides in space say nothing
    // about the image; clipping will find out.
    let overlap = if (subject.side, other.side) == (NearSide::Front, NearSide::Front) {
        overlap(predicates, subject, other)
    } else {
        Overlap::Maybe
    };
    if overlap == Overlap::Apart {
        return Hiding::Nothing;
    }
    let whole = match overlap {
        Overlap::Covered => Hiding::Everything,
        _ => Hiding::Whole,
    };
    match in_front(predicates, subject, other) {
        [true, false] => whole,
        [false, true] => Hiding::Nothing,
        [false, false] if precedes(mesh, other.triangle, subject.triangle) => whole,
        [false, false] => Hiding::Nothing,
        [true, true] => match in_front(predicates, other, subject) {
            [true, false] => Hiding::Nothing,
            [false, true] => whole,
            // Points of the other are left of this line if they lie in front
            // of the subject: the functional is the product of what the
            // subject's plane says of them and what the other's says of the
            // eye.
            _ if subject.facing == other.facing => {
                Hiding::LeftOf(ImageLine::Planes([subject.corners, other.corners]))
            }
            _ => Hiding::LeftOf(ImageLine::Planes([other.corners, subject.corners])),
        },
    }
}

/// Whether some corner of `other` lies in front of the plane of `subject`,
/// and whether some lies behind it.
fn in_front<P: Policy>(
    predicates: &Predicates<'_, P>,
    subject: &Sheet,
    other: &Sheet,
) -> [bool; 2] {
    let mut found = [false; 2];
    for corner in other.corners {
        if subject.corners.contains(&corner) {
            continue;
        }
        match predicates.plane(subject.corners, corner) * subject.facing {
            Sign::Negative => found[0] = true,
            Sign::Positive => found[1] = true,
            Sign::Zero => {}
        }
    }
    found
}

fn overlap<P: Policy>(predicates: &Predicates<'_, P>, subject: &Sheet, other: &Sheet) -> Overlap {
    if is_beyond_an_edge(predicates, subject, other).0 {
        return Overlap::Apart;
    }
    match is_beyond_an_edge(predicates, other, subject) {
        (true, _) => Overlap::Apart,
        (_, true) => Overlap::Covered,
        _ => Overlap::Maybe,
    }
}

/// Whether all corners of `other` lie on or beyond one edge of `of`, and
/// whether none lies beyond any.
fn is_beyond_an_edge<P: Policy>(
    predicates: &Predicates<'_, P>,
    of: &Sheet,
    other: &Sheet,
) -> (bool, bool) {
    let [a, b, c] = of.corners;
    let mut all_inside = true;
    for (p, q) in [(a, b), (b, c), (c, a)] {
        let mut any_inside = false;
        for x in other.corners {
            if x == p || x == q {
                continue;
            }
            let sign = predicates.side(p, q, x) * of.facing;
            any_inside |= sign == Sign::Positive;
            all_inside &= sign != Sign::Negative;
        }
        if !any_inside {
            return (true, false);
        }
    }
    (false, all_inside)
}
