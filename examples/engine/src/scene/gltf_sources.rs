//! Files that a glTF file refers to: those in its folder and below alone, and no more than fits.
//!
//! A scene is a download like any other. What it names is read only where it lies beside it, so that it cannot show other files of
//! the user, wait for a pipe, or fill the memory.

use std::path::{Component, Path, PathBuf};

use gltf::{buffer, image};

use super::gltf_file::Problem;
use super::{gltf_parts, Texture};

/// Most bytes of the file itself, and of all that it refers to together.
pub const MOST_BYTES: u64 = 2 << 30;
/// Most bytes of all pictures together, decoded.
const MOST_TEXELS: usize = 1 << 28;

const BESIDE: &str =
    "Put buffers and pictures into the folder of the file, and refer to them by relative names; or into the file itself";
const SMALLER: &str = "Choose a smaller scene, or smaller pictures";

/// Refuses what may not be read. The crate reads it afterwards.
pub fn check(document: &gltf::Document, folder: &Path) -> Result<(), Problem> {
    let buffers = document.buffers().filter_map(|buffer| match buffer.source() {
        buffer::Source::Uri(uri) => Some(uri),
        buffer::Source::Bin => None,
    });
    let images = document.images().filter_map(|image| match image.source() {
        image::Source::Uri { uri, .. } => Some(uri),
        image::Source::View { .. } => None,
    });
    let mut bytes = 0u64;
    for uri in buffers.chain(images) {
        let Some(path) = beside(folder, uri)? else { continue };
        let refused = |error: std::io::Error| (format!("{} cannot be read ({error})", path.display()), BESIDE);
        bytes = bytes.saturating_add(atrous_files::check_regular(&path).map_err(refused)?);
        // A link may lead out of the folder.
        let (real, home) = (path.canonicalize().map_err(refused)?, folder.canonicalize().map_err(refused)?);
        if !real.starts_with(home) {
            return Err((format!("{} is a link out of the folder of the file", path.display()), BESIDE));
        }
    }
    match bytes > MOST_BYTES {
        true => Err((format!("it refers to {bytes} bytes of other files, where {MOST_BYTES} are allowed"), SMALLER)),
        false => Ok(()),
    }
}

/// The path that a URI means; none for data in the URI itself.
fn beside(folder: &Path, uri: &str) -> Result<Option<PathBuf>, Problem> {
    if uri.starts_with("data:") {
        return Ok(None);
    }
    let start: String = uri.chars().take(80).collect();
    let refused = |problem: &str| (format!("it refers to \"{start}\", which {problem}"), BESIDE);
    if uri.contains(':') {
        return Err(refused("is no relative name"));
    }
    let name = urlencoding::decode(uri).map_err(|_| refused("is not UTF-8"))?;
    let path = Path::new(&*name);
    let inside = |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
    match !name.is_empty() && path.components().all(inside) {
        true => Ok(Some(folder.join(path))),
        false => Err(refused("leads out of its folder")),
    }
}

/// The pictures, one after the other, so that no more than one is in memory twice.
pub fn textures(document: &gltf::Document, folder: &Path, buffers: &[buffer::Data]) -> Result<Vec<Texture>, Problem> {
    let mut textures = Vec::new();
    let mut texels = 0;
    for image in document.images() {
        let data = image::Data::from_source(image.source(), Some(folder), buffers).map_err(super::gltf_file::import_problem)?;
        let texture = gltf_parts::image(&data)?;
        texels += texture.texels.len();
        if texels > MOST_TEXELS {
            return Err((format!("its pictures have more than {MOST_TEXELS} pixels together, which is the limit"), SMALLER));
        }
        textures.push(texture);
    }
    Ok(textures)
}
