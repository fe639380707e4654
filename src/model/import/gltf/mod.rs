//! glTF 2.0 (Khronos Group, 2017; ISO/IEC 12113:2022), as JSON or as GLB.
//!
//! A glTF file is a document (JSON) and buffers (bytes). The crate gltf turns
//! the document into types; its own validation and accessors are not used,
//! because they panic on numbers that are out of range. Here every reference
//! is looked up with a check, every accessor is measured against its buffer
//! before anything is allocated, and an error names the place in the JSON
//! that is wrong.
//!
//! Each node with a mesh becomes an object. The transforms from the root down
//! are composed in f64 and applied once. The hierarchy is walked with a stack
//! of its own; a node that is met twice is an error, so cycles end. Nodes may
//! share meshes, so a small file may be a large model: [`MOST`] bounds it.

mod accessors;
mod buffers;
mod container;
mod meshes;

use std::path::Path;

use ::gltf::json::Node;
use glam::{DMat4, DQuat, DVec3};

use self::container::Document;
use super::super::Precision;
use super::Found;
use super::error::Read;
use super::json_places::Step;

/// The most vertices, corners and primitives that all objects may have
/// together: a limit for files whose nodes repeat a mesh without end.
const MOST: usize = 1 << 26;

/// Reads a glTF or GLB file. `folder` is where relative references lead;
/// without it they are refused.
pub(super) fn read(bytes: &[u8], folder: Option<&Path>) -> Read<Found> {
    let document = Document::open(bytes, folder)?;
    check_extensions(&document)?;
    let mut found = Found::default();
    let mut budget = MOST;
    let mut stack: Vec<(usize, DMat4)> = Vec::new();
    let mut met = vec![false; document.root.nodes.len()];
    push_reversed(&mut stack, roots(&document)?, DMat4::IDENTITY);
    while let Some((number, above)) = stack.pop() {
        let path = [Step::Key("nodes"), Step::Item(number)];
        let node = &document.root.nodes[number];
        if std::mem::replace(&mut met[number], true) {
            let message = format!("node {number} is met twice, expected a tree of nodes");
            return Err(document.fault(&path, message));
        }
        let world = above * transform(&document, node, number)?;
        if node.mesh.is_some() {
            let mut object = meshes::object(&document, number, &mut budget, &mut found.warnings)?;
            object.precision = precision(&object.vertices, world);
            place(&mut object.vertices, world).map_err(|vertex| {
                document.fault(&path, format!(
                    "vertex {vertex} of node {number} is not finite, expected a smaller transform"
                ))
            })?;
            found.objects.push(object);
        }
        let children: Vec<usize> =
            node.children.iter().flatten().map(|child| child.value()).collect();
        check_nodes(&document, &children, &[path[0], path[1], Step::Key("children")])?;
        push_reversed(&mut stack, children, world);
    }
    Ok(found)
}

fn push_reversed(stack: &mut Vec<(usize, DMat4)>, nodes: Vec<usize>, above: DMat4) {
    stack.extend(nodes.into_iter().rev().map(|node| (node, above)));
}

/// Extensions that do not change the shape may be required; others mean that
/// the shape is not to be had without them.
fn check_extensions(document: &Document<'_>) -> Read<()> {
    const HARMLESS: [&str; 5] =
        ["KHR_mesh_quantization", "KHR_materials_", "KHR_texture_", "KHR_lights_", "EXT_texture_"];
    for (item, name) in document.root.extensions_required.iter().enumerate() {
        if !HARMLESS.iter().any(|harmless| name.starts_with(harmless)) {
            let path = [Step::Key("extensionsRequired"), Step::Item(item)];
            let name = name.escape_default();
            let message = format!("the extension '{name}' is required, expected a file without it");
            return Err(document.fault(&path, message));
        }
    }
    Ok(())
}

/// The roots of the default scene, of the first scene, or, without scenes,
/// all nodes that are nobody's child.
fn roots(document: &Document<'_>) -> Read<Vec<usize>> {
    let root = &document.root;
    let number = root.scene.map_or(0, |scene| scene.value());
    if let Some(scene) = root.scenes.get(number) {
        let nodes: Vec<usize> = scene.nodes.iter().map(|node| node.value()).collect();
        let path = [Step::Key("scenes"), Step::Item(number), Step::Key("nodes")];
        check_nodes(document, &nodes, &path)?;
        return Ok(nodes);
    }
    if root.scene.is_some() {
        let message = format!("scene {number} does not exist, expected one of the scenes");
        return Err(document.fault(&[Step::Key("scene")], message));
    }
    let mut is_child = vec![false; root.nodes.len()];
    for child in root.nodes.iter().flat_map(|node| node.children.iter().flatten()) {
        if let Some(slot) = is_child.get_mut(child.value()) {
            *slot = true;
        }
    }
    let roots: Vec<usize> = (0..root.nodes.len()).filter(|&node| !is_child[node]).collect();
    if roots.is_empty() && !root.nodes.is_empty() {
        let message = "every node is the child of another, expected a tree of nodes";
        return Err(document.fault(&[Step::Key("nodes")], message));
    }
    Ok(roots)
}

fn check_nodes(document: &Document<'_>, nodes: &[usize], list: &[Step<'_>]) -> Read<()> {
    let count = document.root.nodes.len();
    for (item, &node) in nodes.iter().enumerate() {
        if count <= node {
            let mut path = list.to_vec();
            path.push(Step::Item(item));
            let message = format!("node {node} does not exist, expected less than {count}");
            return Err(document.fault(&path, message));
        }
    }
    Ok(())
}

/// The transform of one node, with a rotation of length 1 in f64.
fn transform(document: &Document<'_>, node: &Node, number: usize) -> Read<DMat4> {
    let wide = |numbers: [f32; 3]| DVec3::from_array(numbers.map(f64::from));
    let matrix = if let Some(matrix) = node.matrix {
        DMat4::from_cols_array(&matrix.map(f64::from))
    } else {
        let rotation = node.rotation.map_or(DQuat::IDENTITY, |rotation| {
            DQuat::from_array(rotation.0.map(f64::from)).normalize()
        });
        let scale = node.scale.map_or(DVec3::ONE, wide);
        DMat4::from_scale_rotation_translation(
            scale,
            rotation,
            node.translation.map_or(DVec3::ZERO, wide),
        )
    };
    let is_affine = matrix.row(3) == glam::DVec4::W;
    if matrix.is_finite() && is_affine {
        return Ok(matrix);
    }
    let path = [Step::Key("nodes"), Step::Item(number)];
    let message = format!("the transform of node {number} is not finite and affine, expected one");
    Err(document.fault(&path, message))
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
