//! Which scene is drawn.

use super::super::super::Soup;
use super::super::error::Read;
use super::super::json_places::Step;
use super::container::Document;
use super::extensions::tell;
use super::{nodes, objects_below};

/// The objects of the default scene, which is the first if the document names
/// none. Where nothing is in it, those of the first scene with something; the
/// document's author has forgotten to say which. Without scenes, all nodes that
/// are nobody's child are roots.
pub(super) fn draw_first_with_a_shape(
    document: &Document<'_>,
    warnings: &mut Vec<String>,
) -> Read<Vec<Soup>> {
    let root = &document.root;
    let count = root.scenes.len();
    let default = root.scene.map_or(0, |scene| scene.index());
    if root.scene.is_some() && count <= default {
        let message = format!("scene {default} does not exist, expected one of the scenes");
        return Err(document.fault(&[Step::Key("scene")], message));
    }
    if count == 0 {
        return objects_below(document, roots_of_all(document)?, warnings);
    }
    let objects = objects_of(document, default, warnings)?;
    if has_shape(&objects) {
        return Ok(objects);
    }
    for other in (0..count).filter(|&other| other != default) {
        let mut found = Vec::new();
        let objects = objects_of(document, other, &mut found)?;
        if has_shape(&objects) {
            found.into_iter().for_each(|warning| tell(warnings, warning));
            tell(warnings, format!("scene {default} is empty: scene {other} is drawn"));
            return Ok(objects);
        }
    }
    Ok(objects)
}

fn has_shape(objects: &[Soup]) -> bool {
    objects.iter().any(|object| !(object.faces.is_empty() && object.lines.is_empty()))
}

fn objects_of(
    document: &Document<'_>,
    scene: usize,
    warnings: &mut Vec<String>,
) -> Read<Vec<Soup>> {
    let path = [Step::Key("scenes"), Step::Item(scene), Step::Key("nodes")];
    let roots = nodes(document, &document.root.scenes[scene].nodes, &path)?;
    objects_below(document, roots, warnings)
}

/// All nodes that are nobody's child.
fn roots_of_all(document: &Document<'_>) -> Read<Vec<usize>> {
    let all = &document.root.nodes;
    let mut is_child = vec![false; all.len()];
    for child in all.iter().flat_map(|node| &node.children) {
        if let Some(slot) = is_child.get_mut(child.index()) {
            *slot = true;
        }
    }
    let roots: Vec<usize> = (0..all.len()).filter(|&node| !is_child[node]).collect();
    if roots.is_empty() && !all.is_empty() {
        let message = "every node is the child of another, expected a tree of nodes";
        return Err(document.fault(&[Step::Key("nodes")], message));
    }
    Ok(roots)
}
