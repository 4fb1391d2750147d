//! The header is what cbindgen makes of the sources.

use atrous::config::{ConfigField, Conventions, EawWeights};
use atrous::{Config, Input};
use atrous_capi::{atrous_config_default, AtrousConfig, AtrousStatus};
use std::path::Path;

/// What stands before the declarations of the header.
const HEADER: &str = "/* atrous: the passes of a real-time path-tracing denoiser, for the frame graph of a Vulkan engine.
 *
 * Made from crates/capi by cbindgen: `ATROUS_UPDATE_HEADER=1 cargo test -p atrous-capi --test header` renews it, and a test compares.
 * Set struct_size to sizeof(struct) in every struct before it is passed, to read and to fill alike. Structs only grow, at their
 * end: an older header's struct takes defaults, a newer one's must be zero where this library does not know it.
 * docs/contract.md has the contract, docs/hosts/cpp.md an engine that uses it. */";

/// The configuration as cbindgen reads it: what the macro of the table makes of it, with documentation.
fn config() -> String {
    let mut default = std::mem::MaybeUninit::<AtrousConfig>::zeroed();
    // SAFETY: every field is a number, so zeros are one; the pointer is that of a struct whose size is set.
    let default = unsafe {
        (*default.as_mut_ptr()).struct_size = size_of::<AtrousConfig>() as u32;
        assert_eq!(atrous_config_default(default.as_mut_ptr(), 1, 1), AtrousStatus::Ok);
        format!("{:?}", default.assume_init())
    };
    let mut text = "/// Your choices; `atrous_config_default` fills them in.\n#[repr(C)]\npub struct AtrousConfig {\n".to_owned();
    let mut field = |name: &str, lines: &str| {
        let value = default.split_once(&format!(" {name}: ")).expect(name).1;
        let value = value.split([',', ' ']).next().unwrap_or_default();
        let mut line = "    ///".to_owned();
        let default = if ["struct_size", "width", "height"].contains(&name) { String::new() } else { format!("Default: {value}.") };
        for word in lines.split_whitespace().chain(default.split_whitespace()) {
            if line.len() + word.len() > 124 {
                text += &std::mem::replace(&mut line, "\n    ///".to_owned());
            }
            line = format!("{line} {word}");
        }
        let kind = if value.contains(['.', 'i']) { "f32" } else { "u32" };
        text += &format!("{line}\n    pub {name}: {kind},\n");
    };
    field("struct_size", "sizeof(AtrousConfig).");
    field("width", "Width of your images, pixels.");
    field("height", "Height of your images, pixels.");
    for config_field in Conventions::FIELDS.iter().chain(Config::FIELDS) {
        let ConfigField { name, values, .. } = config_field;
        let list: Vec<_> = values().iter().map(|(value, number)| format!("{number} ({value})")).collect();
        let bits: Vec<_> = EawWeights::NAMES.iter().enumerate().map(|(bit, name)| format!("{} ({name})", 1 << bit)).collect();
        let allowed = match *name {
            "eaw_weights" => format!("The sum of any of {}.", bits.join(", ")),
            "levels" => "0 is none.".to_owned(),
            _ if list.is_empty() => String::new(),
            _ => format!("{}.", list.join(", ")),
        };
        field(name, &format!("{} {allowed}", config_field.text()));
    }
    text + "}\n"
}

/// The version as the preprocessor sees it.
fn version() -> String {
    let parts = env!("CARGO_PKG_VERSION").split('.').zip(["MAJOR", "MINOR", "PATCH"]);
    let defines = parts.map(|(number, part)| format!("#define ATROUS_VERSION_{part} {number}\n"));
    let packed = "((ATROUS_VERSION_MAJOR << 22) | (ATROUS_VERSION_MINOR << 12) | ATROUS_VERSION_PATCH)";
    let what = "// The version of this header, packed as Vulkan packs versions; atrous_version() has that of the library.";
    format!("\n{}{what}\n#define ATROUS_VERSION {packed}\n", defines.collect::<String>())
}

/// Names of the inputs, which are those of resources.
fn inputs() -> String {
    let define = |input: &Input| {
        let optional = if input.optional { ", optional" } else { "" };
        let (role, kind) = (input.role.name(), input.kind.name());
        let comment = format!("// {role}, {kind}{optional}: {}", input.doc.trim().replace('`', ""));
        format!("{comment}\n#define ATROUS_INPUT_{} \"{}\"\n", input.name.to_uppercase(), input.name)
    };
    let all: Vec<_> = Input::ALL.iter().map(define).collect();
    format!("\n// Inputs, by the names of their resources.\n\n{}", all.join("\n"))
}

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
        after_includes: Some(version() + &inputs()),
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
    let made = Path::new(env!("CARGO_TARGET_TMPDIR")).join("config.rs");
    std::fs::write(&made, self::config()).expect("a file");
    let mut builder = cbindgen::Builder::new().with_config(config).with_src(made);
    for file in ["status.rs", "structs.rs", "handle.rs", "functions.rs", "record.rs", "conventions.rs", "version.rs"] {
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
