//! Typed views into buffers (§3.6.2): every component type, normalised integers, byte strides and
//! sparse accessors.
//!
//! Elements are decoded when asked for, so an accessor costs nothing but its checks, however large
//! its count. All offsets are checked once, in [`open`].

use super::budget::Budget;
use super::buffers::Bytes;
use gltf::json::accessor::sparse::Sparse as SparseJson;
use gltf::json::accessor::{Accessor as AccessorJson, ComponentType, Type};
use gltf::json::buffer::View;
use gltf::json::validation::{Checked, USize64};
use gltf::json::{Index, Root};

/// A checked accessor.
#[derive(Debug)]
pub(super) struct Accessor<'a> {
    /// How many elements it has; at least one.
    pub(super) count: usize,
    component: ComponentType,
    normalized: bool,
    /// `None` is zeros.
    base: Option<Strided<'a>>,
    sparse: Option<Sparse<'a>>,
}

/// Elements of equal size at equal distances.
#[derive(Debug)]
struct Strided<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
}

impl<'a> Strided<'a> {
    fn get(&self, i: usize) -> &'a [u8] {
        &self.bytes[i * self.stride..][..self.size]
    }
}

/// Elements that differ from the base, in rising order.
#[derive(Debug)]
struct Sparse<'a> {
    count: usize,
    component: ComponentType,
    indices: Strided<'a>,
    values: Strided<'a>,
}

impl Sparse<'_> {
    fn index(&self, k: usize) -> usize {
        unsigned(self.indices.get(k), self.component) as usize
    }

    /// The position of element `i` among those that differ.
    fn find(&self, i: usize) -> Option<usize> {
        let (mut low, mut high) = (0, self.count);
        while low < high {
            let middle = low + (high - low) / 2;
            match self.index(middle).cmp(&i) {
                std::cmp::Ordering::Equal => return Some(middle),
                std::cmp::Ordering::Less => low = middle + 1,
                std::cmp::Ordering::Greater => high = middle,
            }
        }
        None
    }
}

/// What an accessor is used for, which decides the types it may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Usage {
    /// Positions: floats, or integers with `KHR_mesh_quantization`.
    Position,
    /// Normals: floats, or signed normalised integers with `KHR_mesh_quantization`.
    Normal,
    /// Vertex indices: unsigned integers.
    Index,
}

/// Checks an accessor's types and that all it names lies inside its buffers.
///
/// # Errors
/// What is wrong, and the accessor's field when it is one of them.
pub(super) fn open<'a>(
    root: &Root,
    buffers: &'a [Bytes<'a>],
    index: Index<AccessorJson>,
    usage: Usage,
    budget: &mut Budget,
) -> Result<Accessor<'a>, String> {
    let json = root.get(index).ok_or("there is no such accessor")?;
    let (component, components) = types(json, usage)?;
    let count = size(json.count)?;
    if count == 0 {
        return Err("has no elements".into());
    }
    let element = component.size() * components;
    let source = Source { root, buffers };
    let base = match json.buffer_view {
        Some(view) => {
            let offset = json.byte_offset.unwrap_or_default();
            Some(
                source
                    .strided(view, offset, element, count)
                    .map_err(in_field("bufferView"))?,
            )
        }
        None => None,
    };
    let sparse = match &json.sparse {
        Some(s) => Some(
            source
                .sparse(s, element, count, budget)
                .map_err(in_field("sparse"))?,
        ),
        None => None,
    };
    Ok(Accessor {
        count,
        component,
        normalized: json.normalized,
        base,
        sparse,
    })
}

fn in_field(field: &str) -> impl FnOnce(String) -> String {
    move |what| format!("`{field}`: {what}")
}

fn size(n: USize64) -> Result<usize, String> {
    usize::try_from(n.0).map_err(|_| format!("{} is too large", n.0))
}

/// The component type, and how many of them make an element.
fn types(json: &AccessorJson, usage: Usage) -> Result<(ComponentType, usize), String> {
    use ComponentType::{F32, I8, I16, U8, U16, U32};
    let (Checked::Valid(component), Checked::Valid(shape)) = (json.component_type, json.type_)
    else {
        return Err("its type is not valid".into());
    };
    let (component, normalized) = (component.0, json.normalized);
    let fits = match usage {
        Usage::Position => shape == Type::Vec3 && component != U32,
        Usage::Normal => {
            shape == Type::Vec3 && (component == F32 || matches!(component, I8 | I16) && normalized)
        }
        Usage::Index => shape == Type::Scalar && matches!(component, U8 | U16 | U32) && !normalized,
    };
    if !fits {
        let kind = if normalized { "normalised " } else { "" };
        let what = match usage {
            Usage::Position => "positions",
            Usage::Normal => "normals",
            Usage::Index => "indices",
        };
        return Err(format!("{kind}{shape:?} of {component:?} cannot be {what}"));
    }
    Ok((component, shape.multiplicity()))
}

/// Where the bytes are.
struct Source<'r, 'a> {
    root: &'r Root,
    buffers: &'a [Bytes<'a>],
}

impl<'a> Source<'_, 'a> {
    /// `count` elements of `size` bytes from `offset` in a view.
    fn strided(
        &self,
        view: Index<View>,
        offset: USize64,
        size_of_element: usize,
        count: usize,
    ) -> Result<Strided<'a>, String> {
        let json = self.root.get(view).ok_or("there is no such buffer view")?;
        let buffer = self
            .buffers
            .get(json.buffer.value())
            .ok_or("there is no such buffer")?;
        let start = size(json.byte_offset.unwrap_or_default())?;
        let end = start.checked_add(size(json.byte_length)?);
        let bytes = end.and_then(|end| buffer.get(start..end)).ok_or_else(|| {
            format!(
                "the view {} ends behind its buffer of {} bytes",
                view.value(),
                buffer.len()
            )
        })?;
        let stride = json.byte_stride.map_or(size_of_element, |s| s.0);
        if stride < size_of_element {
            return Err(format!(
                "elements of {size_of_element} bytes do not fit a stride of {stride}"
            ));
        }
        let offset = size(offset)?;
        let needed = (count - 1)
            .checked_mul(stride)
            .and_then(|n| n.checked_add(size_of_element))
            .and_then(|n| n.checked_add(offset));
        if needed.is_none_or(|n| n > bytes.len()) {
            return Err(format!(
                "{count} elements end behind the view {} of {} bytes",
                view.value(),
                bytes.len()
            ));
        }
        Ok(Strided {
            bytes: &bytes[offset..],
            stride,
            size: size_of_element,
        })
    }

    fn sparse(
        &self,
        json: &SparseJson,
        size_of_element: usize,
        total: usize,
        budget: &mut Budget,
    ) -> Result<Sparse<'a>, String> {
        let count = size(json.count)?;
        if count == 0 || count > total {
            return Err(format!("{count} of {total} elements cannot differ"));
        }
        let Checked::Valid(component) = json.indices.component_type else {
            return Err("the type of its indices is not valid".into());
        };
        let component = component.0;
        let (i, v) = (&json.indices, &json.values);
        let sparse = Sparse {
            count,
            component,
            indices: self.strided(i.buffer_view, i.byte_offset, component.size(), count)?,
            values: self.strided(v.buffer_view, v.byte_offset, size_of_element, count)?,
        };
        // The look-up below is a binary search. Checking its order takes time, and a file can
        // name one accessor often, so it is paid for like memory.
        budget.pay(count as u64, 1)?;
        let rising = (1..count).all(|k| sparse.index(k - 1) < sparse.index(k));
        if !rising || sparse.index(count - 1) >= total {
            return Err("its indices do not rise, or end behind the accessor".into());
        }
        Ok(sparse)
    }
}

impl Accessor<'_> {
    fn element(&self, i: usize) -> Option<&[u8]> {
        if let Some(sparse) = &self.sparse
            && let Some(k) = sparse.find(i)
        {
            return Some(sparse.values.get(k));
        }
        self.base.as_ref().map(|b| b.get(i))
    }

    /// Element `i` below [`Accessor::count`] as three floats.
    pub(super) fn vec3(&self, i: usize) -> [f32; 3] {
        let Some(bytes) = self.element(i) else {
            return [0.0; 3];
        };
        let size = self.component.size();
        std::array::from_fn(|k| float(&bytes[k * size..][..size], self.component, self.normalized))
    }

    /// Element `i` below [`Accessor::count`] as an index.
    pub(super) fn index(&self, i: usize) -> u32 {
        self.element(i).map_or(0, |b| unsigned(b, self.component))
    }

    /// The index that means "start anew" in graphics interfaces, which §3.7.2.1 forbids.
    pub(super) fn restart_value(&self) -> u32 {
        match self.component {
            ComponentType::U8 => u8::MAX.into(),
            ComponentType::U16 => u16::MAX.into(),
            _ => u32::MAX,
        }
    }
}

/// A component as a float (§3.11 for normalised integers).
fn float(bytes: &[u8], component: ComponentType, normalized: bool) -> f32 {
    // Signed ranges have one value too many; the specification maps it to −1 as well.
    let scaled = |x: f32, one: f32| if normalized { (x / one).max(-1.0) } else { x };
    match (component, bytes) {
        (ComponentType::I8, &[a]) => scaled(f32::from(i8::from_le_bytes([a])), 127.0),
        (ComponentType::U8, &[a]) => scaled(f32::from(a), 255.0),
        (ComponentType::I16, &[a, b]) => scaled(f32::from(i16::from_le_bytes([a, b])), 32767.0),
        (ComponentType::U16, &[a, b]) => scaled(f32::from(u16::from_le_bytes([a, b])), 65535.0),
        (ComponentType::F32, &[a, b, c, d]) => f32::from_le_bytes([a, b, c, d]),
        _ => unreachable!("`types` admits no other component for vectors"),
    }
}

fn unsigned(bytes: &[u8], component: ComponentType) -> u32 {
    match (component, bytes) {
        (ComponentType::U8, &[a]) => a.into(),
        (ComponentType::U16, &[a, b]) => u16::from_le_bytes([a, b]).into(),
        (ComponentType::U32, &[a, b, c, d]) => u32::from_le_bytes([a, b, c, d]),
        _ => unreachable!("`types` and validation admit unsigned components only"),
    }
}
