//! Numbers out of the buffers of a glTF file.

use std::borrow::Cow;

use gltf_json::accessor::{ComponentType, Type};
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index, Root};

use super::error::ModelError;

/// Reads accessors; every count is held against the bytes that are there.
pub(super) struct Accessors<'a> {
    root: &'a Root,
    buffers: &'a [Cow<'a, [u8]>],
}

/// The elements of an accessor: `size` bytes every `stride` bytes.
struct Elements<'a> {
    bytes: &'a [u8],
    count: usize,
    stride: usize,
    size: usize,
    component: ComponentType,
}

impl<'a> Elements<'a> {
    /// One of them, which must be there.
    fn at(&self, number: usize) -> &'a [u8] {
        &self.bytes[number * self.stride..][..self.size]
    }
}

/// Part of a buffer that a view shows.
pub(super) fn view<'a>(
    root: &Root,
    buffers: &'a [Cow<'a, [u8]>],
    number: usize,
) -> Result<&'a [u8], ModelError> {
    let view = &root.buffer_views[number];
    let start = view.byte_offset.unwrap_or_default().0;
    let end = start.saturating_add(view.byte_length.0);
    let bytes = &buffers[view.buffer.value()];
    let range = usize::try_from(start)
        .ok()
        .zip(usize::try_from(end).ok())
        .and_then(|(start, end)| bytes.get(start..end));
    range.ok_or_else(|| {
        let place = format!("bufferViews[{number}]");
        let what = format!(
            "shows bytes {start} to {end} of a buffer of {}",
            bytes.len()
        );
        ModelError::invalid(place, what)
    })
}

impl<'a> Accessors<'a> {
    pub(super) fn new(root: &'a Root, buffers: &'a [Cow<'a, [u8]>]) -> Self {
        Self { root, buffers }
    }

    /// Vectors of `N` numbers, of the elements that are `used`: floats, or integers, which stand for
    /// shares if they are normalised.
    pub(super) fn vectors<const N: usize>(
        &self,
        index: Index<Accessor>,
        used: &[u32],
    ) -> Result<Vec<[f32; N]>, ModelError> {
        let elements = self.elements(index, N)?;
        if let Some(missing) = used.iter().find(|&&i| i as usize >= elements.count) {
            let place = format!("accessors[{}]", index.value());
            let what = format!(
                "vertex {missing} is used, but there are {} (counted from 0)",
                elements.count
            );
            return Err(ModelError::invalid(place, what));
        }
        let is_share = self.root.accessors[index.value()].normalized;
        let width = elements.component.size();
        let vector = |bytes: &[u8]| {
            std::array::from_fn(|i| {
                let part = &bytes[i * width..(i + 1) * width];
                value(part, elements.component, is_share)
            })
        };
        let used = used.iter();
        Ok(used.map(|i| vector(elements.at(*i as usize))).collect())
    }

    /// Colours, of the elements that are `used`; alpha is left out, and what is no number is white.
    pub(super) fn colours(
        &self,
        index: Index<Accessor>,
        used: &[u32],
    ) -> Result<Vec<[f32; 3]>, ModelError> {
        let colours = match self.root.accessors[index.value()].type_ {
            Checked::Valid(Type::Vec4) => {
                let colours = self.vectors::<4>(index, used)?.into_iter();
                colours.map(|[r, g, b, _]| [r, g, b]).collect()
            }
            Checked::Valid(_) | Checked::Invalid => self.vectors::<3>(index, used)?,
        };
        let within = |value: f32| {
            if value.is_nan() {
                1.0
            } else {
                value.clamp(0.0, 1.0)
            }
        };
        Ok(colours
            .into_iter()
            .map(|colour| colour.map(within))
            .collect())
    }

    /// Indices of vertices.
    pub(super) fn indices(&self, index: Index<Accessor>) -> Result<Vec<u32>, ModelError> {
        let elements = self.elements(index, 1)?;
        let number = |bytes: &[u8]| {
            let bytes = bytes.iter().rev();
            bytes.fold(0_u32, |sum, byte| (sum << 8) | u32::from(*byte))
        };
        match elements.component {
            ComponentType::U8 | ComponentType::U16 | ComponentType::U32 => {
                let all = 0..elements.count;
                Ok(all.map(|i| number(elements.at(i))).collect())
            }
            ComponentType::I8 | ComponentType::I16 | ComponentType::F32 => {
                let place = format!("accessors[{}]", index.value());
                let what = "holds indices of vertices that are not unsigned integers";
                Err(ModelError::invalid(place, what))
            }
        }
    }

    fn elements(&self, index: Index<Accessor>, wide: usize) -> Result<Elements<'a>, ModelError> {
        let number = index.value();
        let accessor = &self.root.accessors[number];
        let wrong = |what: String| ModelError::invalid(format!("accessors[{number}]"), what);
        let Checked::Valid(component) = accessor.component_type else {
            return Err(wrong("has an unknown type of numbers".to_owned()));
        };
        let component = component.0;
        if count_of(accessor.type_) != Some(wide) {
            return Err(wrong(format!("has not the {wide} numbers that are wanted")));
        }
        if accessor.sparse.is_some() {
            return Err(wrong("is sparse, which is not read".to_owned()));
        }
        let Some(of) = accessor.buffer_view else {
            return Err(wrong("has no view of a buffer".to_owned()));
        };
        let bytes = view(self.root, self.buffers, of.value())?;
        let size = wide * component.size();
        let stride = self.root.buffer_views[of.value()].byte_stride;
        let stride = stride.map_or(size, |stride| stride.0);
        let (start, count) = (accessor.byte_offset.unwrap_or_default().0, accessor.count.0);
        let last = count.saturating_sub(1).saturating_mul(stride as u64);
        let end = start.saturating_add(last).saturating_add(size as u64);
        if count > 0 && (end > bytes.len() as u64 || stride < size) {
            return Err(wrong(format!(
                "claims {count} elements up to byte {end}, but its view has {}",
                bytes.len()
            )));
        }
        Ok(Elements {
            bytes: if count > 0 {
                &bytes[start as usize..]
            } else {
                &[]
            },
            count: count as usize,
            stride,
            size,
            component,
        })
    }
}

/// Numbers in an element, of vectors and single numbers.
fn count_of(kind: Checked<Type>) -> Option<usize> {
    match kind {
        Checked::Valid(Type::Scalar) => Some(1),
        Checked::Valid(Type::Vec2) => Some(2),
        Checked::Valid(Type::Vec3) => Some(3),
        Checked::Valid(Type::Vec4) => Some(4),
        Checked::Valid(Type::Mat2 | Type::Mat3 | Type::Mat4) | Checked::Invalid => None,
    }
}

/// A number, as the format says that integers stand for shares.
fn value(bytes: &[u8], component: ComponentType, is_share: bool) -> f32 {
    let four: [u8; 4] = std::array::from_fn(|i| bytes.get(i).copied().unwrap_or(0));
    let unsigned = u32::from_le_bytes(four);
    let (value, most) = match component {
        ComponentType::F32 => return f32::from_le_bytes(four),
        ComponentType::I8 => (f32::from(four[0] as i8), 127.0),
        ComponentType::U8 => (f32::from(four[0]), 255.0),
        ComponentType::I16 => (f32::from(unsigned as u16 as i16), 32767.0),
        ComponentType::U16 => (f32::from(unsigned as u16), 65535.0),
        ComponentType::U32 => (unsigned as f32, u32::MAX as f32),
    };
    if is_share {
        (value / most).max(-1.0)
    } else {
        value
    }
}
