//! Checks that what a glTF file promises is there, before the crate `gltf` reads it without looking.

use gltf::accessor::{DataType, Dimensions};
use gltf::{Accessor, Primitive, Semantic};

/// The POSITION accessors exist. The crate's own validation takes that for granted and would panic.
pub fn check_positions(root: &gltf::json::Root) -> Result<(), String> {
    let limit = root.accessors.len();
    for (number, mesh) in root.meshes.iter().enumerate() {
        for attribute in mesh.primitives.iter().flat_map(|primitive| primitive.attributes.values()) {
            let index = attribute.value();
            if index >= limit {
                return Err(format!("mesh {number} refers to accessor {index}, where there are {limit}"));
            }
        }
    }
    Ok(())
}

/// Most corners and indices, of all meshes and of all nodes with a mesh: some ten million triangles.
const ELEMENT_LIMIT: usize = 1 << 25;

/// What is to be read, and to be drawn, has a limit: primitives may share their data and nodes their meshes, so that a small file can
/// ask for much.
pub fn check_amount(document: &gltf::Document) -> Result<(), String> {
    let of_primitive = |primitive: Primitive<'_>| {
        let accessors = [primitive.get(&Semantic::Positions), primitive.indices()];
        accessors.into_iter().flatten().map(|accessor| accessor.count()).fold(0, usize::saturating_add)
    };
    let of_mesh = |mesh: gltf::Mesh<'_>| mesh.primitives().map(of_primitive).fold(0, usize::saturating_add);
    let meshes: Vec<usize> = document.meshes().map(of_mesh).collect();
    let drawn = document.nodes().filter_map(|node| meshes.get(node.mesh()?.index()).copied());
    for (what, amount) in
        [("meshes", meshes.iter().copied().fold(0, usize::saturating_add)), ("nodes", drawn.fold(0, usize::saturating_add))]
    {
        if amount > ELEMENT_LIMIT {
            return Err(format!("its {what} have {amount} corners and indices together, where {ELEMENT_LIMIT} are allowed"));
        }
    }
    Ok(())
}

/// Every buffer view lies within its buffer: the crate cuts pictures out of them without looking.
pub fn check_views(document: &gltf::Document, buffers: &[gltf::buffer::Data]) -> Result<(), String> {
    for view in document.views() {
        let length = buffers.get(view.buffer().index()).map_or(0, |buffer| buffer.len());
        if view.offset().checked_add(view.length()).is_none_or(|end| end > length) {
            let (index, offset, size) = (view.index(), view.offset(), view.length());
            return Err(format!("buffer view {index} ({size} bytes at {offset}) reads past the end of its buffer of {length}"));
        }
    }
    Ok(())
}

/// Every accessor that the demo reads lies within its buffer, has the right kind, and as many elements as corners.
pub fn check_primitive(primitive: &Primitive<'_>, buffers: &[gltf::buffer::Data]) -> Result<(), String> {
    let positions = primitive.get(&Semantic::Positions).ok_or("it has no POSITION attribute")?;
    let count = positions.count();
    check_kind(&positions, "POSITION", Dimensions::Vec3, &[DataType::F32])?;
    check_accessor(&positions, "POSITION", buffers)?;
    if let Some(normals) = primitive.get(&Semantic::Normals) {
        check_kind(&normals, "NORMAL", Dimensions::Vec3, &[DataType::F32])?;
        check_count(&normals, "NORMAL", count)?;
        check_accessor(&normals, "NORMAL", buffers)?;
    }
    if let Some(uvs) = primitive.get(&Semantic::TexCoords(0)) {
        check_kind(&uvs, "TEXCOORD_0", Dimensions::Vec2, &[DataType::F32, DataType::U8, DataType::U16])?;
        check_count(&uvs, "TEXCOORD_0", count)?;
        check_accessor(&uvs, "TEXCOORD_0", buffers)?;
    }
    if let Some(indices) = primitive.indices() {
        check_kind(&indices, "indices", Dimensions::Scalar, &[DataType::U8, DataType::U16, DataType::U32])?;
        check_accessor(&indices, "indices", buffers)?;
    }
    Ok(())
}

fn check_kind(accessor: &Accessor<'_>, name: &str, dimensions: Dimensions, types: &[DataType]) -> Result<(), String> {
    if accessor.dimensions() == dimensions && types.contains(&accessor.data_type()) {
        return Ok(());
    }
    let (given, kind) = (accessor.dimensions(), accessor.data_type());
    Err(format!("{name} is {given:?} of {kind:?}, where {dimensions:?} of one of {types:?} is allowed"))
}

fn check_count(accessor: &Accessor<'_>, name: &str, count: usize) -> Result<(), String> {
    let given = accessor.count();
    (given == count).then_some(()).ok_or_else(|| format!("{name} has {given} elements for {count} corners"))
}

fn check_accessor(accessor: &Accessor<'_>, name: &str, buffers: &[gltf::buffer::Data]) -> Result<(), String> {
    if accessor.sparse().is_some() {
        return Err(format!("{name} is a sparse accessor, which the demo does not read"));
    }
    let view = accessor.view().ok_or_else(|| format!("{name} has no buffer view"))?;
    let buffer = buffers.get(view.buffer().index()).ok_or_else(|| format!("{name} refers to a missing buffer"))?;
    let stride = view.stride().unwrap_or(accessor.size());
    if stride < accessor.size() {
        let size = accessor.size();
        return Err(format!("{name} has elements of {size} bytes every {stride} bytes (byteStride), so that they overlap"));
    }
    // Checked arithmetic: the numbers come from the file.
    let end = accessor
        .count()
        .checked_sub(1)
        .and_then(|last| last.checked_mul(stride))
        .and_then(|start| start.checked_add(accessor.offset())?.checked_add(accessor.size()));
    let view_end = view.offset().checked_add(view.length());
    match (end, view_end) {
        (Some(end), Some(view_end)) if end <= view.length() && view_end <= buffer.len() => Ok(()),
        _ => Err(format!(
            "{name} reads past the end of its data ({} elements of {stride} bytes, of a view of {} bytes at {} in a buffer of {})",
            accessor.count(),
            view.length(),
            view.offset(),
            buffer.len()
        )),
    }
}
