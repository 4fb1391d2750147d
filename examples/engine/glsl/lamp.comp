#version 450
// A lamp at one shadow ray per pixel of light, apart from the path: see include/lamp.glsl.
// In: visibility, seed. Out: noisy_visibility: 0 to 1, rgb; occluder_distance: along the ray, scene units, 0 where nothing is in the way;
// occluder_id: surface_id of what is; unshadowed_direct, of every pixel: linear radiance that the surface reflects where nothing is.
#extension GL_GOOGLE_include_directive : require
#include "lamp.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 1, binding = 2, rgba16f) uniform writeonly image2D noisy_visibility_image;
layout(set = 1, binding = 3, r32f) uniform writeonly image2D occluder_distance_image;
layout(set = 1, binding = 4, rgba32f) uniform writeonly image2D unshadowed_direct_image;
layout(set = 1, binding = 5, r32ui) uniform writeonly uimage2D occluder_id_image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(frame.extent_frame_seed.xy)))) return;
    ivec2 lit = pixel / ivec2(frame.light.xy);
    bool traced = seen_pixel_of(lit) == pixel;
    Visibility visibility = fetch_visibility(pixel);
    LampSample lamp = LampSample(vec3(1.0), 0.0, 0u, vec3(0.0));
    if (visibility.instance != NO_INSTANCE) {
        Rng rng = rng_of_pixel(imageLoad(seed_image, pixel).r, lamp_seed());
        lamp = sample_visible_lamp(surface_at(visibility, frame.camera.eye.xyz), traced, rng);
    }
    imageStore(unshadowed_direct_image, pixel, vec4(lamp.unshadowed, 1.0));
    if (!traced) return;
    imageStore(noisy_visibility_image, lit, vec4(lamp.visibility, 1.0));
    imageStore(occluder_distance_image, lit, vec4(lamp.occluder_distance));
    imageStore(occluder_id_image, lit, uvec4(lamp.occluder_id));
}
