// Lighting at one path per pixel, from the pixel's visibility sample and seed: path_trace.comp, and path_trace_reshaded.comp with RESHADE.
// In: visibility, seed. Out: direct (scattered once), indirect (scattered twice): linear radiance, whose sum with the emission of the G-buffer is
// the picture; scattered: direct + indirect. The same as diffuse + specular, with hit_distance: how far away is what is seen in the surface, scene
// units, 0: beyond the scene; hit_id: its surface_id, 0: none; specular_motion: previous - current place of it, world space.
#ifndef LIGHTING_GLSL
#define LIGHTING_GLSL
#include "pixel_lighting.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 1, binding = 2, rgba32f) uniform writeonly image2D direct_image;
layout(set = 1, binding = 3, rgba32f) uniform writeonly image2D indirect_image;
layout(set = 1, binding = 4, rgba32f) uniform writeonly image2D scattered_image;
layout(set = 1, binding = 5, rgba32f) uniform writeonly image2D diffuse_image;
layout(set = 1, binding = 6, rgba32f) uniform writeonly image2D specular_image;
layout(set = 1, binding = 7, r32f) uniform writeonly image2D hit_distance_image;
layout(set = 1, binding = 8, r32ui) uniform writeonly uimage2D hit_id_image;
layout(set = 1, binding = 9, rgba32f) uniform writeonly image2D specular_motion_image;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, light_extent()))) return;
    ivec2 seen_pixel = seen_pixel_of(pixel);
    PixelSample pixel_sample = fetch_pixel_sample(pixel, seen_pixel);
    Rng rng = rng_of_pixel(pixel_sample.seed, 0u);
    PixelLighting lighting = light_pixel(seen_pixel, pixel_sample, frame.counts.w, rng);
    imageStore(direct_image, pixel, vec4(lighting.direct, 1.0));
    imageStore(indirect_image, pixel, vec4(lighting.indirect, 1.0));
    vec3 scattered = lighting.direct + lighting.indirect;
    imageStore(scattered_image, pixel, vec4(scattered, 1.0));
    imageStore(diffuse_image, pixel, vec4(max(scattered - lighting.specular, 0.0), 1.0));
    imageStore(specular_image, pixel, vec4(lighting.specular, 1.0));
    imageStore(hit_distance_image, pixel, vec4(lighting.seen.distance < 1.0e9 ? lighting.seen.distance : 0.0));
    imageStore(hit_id_image, pixel, uvec4(lighting.seen.surface_id));
    imageStore(specular_motion_image, pixel, vec4(lighting.moved, 0.0));
}

#endif
