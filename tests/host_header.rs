//! The header for hosts' shaders compiles as its own worked example says.

use atrous_harness::DeviceTest;
use shaderc::{CompileOptions, Compiler, EnvVersion, ResolvedInclude, ShaderKind, SourceLanguage, TargetEnv};

pub const TESTS: &[DeviceTest] = &[
    ("the_worked_example_compiles_with_every_stratum_size", the_worked_example_compiles_with_every_stratum_size),
    ("a_missing_image_is_named", a_missing_image_is_named),
    ("the_example_in_hlsl_compiles_with_every_stratum_size", the_example_in_hlsl_compiles_with_every_stratum_size),
];

const HEADER: &str = include_str!("../glsl/host/gradient_sample.glsl");
const HLSL_HEADER: &str = include_str!("../glsl/host/gradient_sample.hlsl");

/// What the example leaves to the host.
const HOST: &str = "
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 1, binding = 1) uniform utexture2D previous_surfaces;
layout(set = 1, binding = 2) uniform utexture2D previous_seeds;
layout(set = 1, binding = 3, rgba32ui) uniform writeonly uimage2D surfaces;
layout(set = 1, binding = 4, r32ui) uniform writeonly uimage2D seeds;
layout(set = 1, binding = 5, rgba16f) uniform writeonly image2D noisy_radiance;
const uint frame_index = 1u;
uvec4 trace_primary_ray(ivec2 pixel) { return uvec4(pixel, 0u, 0u); }
uint hash(ivec2 pixel, uint frame) { return uint(pixel.x) ^ uint(pixel.y) ^ frame; }
vec3 shade(uvec4 surface, uint seed) { return vec3(surface.xyz ^ seed); }
";

/// The same in HLSL.
const HLSL_HOST: &str = "
[[vk::binding(1, 1)]] Texture2D<uint4> previous_surfaces;
[[vk::binding(2, 1)]] Texture2D<uint4> previous_seeds;
[[vk::binding(3, 1)]] RWTexture2D<uint4> surfaces;
[[vk::binding(4, 1)]] RWTexture2D<uint> seeds;
[[vk::binding(5, 1)]] RWTexture2D<float4> noisy_radiance;
static const uint frame_index = 1;
uint4 trace_primary_ray(int2 pixel) { return uint4(pixel, 0, 0); }
uint hash(int2 pixel, uint frame) { return uint(pixel.x) ^ uint(pixel.y) ^ frame; }
float3 shade(uint4 surface, uint seed) { return float3(surface.xyz ^ seed); }
";

/// The lines of the example in the head comment of a header, with what it leaves to the host in front of `main`.
fn with_host(header: &str, host: &str, main: &str) -> String {
    let lines: Vec<_> = header.lines().take_while(|l| l.starts_with("//")).filter_map(|l| l.strip_prefix("//     ")).collect();
    let main = lines.iter().position(|l| l.starts_with(main)).expect("the example has a main");
    assert!(lines.iter().any(|l| l.contains("atrous_gradient_sample(")), "the example calls the header's function");
    let join = |lines: &[&str]| lines.join("\n");
    format!("{}\n{host}\n{}\n", join(&lines[..main]), join(&lines[main..]))
}

fn example() -> String {
    let extension = "#extension GL_GOOGLE_include_directive : require";
    format!("#version 450\n{extension}\n{}", with_host(HEADER, HOST, "void main"))
}

fn compile(source: &str, stratum_size: u32) -> Result<(), String> {
    compile_as(SourceLanguage::GLSL, source, stratum_size)
}

fn compile_as(language: SourceLanguage, source: &str, stratum_size: u32) -> Result<(), String> {
    let mut options = CompileOptions::new().expect("options");
    options.set_source_language(language);
    options.set_target_env(TargetEnv::Vulkan, EnvVersion::Vulkan1_1 as u32);
    options.set_warnings_as_errors();
    options.add_macro_definition("STRATUM_SIZE", Some(&stratum_size.to_string()));
    options.set_include_callback(|name, _, _, _| match name {
        "gradient_sample.glsl" => Ok(ResolvedInclude { resolved_name: name.into(), content: HEADER.into() }),
        "gradient_sample.hlsl" => Ok(ResolvedInclude { resolved_name: name.into(), content: HLSL_HEADER.into() }),
        _ => Err(format!("the example includes {name}")),
    });
    let compiled =
        Compiler::new().expect("shaderc").compile_into_spirv(source, ShaderKind::Compute, "example", "main", Some(&options));
    compiled.map(|_| ()).map_err(|e| e.to_string())
}

fn the_worked_example_compiles_with_every_stratum_size() {
    for size in 2..=4 {
        compile(&example(), size).unwrap_or_else(|e| panic!("strata of {size}:\n{e}\n{}", example()));
    }
}

fn a_missing_image_is_named() {
    let without = example().replace("#define ATROUS_GRADIENT_SAMPLES gradient_samples", "");
    let message = compile(&without, 3).expect_err("nothing to read from");
    assert!(message.contains("define ATROUS_GRADIENT_SAMPLES"), "{message}");
}

fn the_example_in_hlsl_compiles_with_every_stratum_size() {
    let example = with_host(HLSL_HEADER, HLSL_HOST, "[numthreads");
    for size in 2..=4 {
        compile_as(SourceLanguage::HLSL, &example, size).unwrap_or_else(|e| panic!("strata of {size}:\n{e}\n{example}"));
    }
    let without = example.replace("#define ATROUS_GRADIENT_SAMPLES gradient_samples", "");
    let message = compile_as(SourceLanguage::HLSL, &without, 3).expect_err("nothing to read from");
    assert!(message.contains("define ATROUS_GRADIENT_SAMPLES"), "{message}");
}
