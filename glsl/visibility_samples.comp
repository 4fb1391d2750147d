#version 450
// Takes in the visibility of lights, and how far away their occluders are; stops what is no visibility.
// Source: ours. In: guide; of the host noisy_visibility, 0 (occluded) to 1 (lit); occluder_distance, scene units along the shadow ray, 0 or
// infinite where nothing was hit; of further lights the same with _1 to _3 behind.
// Out: visibility_samples: half2(visibility, or 2 for no sample; distance, 0 for none), with signs that tell what the block of 8x8 pixels holds
// (visibility.glsl); sample_colours: half2(green, blue).
// variants: MANY=0,COLOUR=0 MANY=0,COLOUR=1 MANY=1,COLOUR=0 MANY=1,COLOUR=1
// optional: noisy_visibility_1, noisy_visibility_2, noisy_visibility_3, occluder_distance_1, occluder_distance_2, occluder_distance_3
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#if MANY
layout(push_constant) uniform Push {
    uint present;
} push;

#include "optional.glsl"
#endif

#include "frame.glsl"
#include "viewport.glsl"
#include "guide.glsl"
#include "statistics.glsl"
#include "visibility.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint NOISY_VISIBILITY = 3u;
const uint OCCLUDER_DISTANCE = 4u;

layout(set = 0, binding = 2) uniform utexture2D guide;
layout(set = 0, binding = NOISY_VISIBILITY) uniform texture2D noisy_visibility;
layout(set = 0, binding = OCCLUDER_DISTANCE) uniform texture2D occluder_distance;
layout(set = 0, binding = 5, WORDS_FORMAT) uniform writeonly uimage2D visibility_samples;
#if COLOUR
layout(set = 0, binding = 6, WORDS_FORMAT) uniform writeonly uimage2D sample_colours;
#endif
#if MANY
const uint VISIBILITY_OF_OTHERS = COLOUR + 6u;
const uint DISTANCE_OF_OTHERS = COLOUR + 9u;
layout(set = 0, binding = COLOUR + 6) uniform texture2D noisy_visibility_1;
layout(set = 0, binding = COLOUR + 7) uniform texture2D noisy_visibility_2;
layout(set = 0, binding = COLOUR + 8) uniform texture2D noisy_visibility_3;
layout(set = 0, binding = COLOUR + 9) uniform texture2D occluder_distance_1;
layout(set = 0, binding = COLOUR + 10) uniform texture2D occluder_distance_2;
layout(set = 0, binding = COLOUR + 11) uniform texture2D occluder_distance_3;
#endif

// Of surfaces in the block, BLOCK_HAS_LIT and BLOCK_HAS_OCCLUDED of each light.
shared uint seen[MOST_LIGHTS];

vec3 given_visibility(const int light, ivec2 p) {
#if MANY
    if (light > 0 && !is_present(VISIBILITY_OF_OTHERS + uint(light) - 1u)) return vec3(1.0);
    if (light == 1) return texelFetch(noisy_visibility_1, host_pixel(VISIBILITY_OF_OTHERS, p), 0).rgb;
    if (light == 2) return texelFetch(noisy_visibility_2, host_pixel(VISIBILITY_OF_OTHERS + 1u, p), 0).rgb;
    if (light == 3) return texelFetch(noisy_visibility_3, host_pixel(VISIBILITY_OF_OTHERS + 2u, p), 0).rgb;
#endif
    return texelFetch(noisy_visibility, host_pixel(NOISY_VISIBILITY, p), 0).rgb;
}

float given_distance(const int light, ivec2 p) {
#if MANY
    if (light > 0 && !is_present(DISTANCE_OF_OTHERS + uint(light) - 1u)) return 0.0;
    if (light == 1) return texelFetch(occluder_distance_1, host_pixel(DISTANCE_OF_OTHERS, p), 0).x;
    if (light == 2) return texelFetch(occluder_distance_2, host_pixel(DISTANCE_OF_OTHERS + 1u, p), 0).x;
    if (light == 3) return texelFetch(occluder_distance_3, host_pixel(DISTANCE_OF_OTHERS + 2u, p), 0).x;
#endif
    return texelFetch(occluder_distance, host_pixel(OCCLUDER_DISTANCE, p), 0).x;
}

VISIBLE visibility_at(const int light, ivec2 p) {
#if COLOUR
    vec3 v = given_visibility(light, p);
    bool usable = all(greaterThanEqual(v, vec3(0.0))) && all(lessThanEqual(v, vec3(1.0)));
#else
    float v = given_visibility(light, p).x;
    // Not v < 0 || v > 1, which a NaN passes.
    bool usable = v >= 0.0 && v <= 1.0;
#endif
    if (!usable) count_bad(BAD_VISIBILITY);
    return usable ? v : is_finite(v) ? clamp(v, 0.0, 1.0) : VISIBLE(NO_SAMPLE);
}

float distance_at(const int light, ivec2 p) {
    float d = given_distance(light, p);
    if (is_nan(d) || d < 0.0) count_bad(BAD_OCCLUDER_DISTANCE);
    return is_finite(d) && d > 0.0 ? min(d, 65504.0) : 0.0;
}

void take(const int light, ivec2 p, bool is_surface, inout WORDS words, inout WORDS colours) {
    VISIBLE v = is_surface ? visibility_at(light, p) : VISIBLE(1.0);
    if (is_surface && is_sample(v)) {
        if (largest(v) > 0.0) atomicOr(seen[light], BLOCK_HAS_LIT);
        if (largest(1.0 - v) > 0.0) atomicOr(seen[light], BLOCK_HAS_OCCLUDED);
    }
    word_of(words, light) = pack_halves(v, is_surface ? distance_at(light, p) : 0.0);
    word_of(colours, light) = pack_colour_halves(v);
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    bool inside = is_inside(p);
    if (gl_LocalInvocationIndex < MOST_LIGHTS) seen[gl_LocalInvocationIndex] = 0u;
    barrier();
    WORDS words = WORDS(0u), colours = WORDS(0u);
    if (inside) {
        bool is_surface = guide_depth(GuideBits(texelFetch(guide, p, 0))) != 0.0;
        EACH_LIGHT(take(light, p, is_surface, words, colours))
    }
    barrier();
    if (!inside) return;
    EACH_LIGHT(word_of(words, light) |= seen[light])
    imageStore(visibility_samples, p, uvec4(words));
#if COLOUR
    imageStore(sample_colours, p, uvec4(colours));
#endif
}
