//! The parts of a glTF document that say what is drawn.
//!
//! Nothing else is looked at: materials, animations, `extras` and whatever
//! other programs have put in may be anything that is JSON. Of what is looked
//! at nothing has to be there before it is needed.

use std::fmt;

use serde::de::{Deserializer, Error, IgnoredAny, Unexpected, Visitor};
use serde::{Deserialize, de::DeserializeOwned};

/// The outermost object.
#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Root {
    #[serde(deserialize_with = "or_default")]
    pub(super) asset: Asset,
    pub(super) scene: Option<Natural>,
    #[serde(deserialize_with = "or_default")]
    pub(super) scenes: Vec<Scene>,
    #[serde(deserialize_with = "or_default")]
    pub(super) nodes: Vec<Node>,
    #[serde(deserialize_with = "or_default")]
    pub(super) meshes: Vec<Mesh>,
    #[serde(deserialize_with = "or_default")]
    pub(super) accessors: Vec<Accessor>,
    #[serde(deserialize_with = "or_default")]
    pub(super) buffer_views: Vec<BufferView>,
    #[serde(deserialize_with = "or_default")]
    pub(super) buffers: Vec<Buffer>,
    pub(super) animations: List,
    #[serde(deserialize_with = "or_default")]
    pub(super) extensions_used: Vec<String>,
    #[serde(deserialize_with = "or_default")]
    pub(super) extensions_required: Vec<String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Asset {
    pub(super) version: Word,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Scene {
    #[serde(deserialize_with = "or_default")]
    pub(super) nodes: Vec<Natural>,
}

/// Numbers of transforms are read in the precision of all other numbers of
/// glTF: a mesh that is moved by 0.1 meets a vertex at 0.1.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Node {
    pub(super) name: Word,
    pub(super) mesh: Option<Natural>,
    #[serde(deserialize_with = "or_default")]
    pub(super) children: Vec<Natural>,
    pub(super) matrix: Option<[f32; 16]>,
    pub(super) translation: Option<[f32; 3]>,
    pub(super) rotation: Option<[f32; 4]>,
    pub(super) scale: Option<[f32; 3]>,
    /// Of morph targets, in place of those of the mesh.
    pub(super) weights: Option<Vec<f32>>,
    pub(super) skin: Option<IgnoredAny>,
    #[serde(deserialize_with = "or_default")]
    pub(super) extensions: NodeExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct NodeExtensions {
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub(super) instancing: Option<Instancing>,
    #[serde(rename = "KHR_node_visibility")]
    pub(super) visibility: Option<Visibility>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Instancing {
    #[serde(deserialize_with = "or_default")]
    pub(super) attributes: InstanceAttributes,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "UPPERCASE")]
pub(super) struct InstanceAttributes {
    pub(super) translation: Option<Natural>,
    pub(super) rotation: Option<Natural>,
    pub(super) scale: Option<Natural>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Visibility {
    pub(super) visible: Option<bool>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Mesh {
    pub(super) name: Word,
    #[serde(deserialize_with = "or_default")]
    pub(super) primitives: Vec<Primitive>,
    #[serde(deserialize_with = "or_default")]
    pub(super) weights: Vec<f32>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Primitive {
    #[serde(deserialize_with = "or_default")]
    pub(super) attributes: Attributes,
    pub(super) indices: Option<Natural>,
    pub(super) mode: Option<Natural>,
    #[serde(deserialize_with = "or_default")]
    pub(super) targets: Vec<Attributes>,
    #[serde(deserialize_with = "or_default")]
    pub(super) extensions: PrimitiveExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Attributes {
    #[serde(rename = "POSITION")]
    pub(super) position: Option<Natural>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct PrimitiveExtensions {
    #[serde(rename = "KHR_draco_mesh_compression")]
    pub(super) draco: Option<IgnoredAny>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Accessor {
    pub(super) buffer_view: Option<Natural>,
    pub(super) byte_offset: Option<Natural>,
    pub(super) component_type: Option<Natural>,
    pub(super) normalized: Option<bool>,
    pub(super) count: Option<Natural>,
    #[serde(rename = "type")]
    pub(super) kind: Word,
    pub(super) sparse: Option<Sparse>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Sparse {
    pub(super) count: Option<Natural>,
    #[serde(deserialize_with = "or_default")]
    pub(super) indices: SparsePart,
    #[serde(deserialize_with = "or_default")]
    pub(super) values: SparsePart,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct SparsePart {
    pub(super) buffer_view: Option<Natural>,
    pub(super) byte_offset: Option<Natural>,
    pub(super) component_type: Option<Natural>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct BufferView {
    pub(super) buffer: Option<Natural>,
    pub(super) byte_offset: Option<Natural>,
    pub(super) byte_length: Option<Natural>,
    pub(super) byte_stride: Option<Natural>,
    #[serde(deserialize_with = "or_default")]
    pub(super) extensions: BufferExtensions,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Buffer {
    pub(super) uri: Option<String>,
    pub(super) byte_length: Option<Natural>,
    #[serde(deserialize_with = "or_default")]
    pub(super) extensions: BufferExtensions,
}

/// What compresses bytes, or says that a buffer holds none itself.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct BufferExtensions {
    #[serde(rename = "EXT_meshopt_compression")]
    ext_meshopt: Option<Meshopt>,
    #[serde(rename = "KHR_meshopt_compression")]
    khr_meshopt: Option<Meshopt>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Meshopt {
    fallback: Option<bool>,
}

impl BufferExtensions {
    /// The name of the extension that compresses.
    pub(super) fn compression(&self) -> Option<&'static str> {
        let ext = self.ext_meshopt.as_ref().map(|_| "EXT_meshopt_compression");
        ext.or(self.khr_meshopt.as_ref().map(|_| "KHR_meshopt_compression"))
    }

    /// Whether the buffer stands for bytes that are to be decompressed.
    pub(super) fn is_fallback(&self) -> bool {
        let both = [&self.ext_meshopt, &self.khr_meshopt];
        both.into_iter().flatten().any(|meshopt| meshopt.fallback == Some(true))
    }
}

/// A number that counts or names things; 2.0 is 2.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Natural(pub(super) u64);

impl Natural {
    /// The number of a thing in an array; beyond all arrays if it is too large.
    pub(super) fn index(self) -> usize {
        usize::try_from(self.0).unwrap_or(usize::MAX)
    }
}

impl<'de> Deserialize<'de> for Natural {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NaturalVisitor)
    }
}

struct NaturalVisitor;

impl Visitor<'_> for NaturalVisitor {
    type Value = Natural;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a natural number")
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Natural, E> {
        Ok(Natural(number))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Natural, E> {
        // Above this, not every natural number is a double.
        const MOST: f64 = (1_u64 << 53) as f64;
        if (0.0..=MOST).contains(&number) && number.fract() == 0.0 {
            return Ok(Natural(number as u64));
        }
        Err(E::invalid_value(Unexpected::Float(number), &self))
    }
}

/// A word, or something else in its place that is passed over.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum Word {
    Text(String),
    Number(f64),
    Other(IgnoredAny),
}

impl Default for Word {
    fn default() -> Self {
        Word::Other(IgnoredAny)
    }
}

impl Word {
    pub(super) fn text(&self) -> Option<&str> {
        match self {
            Word::Text(text) => Some(text),
            _ => None,
        }
    }
}

/// An array of which only the length matters, or something else in its place.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum List {
    Items(Vec<IgnoredAny>),
    Other(IgnoredAny),
}

impl Default for List {
    fn default() -> Self {
        List::Other(IgnoredAny)
    }
}

impl List {
    pub(super) fn len(&self) -> usize {
        match self {
            List::Items(items) => items.len(),
            List::Other(_) => 0,
        }
    }
}

/// A value that some writers give as null where it is empty.
fn or_default<'de, D: Deserializer<'de>, T: DeserializeOwned + Default>(
    deserializer: D,
) -> Result<T, D::Error> {
    Ok(Option::<T>::deserialize(deserializer)?.unwrap_or_default())
}
