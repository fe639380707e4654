//! Objects by their coordinates.

use glam::DVec3;
use umriss::model::Soup;

/// An object of polygons and loose lines, every corner a vertex of its own;
/// the mesh welds them.
pub(crate) fn polygons<F: AsRef<[DVec3]>>(faces: &[F], lines: &[[DVec3; 2]]) -> Soup {
    let mut soup = Soup::default();
    for face in faces {
        let first = soup.vertices.len() as u32;
        soup.vertices.extend_from_slice(face.as_ref());
        let ring: Vec<u32> = (first..soup.vertices.len() as u32).collect();
        soup.faces.push(&ring, []);
    }
    for line in lines {
        let first = soup.vertices.len() as u32;
        soup.vertices.extend_from_slice(line);
        soup.lines.push([first, first + 1]);
    }
    soup
}

/// The six rectangles of a box, seen counter-clockwise from outside.
pub(crate) fn cuboid(low: DVec3, high: DVec3) -> Vec<Vec<DVec3>> {
    let corner = |i: usize| {
        DVec3::new(
            if i & 1 == 0 { low.x } else { high.x },
            if i & 2 == 0 { low.y } else { high.y },
            if i & 4 == 0 { low.z } else { high.z },
        )
    };
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
        .map(|face| face.map(corner).to_vec())
        .to_vec()
}
