//! Straight lines along which faces end: edges, and stretches of borders that
//! lie on one another.

use super::Mesh;

/// Where two faces or more end in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Hinge {
    /// An edge of the mesh.
    Edge(u32),
    /// One of the mesh's [`super::Borders::stretches`].
    Stretch(u32),
}

impl Mesh {
    /// The vertices at the ends of a hinge, the smaller number first.
    #[inline]
    pub fn hinge_ends(&self, hinge: Hinge) -> [u32; 2] {
        match hinge {
            Hinge::Edge(edge) => self.edges().ends(edge),
            Hinge::Stretch(index) => self.borders().stretches()[index as usize].ends,
        }
    }

    /// The triangles that end along a hinge, each with its corner off it.
    /// Those of a seam's other object are among them.
    pub fn hinge_sides(&self, hinge: Hinge) -> impl Iterator<Item = (u32, u32)> + Clone + '_ {
        let (ends, triangles, sides): (_, &[u32], &[_]) = match hinge {
            Hinge::Edge(edge) => (self.edges().ends(edge), self.edges().triangles(edge), &[]),
            Hinge::Stretch(index) => ([0; 2], &[], self.borders().sides(index, true)),
        };
        let of_edge = triangles.iter().map(move |&triangle| (triangle, self.third(triangle, ends)));
        of_edge.chain(sides.iter().map(|side| (side.triangle, side.third)))
    }
}
