//! A window and what polygons are to it.
//!
//! A window is a box of samples, so its corners are samples too. What is
//! affine has its extremes over a window at its corners: a polygon is
//! outside if one of its borders has all four corners on its outer side,
//! and surrounds the window if each has all four on its inner one. These
//! are exact signs. That boxes are disjoint is told by boxes rounded
//! outward; a polygon beside the window that is neither told apart by its
//! box nor by a border of its own is called crossing, which costs a
//! subdivision and nothing else.

use super::Solver;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::Policy;
use crate::raster::samples::{Face, Footprint, Judge};

/// What a polygon is to a window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Relation {
    /// Seen by none of its samples.
    Outside,
    /// Seen by some, for all that is known; inside or across its borders.
    Crossing,
    /// Seen by all.
    Surrounding,
}

/// What a face is to a window.
pub(super) fn relation<P: Policy>(
    judge: &Judge<'_, P>,
    face: &Face,
    window: &Footprint,
) -> Relation {
    let Some(part) = window.intersection(&face.footprint) else {
        return Relation::Outside;
    };
    let mut surrounds = part == *window;
    let corners = part.corners();
    for border in 0..face.borders().len() {
        let inside = corners.iter().filter(|&&corner| judge.holds(face, border, corner)).count();
        if inside == 0 {
            return Relation::Outside;
        }
        surrounds &= inside == corners.len();
    }
    if surrounds { Relation::Surrounding } else { Relation::Crossing }
}

impl<P: Policy> Solver<'_, P> {
    /// Whether a face that surrounds a window wins all samples of it that
    /// another face may be seen by.
    ///
    /// It does if it wins the four corners of what the other's box shares
    /// with the window: the difference of two depths is affine, and where
    /// it is zero inside as well, it is zero at all corners and they were
    /// decided by the same tie. It does too if the other's corners all lie
    /// behind its plane, or on it and it comes first in a tie.
    pub(super) fn hides(&self, front: &Face, back: &Face, window: &Footprint) -> bool {
        let Some(part) = window.intersection(&back.footprint) else {
            return true;
        };
        if part.corners().iter().all(|&corner| self.judge.beats(front, back, corner)) {
            return true;
        }
        let sides = back.corners.map(|corner| self.judge.behind(front, corner));
        let touches = sides.contains(&Sign::Zero);
        !sides.contains(&Sign::Negative)
            && (!touches || self.sampled.precedes(front.triangle, back.triangle))
    }
}
