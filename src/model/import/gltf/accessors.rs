//! Accessors: typed arrays in buffers, dense or sparse.
//!
//! An accessor is measured against its buffer view before a single element
//! is read or allocated. Every component type goes through f64, which holds
//! all of them exactly.

use super::super::error::{Fault, Read};
use super::super::json_places::Step;
use super::container::Document;
use super::document::{Accessor, Natural, Sparse, SparsePart};

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
        let accessor = self.accessor(number, user)?;
        let at = Place { accessor: number, part: None };
        let component = self.component::<N>(accessor, number)?;
        let normalized = accessor.normalized.unwrap_or(false);
        let scale = if normalized { component.largest() } else { 1.0 };
        let count = self.need(accessor.count, &at.path(), "count")?.0;
        let mut elements = match accessor.buffer_view {
            Some(view) => {
                let start = accessor.byte_offset.map_or(0, |offset| offset.0);
                let array = self.array(view, start, count, N * component.size(), at)?;
                array.iter().map(|bytes| component.read(bytes, scale)).collect()
            }
            None if count <= MOST_ZEROS => vec![[0.0; N]; count as usize],
            None => {
                let message = format!("{count} zeros in no buffer, expected {MOST_ZEROS} at most");
                return Err(self.place_fault(at, message));
            }
        };
        if let Some(sparse) = &accessor.sparse {
            self.overwrite(&mut elements, sparse, component, scale, number)?;
        }
        Ok(elements)
    }

    /// An accessor by its number.
    pub(super) fn accessor(&self, number: usize, user: &[Step<'_>]) -> Read<&Accessor> {
        self.root.accessors.get(number).ok_or_else(|| {
            let count = self.root.accessors.len();
            let message = format!("accessor {number} does not exist, expected less than {count}");
            self.fault(user, message)
        })
    }

    fn component<const N: usize>(&self, accessor: &Accessor, number: usize) -> Read<Component> {
        let wanted = match N {
            1 => "SCALAR",
            3 => "VEC3",
            _ => "VEC4",
        };
        if accessor.kind.text() != Some(wanted) {
            let path = [Step::Key("accessors"), Step::Item(number), Step::Key("type")];
            let message = format!("an accessor of another type, expected {wanted}");
            return Err(self.fault(&path, message));
        }
        match Component::of(accessor.component_type) {
            Some(kind) if N != 1 || kind.is_index() => Ok(kind),
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
        sparse: &Sparse,
        component: Component,
        scale: f64,
        accessor: usize,
    ) -> Read<()> {
        let at = Place { accessor, part: Some("indices") };
        let Some(kind) =
            Component::of(sparse.indices.component_type).filter(|kind| kind.is_index())
        else {
            let message = "an unknown component type, expected 5121, 5123 or 5125";
            return Err(self.place_fault(at, message));
        };
        let path = [Step::Key("accessors"), Step::Item(accessor), Step::Key("sparse")];
        let count = self.need(sparse.count, &path, "count")?.0;
        let targets = self.part(&sparse.indices, count, kind.size(), at)?;
        let at_values = Place { accessor, part: Some("values") };
        let sources = self.part(&sparse.values, count, N * component.size(), at_values)?;
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

    /// One of both arrays of a sparse accessor.
    fn part(&self, part: &SparsePart, count: u64, size: usize, at: Place) -> Read<Array<'_>> {
        let view = self.need(part.buffer_view, &at.path(), "bufferView")?;
        self.array(view, part.byte_offset.map_or(0, |offset| offset.0), count, size, at)
    }

    /// `count` elements of `size` bytes in a view, from byte `start` on.
    fn array(
        &self,
        view: Natural,
        start: u64,
        count: u64,
        size: usize,
        at: Place,
    ) -> Read<Array<'_>> {
        let view = view.index();
        let Some(found) = self.root.buffer_views.get(view) else {
            let views = self.root.buffer_views.len();
            let message = format!("buffer view {view} does not exist, expected under {views}");
            return Err(self.place_fault(at, message));
        };
        let stride = found.byte_stride.map_or(0, Natural::index);
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
        self.fault(&at.path(), message)
    }
}

/// An accessor, or a part of its sparse storage.
#[derive(Clone, Copy)]
struct Place {
    accessor: usize,
    part: Option<&'static str>,
}

impl Place {
    fn path(self) -> Vec<Step<'static>> {
        let mut path = vec![Step::Key("accessors"), Step::Item(self.accessor)];
        if let Some(part) = self.part {
            path.extend([Step::Key("sparse"), Step::Key(part)]);
        }
        path
    }
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

/// How a number is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    /// The component of a number of OpenGL.
    fn of(number: Option<Natural>) -> Option<Self> {
        Some(match number?.0 {
            5120 => Component::I8,
            5121 => Component::U8,
            5122 => Component::I16,
            5123 => Component::U16,
            5125 => Component::U32,
            5126 => Component::F32,
            _ => return None,
        })
    }

    fn is_index(self) -> bool {
        matches!(self, Component::U8 | Component::U16 | Component::U32)
    }

    fn size(self) -> usize {
        match self {
            Component::I8 | Component::U8 => 1,
            Component::I16 | Component::U16 => 2,
            Component::U32 | Component::F32 => 4,
        }
    }

    /// What a normalized component divides by.
    fn largest(self) -> f64 {
        match self {
            Component::I8 => f64::from(i8::MAX),
            Component::U8 => f64::from(u8::MAX),
            Component::I16 => f64::from(i16::MAX),
            Component::U16 => f64::from(u16::MAX),
            Component::U32 | Component::F32 => 1.0,
        }
    }

    /// The components of an element; all bytes are there.
    fn read<const N: usize>(self, bytes: &[u8], scale: f64) -> [f64; N] {
        std::array::from_fn(|lane| {
            let bytes = &bytes[lane * self.size()..];
            let value = match (self, bytes) {
                (Component::I8, &[a, ..]) => f64::from(a as i8),
                (Component::U8, &[a, ..]) => f64::from(a),
                (Component::I16, &[a, b, ..]) => f64::from(i16::from_le_bytes([a, b])),
                (Component::U16, &[a, b, ..]) => f64::from(u16::from_le_bytes([a, b])),
                (Component::U32, &[a, b, c, d, ..]) => f64::from(u32::from_le_bytes([a, b, c, d])),
                (Component::F32, &[a, b, c, d, ..]) => f64::from(f32::from_le_bytes([a, b, c, d])),
                _ => f64::NAN,
            };
            // The least signed value maps to -1 as the next one does.
            if scale == 1.0 { value } else { (value / scale).max(-1.0) }
        })
    }
}
