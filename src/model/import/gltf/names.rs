//! What objects are called: as their node, else as their mesh. Several that
//! would be called alike because they are instances of one thing are numbered,
//! so that drawings, layers and rules can tell them apart.

use rustc_hash::FxHashMap;

use super::super::super::Soup;
use super::container::Document;

/// What gives an object its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Source {
    Node(usize),
    Mesh(usize),
}

/// The source of each object's name, in their order.
#[derive(Debug, Default)]
pub(super) struct Names {
    sources: Vec<Source>,
}

impl Names {
    /// Notes the node and mesh of the next object.
    pub(super) fn note(&mut self, node: usize, mesh: usize, document: &Document<'_>) {
        let has_name = document.root.nodes[node].name.text().is_some_and(|name| !name.is_empty());
        self.sources.push(if has_name { Source::Node(node) } else { Source::Mesh(mesh) });
    }

    /// Gives objects their names: `wheel` to a single one; `wheel #1`, `wheel
    /// #2` and so on to instances, `mesh 0 #1` if neither node nor mesh has a
    /// name.
    pub(super) fn give(&self, document: &Document<'_>, objects: &mut [Soup]) {
        let mut counts: FxHashMap<Source, u32> = FxHashMap::default();
        for source in &self.sources {
            *counts.entry(*source).or_default() += 1;
        }
        let mut given: FxHashMap<Source, u32> = FxHashMap::default();
        for (object, source) in objects.iter_mut().zip(&self.sources) {
            let (name, number) = match *source {
                Source::Node(number) => (document.root.nodes[number].name.text(), number),
                Source::Mesh(number) => (document.root.meshes[number].name.text(), number),
            };
            let name = name.unwrap_or_default();
            if counts[source] == 1 {
                object.name = name.to_owned();
                continue;
            }
            let instance = given.entry(*source).or_default();
            *instance += 1;
            object.name = match name {
                "" => format!("mesh {number} #{instance}"),
                _ => format!("{name} #{instance}"),
            };
        }
    }
}
