//! Convex polygons bounded by planes of the input, cut again and again.
//!
//! A polygon lies in the plane of a face. Its sides are edges of the input,
//! named by their two vertices, or lines in which other planes of the input
//! cut the face; its corners are named by what meets in them
//! ([`PlanePoint`]). A cut by one more plane of the input makes such corners
//! and such a side and nothing else, so names never nest, degrees never grow,
//! and the thousandth cut is as exact as the first. (Sugihara and Iri 1989;
//! Bernstein and Fussell 2009. They keep edges as planes too; the two
//! vertices of an edge of the input say the same at a lower degree.)
//!
//! Concave faces and faces with holes come as convex parts ([`convex_parts`])
//! that meet in inner edges. Those are marked: they bound a part and are no
//! line of the face.

mod area;
mod overlap;
mod parts;
mod split;

pub use parts::{FaceParts, Part, convex_parts};
pub use split::Cut;

use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{InputPlane, Plane, PlanePoint, Policy, Predicates};

/// On which line a side lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// From one vertex towards another along an edge of the input. An inner
    /// edge lies between two parts of one face.
    Edge {
        /// The vertices, in the winding of the face.
        ends: [u32; 2],
        /// Whether it is no border of the face.
        is_inner: bool,
    },
    /// Where a plane cuts the face; the polygon lies where it has this sign.
    Cut(Plane, Sign),
}

/// A corner and the side that begins there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlaneCorner {
    /// Where it is.
    pub point: PlanePoint,
    /// The line of the side to the next corner.
    pub side: Side,
}

/// A convex polygon with an area, in the winding of its face. Corners may lie
/// in the middle of an edge.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlanePolygon {
    /// Three vertices of the face, not collinear and in its winding: its plane.
    pub face: [u32; 3],
    /// The corners; three at least.
    pub corners: Vec<PlaneCorner>,
}

impl PlanePolygon {
    /// What its list of corners takes in memory.
    pub(crate) fn heap_bytes(&self) -> usize {
        self.corners.capacity() * size_of::<PlaneCorner>()
    }

    /// A triangle all of whose edges are borders.
    pub fn triangle(face: [u32; 3]) -> Self {
        PlanePolygon::of_ring(face, &face, |_| false)
    }

    /// The polygon with these vertices, of which `is_inner` says which edges
    /// are inner ones.
    fn of_ring(face: [u32; 3], ring: &[u32], is_inner: impl Fn([u32; 2]) -> bool) -> Self {
        let next = ring.iter().cycle().skip(1);
        let corner = |(&a, &b): (&u32, &u32)| PlaneCorner {
            point: PlanePoint::Vertex(a),
            side: Side::Edge { ends: [a, b], is_inner: is_inner([a, b]) },
        };
        PlanePolygon { face, corners: ring.iter().zip(next).map(corner).collect() }
    }

    /// The plane it lies in.
    pub fn plane(&self) -> InputPlane {
        InputPlane::Face(self.face)
    }

    /// Whether corners lie strictly on the negative and on the positive side
    /// of a plane. O(corners).
    pub fn sides_of<P: Policy>(&self, predicates: &Predicates<'_, P>, plane: Plane) -> [bool; 2] {
        let mut found = [false; 2];
        if plane == self.plane().into() {
            return found;
        }
        for corner in &self.corners {
            match predicates.above(plane, corner.point) {
                Sign::Negative => found[0] = true,
                Sign::Positive => found[1] = true,
                Sign::Zero => {}
            }
            if found == [true; 2] {
                break;
            }
        }
        found
    }

    /// For each side the plane through it and the eye, and the sign that the
    /// polygon has there if its face has this facing, which is not zero.
    pub fn shadow(&self, facing: Sign) -> impl Iterator<Item = (Plane, Sign)> + '_ {
        self.corners.iter().map(move |corner| match corner.side {
            Side::Edge { ends, .. } => (Plane::Silhouette(ends), facing),
            Side::Cut(Plane::Input(plane), inside) => {
                (Plane::Shadow(self.face, plane), inside * facing)
            }
            Side::Cut(plane, inside) => (plane, inside),
        })
    }

    /// The same for planes that do not depend on the eye: through each side
    /// and not parallel to the face.
    pub fn walls<P: Policy>(
        &self,
        predicates: &Predicates<'_, P>,
    ) -> impl Iterator<Item = (Plane, Sign)> + '_ {
        let (axis, turn) = self.axis(predicates);
        self.corners.iter().map(move |corner| match corner.side {
            Side::Edge { ends, .. } => (InputPlane::Wall(ends, axis).into(), turn),
            Side::Cut(plane, inside) => (plane, inside),
        })
    }

    /// An axis that is not parallel to the face, and which way the face turns
    /// for an eye far up that axis.
    pub fn axis<P: Policy>(&self, predicates: &Predicates<'_, P>) -> (u8, Sign) {
        let turns = [2, 1, 0].map(|axis| (axis, predicates.turn_along(self.face, axis)));
        turns.into_iter().find(|(_, turn)| !turn.is_zero()).unwrap_or(turns[0])
    }

    /// Whether two polygons whose planes through sides are `sides` and
    /// `others` have no area in common, in the image or in a common plane:
    /// one of these planes parts them. O(product of corners).
    pub fn are_apart<P: Policy>(
        predicates: &Predicates<'_, P>,
        [first, second]: [&PlanePolygon; 2],
        sides: impl Iterator<Item = (Plane, Sign)>,
        others: impl Iterator<Item = (Plane, Sign)>,
    ) -> bool {
        let beyond = |polygon: &PlanePolygon, (plane, inside): (Plane, Sign)| {
            polygon.corners.iter().all(|c| predicates.above(plane, c.point) != inside)
        };
        let mut sides = sides;
        let mut others = others;
        sides.any(|side| beyond(second, side)) || others.any(|side| beyond(first, side))
    }
}

#[cfg(test)]
mod tests;
