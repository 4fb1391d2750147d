//! glTF files of any strides, graphs, counts and URIs.
#![no_main]

use libfuzzer_sys::fuzz_target;
use std::sync::LazyLock;
use tempfile::TempDir;

static FOLDER: LazyLock<TempDir> = LazyLock::new(|| {
    let folder = tempfile::tempdir().expect("a folder");
    atrous_fuzz::gltf::prepare(folder.path());
    folder
});

fuzz_target!(|bytes: &[u8]| {
    atrous_fuzz::gltf::attack(FOLDER.path(), bytes);
});
