#version 450
// Ambient occlusion at one ray per pixel of light: see include/ambient.glsl.
// In: visibility, seed. Out: noisy_ambient: 0 where something is near, else 1; ambient_distance: how far away it is, scene units, else 0.
#extension GL_GOOGLE_include_directive : require
#include "ambient.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 1, binding = 2, r32f) uniform writeonly image2D noisy_ambient_image;
layout(set = 1, binding = 3, r32f) uniform writeonly image2D ambient_distance_image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, light_extent()))) return;
    ivec2 seen = seen_pixel_of(pixel);
    Visibility visibility = fetch_visibility(seen);
    float hit = 0.0;
    if (visibility.instance != NO_INSTANCE) {
        Rng rng = rng_of_pixel(imageLoad(seed_image, seen).r, AMBIENT_SEED);
        hit = ambient_hit(surface_at(visibility, frame.camera.eye.xyz), rng);
    }
    imageStore(noisy_ambient_image, pixel, vec4(hit > 0.0 ? 0.0 : 1.0));
    imageStore(ambient_distance_image, pixel, vec4(hit));
}
