#version 450
// The medium at one sample per pixel of light, beside the surfaces' lighting.
// In: seed, depth (linear, scene units; 0: background). Out: noisy_volume: linear radiance that the medium scatters once towards the
// eye; scattering_depth: linear depth at which it does in this sample, chosen by transmittance.
#extension GL_GOOGLE_include_directive : require
#include "medium.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 1, binding = 0, r32ui) uniform readonly uimage2D seed_image;
layout(set = 1, binding = 1, r32f) uniform readonly image2D depth_image;
layout(set = 1, binding = 2, rgba32f) uniform writeonly image2D volume_image;
layout(set = 1, binding = 3, r32f) uniform writeonly image2D scattering_depth_image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, light_extent()))) return;
    ivec2 seen = seen_pixel_of(pixel);
    Rng rng = rng_of_pixel(imageLoad(seed_image, seen).r, MEDIUM_SEED);
    vec2 position = vec2(seen) + 0.5 + frame.jitter_epsilon_weight.xy;
    Scattering scattering = scatter_once(position, imageLoad(depth_image, seen).r, rng);
    imageStore(volume_image, pixel, vec4(scattering.radiance, 1.0));
    imageStore(scattering_depth_image, pixel, vec4(scattering.linear_depth));
}
