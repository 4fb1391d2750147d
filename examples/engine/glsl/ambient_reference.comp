#version 450
// Ground truth of ambient occlusion: the estimator of ambient.comp over many rays of each pixel, as reference.comp has it for light.
// In: visibility, seed. In and out: ambient_sum (r: ambient times samples, a: samples).
#extension GL_GOOGLE_include_directive : require
#define RANDOM_SOBOL
#include "ambient.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 1, binding = 2, rgba32f) uniform image2D ambient_sum_image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(frame.extent_frame_seed.xy)))) return;
    vec4 sum = imageLoad(ambient_sum_image, pixel);
    Visibility visibility = fetch_visibility(pixel);
    float open = 1.0;
    if (visibility.instance != NO_INSTANCE) {
        Rng rng = rng_new(imageLoad(seed_image, pixel).r ^ REFERENCE_SEED ^ AMBIENT_SEED, uint(sum.a));
        open = ambient_hit(surface_at(visibility, frame.camera.eye.xyz), rng) > 0.0 ? 0.0 : 1.0;
    }
    imageStore(ambient_sum_image, pixel, sum + vec4(open, 0.0, 0.0, 1.0));
}
