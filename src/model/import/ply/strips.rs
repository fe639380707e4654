//! Strips of triangles: each vertex makes one with the two before it.

use super::super::super::Faces;

/// What begins another strip.
pub(super) const RESTART: u32 = u32::MAX;

/// Adds the triangles of strips. Every second one is turned, so that all of a
/// strip have the winding of its first. A vertex that is repeated makes no
/// triangle: that is how strips turn round a corner.
pub(super) fn add_strips(faces: &mut Faces, vertices: &[u32]) {
    for strip in vertices.split(|&vertex| vertex == RESTART) {
        for (number, window) in strip.windows(3).enumerate() {
            let odd = number % 2;
            let [a, b, c] = [window[0], window[1 + odd], window[2 - odd]];
            if a != b && b != c && c != a {
                faces.push(&[a, b, c], []);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_turn_every_second_triangle_and_begin_again() {
        let mut faces = Faces::default();
        add_strips(&mut faces, &[0, 1, 2, 3, RESTART, 7, 6, 6, 5, 4, RESTART, RESTART, 1, 2]);
        assert_eq!(faces.as_triangles(), Some(&[0, 1, 2, 1, 3, 2, 6, 5, 4][..]));
    }
}
