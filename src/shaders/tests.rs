use super::*;
use crate::config::{AdaptiveRule, Config, GradientSource, PostProcess, Preset, Sampling, Signals};
use crate::contract::{Access, Dispatch, ImageFormat, PassDecl, Shape, Use};
use crate::{Declaration, UseFrame};
use std::collections::BTreeSet;
use std::sync::LazyLock;

const GRADIENT_SOURCES: [(GradientSource, bool); 6] = [
    (GradientSource::ForwardProjected, false),
    (GradientSource::ForwardProjected, true),
    (GradientSource::Reshaded, false),
    (GradientSource::Sparse, false),
    (GradientSource::Confidence, false),
    (GradientSource::ChangeTest, false),
];

/// Every structural configuration that changes a declaration.
fn declarations() -> &'static [Declaration] {
    static DECLARATIONS: LazyLock<Vec<Declaration>> =
        LazyLock::new(|| declarations_with(|config| config.declare().expect("valid")));
    &DECLARATIONS
}

fn declarations_with(declare: fn(&Config) -> Declaration) -> Vec<Declaration> {
    let mut all = Vec::new();
    for (debug_view, signals) in [false, true].into_iter().flat_map(|view| Signals::ALL.map(|signals| (view, signals))) {
        add_declarations(&mut all, declare, Config { signals, debug_view, ..Config::new([64, 36]) });
    }
    all
}

fn add_declarations(all: &mut Vec<Declaration>, declare: fn(&Config) -> Declaration, base: Config) {
    for (surface_id, object_normal) in [(false, false), (true, false), (false, true), (true, true)] {
        for post_process in [PostProcess::None, PostProcess::ToneMap, PostProcess::ToneMapTaa] {
            for levels in [1, 2, 5, 10] {
                let config = Config { surface_id, object_normal, post_process, levels: Some(levels), ..base };
                all.push(declare(&config));
            }
            let config = Config { surface_id, object_normal, post_process, ..base };
            all.push(declare(&Config { preset: Preset::Eaw, object_normal: false, ..config }));
            for (preset, levels) in [(Preset::Volume, 1), (Preset::Volume, 10), (Preset::Svgf, 5), (Preset::Eaw, 5)] {
                for firefly_filter in [false, true] {
                    let config =
                        Config { preset, levels: Some(levels), firefly_filter, volume: true, object_normal: false, ..config };
                    all.push(declare(&config));
                }
            }
            all.push(declare(&Config { firefly_filter: true, ..config }));
            all.push(declare(&Config { material_class: true, ..config }));
            all.push(declare(&Config { visibility: 1, ..config }));
            all.push(declare(&Config { visibility: 1, light_extent: Some([32, 36]), ..config }));
            all.push(declare(&Config { reactive_mask: true, ..config }));
            let half = Config { light_extent: Some([32, 18]), float_output: true, ..config };
            all.push(declare(&Config { volume: true, reactive_mask: true, ..half }));
            all.push(declare(&Config { visibility: 1, coloured_visibility: true, ..config }));
            all.push(declare(&Config { visibility: 3, ambient_occlusion: true, ..config }));
            all.push(declare(&Config { visibility: 4, coloured_visibility: true, ..config }));
            all.push(declare(&Config { visibility: 1, volume: true, float_output: true, ..config }));
            for preset in [Preset::Svgf, Preset::Asvgf, Preset::Percentile, Preset::Fast, Preset::Best, Preset::Eaw] {
                all.extend(Sampling::ALL.map(|sampling| declare(&Config { preset, sampling, ..config })));
            }
            for adaptive_rule in [AdaptiveRule::ChangeTest, AdaptiveRule::Percentiles] {
                all.push(declare(&Config { preset: Preset::Percentile, adaptive_rule, ..config }));
            }
            for preset in Preset::ALL.into_iter().filter(|preset| preset.has_gradients()) {
                for (gradient_source, forward_motion) in GRADIENT_SOURCES {
                    all.push(declare(&Config { preset, gradient_source, forward_motion, ..config }));
                    let with_all = Config { preset, gradient_source, firefly_filter: true, volume: true, ..config };
                    all.push(declare(&with_all));
                }
            }
        }
    }
}

fn dispatches(declaration: &Declaration) -> impl Iterator<Item = (&PassDecl, &Dispatch)> {
    declaration.passes().iter().filter_map(|p| p.dispatch().map(|d| (p, d)))
}

/// Each binding of a pass, with what is wired to it.
fn wired(pass: &PassDecl) -> impl Iterator<Item = (&ShaderBinding, Option<&Use>)> {
    let dispatch = pass.dispatch().expect("a dispatch");
    let slots = dispatch.shader.bindings.iter().zip(&dispatch.slots);
    slots.map(|(binding, slot)| (binding, slot.wired.map(|i| &pass.uses[i])))
}

#[test]
fn uses_equal_the_bindings_in_order_access_and_format() {
    for declaration in declarations() {
        for (pass, dispatch) in dispatches(declaration) {
            let numbers: Vec<u32> = pass.bindings().map(|(number, _)| number).collect();
            assert_eq!(numbers.len(), pass.uses.len(), "{}", pass.name);
            assert!(numbers.is_sorted() && dispatch.shader.bindings.len() <= MAX_BINDINGS, "{}", pass.name);
            for (binding, used) in wired(pass) {
                let Some(used) = used else {
                    assert!(binding.optional, "{}: {}", pass.name, binding.name);
                    continue;
                };
                let resource = declaration.resource(used.resource);
                let what = format!("{}: {} bound to {}", pass.name, resource.name, binding.name);
                assert_eq!(used.access, Access::of(binding.kind), "{what}");
                match (binding.kind, resource.shape) {
                    (BindingKind::SampledImage(component), Shape::Image { format, .. }) => {
                        assert_eq!(crate::contract::component_of(format.preferred()), Some(component), "{what}");
                    }
                    (BindingKind::StorageImage(texel, _), Shape::Image { format, .. }) => {
                        assert_eq!(format, ImageFormat::Exactly(vk_format(texel)), "{what}");
                    }
                    (BindingKind::UniformBuffer | BindingKind::StorageBuffer(_), Shape::Buffer { .. }) => {}
                    _ => panic!("{what}: an image and a buffer"),
                }
            }
        }
    }
}

#[test]
fn what_stands_in_for_a_binding_is_always_there_and_of_its_kind() {
    for declaration in declarations() {
        for (pass, dispatch) in dispatches(declaration) {
            for (binding, slot) in dispatch.shader.bindings.iter().zip(&dispatch.slots).filter(|(b, _)| b.optional) {
                let (other, used) = wired(pass).find(|(_, u)| u.is_some_and(|u| *u == pass.uses[slot.stand_in])).expect("a use");
                let lifetime = declaration.resource(used.expect("a use").resource).lifetime;
                assert!(other.kind.stands_in_for(binding.kind), "{}: {} for {}", pass.name, other.name, binding.name);
                assert_ne!(lifetime, crate::Lifetime::Input { optional: true }, "{}: {}", pass.name, other.name);
            }
        }
    }
}

/// Holds names of bindings to those of the resources at them, but for signals by number, ports of filters and images in place.
#[test]
fn names_of_bindings_match_those_of_resources() {
    const RENAMED: [(&str, &[&str]); 30] = [
        ("frame", &["frame_constants"]),
        ("input", &["irradiance", "filled_irradiance", "estimate", "atrous_", "denoised_volume"]),
        ("output", &["atrous_", "irradiance_history", "denoised_volume"]),
        ("irradiance", &["filled_irradiance", "accumulated"]),
        ("compared", &["noisy_"]),
        ("noisy", &["irradiance", "filled_irradiance"]),
        ("holed", &["irradiance"]),
        ("filled", &["filled_irradiance"]),
        ("history", &["irradiance_history"]),
        ("radiance", &["denoised_", "irradiance"]),
        ("denoised_radiance", &["denoised_volume"]),
        ("filtered", &["atrous_", "irradiance_history", "upsampled"]),
        ("upsampled", &["denoised_visibility"]),
        ("denoised_visibility", &["filtered_visibility"]),
        ("estimate", &["irradiance_history"]),
        ("gradient_in", &["gradient"]),
        ("gradient_out", &["gradient_even", "gradient_odd"]),
        ("before_in", &["light_before"]),
        ("before_out", &["light_before_even", "light_before_odd"]),
        ("now_in", &["light_now"]),
        ("now_out", &["light_now_even", "light_now_odd"]),
        ("light_ratio", &["light_before_even"]),
        ("other_confidence", &["history_confidence"]),
        ("filter_in", &["visibility_history", "visibility_even", "visibility_odd"]),
        ("filter_out", &["visibility_even", "visibility_odd"]),
        ("noisy_visibility", &["noisy_ambient"]),
        ("occluder_distance", &["ambient_distance"]),
        ("denoised_visibility", &["denoised_ambient"]),
        ("filter_in_colours", &["visibility_history_colours", "visibility_even_colours", "visibility_odd_colours"]),
        ("filter_out_colours", &["visibility_even_colours", "visibility_odd_colours"]),
    ];
    let unshared = |config: &Config| config.graph().expect("valid").share_outputs(false).finish().expect("valid");
    for declaration in declarations_with(unshared) {
        for (pass, _) in dispatches(&declaration) {
            for ((_, binding), used) in pass.bindings().zip(&pass.uses) {
                let name = binding.trim_end_matches("_0").trim_end_matches("_1").trim_end_matches("_2");
                let previous = name.strip_prefix("previous_").filter(|_| used.frame == UseFrame::Previous);
                let resource = &declaration.resource(used.resource).name;
                let name = previous.unwrap_or(name);
                let renamed = RENAMED.iter().any(|(of, to)| *of == name && to.iter().any(|to| resource.starts_with(to)));
                let same = resource.starts_with(name) || resource.ends_with(name);
                let special = name == "noisy" && resource == "other_denoised_radiance";
                let packed = name == "object_normal" && resource == "object_normal_guide";
                let display = name == "tone_mapped" && resource == "display";
                assert!(renamed || same || special || packed || display, "{}: {resource} bound to {binding}", pass.name);
            }
        }
    }
}

#[test]
fn every_variant_belongs_to_a_configuration() {
    let used: BTreeSet<_> =
        declarations().iter().flat_map(|d| dispatches(d).map(|(_, d)| d.shader.name.clone()).collect::<Vec<_>>()).collect();
    let all: BTreeSet<_> = ALL.iter().map(|s| s.name.clone()).collect();
    assert_eq!(used, all);
}

#[test]
fn a_pass_is_free_of_hazards_inside() {
    for declaration in declarations() {
        for pass in declaration.passes() {
            for (i, a) in pass.uses.iter().enumerate() {
                for b in &pass.uses[..i] {
                    let in_place = declaration.resource(a.resource).lifetime == crate::Lifetime::HistoryInPlace;
                    let same_copy = a.resource == b.resource && (a.frame == b.frame || in_place);
                    let same_copy = same_copy && (a.access.writes() || b.access.writes());
                    assert!(!same_copy, "{} uses {} twice", pass.name, declaration.resource(a.resource).name);
                }
            }
        }
    }
}

#[test]
fn histories_and_transients_live_as_declared() {
    for declaration in declarations() {
        for (i, resource) in declaration.resources().iter().enumerate() {
            let uses: Vec<_> = declaration.passes().iter().flat_map(|p| &p.uses).filter(|u| u.resource.0 as usize == i).collect();
            let first = uses.first().unwrap_or_else(|| panic!("{} is never used", resource.name));
            let previous_after_write = uses.iter().skip_while(|u| !u.access.writes()).any(|u| u.frame == UseFrame::Previous);
            match resource.lifetime {
                crate::Lifetime::Input { .. } => assert!(uses.iter().all(|u| !u.access.writes()), "{}", resource.name),
                crate::Lifetime::Output | crate::Lifetime::Transient => {
                    assert!(!first.access.reads(), "{} is read before it is written", resource.name);
                }
                crate::Lifetime::HistoryInPlace => assert!(!previous_after_write, "{}", resource.name),
                crate::Lifetime::History => assert!(uses.iter().any(|u| u.frame == UseFrame::Previous), "{}", resource.name),
            }
            if !resource.lifetime.is_history() {
                assert!(uses.iter().all(|u| u.frame == UseFrame::Current), "{}", resource.name);
            }
        }
    }
}

/// Shaders that are compiled, and what they include.
fn glsl_sources() -> Vec<(String, String)> {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("glsl");
    let paths = [root.clone(), root.join("include")].into_iter().flat_map(|folder| {
        std::fs::read_dir(&folder).expect("sources").map(|entry| entry.expect("an entry").path()).filter(|path| path.is_file())
    });
    paths.map(|path| (path.display().to_string(), std::fs::read_to_string(&path).expect("text"))).collect()
}

/// The unpacker around each fetch of an image, and the image: `unpack_luminance_history(texelFetch(previous_luminance_history, ...))`.
fn unpacked_fetches(text: &str) -> impl Iterator<Item = (&str, &str)> {
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    ["texelFetch(", "packed_at(", "texel_at(", "imageLoad("].into_iter().flat_map(move |fetch| {
        text.match_indices(fetch).filter_map(move |(at, _)| {
            let around = text[..at].strip_suffix('(')?;
            let unpacker = &around[around.rfind(|c| !is_name(c)).map_or(0, |end| end + 1)..];
            let image = &text[at + fetch.len()..];
            Some((unpacker, &image[..image.find(|c| !is_name(c))?]))
        })
    })
}

/// An unpacker has the name of the image that it is for, so that no image is read as another one.
#[test]
fn images_are_unpacked_as_what_they_are() {
    const OTHERS: [(&str, &str); 7] = [
        ("GuideBits", "guide"),
        ("GuideBits", "gradient_guide"),
        ("PointBits", "points"),
        ("unpack_image_share", "reflection"),
        ("unpack_noisy_luminance", "luminance"),
        ("unpack_noisy_red_blue", "red_blue"),
        ("unpack_block_percentiles", "blocks"),
    ];
    let mut unpackers = BTreeSet::new();
    for (path, text) in glsl_sources() {
        for (unpacker, image) in unpacked_fetches(&text) {
            let image = image.trim_start_matches("previous_").trim_end_matches("_0").trim_end_matches("_1");
            let is_unpacker = unpacker.starts_with("unpack") || unpacker.ends_with("Bits");
            let fits = unpacker.strip_prefix("unpack_") == Some(image) || OTHERS.contains(&(unpacker, image));
            assert!(fits || !is_unpacker, "{path}: {image} is unpacked by {unpacker}");
            unpackers.extend(fits.then(|| unpacker.to_owned()));
        }
    }
    assert!(unpackers.len() > 12, "{unpackers:?}");
}
