//! Objects that share the vertices of their file, each given its own.

use glam::DVec3;

use super::super::{Color, FacePlaces, Faces, Soup};

/// An object whose faces and lines still number the vertices of the file.
#[derive(Debug, Default)]
pub(super) struct Part {
    pub(super) name: String,
    pub(super) faces: Faces,
    pub(super) colors: Option<Vec<Option<Color>>>,
    pub(super) lines: Vec<[u32; 2]>,
    pub(super) places: FacePlaces,
}

/// Gives each part the vertices it uses, in file order. A single part, or
/// none, keeps all vertices of the file as they are. All numbers must be in
/// range. O(vertices + corners log corners).
pub(super) fn split(vertices: Vec<DVec3>, mut parts: Vec<Part>) -> Vec<Soup> {
    if parts.len() <= 1 {
        let Part { name, faces, colors, lines, places } = parts.pop().unwrap_or_default();
        return vec![Soup { name, vertices, faces, colors, lines, places, ..Soup::default() }];
    }
    // Where a vertex of the file stands in the part at hand.
    let mut places = vec![UNUSED; vertices.len()];
    parts.into_iter().map(|part| cut_out(&vertices, part, &mut places)).collect()
}

const UNUSED: u32 = u32::MAX;

fn cut_out(vertices: &[DVec3], part: Part, places: &mut [u32]) -> Soup {
    let Part { name, mut faces, colors, mut lines, places: face_places } = part;
    let mut numbers = Vec::new();
    for &number in faces.corners().iter().chain(lines.as_flattened()) {
        if places[number as usize] == UNUSED {
            places[number as usize] = 0;
            numbers.push(number);
        }
    }
    numbers.sort_unstable();
    for (place, &number) in numbers.iter().enumerate() {
        places[number as usize] = place as u32;
    }
    faces.renumber(|number| places[number as usize]);
    for number in lines.as_flattened_mut() {
        *number = places[*number as usize];
    }
    for &number in &numbers {
        places[number as usize] = UNUSED;
    }
    let vertices = numbers.iter().map(|&number| vertices[number as usize]).collect();
    let (vertex_numbers, places) = (Some(numbers), face_places);
    Soup { name, vertices, vertex_numbers, faces, colors, lines, places, ..Soup::default() }
}

/// References to vertices that may still follow in the file. Only numbers
/// larger than all before them are kept: no other can be the first that is
/// out of range.
#[derive(Debug, Default)]
pub(super) struct ForwardReferences {
    /// (place in the file, vertex number counted from 0)
    rising: Vec<(u64, u64)>,
}

impl ForwardReferences {
    /// Notes that vertex `number` is wanted at `place`.
    pub(super) fn note(&mut self, place: u64, number: u64) {
        if self.rising.last().is_none_or(|&(_, last)| last < number) {
            self.rising.push((place, number));
        }
    }

    /// The first reference that `count` vertices do not satisfy.
    pub(super) fn first_beyond(&self, count: u64) -> Option<(u64, u64)> {
        self.rising.iter().copied().find(|&(_, number)| count <= number)
    }
}
