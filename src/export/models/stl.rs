//! Binary STL: triangles, in narrow floats.

use super::ExportError;
use crate::model::{Mesh, Soup};
use glam::DVec3;

/// Bytes before the number of triangles.
const HEADER: &[u8; 80] = &[b' '; 80];

pub(super) fn write(objects: &[Soup]) -> Result<Vec<u8>, ExportError> {
    // Polygons are triangulated as they are for drawing.
    let mesh = Mesh::new(objects.to_vec(), None)?;
    let mut bytes = HEADER.to_vec();
    bytes.extend((mesh.triangles().len() as u32).to_le_bytes());
    for corners in mesh.triangles() {
        let places = corners.map(|corner| mesh.vertices()[corner as usize]);
        let [a, b, c] = places;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        for place in [normal].into_iter().chain(places) {
            bytes.extend(narrow(place).into_iter().flat_map(f32::to_le_bytes));
        }
        bytes.extend([0; 2]);
    }
    Ok(bytes)
}

fn narrow(place: DVec3) -> [f32; 3] {
    place.to_array().map(|number| number as f32)
}
