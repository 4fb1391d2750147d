// Lighting at one path per pixel, from the pixel's visibility sample and seed: path_trace.comp, and path_trace_reshaded.comp with RESHADE.
// In: visibility, seed. Out: direct (scattered once), indirect (scattered twice), emission (seen directly; no noise):
// linear radiance, whose sum is the picture; scattered: direct + indirect. The same as diffuse + specular, with hit_distance: how far
// away is what is seen in the surface, scene units, 0: beyond the scene; and hit_id: its surface_id, 0: none.
#ifndef LIGHTING_GLSL
#define LIGHTING_GLSL
#include "pixel_sample.glsl"
#include "path.glsl"
#include "camera.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 1, binding = 2, rgba32f) uniform writeonly image2D direct_image;
layout(set = 1, binding = 3, rgba32f) uniform writeonly image2D indirect_image;
layout(set = 1, binding = 4, rgba32f) uniform writeonly image2D emission_image;
layout(set = 1, binding = 5, rgba32f) uniform writeonly image2D scattered_image;
layout(set = 1, binding = 6, rgba32f) uniform writeonly image2D diffuse_image;
layout(set = 1, binding = 7, rgba32f) uniform writeonly image2D specular_image;
layout(set = 1, binding = 8, r32f) uniform writeonly image2D hit_distance_image;
layout(set = 1, binding = 9, r32ui) uniform writeonly uimage2D hit_id_image;

vec3 seen_emission(Surface s) { return s.emission * medium_transmittance(distance(frame.camera.eye.xyz, s.position)); }

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(frame.extent_frame_seed.xy)))) return;
    PixelSample pixel_sample = fetch_pixel_sample(pixel);
    Lighting lighting = Lighting(vec3(0.0), vec3(0.0), vec3(0.0), NOTHING_SEEN);
    vec3 emission;
    if (pixel_sample.visibility.instance == NO_INSTANCE) {
        emission = environment(normalize(ray_direction(frame.camera, vec2(pixel) + 0.5 + frame.jitter_epsilon_weight.xy)));
        emission *= medium_transmittance(1.0e30);
    } else {
        Surface s = surface_at(pixel_sample.visibility, pixel_sample.eye);
        emission = seen_emission(s);
        Rng rng = rng_of_pixel(pixel_sample.seed, 0u);
        // The sun that has images of its own is no part of these.
        uint left_out = frame.counts.w != 0u ? frame.counts.z - 1u : NO_LIGHT;
        lighting = trace_path(s, pixel_sample.eye, left_out, rng);
    }
    // What is seen directly is not filtered, so it is this frame's everywhere.
    if (pixel_sample.is_reused) emission = seen_emission(surface_at(fetch_visibility(pixel), frame.camera.eye.xyz));
    imageStore(direct_image, pixel, vec4(lighting.direct, 1.0));
    imageStore(indirect_image, pixel, vec4(lighting.indirect, 1.0));
    imageStore(emission_image, pixel, vec4(emission, 1.0));
    vec3 scattered = lighting.direct + lighting.indirect;
    imageStore(scattered_image, pixel, vec4(scattered, 1.0));
    imageStore(diffuse_image, pixel, vec4(max(scattered - lighting.specular, 0.0), 1.0));
    imageStore(specular_image, pixel, vec4(lighting.specular, 1.0));
    imageStore(hit_distance_image, pixel, vec4(lighting.seen.distance < 1.0e9 ? lighting.seen.distance : 0.0));
    imageStore(hit_id_image, pixel, uvec4(lighting.seen.surface_id));
}

#endif
