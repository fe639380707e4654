//! The borders of the result, pieced together while the sweep goes on.
//!
//! A piece of an edge is a border if what lies left of it is not what lies
//! right of it. Each of its two sides is a *flank*, directed so that its area
//! is on its left. Around a point the borders divide the plane into wedges;
//! a ring that comes in along one side of a wedge goes out along the other:
//!
//! ```text
//!            \  b                 flank coming in along b, the wedge on its left,
//!       wedge \                   is followed by the flank going out along a
//!              p ------ a
//! ```
//!
//! That is the turn of Weiler and Atherton (1977): follow one polygon, turn
//! onto the other at a crossing, keep the inside on one side. As all pieces
//! around a point are known in their exact order, it cannot go astray where
//! edges touch or coincide. Rings through one point never cross there, and
//! areas that touch in a point only are not joined.

use crate::kernel::predicates::ImagePoint;

/// One side of a border: twice the number of the border, plus one where
/// the area is below it.
pub(super) type Flank = u32;

/// No border.
pub(super) const NO_BORDER: u32 = u32::MAX;

/// A piece between two areas of which at least one is wanted.
#[derive(Debug, Clone, Copy)]
pub(super) struct Border {
    /// The edge of which it is a piece.
    pub(super) edge: u32,
    /// Ends in the order of the sweep: numbers of [`Borders::points`].
    pub(super) ends: [u32; 2],
    /// What lies above and below.
    pub(super) labels: [u32; 2],
    /// The faces above and below.
    pub(super) faces: [u32; 2],
}

/// All borders with the order of their flanks.
#[derive(Debug, Default)]
pub(super) struct Borders {
    pub(super) list: Vec<Border>,
    /// The flank that follows each flank.
    pub(super) next: Vec<Flank>,
    /// The ends of borders, in the order of the sweep.
    pub(super) points: Vec<ImagePoint>,
    /// Faces that are one, by a parent each.
    faces: Vec<u32>,
    /// The borders that leave a point and then those that arrive.
    around: Vec<(u32, bool)>,
}

impl Border {
    /// The label on the left of a flank.
    pub(super) fn label(&self, flank: Flank) -> u32 {
        self.labels[flank as usize & 1]
    }

    /// The face on the left of a flank.
    pub(super) fn face(&self, flank: Flank) -> u32 {
        self.faces[flank as usize & 1]
    }

    /// Where a flank starts.
    pub(super) fn start(&self, flank: Flank) -> u32 {
        self.ends[flank as usize & 1]
    }
}

impl Borders {
    pub(super) fn border(&self, flank: Flank) -> &Border {
        &self.list[(flank >> 1) as usize]
    }

    /// A new point, later than all others.
    pub(super) fn point(&mut self, point: ImagePoint) -> u32 {
        self.points.push(point);
        self.points.len() as u32 - 1
    }

    /// A new border that leaves a point.
    pub(super) fn start(&mut self, edge: u32, from: u32, labels: [u32; 2], faces: [u32; 2]) -> u32 {
        self.list.push(Border { edge, ends: [from, from], labels, faces });
        self.next.extend([NO_BORDER; 2]);
        self.list.len() as u32 - 1
    }

    /// Goes on from border `from` to border `to`, which is all there is at
    /// the point between them.
    pub(super) fn go_on(&mut self, from: u32, to: u32, at: u32) {
        self.list[from as usize].ends[1] = at;
        self.next[2 * from as usize] = 2 * to;
        self.next[2 * to as usize + 1] = 2 * from + 1;
    }

    /// Begins to collect the borders around a point, counterclockwise from
    /// straight below: those that leave upwards, then those that arrive
    /// downwards.
    pub(super) fn begin(&mut self) {
        self.around.clear();
    }

    pub(super) fn leaves(&mut self, border: u32) {
        self.around.push((border, true));
    }

    pub(super) fn arrives(&mut self, border: u32, at: u32) {
        self.list[border as usize].ends[1] = at;
        self.around.push((border, false));
    }

    /// Links the flanks of all wedges around the point.
    pub(super) fn finish(&mut self) {
        for (i, &(border, leaves)) in self.around.iter().enumerate() {
            let (after, after_leaves) = self.around[(i + 1) % self.around.len()];
            let outgoing = 2 * border + u32::from(!leaves);
            let incoming = 2 * after + u32::from(after_leaves);
            self.next[incoming as usize] = outgoing;
        }
    }

    /// A new face.
    pub(super) fn new_face(&mut self) -> u32 {
        self.faces.push(self.faces.len() as u32);
        self.faces.len() as u32 - 1
    }

    /// Two faces are one.
    pub(super) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.faces[a.max(b) as usize] = a.min(b);
    }

    /// The number that stands for a face and all that are one with it.
    pub(super) fn find(&mut self, mut face: u32) -> u32 {
        while self.faces[face as usize] != face {
            let parent = self.faces[face as usize];
            self.faces[face as usize] = self.faces[parent as usize];
            face = parent;
        }
        face
    }
}
