//! Points and lines that are known by the input that defines them.
//!
//! A line to be walked, the *carrier*, is an edge or the common line of two
//! faces. Its ends are vertices or *piercings* (an edge through the plane
//! of a face). What happens along it happens where it meets a plane: of a
//! face, of an edge and the eye (an image crossing), of a vertex and the
//! eye, or the near plane. Such a [`Place`] is never rounded; every
//! question about it is a polynomial in input coordinates, because the
//! functional of a plane is linear in the point it is applied to
//! (Attene 2020 calls these implicit points).

/// The point where an edge meets the plane of a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Piercing {
    /// The edge, directed so that its first vertex is not on the positive
    /// side of the face and its second not on the negative side. Not both
    /// lie on the face's plane.
    pub edge: [u32; 2],
    /// The corners of the face.
    pub face: [u32; 3],
}

impl Piercing {
    /// The same point under the one name that does not depend on the order of
    /// the face's corners and on their winding.
    #[must_use]
    pub fn canonical(self) -> Self {
        let (face, is_odd) = sorted(self.face);
        let [a, b] = self.edge;
        Piercing { edge: if is_odd { [b, a] } else { [a, b] }, face }
    }
}

/// Corners in ascending order, and whether that turns them the other way.
fn sorted([a, b, c]: [u32; 3]) -> ([u32; 3], bool) {
    let mut corners = [a, b, c];
    corners.sort_unstable();
    let is_turned = [[a, b, c], [b, c, a], [c, a, b]].contains(&corners);
    (corners, !is_turned)
}

/// An input vertex or a piercing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Point {
    /// A vertex.
    Vertex(u32),
    /// Where an edge meets the plane of a face.
    Piercing(Piercing),
}

/// A straight line segment to be walked from its first end to its second.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Carrier {
    /// Where the walk begins and ends.
    pub ends: [Point; 2],
}

impl Carrier {
    /// The edge from vertex `a` to vertex `b`.
    pub fn edge(a: u32, b: u32) -> Self {
        Carrier { ends: [Point::Vertex(a), Point::Vertex(b)] }
    }

    /// The same segment, walked the other way.
    #[must_use]
    pub fn reversed(self) -> Self {
        let [start, end] = self.ends;
        Carrier { ends: [end, start] }
    }

    /// The vertices, if this is an edge.
    #[inline(always)]
    pub fn as_edge(&self) -> Option<[u32; 2]> {
        match self.ends {
            [Point::Vertex(a), Point::Vertex(b)] => Some([a, b]),
            _ => None,
        }
    }
}

/// A plane at which something may change along a carrier.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Cut {
    /// The plane of a face: the carrier pierces it.
    Face([u32; 3]),
    /// The plane of an edge and the eye: their images cross.
    Silhouette([u32; 2]),
    /// The plane of a vertex, the eye and an axis direction (0, 1, 2): the
    /// carrier passes the image of the vertex.
    Vertex(u32, u8),
    /// The near plane.
    Near,
    /// The plane of the eye and the line where the near plane cuts the plane
    /// of a face: the carrier passes the image of that line.
    NearLine([u32; 3]),
}

impl Cut {
    /// The same plane under the one name that does not depend on the order of
    /// vertices; its sides may change.
    #[must_use]
    pub fn canonical(self) -> Self {
        match self {
            Cut::Face(face) => Cut::Face(sorted(face).0),
            Cut::Silhouette([a, b]) => Cut::Silhouette([a.min(b), a.max(b)]),
            Cut::NearLine(face) => Cut::NearLine(sorted(face).0),
            Cut::Vertex(..) | Cut::Near => self,
        }
    }
}

/// A point of a carrier: an end or a cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Place {
    /// The first end.
    Start,
    /// The second end.
    End,
    /// Where a plane cuts the carrier strictly between its ends.
    Cut(Cut),
}

/// A point strictly inside a part of a carrier: exact, and no end of anything
/// unless by chance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Probe {
    /// The combination of the carrier's ends with these integer weights.
    Weights([f64; 2]),
    /// Some point between two places, for parts shorter than a float can
    /// divide.
    Between([Place; 2]),
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::numbers::Sign;
    use crate::kernel::predicates::{Exact, Eye, Points, Predicates};
    use glam::DVec3;

    #[test]
    fn a_piercing_has_one_name_whatever_the_order_of_corners() {
        let vertices = [
            DVec3::X,
            DVec3::Y,
            DVec3::ZERO,
            DVec3::new(0.2, 0.3, -1.0),
            DVec3::new(0.1, 0.1, 2.0),
        ];
        let points = Points::new(&vertices, Eye::Towards(DVec3::Z), None);
        let predicates = Predicates::<Exact>::new(&points);
        let orders = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
        let names = orders.map(|face| {
            let edge = match predicates.plane(face, 3) {
                Sign::Negative => [3, 4],
                _ => [4, 3],
            };
            Piercing { edge, face }.canonical()
        });
        assert_eq!(names[0].face, [0, 1, 2]);
        assert!(names.iter().all(|name| *name == names[0]));
        assert_eq!(predicates.plane(names[0].face, names[0].edge[0]), Sign::Negative);
        let cuts = orders.map(|face| Cut::Face(face).canonical());
        assert!(cuts.iter().all(|cut| *cut == cuts[0]));
        assert_eq!(Cut::Silhouette([7, 2]).canonical(), Cut::Silhouette([2, 7]));
    }
}
