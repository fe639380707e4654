//! Single rings that need no search: quadrilaterals and fans.
//!
//! Nearly all faces of nearly all models are one or the other. Where a ring is
//! planar, any axis along which it turns at all gives the same signs; where it
//! is not, the axis has to be the same wherever the ring begins.

use super::Triangles;
use super::axis::{axes_of, canonical_axes_of, least_corner};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{are_coplanar, compare_lengths, orientation};
use glam::{DVec2, DVec3};

/// The triangles of a quadrilateral that does not cross itself, and of a ring
/// that is star-shaped from its least corner. O(n).
pub(super) fn triangulate(ring: &[DVec3]) -> Option<Triangles> {
    let least = least_corner(ring);
    let axes = axes_of(ring, least);
    let axis = axes.order[0];
    let found = Ring { ring, least, axis }.triangulate();
    if axes.is_certain || found.as_ref().is_some_and(|found| found.is_planar) {
        return found;
    }
    match canonical_axes_of(ring)[0] {
        other if other != axis => Ring { ring, least, axis: other }.triangulate(),
        _ => found,
    }
}

/// A ring seen from the positive end of an axis, corners counted from the least.
struct Ring<'a> {
    ring: &'a [DVec3],
    least: usize,
    axis: usize,
}

impl Ring<'_> {
    #[inline]
    fn number(&self, corner: usize) -> usize {
        let number = self.least + corner;
        if number < self.ring.len() { number } else { number - self.ring.len() }
    }

    #[inline]
    fn at(&self, corner: usize) -> DVec3 {
        self.ring[self.number(corner)]
    }

    #[inline]
    fn turn(&self, corners: [usize; 3]) -> Sign {
        let [a, b, c] = corners.map(|corner| {
            let p = self.at(corner);
            match self.axis {
                0 => DVec2::new(p.y, p.z),
                1 => DVec2::new(p.z, p.x),
                _ => DVec2::new(p.x, p.y),
            }
        });
        orientation(a, b, c)
    }

    fn triangulate(&self) -> Option<Triangles> {
        match self.ring.len() {
            4 => self.quadrilateral(),
            _ => self.fan(),
        }
    }

    /// Whether all corners lie in the plane of three.
    fn is_planar(&self, corners: [usize; 3]) -> bool {
        are_coplanar(self.ring, corners.map(|corner| self.number(corner)))
    }

    fn triangles(&self, corners: &[[usize; 3]], is_planar: bool) -> Triangles {
        let numbers = |corners: &[usize; 3]| corners.map(|corner| self.number(corner) as u32);
        Triangles { corners: corners.iter().map(numbers).collect(), is_planar }
    }

    /// Two triangles that turn alike lie on both sides of their diagonal.
    /// Where both diagonals do, a flat one is cut from the least corner, and a
    /// bent one along the shorter diagonal, which bends it less.
    fn quadrilateral(&self) -> Option<Triangles> {
        const FROM_LEAST: [[usize; 3]; 2] = [[0, 1, 2], [0, 2, 3]];
        const ACROSS: [[usize; 3]; 2] = [[1, 2, 3], [3, 0, 1]];
        let fits = |halves: [[usize; 3]; 2]| {
            let turns = halves.map(|half| self.turn(half));
            turns[0] == turns[1] && !turns[0].is_zero()
        };
        if !fits(FROM_LEAST) {
            return fits(ACROSS).then(|| self.triangles(&ACROSS, self.is_planar(ACROSS[0])));
        }
        let is_planar = self.is_planar(FROM_LEAST[0]);
        let [from_least, across] = [[0, 2], [1, 3]].map(|ends| ends.map(|corner| self.at(corner)));
        let is_across = !is_planar && compare_lengths(across, from_least).is_lt() && fits(ACROSS);
        Some(self.triangles(if is_across { &ACROSS } else { &FROM_LEAST }, is_planar))
    }

    /// The fan from the least corner, if its triangles all turn one way and
    /// together less than half a revolution around that corner.
    fn fan(&self) -> Option<Triangles> {
        let seconds = 1..self.ring.len() - 1;
        let turn = self.turn([0, 1, 2]);
        if turn.is_zero() || !seconds.clone().all(|i| self.turn([0, i, i + 1]) == turn) {
            return None;
        }
        let is_planar = self.is_planar([0, 1, 2]);
        // Of a planar ring the least corner is one of its convex hull.
        if !is_planar && !seconds.clone().all(|i| self.turn([0, 1, i + 1]) == turn) {
            return None;
        }
        let corners: Vec<_> = seconds.map(|i| [0, i, i + 1]).collect();
        Some(self.triangles(&corners, is_planar))
    }
}
