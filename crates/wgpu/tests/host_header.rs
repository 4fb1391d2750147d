//! The header for hosts' shaders in WGSL is valid as its own worked example says.

use naga::valid::{Capabilities, ValidationFlags, Validator};

const HEADER: &str = include_str!("../../../glsl/host/gradient_sample.wgsl");

/// What the example leaves to the host.
const HOST: &str = "
@group(1) @binding(1) var previous_surfaces: texture_2d<u32>;
@group(1) @binding(2) var previous_seeds: texture_2d<u32>;
@group(1) @binding(3) var surfaces: texture_storage_2d<rgba32uint, write>;
@group(1) @binding(4) var seeds: texture_storage_2d<r32uint, write>;
@group(1) @binding(5) var noisy_radiance: texture_storage_2d<rgba16float, write>;
const frame_index: u32 = 1u;
fn trace_primary_ray(pixel: vec2<i32>) -> vec4<u32> { return vec4<u32>(vec2<u32>(pixel), 0u, 0u); }
fn hash(pixel: vec2<i32>, frame: u32) -> u32 { return u32(pixel.x) ^ u32(pixel.y) ^ frame; }
fn shade(surface: vec4<u32>, seed: u32) -> vec3<f32> { return vec3<f32>(surface.xyz ^ vec3<u32>(seed)); }
";

fn example(stratum_size: u32) -> String {
    let comment = HEADER.lines().take_while(|line| line.starts_with("//"));
    let lines: Vec<_> = comment.filter_map(|line| line.strip_prefix("//     ")).collect();
    let code = lines.join("\n").replace("atrous_stratum_size: i32 = 3", &format!("atrous_stratum_size: i32 = {stratum_size}"));
    assert!(code.contains(&format!("i32 = {stratum_size};")) && code.contains("atrous_gradient_sample("), "{code}");
    format!("{HEADER}\n{code}\n{HOST}")
}

fn problem(source: &str) -> Option<String> {
    let module = match naga::front::wgsl::parse_str(source) {
        Ok(module) => module,
        Err(error) => return Some(error.emit_to_string(source)),
    };
    let validated = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&module);
    validated.err().map(|error| format!("{error:?}"))
}

#[test]
fn the_worked_example_is_valid_with_every_stratum_size() {
    for size in 2..=4 {
        assert_eq!(problem(&example(size)), None, "strata of {size}");
    }
}

#[test]
fn a_missing_image_is_named() {
    let without = example(3).replace("@group(1) @binding(0) var atrous_gradient_samples: texture_2d<u32>;", "");
    assert!(problem(&without).is_some_and(|problem| problem.contains("atrous_gradient_samples")));
}
