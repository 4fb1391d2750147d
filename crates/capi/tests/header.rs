//! The header is what cbindgen makes of the sources.

use atrous::config::{ConfigField, Conventions, EawWeights};
use atrous::{Choice, Config, Counter, DebugView, Input, Phase, ResetReason};
use atrous_capi::{atrous_config_default, AtrousConfig, AtrousStatus, NodeInfo, NODES};
use std::path::Path;

/// What stands before the declarations of the header.
const HEADER: &str = "/* atrous: the passes of a real-time path-tracing denoiser, for the frame graph of a Vulkan engine.
 *
 * Made from crates/capi by cbindgen: `ATROUS_UPDATE_HEADER=1 cargo test -p atrous-capi --test header` renews it, and a test compares.
 * Set struct_size to sizeof(struct) in every struct before it is passed, to read and to fill alike. Structs only grow, at their
 * end: an older header's struct takes defaults, a newer one's must be zero where this library does not know it.
 * Threads: any may call. Calls that only read a denoiser, atrous_record among them, run side by side: record different passes, or
 * one pass in different frame slots, from as many threads as you like. Calls that change it wait until those are done, and calls
 * of one executor wait for each other.
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
        let (value, is_pair) = match value.strip_prefix('[') {
            Some(pair) => (pair.split(']').next().unwrap_or_default(), true),
            None => (value.split([',', ' ']).next().unwrap_or_default(), false),
        };
        let mut line = "    ///".to_owned();
        let default = if ["struct_size", "width", "height"].contains(&name) { String::new() } else { format!("Default: {value}.") };
        for word in lines.split_whitespace().chain(default.split_whitespace()) {
            if line.len() + word.len() > 124 {
                text += &std::mem::replace(&mut line, "\n    ///".to_owned());
            }
            line = format!("{line} {word}");
        }
        let kind = match is_pair {
            true => "[u32; 2]",
            false if value.contains(['.', 'i']) => "f32",
            false => "u32",
        };
        text += &format!("{line}\n    pub {name}: {kind},\n");
    };
    field("struct_size", "sizeof(AtrousConfig).");
    field("width", "Width of your images, pixels.");
    field("height", "Height of your images, pixels.");
    let all: Vec<_> = Conventions::FIELDS.iter().chain(Config::FIELDS).collect();
    for name in AtrousConfig::FIELDS {
        let config_field = *all.iter().find(|field| field.name == *name).expect(name);
        let ConfigField { name, values, .. } = config_field;
        let list: Vec<_> = values().iter().map(|(value, number)| format!("{number} ({value})")).collect();
        let bits: Vec<_> = EawWeights::NAMES.iter().enumerate().map(|(bit, name)| format!("{} ({name})", 1 << bit)).collect();
        let allowed = match *name {
            "eaw_weights" => format!("The sum of any of {}.", bits.join(", ")),
            "levels" => "0 is none.".to_owned(),
            "output_extent" | "light_extent" | "image_extent" => "0, 0 is none.".to_owned(),
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

/// An enumeration of C. Fields stay numbers of 32 bits, so that their size does not depend on the compiler.
fn enumeration(name: &str, values: impl Iterator<Item = (String, u32)>) -> String {
    let camel = camel(name);
    let prefix = format!("ATROUS_{}", name.to_uppercase());
    let lines = values.map(|(value, number)| format!("  {prefix}_{} = {number},\n", value.to_uppercase()));
    format!("\ntypedef enum Atrous{camel} {{\n{}}} Atrous{camel};\n", lines.collect::<String>())
}

/// Choices of a frame, where 0 is none.
fn or_none<T: Choice>() -> impl Iterator<Item = (String, u32)> {
    let shift: u32 = T::ALL.iter().any(|value| value.number() == 0).into();
    let values = T::ALL.iter().map(move |value| (value.name().to_owned(), value.number() + shift));
    std::iter::once(("none".to_owned(), 0)).chain(values)
}

/// Every choice, from the tables that have their names.
fn tables() -> Vec<(String, Vec<(String, u32)>)> {
    let mut all = Vec::new();
    for field in Conventions::FIELDS.iter().chain(Config::FIELDS) {
        let values = (field.values)();
        if values.iter().any(|(value, _)| *value != "false" && *value != "true") {
            all.push((field.name.to_owned(), values.iter().map(|(value, number)| (value.to_string(), *number)).collect()));
        }
    }
    all.push(("eaw_weights".to_owned(), (0..).zip(EawWeights::NAMES).map(|(bit, name)| (name.to_string(), 1 << bit)).collect()));
    all.push(("phase".to_owned(), Phase::ALL.into_iter().map(|phase| (snake(&format!("{phase:?}")), phase as u32)).collect()));
    all.push(("reset".to_owned(), or_none::<ResetReason>().collect()));
    all.push(("view".to_owned(), or_none::<DebugView>().collect()));
    all
}

/// Every choice and counter.
fn choices() -> String {
    let mut text = "\n// Choices, by the names of the fields that take them.\n".to_owned();
    for (name, values) in tables() {
        text += &enumeration(&name, values.into_iter());
    }
    text += "\n// Indices of atrous_executor_statistics, and of the words in the buffer `statistics`.\n";
    let count = Counter::ALL.len() as u32;
    let counters = Counter::ALL.iter().map(|counter| (counter.name().to_owned(), counter.number()));
    text + &enumeration("counter", counters) + &format!("\n#define ATROUS_COUNTER_COUNT {count}\n")
}

/// An enumeration of C++ with a scope, of the values of that of C.
fn scoped(name: &str, values: impl Iterator<Item = (String, u32)>) -> String {
    let lines =
        values.map(|(value, _)| format!("    {} = ATROUS_{}_{},\n", camel(&value), name.to_uppercase(), value.to_uppercase()));
    format!("\nenum class {} : uint32_t {{\n{}}};\n", camel(name), lines.collect::<String>())
}

fn snake(name: &str) -> String {
    let word = |(at, c): (usize, char)| match c.is_uppercase() && at > 0 {
        true => format!("_{}", c.to_lowercase()),
        false => c.to_lowercase().to_string(),
    };
    name.char_indices().map(word).collect()
}

fn camel(name: &str) -> String {
    name.split('_').map(|word| word[..1].to_uppercase() + &word[1..]).collect()
}

/// The part of `atrous.hpp` that the tables make.
fn choices_of_cpp() -> String {
    let mut text = String::new();
    for (name, values) in tables() {
        text += &scoped(&name, values.into_iter());
        if Conventions::FIELDS.iter().chain(Config::FIELDS).any(|field| field.name == name) && name != "eaw_weights" {
            let setter = format!("inline void set(AtrousConfig& config, {} value)", camel(&name));
            text += &format!("{setter} {{ config.{name} = static_cast<uint32_t>(value); }}\n");
        }
    }
    text
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

/// Names of the nodes with those of their arguments, and initialisers of arguments.
fn nodes() -> String {
    let mut text =
        "\n// Nodes for atrous_graph_node with their arguments, of which those in brackets have defaults: Graph and nodes in the\n\
        // documentation of the crate say what each means. A choice is given by its name.\n"
            .to_owned();
    for NodeInfo { name, needed, optional } in NODES {
        let optional = if optional.is_empty() { String::new() } else { format!("[{}]", optional.join(", ")) };
        let all: Vec<_> = needed.iter().map(|name| name.to_string()).chain(Some(optional).filter(|o| !o.is_empty())).collect();
        let mut line = "\n//".to_owned();
        for word in format!("{name}({})", all.join(", ")).split(' ') {
            if line.len() + word.len() > 130 {
                text += &std::mem::replace(&mut line, "\n//".to_owned());
            }
            line = format!("{line} {word}");
        }
        text += &format!("{line}\n#define ATROUS_NODE_{} \"{name}\"\n", name.to_uppercase());
    }
    text += "\n// Initialisers of AtrousArgument: { ATROUS_PORT(\"guides\", guides), ATROUS_NUMBER(\"levels\", 4) }.\n\n";
    let kinds = [
        ("PORT", "port, 0, 0"),
        ("PREVIOUS", "port, 0, 0"),
        ("NUMBER", "0, number, 0"),
        ("TEXT", "0, 0, text"),
        ("CONSTANT", "0, number, 0"),
    ];
    for (kind, content) in kinds {
        let value = content.split(", ").find(|part| *part != "0").unwrap_or_default();
        // A whole number becomes a double even where C++ would call that narrowing.
        let content = content.replace(value, &format!("{}({value})", if value == "number" { "(double)" } else { "" }));
        text += &format!("#define ATROUS_{kind}(name, {value}) {{(name), ATROUS_ARGUMENT_KIND_{kind}, {content}}}\n");
    }
    text
}

fn header() -> String {
    let vulkan = [
        "AccessFlags",
        "AccessFlags2",
        "Buffer",
        "BufferMemoryBarrier",
        "BufferUsageFlags",
        "CommandBuffer",
        "DependencyInfo",
        "Device",
        "Format",
        "Image",
        "ImageAspectFlags",
        "ImageLayout",
        "ImageMemoryBarrier",
        "ImageUsageFlags",
        "ImageView",
        "Instance",
        "MemoryBarrier",
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
        after_includes: Some(version() + &inputs() + &choices() + &nodes()),
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
    // Of an argument, whose field is a number.
    config.export.include = vec!["AtrousArgumentKind".into()];
    config.enumeration.prefix_with_name = true;
    config.enumeration.rename_variants = cbindgen::RenameRule::ScreamingSnakeCase;
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let made = Path::new(env!("CARGO_TARGET_TMPDIR")).join("config.rs");
    std::fs::write(&made, self::config()).expect("a file");
    let mut builder = cbindgen::Builder::new().with_config(config).with_src(made);
    for file in [
        "status.rs",
        "structs.rs",
        "handle.rs",
        "device.rs",
        "functions.rs",
        "graph.rs",
        "pipelines.rs",
        "record.rs",
        "tracker.rs",
        "executor.rs",
        "conventions.rs",
        "log.rs",
        "version.rs",
    ] {
        builder = builder.with_src(root.join(file));
    }
    let mut text = Vec::new();
    builder.generate().expect("a header").write(&mut text);
    String::from_utf8(text).expect("UTF-8")
}

/// Compares a file with what it is made from, after renewing it where that is asked for.
fn assert_current(file: &str, made: impl FnOnce(&str) -> String, source: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let stored = || std::fs::read_to_string(&path).unwrap_or_default();
    let made = made(&stored());
    if std::env::var("ATROUS_UPDATE_HEADER").is_ok_and(|v| v == "1") {
        std::fs::write(&path, &made).expect(file);
    }
    assert!(stored() == made, "{file} is not what {source} says: ATROUS_UPDATE_HEADER=1 cargo test -p atrous-capi --test header");
}

#[test]
fn the_c_header_is_current() {
    assert_current("include/atrous.h", |_| header(), "src");
}

#[test]
fn the_choices_of_cpp_are_current() {
    const MARKS: [&str; 2] = ["// choices: begin\n", "// choices: end\n"];
    let made = |stored: &str| {
        let (head, rest) = stored.split_once(MARKS[0]).expect("a beginning");
        let (_, tail) = rest.split_once(MARKS[1]).expect("an end");
        format!("{head}{}{}{}{tail}", MARKS[0], choices_of_cpp(), MARKS[1])
    };
    assert_current("include/atrous.hpp", made, "a table of choices");
}
