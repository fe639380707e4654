//! Which layer a piece belongs to.
//!
//! Pieces fall into groups: one for all, or one per class, one per object
//! name, or one per class of each of those. Each group that has anything to draw gets a layer of visible lines
//! and one for each level of hidden ones, and where lines of a group and
//! level look different, one for each look. Visible layers are numbered
//! from 1, hidden ones go on from there, so by visibility the hidden lines
//! are layer 2 whether or not anything is visible. A pen that a rule asks
//! for is the number of the layer.

use super::styles::Look;
use super::weight::Weights;
use super::{DrawingOptions, Hidden, LayerBy, LayerTags, Styles};
use crate::view::{LineClass, LinePiece, VisibleLines};
use rustc_hash::FxHashMap;

/// A layer and the pieces that will be drawn in it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LayerPlan {
    /// Counted from 1, visible layers first.
    pub(super) number: u32,
    /// Number and name.
    pub(super) label: String,
    /// How its lines look.
    pub(super) look: Look,
    /// What they are.
    pub(super) tags: LayerTags,
    /// Indices of its pieces, ascending.
    pub(super) pieces: Vec<u32>,
}

/// What decides about layers.
#[derive(Clone, Copy)]
pub(super) struct Layering<'a> {
    pub(super) options: &'a DrawingOptions,
    pub(super) styles: &'a Styles,
    pub(super) weights: Option<&'a Weights>,
}

impl Layering<'_> {
    /// Whether a piece is drawn.
    pub(super) fn draws(&self, piece: &LinePiece) -> bool {
        piece.is_visible() || self.options.hidden != Hidden::None
    }

    /// Distributes the pieces that are drawn. Layers come in the order of
    /// painting, the deepest hidden ones first; none is empty. O(n).
    pub(super) fn plan(&self, lines: &VisibleLines) -> Vec<LayerPlan> {
        let groups = Groups::new(lines, self.options.layer_by);
        let mut known: FxHashMap<[u32; 5], usize> = FxHashMap::default();
        let mut buckets: Vec<Bucket> = Vec::new();
        for (index, piece) in lines.pieces.iter().enumerate() {
            if !self.draws(piece) {
                continue;
            }
            let level = self.styles.level(piece, self.options);
            let step = match self.weights {
                Some(weights) if level == 0 => weights.step(piece) as u32,
                _ => 0,
            };
            let key = [level, step, piece.object, piece.class as u32, u32::from(piece.outline)];
            let bucket = *known.entry(key).or_insert_with(|| {
                let name = lines.objects.get(piece.object as usize).map_or("", String::as_str);
                let look = self.styles.look(piece, name, self.options, self.weights);
                let group = groups.of(piece);
                find_bucket(&mut buckets, Bucket { level, group, look, pieces: Vec::new() })
            });
            buckets[bucket].pieces.push(index as u32);
        }
        buckets.sort_by(Bucket::compare);
        number(&groups, buckets, self.options)
    }
}

/// Pieces of one layer.
struct Bucket {
    level: u32,
    group: usize,
    look: Look,
    pieces: Vec<u32>,
}

impl Bucket {
    fn compare(&self, other: &Self) -> std::cmp::Ordering {
        let key = |bucket: &Self| (bucket.level, bucket.group);
        key(self).cmp(&key(other)).then_with(|| self.look.compare(&other.look))
    }
}

/// The place of the bucket like `wanted`, which is added if there is none.
fn find_bucket(buckets: &mut Vec<Bucket>, wanted: Bucket) -> usize {
    let place = buckets.iter().position(|bucket| bucket.compare(&wanted).is_eq());
    place.unwrap_or_else(|| {
        buckets.push(wanted);
        buckets.len() - 1
    })
}

/// Numbers and names sorted buckets and brings them into painting order.
fn number(groups: &Groups<'_>, buckets: Vec<Bucket>, options: &DrawingOptions) -> Vec<LayerPlan> {
    let mut used: Vec<usize> = buckets.iter().map(|bucket| bucket.group).collect();
    used.sort_unstable();
    used.dedup();
    let levels = buckets.last().map_or(0, |bucket| bucket.level);
    let mut buckets = buckets.into_iter().peekable();
    let mut by_level: Vec<Vec<LayerPlan>> = Vec::new();
    let mut next = 1;
    for level in 0..=levels {
        let mut plans = Vec::new();
        for &group in &used {
            let own = |bucket: &Bucket| bucket.level == level && bucket.group == group;
            let mut looks = Vec::new();
            while let Some(bucket) = buckets.next_if(own) {
                looks.push(bucket);
            }
            let width_matters = looks.windows(2).any(|two| two[0].look.width != two[1].look.width);
            // A group without lines of this level keeps a number free.
            next += u32::from(looks.is_empty());
            for bucket in looks {
                let mut name = groups.layer_name(group, level, options);
                if width_matters {
                    name += &format!("-{}mm", super::length::plain(bucket.look.width));
                }
                let number = bucket.look.pen.unwrap_or(next);
                let label = format!("{number}-{name}");
                let (look, pieces, tags) = (bucket.look, bucket.pieces, groups.tags(group, level));
                plans.push(LayerPlan { number, label, look, tags, pieces });
                next += 1;
            }
        }
        by_level.push(plans);
    }
    by_level.into_iter().rev().flatten().collect()
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
            LayerBy::Object | LayerBy::Part => {
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
            LayerBy::Part => {
                self.of_object[piece.object as usize] * LineClass::ALL.len() + piece.class as usize
            }
        }
    }

    /// What is known of all lines of a group.
    fn tags(&self, group: usize, level: u32) -> LayerTags {
        let classes = LineClass::ALL.len();
        let (class, object) = match self.by {
            LayerBy::Visibility => (None, None),
            LayerBy::Class => (Some(group), None),
            LayerBy::Object => (None, Some(group)),
            LayerBy::Part => (Some(group % classes), Some(group / classes)),
        };
        LayerTags {
            level,
            class: class.map(|class| LineClass::ALL[class]),
            object: object.map(|object| self.names[object].to_owned()),
        }
    }

    fn layer_name(&self, group: usize, level: u32, options: &DrawingOptions) -> String {
        let LayerTags { class, object, .. } = self.tags(group, level);
        let object = object.map(|name| if name.is_empty() { "object".to_owned() } else { name });
        let class = class.map(|class| class.name().to_owned());
        let kind = match self.by {
            LayerBy::Visibility if level == 0 => Some("visible".to_owned()),
            _ if 0 < level => Some("hidden".to_owned()),
            _ => None,
        };
        let depth = (0 < level && options.hidden_by.tells_apart()).then(|| level.to_string());
        let words: Vec<String> = [object, class, kind, depth].into_iter().flatten().collect();
        words.join("-")
    }
}
