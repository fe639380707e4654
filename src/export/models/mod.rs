//! Models as files, for what was healed here and is drawn or worked on
//! elsewhere.
//!
//! What was made equal stays so: vertices of equal places are written once,
//! with all digits of their doubles (STL alone has narrow floats). Faces keep
//! their corners and order; those that have no three corners any more are left
//! out. What a format has no place for is told.

mod json;
mod ply;
mod stl;
mod text;

use super::ExportError;
use crate::model::import::Format;
use crate::model::{Color, Soup};
use glam::DVec3;
use rustc_hash::FxHashMap;

/// A model as the bytes of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ModelFile {
    /// The bytes.
    pub bytes: Vec<u8>,
    /// What the format has no place for.
    pub left_out: Vec<&'static str>,
}

/// Writes the objects of a model, their coordinates as they are. O(n).
///
/// # Errors
///
/// For glTF, which is not written; for faces with holes as OBJ, OFF or PLY; for
/// coordinates that are not finite as JSON.
///
/// ```
/// use umriss::export::write_model;
/// use umriss::model::import::{Format, read_bytes};
///
/// let off = b"OFF\n4 1 0\n0 0 0\n9 0 0\n9 9 0\n0 9 0\n4 0 1 2 3\n";
/// let read = read_bytes("square.off", off, None)?;
/// let file = write_model(&read.objects, Format::Obj)?;
/// assert!(file.bytes.ends_with(b"f 1 2 3 4\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_model(objects: &[Soup], format: Format) -> Result<ModelFile, ExportError> {
    let model = Model::of(objects);
    let whole = matches!(format, Format::Obj | Format::Off | Format::Ply);
    if whole && model.faces.iter().any(|face| face.rings.len() > 1) {
        return Err(ExportError::Holes(format.name()));
    }
    let bytes = match format {
        Format::Obj => text::obj(&model),
        Format::Off => text::off(&model),
        Format::Ply => ply::write(&model),
        Format::Stl => stl::write(objects)?,
        Format::Gltf => return Err(ExportError::ModelFormat(format.name().to_owned())),
        Format::PolygonScene => json::write(&model)?,
    };
    let holds = |formats: &[Format]| formats.contains(&format);
    let several = objects.len() > 1;
    let lines = objects.iter().any(|object| !object.lines.is_empty());
    let colors = model.faces.iter().any(|face| face.color.is_some());
    let left_out = [
        (several && !holds(&[Format::Obj, Format::PolygonScene]), "the names of objects"),
        (lines && !holds(&[Format::Obj]), "loose lines"),
        (colors && !holds(&[Format::Ply, Format::PolygonScene]), "colours"),
    ];
    let left_out = left_out.into_iter().filter(|(is_so, _)| *is_so).map(|(_, name)| name);
    Ok(ModelFile { bytes, left_out: left_out.collect() })
}

/// The objects of a model over one list of vertices.
struct Model<'a> {
    objects: &'a [Soup],
    vertices: Vec<DVec3>,
    faces: Vec<Face>,
    /// Of each object: the end of its faces, and its loose lines.
    parts: Vec<(usize, Vec<[u32; 2]>)>,
}

/// A face that has an area, perhaps.
struct Face {
    /// The outer ring, then holes.
    rings: Vec<Vec<u32>>,
    color: Option<Color>,
}

impl<'a> Model<'a> {
    fn of(objects: &'a [Soup]) -> Self {
        let mut model =
            Model { objects, vertices: Vec::new(), faces: Vec::new(), parts: Vec::new() };
        let mut numbers = FxHashMap::default();
        for object in objects {
            let mut number = |corner: u32| {
                let vertex = object.vertices[corner as usize];
                // Zeros of both signs are one number.
                let place = (vertex + DVec3::ZERO).to_array().map(f64::to_bits);
                *numbers.entry(place).or_insert_with(|| {
                    model.vertices.push(vertex + DVec3::ZERO);
                    model.vertices.len() as u32 - 1
                })
            };
            for face in 0..object.faces.len() {
                let rings = object.faces.rings(face).map(|ring| {
                    let mut ring: Vec<u32> = ring.iter().map(|&corner| number(corner)).collect();
                    ring.dedup();
                    while ring.len() > 1 && ring.first() == ring.last() {
                        ring.pop();
                    }
                    ring
                });
                let mut rings = rings.collect::<Vec<_>>();
                if rings[0].len() < 3 {
                    continue;
                }
                rings.retain(|ring| ring.len() > 2);
                let color = object.colors.as_ref().and_then(|colors| colors[face]);
                model.faces.push(Face { rings, color });
            }
            let lines = object.lines.iter().map(|ends| ends.map(&mut number)).collect();
            model.parts.push((model.faces.len(), lines));
        }
        model
    }
}

#[cfg(test)]
mod tests;
