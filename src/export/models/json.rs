//! The polygon scene: polygons with holes, colours and objects.

use super::{ExportError, Model};
use serde::Serialize;

#[derive(Serialize)]
struct SceneFile<'a> {
    vertices: Vec<[f64; 3]>,
    faces: Vec<FaceFile<'a>>,
}

#[derive(Serialize)]
struct FaceFile<'a> {
    outer: &'a [u32],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    holes: &'a [Vec<u32>],
    #[serde(skip_serializing_if = "Option::is_none")]
    color: Option<String>,
    #[serde(skip_serializing_if = "str::is_empty")]
    object: &'a str,
}

pub(super) fn write(model: &Model<'_>) -> Result<Vec<u8>, ExportError> {
    if let Some(index) = model.vertices.iter().position(|vertex| !vertex.is_finite()) {
        return Err(ExportError::NotFiniteVertex(index));
    }
    let mut start = 0;
    let mut faces = Vec::with_capacity(model.faces.len());
    for (object, &(end, _)) in model.objects.iter().zip(&model.parts) {
        faces.extend(model.faces[start..end].iter().map(|face| FaceFile {
            outer: &face.rings[0],
            holes: &face.rings[1..],
            color: face.color.map(|color| {
                let [r, g, b] = color.0;
                format!("#{r:02x}{g:02x}{b:02x}")
            }),
            object: &object.name,
        }));
        start = end;
    }
    let vertices = model.vertices.iter().map(|vertex| vertex.to_array()).collect();
    // Lists of numbers and strings always have a JSON.
    let mut bytes = serde_json::to_vec(&SceneFile { vertices, faces }).unwrap_or_default();
    bytes.push(b'\n');
    Ok(bytes)
}
