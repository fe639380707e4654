//! How far apart things may be to be taken as one, measured so that neither
//! large nor small numbers get out of range.

use glam::DVec3;
use std::cmp::Ordering;

/// A distance, greater than zero and finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tolerance(f64);

/// Where a position is beside an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Beside {
    /// From 0 at the first end to 1 at the second.
    pub(super) along: f64,
}

impl Tolerance {
    pub(super) fn new(distance: f64) -> Self {
        Tolerance(distance)
    }

    pub(super) fn distance(self) -> f64 {
        self.0
    }

    /// Whether two positions are that near.
    #[inline]
    pub(super) fn allows(self, p: DVec3, q: DVec3) -> bool {
        ((p - q) / self.0).length_squared() <= 1.0
    }

    /// Whether a position is that near to the inside of an edge, and where; the
    /// same from both ends.
    pub(super) fn beside(self, position: DVec3, [from, to]: [DVec3; 2]) -> Option<Beside> {
        if compare(from, to).is_gt() {
            let Beside { along } = self.beside(position, [to, from])?;
            return Some(Beside { along: 1.0 - along });
        }
        let edge = to - from;
        let scale = edge.abs().max_element();
        let (edge, offset) = (edge / scale, (position - from) / scale);
        let along = offset.dot(edge) / edge.length_squared();
        let inside = 0.0 < along && along < 1.0;
        let off = (offset - edge * along) * (scale / self.0);
        (inside && off.length_squared() <= 1.0).then_some(Beside { along })
    }

    /// Whether a triangle is no wider than that: its height over its longest
    /// side.
    #[inline]
    pub(super) fn is_width_of(self, [p, q, r]: [DVec3; 3]) -> bool {
        let [u, v] = [(q - p) / self.0, (r - p) / self.0];
        let longest = u.length_squared().max(v.length_squared()).max((u - v).length_squared());
        u.cross(v).length_squared() <= longest
    }
}

/// An order of positions: by x, then y, then z.
pub(super) fn compare(p: DVec3, q: DVec3) -> Ordering {
    let coordinates = p.to_array().into_iter().zip(q.to_array());
    coordinates.fold(Ordering::Equal, |order, (x, y)| order.then(x.total_cmp(&y)))
}

/// An order of positions that prefers those nearest to the planes through the
/// origin: of 0 and what is left of it by rounding, 0.
pub(super) fn rank(p: DVec3, q: DVec3) -> Ordering {
    compare(p.abs(), q.abs()).then(compare(p, q))
}

/// The distance of two positions.
pub(super) fn distance(p: DVec3, q: DVec3) -> f64 {
    let offset = p - q;
    let scale = offset.abs().max_element();
    if scale == 0.0 { 0.0 } else { (offset / scale).length() * scale }
}
