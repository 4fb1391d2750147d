//! What is written twice must say the same.

use atrous::config::{ConfigField, Conventions, EawWeights, GradientSource, PostProcess, Preset, Sampling, Signals};
use atrous::{Access, Config, Input, Lifetime, Shape, Tuning};
use atrous_harness::DeviceTest;
use std::collections::BTreeSet;

pub const TESTS: &[DeviceTest] = &[
    ("the_readme_shows_a_part_of_host_ash", the_readme_shows_a_part_of_host_ash),
    ("the_pages_of_hosts_show_parts_of_them", the_pages_of_hosts_show_parts_of_them),
    ("the_first_steps_are_a_program", the_first_steps_are_a_program),
    ("the_glue_of_an_ash_host_is_small", the_glue_of_an_ash_host_is_small),
    ("a_field_of_a_configuration_names_its_default", a_field_of_a_configuration_names_its_default),
    ("the_numbers_of_each_preset_stand_in_their_table", the_numbers_of_each_preset_stand_in_their_table),
    ("the_inputs_name_every_output", the_inputs_name_every_output),
    ("the_table_of_inputs_is_what_configurations_ask_for", the_table_of_inputs_is_what_configurations_ask_for),
    ("the_inputs_are_those_of_the_table", the_inputs_are_those_of_the_table),
    ("the_table_of_presets_has_their_passes_and_bytes", the_table_of_presets_has_their_passes_and_bytes),
    ("the_contract_has_what_each_access_means", the_contract_has_what_each_access_means),
    ("each_promise_names_tests_that_exist", each_promise_names_tests_that_exist),
];

/// Markers around what lies between an engine's own frame graph and the denoiser.
const GLUE_BEGIN: &str = "// glue: begin";
const GLUE_END: &str = "// glue: end";

/// The lines between the markers, without their common indentation.
fn excerpt(source: &str, document: &str) -> String {
    let marker = |which: &str| format!("// {document}: {which}");
    let inside = source.lines().skip_while(|l| l.trim() != marker("begin")).skip(1);
    let inside = inside.take_while(|l| l.trim() != marker("end"));
    let lines: Vec<_> = inside.filter(|l| ![GLUE_BEGIN, GLUE_END].contains(&l.trim())).collect();
    let indentation = lines.iter().filter(|l| !l.is_empty()).map(|l| l.len() - l.trim_start().len()).min().unwrap_or(0);
    lines.iter().map(|l| format!("{}\n", l.get(indentation..).unwrap_or_default())).collect()
}

fn the_pages_of_hosts_show_parts_of_them() {
    let hosts = [
        ("docs/hosts/ash.md", include_str!("../docs/hosts/ash.md"), include_str!("../examples/host_ash.rs")),
        ("docs/hosts/vk_graph.md", include_str!("../docs/hosts/vk_graph.md"), include_str!("../examples/host_vk_graph.rs")),
        ("docs/hosts/cpp.md", include_str!("../docs/hosts/cpp.md"), include_str!("../examples/host_cpp/main.cpp")),
        ("docs/add_a_stage.md", include_str!("../docs/add_a_stage.md"), include_str!("../examples/custom_graph.rs")),
    ];
    for (name, page, source) in hosts {
        let excerpt = excerpt(source, "docs");
        assert!(excerpt.lines().count() > 5, "no part of the example of {name} is marked");
        assert!(page.contains(&excerpt), "{name} must have this from its example:\n{excerpt}");
    }
}

fn the_first_steps_are_a_program() {
    let (_, program) = include_str!("../examples/first_steps.rs").split_once("\n\n").expect("a head");
    let page = include_str!("../docs/first_steps.md");
    assert!(page.contains(&format!("```rust,no_run\n{program}```")), "docs/first_steps.md must have examples/first_steps.rs");
}

fn the_glue_of_an_ash_host_is_small() {
    let (mut lines, mut inside) = (0, false);
    for line in include_str!("../examples/host_ash.rs").lines().map(str::trim) {
        match line {
            GLUE_BEGIN => inside = true,
            GLUE_END => inside = false,
            _ => lines += usize::from(inside && !line.is_empty()),
        }
    }
    assert!(!inside && lines > 30, "{lines} lines of examples/host_ash.rs are marked as glue");
    assert!(lines <= 60, "a new host has {lines} lines of glue to write; 60 are allowed");
    println!("examples/host_ash.rs: {lines} lines of glue");
}

fn a_field_of_a_configuration_names_its_default() {
    let config = Config::new([1, 1]);
    let values = [format!("{config:#?}"), format!("{:#?}", config.conventions)];
    for (name, fields, values) in [("Config", Config::FIELDS, &values[0]), ("Conventions", Conventions::FIELDS, &values[1])] {
        for ConfigField { name: field, doc, .. } in fields {
            let doc = doc.replace('\n', "");
            let value = values.lines().find_map(|l| l.strip_prefix(&format!("    {field}: "))).expect(field).trim_end_matches(',');
            let expected = match *field {
                "eaw_weights" => "Default: all three".to_owned(),
                "levels" | "output_extent" | "light_extent" | "image_extent" => "Default: none".to_owned(),
                _ if value == "inf" => "Default: infinity".to_owned(),
                _ if value.starts_with(char::is_uppercase) => format!("::{value}`]"),
                _ => format!("Default: {value}"),
            };
            assert!(doc.contains("efault") && doc.contains(&expected), "{name}::{field} is {value}, and says:{doc}");
        }
    }
}

fn the_numbers_of_each_preset_stand_in_their_table() {
    let default = Tuning::default();
    for preset in Preset::ALL.into_iter().filter(|preset| *preset != Preset::default()) {
        let of_preset = Tuning::for_preset(preset);
        let different = Tuning::FIELDS.iter().map(|f| f.name).filter(|name| of_preset.get(name) != default.get(name));
        let numbers: Vec<_> = different.map(|name| format!("`{name}` {}", of_preset.get(name).expect(name))).collect();
        let row = format!("    /// | [`Preset::{preset:?}`] | {} |\n", numbers.join(", "));
        assert!(include_str!("../src/contract/tuning.rs").contains(&row), "Tuning::for_preset must have this row:\n{row}");
    }
}

/// What a host can configure, as far as it changes the declaration.
fn configurations() -> Vec<Config> {
    let mut all = Vec::new();
    for preset in Preset::ALL {
        for signals in Signals::ALL {
            for gradient_source in GradientSource::ALL {
                let base = Config { preset, signals, gradient_source, ..Config::new([1920, 1080]) };
                all.push(base);
                all.push(Config { output_extent: Some([2880, 1620]), ..base });
                all.push(Config {
                    post_process: PostProcess::ToneMapTaa,
                    object_normal: true,
                    material_class: true,
                    debug_view: true,
                    reactive_mask: true,
                    volume: true,
                    visibility: 4,
                    ambient_occlusion: true,
                    forward_motion: true,
                    firefly_filter: true,
                    sampling: Sampling::OneOf2x2,
                    eaw_weights: EawWeights::first(3),
                    ..base
                });
            }
        }
    }
    all
}

/// Names of the outputs of all configurations.
pub fn outputs() -> BTreeSet<String> {
    let declarations = configurations().into_iter().filter_map(|config| config.declare().ok());
    let of = |d: atrous::Declaration| {
        let outputs = d.resources().iter().filter(|r| r.lifetime == Lifetime::Output).map(|r| r.name.clone());
        outputs.collect::<Vec<_>>()
    };
    declarations.flat_map(of).collect()
}

fn the_inputs_name_every_output() {
    let names = outputs();
    let page = include_str!("../docs/inputs.md");
    // Those of further lights have one row with the first.
    let row = |name: &str| name.trim_end_matches(['1', '2', '3']).trim_end_matches('_').to_owned();
    let missing: Vec<_> = names.iter().filter(|name| !page.contains(&format!("| `{}` |", row(name)))).collect();
    assert!(names.len() > 6 && missing.is_empty(), "docs/inputs.md has no row for {missing:?}");
}

/// Every input of every configuration is one of the table, with its format, and the table has no other.
fn the_table_of_inputs_is_what_configurations_ask_for() {
    let mut names = BTreeSet::new();
    for config in configurations() {
        let Ok(declaration) = config.declare() else { continue };
        for resource in declaration.resources() {
            let Lifetime::Input { optional } = resource.lifetime else { continue };
            let input = Input::by_name(&resource.name).unwrap_or_else(|| panic!("{} is not in the table", resource.name));
            let format = match resource.shape {
                Shape::Image { format, .. } => Some(format),
                Shape::Buffer { .. } => None,
            };
            assert_eq!((format, optional), (input.kind.format(), input.optional), "{}", input.name);
            names.insert(input.name);
        }
    }
    let unused: Vec<_> = Input::ALL.iter().map(|input| input.name).filter(|name| !names.contains(name)).collect();
    assert!(unused.is_empty(), "no configuration asks for {unused:?}");
    let layers = || Input::ALL.iter().filter_map(|input| input.layer);
    let captured: BTreeSet<_> = layers().map(|layer| layer.names[0]).collect();
    assert_eq!(captured.len(), layers().count(), "two inputs have one layer");
}

/// Markers around the table of inputs.
const INPUTS: [&str; 2] = ["<!-- inputs: begin -->\n", "<!-- inputs: end -->"];

fn the_inputs_are_those_of_the_table() {
    let mut table = "| input | use | texel | in captures | content |\n| --- | --- | --- | --- | --- |\n".to_owned();
    // Those of further lights have one row with the first.
    for Input { name, doc, role, kind, optional, layer, .. } in Input::ALL.iter().filter(|input| input.light == 0) {
        let layer = layer.map_or(String::new(), |layer| format!("`{}.{}`", layer.names[0], layer.components.join("")));
        let optional = if *optional { "optional: " } else { "" };
        table += &format!("| `{name}` | {} | {} | {layer} | {optional}{} |\n", role.name(), kind.name(), doc.trim());
    }
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/inputs.md");
    let page = std::fs::read_to_string(&path).expect("docs/inputs.md");
    let (before, rest) = page.split_once(INPUTS[0]).expect("the table begins");
    let (stored, after) = rest.split_once(INPUTS[1]).expect("the table ends");
    if std::env::var("ATROUS_UPDATE_DOCS").is_ok_and(|v| v == "1") {
        std::fs::write(&path, [before, INPUTS[0], &table, INPUTS[1], after].concat()).expect("docs/inputs.md");
        return;
    }
    assert!(
        stored == table,
        "docs/inputs.md is not what src/contract/inputs.rs says: ATROUS_UPDATE_DOCS=1 cargo test --test suite documents::the_inputs_are"
    );
}

/// Presets and signals, and the bytes that README.md has for them in whole numbers.
fn the_table_of_presets_has_their_passes_and_bytes() {
    let apart = [(Preset::Best, Signals::Specular), (Preset::Svgf, Signals::Apart)];
    let together = Preset::ALL.map(|preset| (preset, Signals::Together));
    let rows = together.into_iter().chain(apart).map(|(preset, signals)| {
        let declaration = Config { preset, signals, ..Config::new([1920, 1080]) }.declare().expect("valid");
        let memory = declaration.memory();
        let [history, transient] = [memory.history, memory.transient].map(|bytes| bytes as f64 / (1920.0 * 1080.0));
        if signals == Signals::Together {
            let row = readme_row(preset);
            let bytes = format!(" {:.0} ", history + transient);
            assert_eq!(row.split('|').nth(4), Some(bytes.as_str()), "README.md has other bytes per pixel: {row}");
        }
        format!("| `{preset:?}`, `{signals:?}` | {} | {history:.1} + {transient:.1} |", declaration.passes().len())
    });
    needs_rows("docs/presets.md", include_str!("../docs/presets.md"), rows);
}

fn readme_row(preset: Preset) -> &'static str {
    let named = |line: &&str| line.starts_with(&format!("| `{preset}`"));
    include_str!("../README.md").lines().find(named).unwrap_or_else(|| panic!("README.md has no row for {preset}"))
}

fn needs_rows(name: &str, page: &str, rows: impl IntoIterator<Item = String>) {
    let missing: Vec<_> = rows.into_iter().filter(|row| !page.contains(row.as_str())).collect();
    assert!(missing.is_empty(), "{name} must have these rows:\n{}", missing.join("\n"));
}

fn the_contract_has_what_each_access_means() {
    let rows = Access::ALL.map(|access| {
        let (scope, image) = (access.scope(), access.image());
        let masks = format!("{:?}", scope.access).replace(" | ", "`, `");
        let layout = if access == Access::Uniform { "none".to_owned() } else { format!("`{:?}`", image.layout) };
        format!("| `{access:?}` | `{:?}` | `{masks}` | {layout} |", scope.stage)
    });
    needs_rows("docs/contract.md", include_str!("../docs/contract.md"), rows);
}

/// Every `group::test` of docs/specification/reliability.md, where `*` is all of a group.
fn each_promise_names_tests_that_exist() {
    let promises = include_str!("../docs/specification/reliability.md");
    let quoted = promises.split('`').skip(1).step_by(2).filter_map(|code| code.split_once("::"));
    let tests: Vec<_> = quoted
        .filter(|(group, name)| format!("{group}{name}").chars().all(|c| c.is_ascii_lowercase() || "_*".contains(c)))
        .collect();
    assert!(tests.len() > 20, "{tests:?}");
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    for (group, name) in tests.into_iter().filter(|(group, _)| *group != "shaders") {
        let source = [format!("{group}.rs"), format!("{group}/mod.rs")]
            .iter()
            .find_map(|path| std::fs::read_to_string(folder.join(path)).ok());
        let source = source.unwrap_or_else(|| panic!("there is no group `{group}`"));
        assert!(name == "*" || source.contains(&format!("(\"{name}\", ")), "there is no test `{group}::{name}`");
    }
}

fn the_readme_shows_a_part_of_host_ash() {
    let source = include_str!("../examples/host_ash.rs");
    let excerpt = excerpt(source, "README");
    let lines = excerpt.lines().count();
    assert!((10..=20).contains(&lines), "{lines} lines");
    assert!(include_str!("../README.md").contains(&excerpt), "README.md must have this from examples/host_ash.rs:\n{excerpt}");
    let whole = source.lines().count();
    assert!(whole < 250, "examples/host_ash.rs has {whole} lines; an engine that takes 250 proves nothing");
}
