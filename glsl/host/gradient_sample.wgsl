// For a host's path tracer in WGSL: which pixels of this frame repeat a sample of the previous frame, so that the denoiser sees how light
// changed. What the host has to do, and what it must not do: gradient_sample.glsl, which this is a translation of. WGSL has no includes: put
// this text before the shader's own, which then gives the two names that it uses.
//
// A worked example, for strata of 3x3 pixels (Config::stratum_size); `surfaces` and `seeds` are the host's own images.
//
//     const atrous_stratum_size: i32 = 3;
//     @group(1) @binding(0) var atrous_gradient_samples: texture_2d<u32>;
//
//     @compute @workgroup_size(8, 8)
//     fn main(@builtin(global_invocation_id) id: vec3<u32>) {
//         let pixel = vec2<i32>(id.xy);
//         var surface = trace_primary_ray(pixel);                  // instance, triangle, barycentrics
//         var seed = hash(pixel, frame_index);
//         let repeated = atrous_gradient_sample(pixel);
//         if (repeated.is_sample) {
//             surface = textureLoad(previous_surfaces, repeated.previous_pixel, 0);
//             seed = textureLoad(previous_seeds, repeated.previous_pixel, 0).x;
//         }
//         textureStore(surfaces, pixel, surface);
//         textureStore(seeds, pixel, vec4<u32>(seed));
//         textureStore(noisy_radiance, pixel, vec4<f32>(shade(surface, seed), 1.0)); // light of this frame, for its eye
//     }

struct AtrousGradientSample {
    is_sample: bool,
    previous_pixel: vec2<i32>,
}

// Whether `pixel` repeats a sample of the previous frame, and of which pixel there.
fn atrous_gradient_sample(pixel: vec2<i32>) -> AtrousGradientSample {
    let stratum = pixel / atrous_stratum_size;
    let offset = pixel - stratum * atrous_stratum_size;
    let texel = textureLoad(atrous_gradient_samples, stratum, 0);
    let place = u32(1 + offset.x + offset.y * atrous_stratum_size);
    return AtrousGradientSample(texel.z == place, vec2<i32>(texel.xy));
}
