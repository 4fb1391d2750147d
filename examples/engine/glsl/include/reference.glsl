// Ground truth: the estimator of lighting.glsl over many samples of each pixel, with Owen-scrambled Sobol' points
// in place of independent random numbers. Adds one sample to float32 sums. A dispatch for each, and no loop over a count that the host
// gives: software drivers compile such a shader again for every count.
// In: visibility. In and out: direct_sum, indirect_sum (rgb: linear radiance times samples, a: samples).
#ifndef REFERENCE_GLSL
#define REFERENCE_GLSL
#define RANDOM_SOBOL
#include "pixel_sample.glsl"
#include "pixel_lighting.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 1, binding = 2, rgba32f) uniform image2D direct_sum_image;
layout(set = 1, binding = 3, rgba32f) uniform image2D indirect_sum_image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(frame.extent_frame_seed.xy)))) return;
    vec4 direct = imageLoad(direct_sum_image, pixel);
    vec4 indirect = imageLoad(indirect_sum_image, pixel);
    PixelSample pixel_sample = fetch_pixel_sample(pixel, pixel);
    Rng rng = rng_new(pixel_sample.seed ^ REFERENCE_SEED, uint(direct.a));
    PixelLighting lighting = light_pixel(pixel, pixel_sample, 0u, rng);
    imageStore(direct_sum_image, pixel, direct + vec4(lighting.direct, 1.0));
    imageStore(indirect_sum_image, pixel, indirect + vec4(lighting.indirect, 1.0));
}

#endif
