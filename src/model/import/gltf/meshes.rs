//! The object that a node with a mesh makes, in the mesh's own coordinates.

use ::gltf::Semantic;
use ::gltf::json::mesh::{Mode, Primitive};
use ::gltf::json::validation::Checked;
use glam::DVec3;
use rustc_hash::FxHashMap;

use super::super::super::{Faces, Soup};
use super::super::error::Read;
use super::super::json_places::Step;
use super::container::Document;

/// All primitives of the node's mesh as one object. Primitives that use the
/// same positions share their vertices.
pub(super) fn object(
    document: &Document<'_>,
    node_number: usize,
    budget: &mut usize,
    warnings: &mut Vec<String>,
) -> Read<Soup> {
    let node = &document.root.nodes[node_number];
    let number = node.mesh.map_or(0, |mesh| mesh.value());
    let Some(mesh) = document.root.meshes.get(number) else {
        let path = [Step::Key("nodes"), Step::Item(node_number), Step::Key("mesh")];
        let count = document.root.meshes.len();
        let message = format!("mesh {number} does not exist, expected less than {count}");
        return Err(document.fault(&path, message));
    };
    let name = node.name.as_ref().or(mesh.name.as_ref()).cloned().unwrap_or_default();
    let mut builder = Builder {
        document,
        mesh: number,
        budget,
        warnings,
        bases: FxHashMap::default(),
        vertices: Vec::new(),
        triangles: Vec::new(),
        lines: Vec::new(),
    };
    if node.skin.is_some() {
        builder.warn("skins are ignored: the mesh stands in its rest position");
    }
    for (item, primitive) in mesh.primitives.iter().enumerate() {
        builder.primitive(item, primitive)?;
    }
    let Builder { vertices, triangles, lines, .. } = builder;
    let faces = Faces::from_triangles(triangles);
    Ok(Soup { name, vertices, faces, lines, ..Soup::default() })
}

struct Builder<'a, 'b> {
    document: &'a Document<'b>,
    mesh: usize,
    budget: &'a mut usize,
    warnings: &'a mut Vec<String>,
    /// First vertex and number of vertices for each accessor of positions.
    bases: FxHashMap<usize, (u32, u32)>,
    vertices: Vec<DVec3>,
    triangles: Vec<u32>,
    lines: Vec<[u32; 2]>,
}

impl Builder<'_, '_> {
    fn primitive(&mut self, item: usize, primitive: &Primitive) -> Read<()> {
        let path =
            [Step::Key("meshes"), Step::Item(self.mesh), Step::Key("primitives"), Step::Item(item)];
        self.spend(1, &path)?;
        let Checked::Valid(mode) = primitive.mode else {
            let path = [&path[..], &[Step::Key("mode")]].concat();
            return Err(self.document.fault(&path, "an unknown mode, expected 0 to 6"));
        };
        if mode == Mode::Points {
            self.warn("points are ignored");
            return Ok(());
        }
        let Some(positions) = primitive.attributes.get(&Checked::Valid(Semantic::Positions)) else {
            self.warn("primitives without positions are ignored");
            return Ok(());
        };
        let (base, count) = self.positions(positions.value(), &path)?;
        let corners = match primitive.indices {
            Some(indices) => self.indices(indices.value(), base, count, &path)?,
            None => {
                self.spend(u64::from(count), &path)?;
                (base..base + count).collect()
            }
        };
        self.connect(mode, &corners, &path)
    }

    /// First vertex and number of the vertices of an accessor.
    fn positions(&mut self, accessor: usize, path: &[Step<'_>; 4]) -> Read<(u32, u32)> {
        if let Some(&range) = self.bases.get(&accessor) {
            return Ok(range);
        }
        let user = [&path[..], &[Step::Key("attributes"), Step::Key("POSITION")]].concat();
        let positions = self.document.elements::<3>(accessor, &user)?;
        self.spend(positions.len() as u64, path)?;
        if let Some(wrong) = positions.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
            let path = [Step::Key("accessors"), Step::Item(accessor)];
            let message = format!("position {wrong} is not finite, expected finite numbers");
            return Err(self.document.fault(&path, message));
        }
        // The budget keeps both numbers far below 32 bits.
        let range = (self.vertices.len() as u32, positions.len() as u32);
        self.vertices.extend(positions.into_iter().map(DVec3::from_array));
        self.bases.insert(accessor, range);
        Ok(range)
    }

    fn indices(
        &mut self,
        accessor: usize,
        base: u32,
        count: u32,
        path: &[Step<'_>; 4],
    ) -> Read<Vec<u32>> {
        let user = [&path[..], &[Step::Key("indices")]].concat();
        let indices = self.document.elements::<1>(accessor, &user)?;
        self.spend(indices.len() as u64, path)?;
        let mut corners = Vec::with_capacity(indices.len());
        for [index] in indices {
            if f64::from(count) <= index {
                let path = [Step::Key("accessors"), Step::Item(accessor)];
                let message = format!("vertex {index} does not exist, expected less than {count}");
                return Err(self.document.fault(&path, message));
            }
            corners.push(base + index as u32);
        }
        Ok(corners)
    }

    /// Makes triangles or lines of the corners as the mode says.
    fn connect(&mut self, mode: Mode, corners: &[u32], path: &[Step<'_>; 4]) -> Read<()> {
        let of = match mode {
            Mode::Triangles => 3,
            Mode::Lines => 2,
            _ => 1,
        };
        if !corners.len().is_multiple_of(of) {
            let message = format!("{} corners, expected a multiple of {of}", corners.len());
            return Err(self.document.fault(path, message));
        }
        // Strips and fans have up to three corners for each one that is listed.
        self.spend(2 * corners.len() as u64, path)?;
        match mode {
            Mode::Triangles => self.triangles.extend_from_slice(corners),
            Mode::TriangleStrip => {
                for (number, triangle) in corners.windows(3).enumerate() {
                    let odd = number % 2;
                    let [a, b, c] = [triangle[0], triangle[1 + odd], triangle[2 - odd]];
                    self.triangles.extend([a, b, c]);
                }
            }
            Mode::TriangleFan => {
                for pair in corners.get(1..).unwrap_or_default().windows(2) {
                    self.triangles.extend([corners[0], pair[0], pair[1]]);
                }
            }
            Mode::Lines => {
                self.lines.extend(corners.chunks_exact(2).map(|ends| [ends[0], ends[1]]));
            }
            Mode::LineStrip | Mode::LineLoop => {
                self.lines.extend(corners.windows(2).map(|ends| [ends[0], ends[1]]));
                if let (Mode::LineLoop, [first, _, .., last]) = (mode, corners) {
                    self.lines.push([*last, *first]);
                }
            }
            Mode::Points => {}
        }
        Ok(())
    }

    fn spend(&mut self, cost: u64, path: &[Step<'_>; 4]) -> Read<()> {
        match usize::try_from(cost).ok().and_then(|cost| self.budget.checked_sub(cost)) {
            Some(left) => {
                *self.budget = left;
                Ok(())
            }
            None => {
                let most = super::MOST;
                let message = format!("too many vertices and corners, expected {most} in all");
                Err(self.document.fault(path, message))
            }
        }
    }

    fn warn(&mut self, warning: &str) {
        if !self.warnings.iter().any(|known| known == warning) {
            self.warnings.push(warning.to_owned());
        }
    }
}
