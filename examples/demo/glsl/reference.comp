#version 450
// Ground truth: the estimator of path_trace.comp over many samples of each pixel, with Owen-scrambled Sobol' points
// in place of independent random numbers. Adds `sample_count` samples from `first_sample` on to float32 sums.
// In: visibility. In and out: direct_sum, indirect_sum (linear radiance times samples).
#extension GL_GOOGLE_include_directive : require
#define RANDOM_SOBOL
#include "pixel_sample.glsl"
#include "path.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 1, binding = 2, rgba32f) uniform image2D direct_sum_image;
layout(set = 1, binding = 3, rgba32f) uniform image2D indirect_sum_image;
layout(push_constant) uniform Range {
    uint first_sample;
    uint sample_count;
    uint seed;
} range;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(frame.extent_frame_seed.xy)))) return;
    vec3 direct = range.first_sample == 0u ? vec3(0.0) : imageLoad(direct_sum_image, pixel).rgb;
    vec3 indirect = range.first_sample == 0u ? vec3(0.0) : imageLoad(indirect_sum_image, pixel).rgb;
    PixelSample pixel_sample = fetch_pixel_sample(pixel);
    if (pixel_sample.visibility.instance != NO_INSTANCE) {
        Surface s = surface_at(pixel_sample.visibility, frame.camera.eye.xyz);
        for (uint i = range.first_sample; i < range.first_sample + range.sample_count; i++) {
            Rng rng = rng_new(pixel_sample.seed ^ range.seed, i);
            Lighting lighting = trace_path(s, frame.camera.eye.xyz, rng);
            direct += lighting.direct;
            indirect += lighting.indirect;
        }
    }
    imageStore(direct_sum_image, pixel, vec4(direct, 1.0));
    imageStore(indirect_sum_image, pixel, vec4(indirect, 1.0));
}
