#version 450
// Ground truth of a lamp's visibility: the estimator of lamp.comp over many rays of each pixel, as reference.comp has it for light.
// In: visibility, seed. In and out: lamp_sum (rgb: visibility times samples, a: samples).
#extension GL_GOOGLE_include_directive : require
#define RANDOM_SOBOL
#include "lamp.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 1, binding = 2, rgba32f) uniform image2D lamp_sum_image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(frame.extent_frame_seed.xy)))) return;
    vec4 sum = imageLoad(lamp_sum_image, pixel);
    Visibility visibility = fetch_visibility(pixel);
    vec3 seen = vec3(1.0);
    if (visibility.instance != NO_INSTANCE) {
        Rng rng = rng_new(imageLoad(seed_image, pixel).r ^ REFERENCE_SEED ^ lamp_seed(), uint(sum.a));
        seen = sample_visible_lamp(surface_at(visibility, frame.camera.eye.xyz), true, rng).visibility;
    }
    imageStore(lamp_sum_image, pixel, sum + vec4(seen, 1.0));
}
