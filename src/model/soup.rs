//! What a model file says, before anything is made of it: vertices, faces
//! with holes, loose lines, object names.

use super::{FacePlaces, Precision};
use glam::DVec3;

/// An object's colour, as in `#rrggbb`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Color(pub [u8; 3]);

/// The meaning of a model's numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Unit {
    /// Millimetres.
    #[default]
    Millimetre,
    /// Centimetres.
    Centimetre,
    /// Metres.
    Metre,
    /// Inches of 25.4 mm.
    Inch,
}

impl Unit {
    /// All units.
    pub const ALL: [Unit; 4] = [Unit::Millimetre, Unit::Centimetre, Unit::Metre, Unit::Inch];

    /// The name in flags and files: mm, cm, m, in.
    pub fn name(self) -> &'static str {
        match self {
            Unit::Millimetre => "mm",
            Unit::Centimetre => "cm",
            Unit::Metre => "m",
            Unit::Inch => "in",
        }
    }

    /// The unit called `name`.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|unit| unit.name() == name)
    }

    /// Millimetres in one unit.
    pub fn millimetres(self) -> f64 {
        match self {
            Unit::Millimetre => 1.0,
            Unit::Centimetre => 10.0,
            Unit::Metre => 1000.0,
            Unit::Inch => 25.4,
        }
    }
}

/// Which axis of the file points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum UpAxis {
    /// y is up: (x, y, z) of the file becomes (x, -z, y) of the world.
    Y,
    /// z is up: coordinates are taken as they are.
    #[default]
    Z,
}

/// What a format prescribes about its coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Placement {
    /// The unit of length.
    pub unit: Unit,
    /// The axis that points up.
    pub up: UpAxis,
}

/// Faces of one object in file order, in flat arrays. A face is an outer
/// ring and any number of hole rings; a ring is a cycle of vertex numbers
/// (the first is not repeated at its end).
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Faces {
    corners: Vec<u32>,
    /// End of each ring in `corners`; empty while all faces are triangles.
    rings: Vec<u32>,
    /// End of each face in `rings`; empty while all faces are triangles.
    faces: Vec<u32>,
}

impl Faces {
    /// Triangles, three corners each.
    pub fn from_triangles(corners: Vec<u32>) -> Self {
        debug_assert!(corners.len().is_multiple_of(3));
        Faces { corners, ..Self::default() }
    }

    /// Appends a face: its outer ring, then its holes. Rings may have any
    /// number of corners; what is no polygon is set aside later and counted.
    pub fn push<'a>(&mut self, outer: &[u32], holes: impl IntoIterator<Item = &'a [u32]>) {
        let mut holes = holes.into_iter().peekable();
        if self.faces.is_empty() && outer.len() == 3 && holes.peek().is_none() {
            self.corners.extend_from_slice(outer);
            return;
        }
        if self.faces.is_empty() {
            let triangles = (self.corners.len() / 3) as u32;
            self.rings = (1..=triangles).map(|i| 3 * i).collect();
            self.faces = (1..=triangles).collect();
        }
        self.corners.extend_from_slice(outer);
        self.rings.push(self.corners.len() as u32);
        for hole in holes {
            self.corners.extend_from_slice(hole);
            self.rings.push(self.corners.len() as u32);
        }
        self.faces.push(self.rings.len() as u32);
    }

    /// The number of faces.
    pub fn len(&self) -> usize {
        if self.faces.is_empty() { self.corners.len() / 3 } else { self.faces.len() }
    }

    /// Whether there is no face.
    pub fn is_empty(&self) -> bool {
        self.corners.is_empty() && self.faces.is_empty()
    }

    /// The corners of all triangles, if every face is a plain triangle.
    pub fn as_triangles(&self) -> Option<&[u32]> {
        self.faces.is_empty().then_some(&*self.corners)
    }

    /// The corners of all rings of all faces, one after the other.
    pub fn corners(&self) -> &[u32] {
        &self.corners
    }

    /// Replaces every vertex number `i` by `number(i)`.
    pub fn renumber(&mut self, number: impl Fn(u32) -> u32) {
        for corner in &mut self.corners {
            *corner = number(*corner);
        }
    }

    /// The rings of face `face`, outer ring first.
    pub fn rings(&self, face: usize) -> impl ExactSizeIterator<Item = &[u32]> + Clone {
        let plain = self.faces.is_empty();
        let (first, end) = if plain {
            (face, face + 1)
        } else {
            (start_of(&self.faces, face), self.faces[face] as usize)
        };
        (first..end).map(move |ring| {
            if plain {
                &self.corners[3 * ring..3 * ring + 3]
            } else {
                &self.corners[start_of(&self.rings, ring)..self.rings[ring] as usize]
            }
        })
    }
}

/// Where item `index` begins in an array of ends.
fn start_of(ends: &[u32], index: usize) -> usize {
    if index == 0 { 0 } else { ends[index - 1] as usize }
}

/// One object of a file. Vertices are neither welded nor checked for use;
/// coordinates are finite.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Soup {
    /// The object's name, empty if the file gives none.
    pub name: String,
    /// Positions, exactly as the file says (f32 formats widened).
    pub vertices: Vec<DVec3>,
    /// Where vertex `i` stands in the file if that is not `i`: the numbers
    /// that a JSON drawing shows, counted from 0.
    pub vertex_numbers: Option<Vec<u32>>,
    /// How the positions were rounded when the file was written.
    pub precision: Precision,
    /// Faces in file order; indices into `vertices`, all in range.
    pub faces: Faces,
    /// Colour of each face, where the file gives colours.
    pub colors: Option<Vec<Option<Color>>>,
    /// Loose lines (OBJ `l`), one entry per segment; indices in range.
    pub lines: Vec<[u32; 2]>,
    /// Where the faces stand in the file.
    pub places: FacePlaces,
}

/// Moves the positions of all objects into one array; with the place where
/// those of each begin.
pub(super) fn take_positions(soups: &mut [Soup]) -> (Vec<DVec3>, Vec<u32>) {
    let (mut positions, mut starts) = (Vec::new(), Vec::with_capacity(soups.len()));
    for soup in soups {
        starts.push(positions.len() as u32);
        if positions.is_empty() {
            positions = std::mem::take(&mut soup.vertices);
        } else {
            positions.append(&mut soup.vertices);
        }
    }
    (positions, starts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_stay_flat_until_a_polygon_comes() {
        let mut faces = Faces::default();
        faces.push(&[0, 1, 2], []);
        assert!(faces.as_triangles().is_some());
        faces.push(&[0, 1, 2, 3], [&[4u32, 5, 6][..]]);
        assert_eq!(faces.len(), 2);
        let first: Vec<_> = faces.rings(0).collect();
        let second: Vec<_> = faces.rings(1).collect();
        assert_eq!(first, [&[0, 1, 2][..]]);
        assert_eq!(second, [&[0, 1, 2, 3][..], &[4, 5, 6][..]]);
    }
}
