//! Tells of faces whose outlines cross themselves, by face and line.

use crate::session::RunFlags;
use umriss::model::{FacePlace, Mesh};

/// Faces that are told one by one; the rest is told as a number.
const MOST: usize = 10;

/// Notes the crossed faces of a mesh. `line_of` finds the line of a face of a
/// file, where its reader did not note it.
pub(crate) fn tell(
    mesh: &Mesh,
    session: &RunFlags,
    line_of: impl Fn(&str, FacePlace) -> Option<u64>,
) {
    let crossed = mesh.crossed_faces();
    for &face in crossed.iter().take(MOST) {
        let (object, place) = mesh.place_of_face(face);
        let file = &object.places.file;
        let prefix = if file.is_empty() { String::new() } else { format!("{file}: ") };
        let line = match place.line.or_else(|| line_of(file, place)) {
            Some(line) => format!(" (line {line})"),
            None => String::new(),
        };
        session.note(&format!("{prefix}face {}{line} crosses itself", place.number));
    }
    if crossed.len() > MOST {
        session.note(&format!("{} more faces cross themselves", crossed.len() - MOST));
    }
}
