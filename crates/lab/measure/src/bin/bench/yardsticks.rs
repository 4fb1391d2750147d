//! What the device can do, measured beside the graphs: a copy of an image, and a loop of arithmetic.

use atrous::graph::{Graph, Irradiance, Stage};
use atrous::Declaration;
use std::error::Error;

/// Fused multiply-adds of a pixel in the arithmetic loop.
pub const MULTIPLY_ADDS: u32 = 1024;

const HEAD: &str = "#version 450
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;
";

/// A copy of an image: 8 bytes read and 8 written a pixel.
pub fn copy(size: [u32; 2]) -> Result<Declaration, Box<dyn Error>> {
    let source = format!(
        "{HEAD}layout(set = 0, binding = 0) uniform texture2D source;
        layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D copied;
        void main() {{
            ivec2 p = ivec2(gl_GlobalInvocationID.xy);
            if (all(lessThan(p, imageSize(copied)))) imageStore(copied, p, texelFetch(source, p, 0));
        }}"
    );
    let stage = Stage::new("copy", &compile(&source)?)?;
    let mut g = Graph::new(size);
    let written = g.stage(&stage).input("source", "noisy_radiance").add();
    g.output("copied", &Irradiance::of(written.written("copied")));
    Ok(g.finish()?)
}

/// A loop of [`MULTIPLY_ADDS`] a pixel, unrolled: one behind the other in four chains. Writes 4 bytes a pixel.
pub fn arithmetic(size: [u32; 2]) -> Result<Declaration, Box<dyn Error>> {
    let body = "v = fma(v, vec4(0.999), vec4(0.001));\n".repeat(MULTIPLY_ADDS as usize / 4);
    let source = format!(
        "{HEAD}layout(set = 0, binding = 0, r32f) uniform writeonly image2D computed;
        void main() {{
            ivec2 p = ivec2(gl_GlobalInvocationID.xy);
            if (any(greaterThanEqual(p, imageSize(computed)))) return;
            vec4 v = vec4(p.x, p.y, p.x + p.y, p.x - p.y);
            {body}
            imageStore(computed, p, vec4(v.x + v.y + v.z + v.w));
        }}"
    );
    let stage = Stage::new("arithmetic", &compile(&source)?)?;
    let mut g = Graph::new(size);
    let written = g.stage(&stage).add();
    g.output("computed", &Irradiance::of(written.written("computed")));
    Ok(g.finish()?)
}

/// SPIR-V with its names, since bindings are matched by them.
fn compile(source: &str) -> Result<Vec<u32>, Box<dyn Error>> {
    let mut options = shaderc::CompileOptions::new()?;
    options.set_target_env(shaderc::TargetEnv::Vulkan, shaderc::EnvVersion::Vulkan1_1 as u32);
    let kind = shaderc::ShaderKind::Compute;
    Ok(shaderc::Compiler::new()?.compile_into_spirv(source, kind, "yardstick", "main", Some(&options))?.as_binary().to_vec())
}
