//! Accessors: typed arrays in buffers, dense or sparse.
//!
//! An accessor is measured against its buffer view before a single element
//! is read or allocated. Every component type goes through f64, which holds
//! all of them exactly.

use ::gltf::json::accessor::{Accessor, ComponentType, Type, sparse};
use ::gltf::json::validation::Checked;

use super::super::error::{Fault, Read};
use super::super::json_places::Step;
use super::container::Document;

/// Elements of an accessor without a buffer view are zero and cost no bytes,
/// so their number needs a limit of its own.
const MOST_ZEROS: u64 = 1 << 20;

impl Document<'_> {
    /// The elements of an accessor of `N` components. `user` is the place in
    /// the document that refers to it.
    pub(super) fn elements<const N: usize>(
        &self,
        number: usize,
        user: &[Step<'_>],
    ) -> Read<Vec<[f64; N]>> {
        let Some(accessor) = self.root.accessors.get(number) else {
            let count = self.root.accessors.len();
            let message = format!("accessor {number} does not exist, expected less than {count}");
            return Err(self.fault(user, message));
        };
        let component = self.component::<N>(accessor, number)?;
        let scale = if accessor.normalized { component.largest() } else { 1.0 };
        let count = accessor.count.0;
        let start = accessor.byte_offset.unwrap_or_default().0;
        let at = Place { accessor: number, part: None };
        let mut elements = match accessor.buffer_view {
            Some(view) => {
                let array = self.array(view.value(), start, count, N * component.size(), at)?;
                array.iter().map(|bytes| component.read(bytes, scale)).collect()
            }
            None if accessor.sparse.is_some() && count <= MOST_ZEROS => {
                vec![[0.0; N]; count as usize]
            }
            None => {
                return Err(self.place_fault(at, "elements in no buffer, expected a bufferView"));
            }
        };
        if let Some(sparse) = &accessor.sparse {
            self.overwrite(&mut elements, sparse, component, scale, number)?;
        }
        Ok(elements)
    }

    fn component<const N: usize>(&self, accessor: &Accessor, number: usize) -> Read<Component> {
        let wanted = if N == 1 { Type::Scalar } else { Type::Vec3 };
        if accessor.type_ != Checked::Valid(wanted) {
            let name = if N == 1 { "SCALAR" } else { "VEC3" };
            let path = [Step::Key("accessors"), Step::Item(number), Step::Key("type")];
            return Err(self.fault(&path, format!("an accessor of another type, expected {name}")));
        }
        match accessor.component_type {
            Checked::Valid(kind) if N != 1 || is_index(kind.0) => Ok(Component(kind.0)),
            _ => {
                let path = [Step::Key("accessors"), Step::Item(number), Step::Key("componentType")];
                let names = if N == 1 { "5121, 5123 or 5125" } else { "5120 to 5126" };
                Err(self.fault(&path, format!("an unknown component type, expected {names}")))
            }
        }
    }

    /// Replaces the elements that a sparse accessor lists.
    fn overwrite<const N: usize>(
        &self,
        elements: &mut [[f64; N]],
        sparse: &sparse::Sparse,
        component: Component,
        scale: f64,
        accessor: usize,
    ) -> Read<()> {
        let (indices, values) = (&sparse.indices, &sparse.values);
        let at = Place { accessor, part: Some("indices") };
        let Checked::Valid(kind) = indices.component_type else {
            return Err(self.place_fault(at, "an unknown component type, expected 5121 to 5125"));
        };
        let kind = Component(kind.0);
        let (view, start) = (indices.buffer_view.value(), indices.byte_offset.0);
        let targets = self.array(view, start, sparse.count.0, kind.size(), at)?;
        let at_values = Place { accessor, part: Some("values") };
        let (view, start) = (values.buffer_view.value(), values.byte_offset.0);
        let size = N * component.size();
        let sources = self.array(view, start, sparse.count.0, size, at_values)?;
        let count = elements.len();
        for (target, source) in targets.iter().zip(sources.iter()) {
            let [target] = kind.read::<1>(target, 1.0);
            let Some(element) = elements.get_mut(target as usize) else {
                let message = format!("element {target} does not exist, expected under {count}");
                return Err(self.place_fault(at, message));
            };
            *element = component.read(source, scale);
        }
        Ok(())
    }

    /// `count` elements of `size` bytes in a view, from byte `start` on.
    fn array(
        &self,
        view: usize,
        start: u64,
        count: u64,
        size: usize,
        at: Place,
    ) -> Read<Array<'_>> {
        let Some(found) = self.root.buffer_views.get(view) else {
            let views = self.root.buffer_views.len();
            let message = format!("buffer view {view} does not exist, expected under {views}");
            return Err(self.place_fault(at, message));
        };
        let stride = found.byte_stride.map_or(0, |stride| stride.0);
        if stride != 0 && (stride < size || 252 < stride) {
            let path = [Step::Key("bufferViews"), Step::Item(view), Step::Key("byteStride")];
            let message = format!("a stride of {stride} bytes, expected {size} to 252");
            return Err(self.fault(&path, message));
        }
        let stride = if stride == 0 { size } else { stride };
        let bytes = self.view(view)?;
        let end = match count {
            0 => Some(start),
            _ => (count - 1)
                .checked_mul(stride as u64)
                .and_then(|length| length.checked_add(size as u64))
                .and_then(|length| length.checked_add(start)),
        };
        let range =
            end.and_then(|end| Some(usize::try_from(start).ok()?..usize::try_from(end).ok()?));
        match range.and_then(|range| bytes.get(range)) {
            Some(bytes) => Ok(Array { bytes, stride, size }),
            None => {
                let length = bytes.len();
                let message = format!(
                    "{count} elements of {stride} bytes from byte {start} on, expected at most {length} bytes"
                );
                Err(self.place_fault(at, message))
            }
        }
    }

    fn place_fault(&self, at: Place, message: impl Into<String>) -> Fault {
        let mut path = vec![Step::Key("accessors"), Step::Item(at.accessor)];
        if let Some(part) = at.part {
            path.extend([Step::Key("sparse"), Step::Key(part)]);
        }
        self.fault(&path, message)
    }
}

/// An accessor, or a part of its sparse storage.
#[derive(Clone, Copy)]
struct Place {
    accessor: usize,
    part: Option<&'static str>,
}

/// Elements of a known size, all of them within `bytes`.
struct Array<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
}

impl<'a> Array<'a> {
    fn iter(&self) -> impl Iterator<Item = &'a [u8]> {
        self.bytes.chunks(self.stride).map(|chunk| &chunk[..self.size])
    }
}

fn is_index(kind: ComponentType) -> bool {
    matches!(kind, ComponentType::U8 | ComponentType::U16 | ComponentType::U32)
}

#[derive(Clone, Copy)]
struct Component(ComponentType);

impl Component {
    fn size(self) -> usize {
        self.0.size()
    }

    /// What a normalized component divides by.
    fn largest(self) -> f64 {
        match self.0 {
            ComponentType::I8 => f64::from(i8::MAX),
            ComponentType::U8 => f64::from(u8::MAX),
            ComponentType::I16 => f64::from(i16::MAX),
            ComponentType::U16 => f64::from(u16::MAX),
            ComponentType::U32 | ComponentType::F32 => 1.0,
        }
    }

    /// The components of an element; all bytes are there.
    fn read<const N: usize>(self, bytes: &[u8], scale: f64) -> [f64; N] {
        std::array::from_fn(|lane| {
            let bytes = &bytes[lane * self.size()..];
            let value = match (self.0, bytes) {
                (ComponentType::I8, &[a, ..]) => f64::from(a as i8),
                (ComponentType::U8, &[a, ..]) => f64::from(a),
                (ComponentType::I16, &[a, b, ..]) => f64::from(i16::from_le_bytes([a, b])),
                (ComponentType::U16, &[a, b, ..]) => f64::from(u16::from_le_bytes([a, b])),
                (ComponentType::U32, &[a, b, c, d, ..]) => {
                    f64::from(u32::from_le_bytes([a, b, c, d]))
                }
                (ComponentType::F32, &[a, b, c, d, ..]) => {
                    f64::from(f32::from_le_bytes([a, b, c, d]))
                }
                _ => f64::NAN,
            };
            // The least signed value maps to -1 as the next one does.
            if scale == 1.0 { value } else { (value / scale).max(-1.0) }
        })
    }
}
