//! The header is what cbindgen makes of the sources.

use std::path::Path;

/// What stands before the declarations of the header.
const HEADER: &str = "/* atrous: the passes of a real-time path-tracing denoiser, for the frame graph of a Vulkan engine.
 *
 * Made from crates/capi by cbindgen: `ATROUS_UPDATE_HEADER=1 cargo test -p atrous-capi --test header` renews it, and a test compares.
 * Set struct_size to sizeof(struct) in every struct before it is passed, to read and to fill alike.
 * docs/contract.md has the contract, docs/hosts/cpp.md an engine that uses it. */";

fn header() -> String {
    let vulkan = [
        "AccessFlags",
        "AccessFlags2",
        "Buffer",
        "BufferUsageFlags",
        "CommandBuffer",
        "Device",
        "Format",
        "Image",
        "ImageLayout",
        "ImageUsageFlags",
        "ImageView",
        "Instance",
        "PhysicalDevice",
        "PipelineCache",
        "PipelineStageFlags",
        "PipelineStageFlags2",
    ];
    let mut config = cbindgen::Config {
        language: cbindgen::Language::C,
        cpp_compat: true,
        include_guard: Some("ATROUS_H".into()),
        header: Some(HEADER.into()),
        includes: vec!["vulkan/vulkan_core.h".into()],
        sys_includes: vec!["stdint.h".into()],
        no_includes: true,
        documentation_style: cbindgen::DocumentationStyle::C99,
        style: cbindgen::Style::Both,
        usize_is_size_t: true,
        ..Default::default()
    };
    config.export.rename = vulkan.iter().map(|n| (n.to_string(), format!("Vk{n}"))).collect();
    config.export.rename.insert("GetInstanceProcAddr".into(), "PFN_vkGetInstanceProcAddr".into());
    config.enumeration.prefix_with_name = true;
    config.enumeration.rename_variants = cbindgen::RenameRule::ScreamingSnakeCase;
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut builder = cbindgen::Builder::new().with_config(config);
    for file in ["status.rs", "structs.rs", "handle.rs", "functions.rs", "record.rs", "conventions.rs"] {
        builder = builder.with_src(root.join(file));
    }
    let mut text = Vec::new();
    builder.generate().expect("a header").write(&mut text);
    String::from_utf8(text).expect("UTF-8")
}

#[test]
fn the_c_header_is_current() {
    let made = header();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("include/atrous.h");
    if std::env::var("ATROUS_UPDATE_HEADER").is_ok_and(|v| v == "1") {
        std::fs::write(&path, &made).expect("include/atrous.h");
    }
    let stored = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        stored == made,
        "include/atrous.h is not what src says: ATROUS_UPDATE_HEADER=1 cargo test -p atrous-capi --test header"
    );
}
