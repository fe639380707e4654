//! Which layer a piece belongs to.
//!
//! Pieces fall into groups: one for all, or one per class, or one per object
//! name. Each group that has anything to draw gets a visible layer, numbered
//! 1 to n, and a hidden one, numbered n + 1 to 2n. So by visibility the
//! hidden lines are always layer 2, whether or not anything is visible.

use super::{DrawingOptions, Hidden, LayerBy};
use crate::view::{LineClass, LinePiece, VisibleLines};
use rustc_hash::FxHashMap;

/// A layer and the pieces that will be drawn in it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LayerPlan {
    /// Counted from 1, visible layers first.
    pub(super) number: u32,
    /// Number and name.
    pub(super) label: String,
    /// Whether the layer holds hidden pieces.
    pub(super) hidden: bool,
    /// Indices of its pieces, ascending.
    pub(super) pieces: Vec<u32>,
}

/// Distributes the pieces that are drawn. Layers come in the order of
/// painting, hidden ones first; none is empty.
pub(super) fn plan(lines: &VisibleLines, options: &DrawingOptions) -> Vec<LayerPlan> {
    let groups = Groups::new(lines, options.layer_by);
    let mut buckets: Vec<[Vec<u32>; 2]> = vec![Default::default(); groups.names.len()];
    for (index, piece) in lines.pieces.iter().enumerate() {
        if piece.is_visible() || options.hidden != Hidden::None {
            let bucket = &mut buckets[groups.of(piece)];
            bucket[usize::from(!piece.is_visible())].push(index as u32);
        }
    }
    let used = |group: &usize| buckets[*group].iter().any(|pieces| !pieces.is_empty());
    let used: Vec<usize> = (0..buckets.len()).filter(used).collect();
    let mut plans = Vec::new();
    for hidden in [true, false] {
        for (rank, group) in used.iter().enumerate() {
            let pieces = std::mem::take(&mut buckets[*group][usize::from(hidden)]);
            if !pieces.is_empty() {
                let number = if hidden { used.len() + rank + 1 } else { rank + 1 } as u32;
                let label = format!("{number}-{}", groups.layer_name(*group, hidden));
                plans.push(LayerPlan { number, label, hidden, pieces });
            }
        }
    }
    plans
}

/// The groups of a drawing, in the order of their layers.
struct Groups<'a> {
    by: LayerBy,
    names: Vec<&'a str>,
    /// By object: the group of each object.
    of_object: Vec<usize>,
}

impl<'a> Groups<'a> {
    fn new(lines: &'a VisibleLines, by: LayerBy) -> Self {
        let mut of_object = Vec::new();
        let names = match by {
            LayerBy::Visibility => vec![""],
            LayerBy::Class => LineClass::ALL.map(LineClass::name).to_vec(),
            LayerBy::Object => {
                let mut names = Vec::new();
                let mut known = FxHashMap::default();
                for name in &lines.objects {
                    let group = *known.entry(name).or_insert(names.len());
                    if group == names.len() {
                        names.push(name.as_str());
                    }
                    of_object.push(group);
                }
                names
            }
        };
        Groups { by, names, of_object }
    }

    fn of(&self, piece: &LinePiece) -> usize {
        match self.by {
            LayerBy::Visibility => 0,
            LayerBy::Class => piece.class as usize,
            LayerBy::Object => self.of_object[piece.object as usize],
        }
    }

    fn layer_name(&self, group: usize, hidden: bool) -> String {
        match (self.by, self.names[group], hidden) {
            (LayerBy::Visibility, _, false) => "visible".to_owned(),
            (LayerBy::Visibility, _, true) => "hidden".to_owned(),
            (LayerBy::Object, "", false) => "object".to_owned(),
            (LayerBy::Object, "", true) => "object-hidden".to_owned(),
            (_, name, false) => name.to_owned(),
            (_, name, true) => format!("{name}-hidden"),
        }
    }
}
