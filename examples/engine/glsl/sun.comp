#version 450
// The sun at one shadow ray per pixel, apart from the path: see include/sun.glsl.
// In: visibility, seed. Out: noisy_visibility: 0 or 1; occluder_distance: along the ray, scene units, 0 where nothing is in the way;
// occluder_id: surface_id of what is; unshadowed_direct: linear radiance that the surface reflects where nothing is.
#extension GL_GOOGLE_include_directive : require
#include "sun.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 1, binding = 2, r32f) uniform writeonly image2D noisy_visibility_image;
layout(set = 1, binding = 3, r32f) uniform writeonly image2D occluder_distance_image;
layout(set = 1, binding = 4, rgba32f) uniform writeonly image2D unshadowed_direct_image;
layout(set = 1, binding = 5, r32ui) uniform writeonly uimage2D occluder_id_image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(frame.extent_frame_seed.xy)))) return;
    Visibility visibility = fetch_visibility(pixel);
    SunSample sun = SunSample(1.0, 0.0, 0u, vec3(0.0));
    if (visibility.instance != NO_INSTANCE) {
        Rng rng = rng_of_pixel(imageLoad(seed_image, pixel).r, SUN_SEED);
        sun = sample_visible_sun(surface_at(visibility, frame.camera.eye.xyz), rng);
    }
    imageStore(noisy_visibility_image, pixel, vec4(sun.visibility));
    imageStore(occluder_distance_image, pixel, vec4(sun.occluder_distance));
    imageStore(occluder_id_image, pixel, uvec4(sun.occluder_id));
    imageStore(unshadowed_direct_image, pixel, vec4(sun.unshadowed, 1.0));
}
