//! The object that a node with a mesh makes, in the mesh's own coordinates.

use glam::DVec3;
use rustc_hash::FxHashMap;

use super::super::super::{Faces, Soup};
use super::super::error::Read;
use super::super::json_places::Step;
use super::budget::Budget;
use super::container::Document;
use super::document::{Attributes, Natural, Node, Primitive};
use super::extensions::tell;

/// How a primitive's corners are connected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mode {
    Points,
    Lines,
    LineLoop,
    LineStrip,
    Triangles,
    TriangleStrip,
    TriangleFan,
}

impl Mode {
    /// The mode of a number of OpenGL: triangles, if none is given.
    fn of(number: Option<Natural>) -> Option<Self> {
        Some(match number.map_or(4, |number| number.0) {
            0 => Mode::Points,
            1 => Mode::Lines,
            2 => Mode::LineLoop,
            3 => Mode::LineStrip,
            4 => Mode::Triangles,
            5 => Mode::TriangleStrip,
            6 => Mode::TriangleFan,
            _ => return None,
        })
    }
}

/// All primitives of a node's mesh as one object without a name. Primitives
/// that use the same positions share their vertices.
pub(super) fn object(
    document: &Document<'_>,
    node: &Node,
    mesh: usize,
    budget: &mut Budget<'_>,
    warnings: &mut Vec<String>,
) -> Read<Soup> {
    // The caller has looked the mesh up.
    let found = &document.root.meshes[mesh];
    let mut builder = Builder {
        document,
        mesh,
        weights: node.weights.as_deref().unwrap_or(&found.weights),
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
    for (item, primitive) in found.primitives.iter().enumerate() {
        builder.primitive(item, primitive)?;
    }
    let Builder { vertices, triangles, lines, .. } = builder;
    let faces = Faces::from_triangles(triangles);
    Ok(Soup { vertices, faces, lines, ..Soup::default() })
}

/// Accessors that give the same vertices: one of positions, and those of the
/// morph targets that move them, each with its place among the targets.
type Shape = (usize, Vec<(usize, usize)>);

struct Builder<'a, 'd, 'r> {
    document: &'a Document<'d>,
    mesh: usize,
    /// How far each morph target is put into effect.
    weights: &'a [f32],
    budget: &'a mut Budget<'r>,
    warnings: &'a mut Vec<String>,
    /// First vertex and number of vertices for each shape.
    bases: FxHashMap<Shape, (u32, u32)>,
    vertices: Vec<DVec3>,
    triangles: Vec<u32>,
    lines: Vec<[u32; 2]>,
}

impl Builder<'_, '_, '_> {
    fn primitive(&mut self, item: usize, primitive: &Primitive) -> Read<()> {
        let path =
            [Step::Key("meshes"), Step::Item(self.mesh), Step::Key("primitives"), Step::Item(item)];
        self.spend(1, &path)?;
        let Some(mode) = Mode::of(primitive.mode) else {
            let path = [&path[..], &[Step::Key("mode")]].concat();
            return Err(self.document.fault(&path, "an unknown mode, expected 0 to 6"));
        };
        if mode == Mode::Points {
            self.warn("points are ignored");
            return Ok(());
        }
        let Some(positions) = primitive.attributes.position else {
            self.warn("primitives without positions are ignored");
            return Ok(());
        };
        self.check_compression(primitive, positions.index(), &path)?;
        let (base, count) = self.positions(positions.index(), &primitive.targets, &path)?;
        let corners = match primitive.indices {
            Some(indices) => self.indices(indices.index(), base, count, &path)?,
            None => {
                self.spend(u64::from(count), &path)?;
                (base..base + count).collect()
            }
        };
        self.connect(mode, &corners, &path)
    }

    /// A compressed primitive can only be read if its accessors have bytes of
    /// their own too.
    fn check_compression(
        &self,
        primitive: &Primitive,
        positions: usize,
        path: &[Step<'_>; 4],
    ) -> Read<()> {
        if primitive.extensions.draco.is_none() {
            return Ok(());
        }
        for number in [Some(positions), primitive.indices.map(Natural::index)].into_iter().flatten()
        {
            let accessor = self.document.accessor(number, path)?;
            if accessor.buffer_view.is_none() {
                let name = "KHR_draco_mesh_compression";
                let path = [&path[..], &[Step::Key("extensions"), Step::Key(name)]].concat();
                let message = format!("the mesh is compressed by {name}, expected one that is not");
                return Err(self.document.fault(&path, message));
            }
        }
        Ok(())
    }

    /// First vertex and number of the vertices of an accessor, moved by the
    /// morph targets that have a weight.
    fn positions(
        &mut self,
        accessor: usize,
        targets: &[Attributes],
        path: &[Step<'_>; 4],
    ) -> Read<(u32, u32)> {
        let moving = targets.iter().zip(self.weights).enumerate().filter_map(|(item, (to, &w))| {
            to.position.filter(|_| w != 0.0).map(|position| (item, position.index()))
        });
        let shape: Shape = (accessor, moving.collect());
        if let Some(&range) = self.bases.get(&shape) {
            return Ok(range);
        }
        let user = [&path[..], &[Step::Key("attributes"), Step::Key("POSITION")]].concat();
        let mut positions = self.document.elements::<3>(accessor, &user)?;
        self.spend(positions.len() as u64, path)?;
        for &(item, target) in &shape.1 {
            self.morph(&mut positions, item, target, path)?;
        }
        if let Some(wrong) = positions.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
            let path = [Step::Key("accessors"), Step::Item(accessor)];
            let message = format!("position {wrong} is not finite, expected finite numbers");
            return Err(self.document.fault(&path, message));
        }
        // The budget keeps both numbers far below 32 bits.
        let range = (self.vertices.len() as u32, positions.len() as u32);
        self.vertices.extend(positions.into_iter().map(DVec3::from_array));
        self.bases.insert(shape, range);
        Ok(range)
    }

    /// Moves positions as one morph target says, by its weight. Products are
    /// exact; sums are rounded, one after the other.
    fn morph(
        &mut self,
        positions: &mut [[f64; 3]],
        item: usize,
        target: usize,
        path: &[Step<'_>; 4],
    ) -> Read<()> {
        let steps = [Step::Key("targets"), Step::Item(item), Step::Key("POSITION")];
        let user = [&path[..], &steps].concat();
        let moves = self.document.elements::<3>(target, &user)?;
        self.spend(moves.len() as u64, path)?;
        if moves.len() != positions.len() {
            let (found, expected) = (moves.len(), positions.len());
            let message = format!("a morph target of {found} positions, expected {expected}");
            return Err(self.document.fault(&user, message));
        }
        let weight = f64::from(self.weights[item]);
        for (position, by) in positions.iter_mut().zip(moves) {
            for (x, by) in position.iter_mut().zip(by) {
                *x += weight * by;
            }
        }
        Ok(())
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
        self.budget.spend(cost).map_err(|message| self.document.fault(path, message))
    }

    fn warn(&mut self, warning: &str) {
        tell(self.warnings, warning.to_owned());
    }
}
