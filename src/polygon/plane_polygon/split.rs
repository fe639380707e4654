//! One polygon cut in two by a plane.

use super::{PlaneCorner, PlanePolygon, Side};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Plane, PlanePoint, Policy, Predicates};

/// What a plane makes of a polygon.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Cut {
    /// All of it lies in the plane.
    Within,
    /// All of it lies on the negative side, or touches the plane from there.
    Below,
    /// All of it lies on the positive side, or touches the plane from there.
    Above,
    /// The plane parts it; the negative part comes first.
    Parted([PlanePolygon; 2]),
}

impl PlanePolygon {
    /// Cuts the polygon by a plane. The parts share the new side, which is no
    /// edge of the input, and nothing else. O(corners).
    pub fn cut<P: Policy>(&self, predicates: &Predicates<'_, P>, plane: Plane) -> Cut {
        if plane == self.plane().into() {
            return Cut::Within;
        }
        let signs: Vec<Sign> =
            self.corners.iter().map(|c| predicates.above(plane, c.point)).collect();
        let has = |sign| signs.contains(&sign);
        match [has(Sign::Negative), has(Sign::Positive)] {
            [false, false] => Cut::Within,
            [true, false] => Cut::Below,
            [false, true] => Cut::Above,
            [true, true] => Cut::Parted(
                [Sign::Negative, Sign::Positive].map(|keep| self.kept(&signs, plane, keep)),
            ),
        }
    }

    /// The part on which the plane has the sign `keep`, given its signs at
    /// all corners.
    ///
    /// ```text
    ///          keep                 a corner on the plane stays, with the cut
    ///      i o------o               for its side where the ring leaves there
    ///       /        \
    ///  ----x==========x----  plane  x: new corners, = the new side
    ///     o            o
    /// ```
    fn kept(&self, signs: &[Sign], plane: Plane, keep: Sign) -> PlanePolygon {
        let side = Side::Cut(plane, keep);
        let mut corners = Vec::with_capacity(self.corners.len() + 1);
        for (i, corner) in self.corners.iter().enumerate() {
            let (own, next) = (signs[i] * keep, signs[(i + 1) % signs.len()] * keep);
            let crossing = || self.crossing(corner.side, plane, signs[i]);
            match (own, next) {
                (Sign::Positive, Sign::Negative) => {
                    corners.push(*corner);
                    corners.push(PlaneCorner { point: crossing(), side });
                }
                (Sign::Negative, Sign::Positive) => {
                    corners.push(PlaneCorner { point: crossing(), side: corner.side });
                }
                (Sign::Zero, Sign::Negative) => {
                    corners.push(PlaneCorner { point: corner.point, side });
                }
                (Sign::Negative, _) => {}
                _ => corners.push(*corner),
            }
        }
        PlanePolygon { face: self.face, corners }
    }

    /// Where a plane crosses a side at whose start it has the sign `from` and
    /// at whose end the other.
    fn crossing(&self, side: Side, plane: Plane, from: Sign) -> PlanePoint {
        match side {
            Side::Edge { ends: [a, b], .. } => {
                let ends = if from == Sign::Negative { [a, b] } else { [b, a] };
                PlanePoint::OnEdge(ends, plane)
            }
            Side::Cut(other, inside) => {
                // The side runs along n_other x n times `inside`, for it has
                // the polygon on its left; the normal h of the face's
                // functional is -n. So the plane grows along the side, that is
                // `from` is negative, if [h, other, plane] has the sign `inside`.
                let grows = from == Sign::Negative;
                let ordered = grows == (inside == Sign::Positive);
                let planes = if ordered { [other, plane] } else { [plane, other] };
                PlanePoint::OnFace(self.face, planes)
            }
        }
    }
}
