//! glTF 2.0 (Khronos Group, 2017; ISO/IEC 12113:2022), as JSON or as GLB.
//!
//! A glTF file is a document (JSON) and buffers (bytes). serde_json turns what
//! is drawn of the document into types, and passes over all else. There is a
//! good crate, gltf; it does not stand here because it reads a document whole:
//! a material, an animation or a note (`extras`) of a form that it does not
//! know makes it refuse the shape. Here every reference is looked up with a
//! check, every accessor is measured against its buffer before anything is
//! allocated, and an error names the place in the JSON that is wrong.
//!
//! Each node with a mesh becomes an object, or several if it has instances.
//! Morph targets are applied with the weights that the file gives. The
//! transforms from the root down are composed in f64 and applied once. The
//! hierarchy is walked with a stack of its own; a node that is met twice is an
//! error, so cycles end. Nodes may share meshes, so a small file may be a large
//! model: [`budget`] bounds it.

mod accessors;
mod budget;
mod buffers;
mod container;
mod document;
mod extensions;
mod files;
mod instances;
mod meshes;
mod names;
mod scenes;

use glam::{DMat4, DVec3};

use self::budget::Budget;
use self::container::Document;
use self::document::{Natural, Node};
use self::instances::{instances, transform};
use self::names::Names;
use super::super::{Precision, Soup};
use super::Found;
use super::error::Read;
use super::json_places::Step;
use crate::run::Run;
use files::Surroundings;
use std::path::Path;

/// Reads a glTF or GLB file; see [`Surroundings`].
pub(super) fn read(
    bytes: &[u8],
    folder: Option<&Path>,
    allow_outside: bool,
    run: &Run<'_>,
) -> Read<Found> {
    let surroundings = Surroundings { folder, allow_outside };
    let mut warnings = Vec::new();
    let document = Document::open(bytes, surroundings, run, &mut warnings)?;
    extensions::check(&document, &mut warnings)?;
    let objects = scenes::draw_first_with_a_shape(&document, &mut warnings)?;
    Ok(Found { objects, warnings })
}

/// The objects of all nodes below some roots.
fn objects_below(
    document: &Document<'_>,
    roots: Vec<usize>,
    warnings: &mut Vec<String>,
) -> Read<Vec<Soup>> {
    let mut walk = Walk {
        document,
        budget: Budget::within(document.run),
        warnings,
        objects: Vec::new(),
        names: Names::default(),
    };
    let mut stack: Vec<(usize, DMat4)> = Vec::new();
    let mut met = vec![false; document.root.nodes.len()];
    push_reversed(&mut stack, roots, DMat4::IDENTITY);
    while let Some((number, above)) = stack.pop() {
        let path = [Step::Key("nodes"), Step::Item(number)];
        let node = &document.root.nodes[number];
        if std::mem::replace(&mut met[number], true) {
            let message = format!("node {number} is met twice, expected a tree of nodes");
            return Err(document.fault(&path, message));
        }
        let visibility = node.extensions.visibility.as_ref();
        if visibility.and_then(|visibility| visibility.visible) == Some(false) {
            continue;
        }
        let world = above * transform(document, node, number, walk.warnings)?;
        if let Some(mesh) = node.mesh {
            walk.mesh(number, node, mesh, world)?;
        }
        let children = nodes(document, &node.children, &[path[0], path[1], Step::Key("children")])?;
        push_reversed(&mut stack, children, world);
    }
    let Walk { mut objects, names, .. } = walk;
    names.give(document, &mut objects);
    Ok(objects)
}

fn push_reversed(stack: &mut Vec<(usize, DMat4)>, nodes: Vec<usize>, above: DMat4) {
    stack.extend(nodes.into_iter().rev().map(|node| (node, above)));
}

/// Numbers of nodes that exist; `list` is where they stand in the document.
fn nodes(document: &Document<'_>, numbers: &[Natural], list: &[Step<'_>]) -> Read<Vec<usize>> {
    let count = document.root.nodes.len();
    let check = |(item, number): (usize, &Natural)| match number.index() {
        node if node < count => Ok(node),
        _ => {
            let path = [list, &[Step::Item(item)]].concat();
            let message = format!("node {} does not exist, expected less than {count}", number.0);
            Err(document.fault(&path, message))
        }
    };
    numbers.iter().enumerate().map(check).collect()
}

/// What is made on the way through a tree of nodes.
struct Walk<'a, 'd> {
    document: &'a Document<'d>,
    budget: Budget<'d>,
    warnings: &'a mut Vec<String>,
    objects: Vec<Soup>,
    names: Names,
}

impl Walk<'_, '_> {
    /// Adds the mesh of a node, once for each of its instances.
    fn mesh(&mut self, number: usize, node: &Node, mesh: Natural, world: DMat4) -> Read<()> {
        let (document, path) = (self.document, [Step::Key("nodes"), Step::Item(number)]);
        let (mesh, count) = (mesh.index(), document.root.meshes.len());
        if count <= mesh {
            let message = format!("mesh {mesh} does not exist, expected less than {count}");
            return Err(document.fault(&[path[0], path[1], Step::Key("mesh")], message));
        }
        let object = meshes::object(document, node, mesh, &mut self.budget, self.warnings)?;
        let size = 1 + object.vertices.len() + object.faces.corners().len() + object.lines.len();
        let transforms = instances(document, node, number, self.warnings)?;
        for (instance, transform) in transforms.into_iter().enumerate() {
            if 0 < instance {
                let spent = self.budget.spend(size as u64);
                spent.map_err(|message| document.fault(&path, message))?;
            }
            let mut object = object.clone();
            object.precision = precision(&object.vertices, world * transform);
            place(&mut object.vertices, world * transform).map_err(|vertex| {
                document.fault(&path, format!(
                    "vertex {vertex} of node {number} is not finite, expected a smaller transform"
                ))
            })?;
            self.names.note(number, mesh, document);
            self.objects.push(object);
        }
        Ok(())
    }
}

/// How the vertices of a mesh, which are narrow floats, are rounded once they
/// are in the world.
fn precision(vertices: &[DVec3], world: DMat4) -> Precision {
    if world == DMat4::IDENTITY {
        return Precision::Float32;
    }
    let [x, y, z] = [world.x_axis, world.y_axis, world.z_axis].map(|axis| axis.truncate().length());
    let distance = world.w_axis.truncate().abs().max_element();
    Precision::of_placed(vertices, x.max(y).max(z), distance)
}

/// Moves vertices into the world; the error is the first that is no longer
/// finite.
fn place(vertices: &mut [DVec3], world: DMat4) -> Result<(), usize> {
    if world == DMat4::IDENTITY {
        return Ok(());
    }
    for (number, vertex) in vertices.iter_mut().enumerate() {
        *vertex = world.transform_point3(*vertex);
        if !vertex.is_finite() {
            return Err(number);
        }
    }
    Ok(())
}
