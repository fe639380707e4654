//! PLY, binary, in doubles.

use super::Model;

pub(super) fn write(model: &Model<'_>) -> Vec<u8> {
    let colored = model.faces.iter().any(|face| face.color.is_some());
    let colors = match colored {
        true => "property uchar red\nproperty uchar green\nproperty uchar blue\n",
        false => "",
    };
    let header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\n\
         property double y\nproperty double z\nelement face {}\n\
         property list uint int vertex_indices\n{colors}end_header\n",
        model.vertices.len(),
        model.faces.len()
    );
    let mut bytes = header.into_bytes();
    for vertex in &model.vertices {
        vertex.to_array().iter().for_each(|number| bytes.extend(number.to_le_bytes()));
    }
    for face in &model.faces {
        let ring = &face.rings[0];
        bytes.extend((ring.len() as u32).to_le_bytes());
        ring.iter().for_each(|corner| bytes.extend(corner.to_le_bytes()));
        if colored {
            // Faces without a colour are white: all have one or none has.
            bytes.extend(face.color.map_or([0xff; 3], |color| color.0));
        }
    }
    bytes
}
