#version 450
// Ground truth of the medium: the estimator of volume.comp over many samples of each pixel, as reference.comp has it for surfaces.
// In: seed, depth. In and out: volume_sum (rgb: linear radiance times samples, a: samples).
#extension GL_GOOGLE_include_directive : require
#define RANDOM_SOBOL
#include "medium.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 1, binding = 0, r32ui) uniform readonly uimage2D seed_image;
layout(set = 1, binding = 1, r32f) uniform readonly image2D depth_image;
layout(set = 1, binding = 2, rgba32f) uniform image2D volume_sum_image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(frame.extent_frame_seed.xy)))) return;
    vec4 sum = imageLoad(volume_sum_image, pixel);
    uint seed = imageLoad(seed_image, pixel).r ^ REFERENCE_SEED ^ MEDIUM_SEED;
    float depth = imageLoad(depth_image, pixel).r;
    vec2 position = vec2(pixel) + 0.5 + frame.jitter_epsilon_weight.xy;
    Rng rng = rng_new(seed, uint(sum.a));
    imageStore(volume_sum_image, pixel, sum + vec4(scatter_once(position, depth, rng).radiance, 1.0));
}
