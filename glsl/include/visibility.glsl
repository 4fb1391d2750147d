// Packing of visibility, and lengths on a surface, by which penumbrae are measured. Bits: docs/specification/packed_images.md. Twin: src/reference/visibility.rs.
// Of one light a texel is a word. With MANY it has a word for each of up to four lights. With COLOUR a second image of the same format has
// green and blue.
#ifndef VISIBILITY_GLSL
#define VISIBILITY_GLSL
#include "frame.glsl"
#include "view_position.glsl"

#ifndef MANY
#define MANY 0
#endif
#ifndef COLOUR
#define COLOUR 0
#endif

#if MANY
layout(constant_id = 2) const uint LIGHTS = 4u;
#define MOST_LIGHTS 4
#define WORDS uvec4
#define WORDS_FORMAT rgba32ui
#define word_of(words, light) (words)[light]
#define words_of(texel) (texel)
// Indices of lights are literals, so that no array is left when a pipeline is made.
#define EACH_LIGHT(statement) { const int light = 0; statement; } if (LIGHTS > 1u) { const int light = 1; statement; } \
    if (LIGHTS > 2u) { const int light = 2; statement; } if (LIGHTS > 3u) { const int light = 3; statement; }
#else
#define LIGHTS 1u
#define MOST_LIGHTS 1
#define WORDS uint
#define WORDS_FORMAT r32ui
#define word_of(words, light) (words)
#define words_of(texel) (texel).x
#define EACH_LIGHT(statement) { const int light = 0; statement; }
#endif

// Before the loop over a row of taps: texels of a row are on their way at once. Of several lights it would be too much code.
#if MANY
#define IN_A_ROW [[dont_unroll]]
#else
#define IN_A_ROW [[unroll]]
#endif

#if COLOUR
#define VISIBLE vec3
float largest(vec3 v) { return max(v.x, max(v.y, v.z)); }
float mean_of(vec3 v) { return (v.x + v.y + v.z) * (1.0 / 3.0); }
#else
#define VISIBLE float
float largest(float v) { return v; }
float mean_of(float v) { return v; }
#endif

// Visible shares of lights with a number each: of samples the distance of the occluder, of estimates the deviation.
#if COLOUR
VISIBLE visible_halves(uint word, uint colours) { return vec3(unpackHalf2x16(word).x, unpackHalf2x16(colours)); }
uint pack_colour_halves(VISIBLE v) { return packHalf2x16(v.yz); }
float first_of(VISIBLE v) { return v.x; }
#else
VISIBLE visible_halves(uint word, uint colours) { return unpackHalf2x16(word).x; }
uint pack_colour_halves(VISIBLE v) { return 0u; }
float first_of(VISIBLE v) { return v; }
#endif
uint pack_halves(VISIBLE v, float number) { return packHalf2x16(vec2(first_of(v), number)); }
float number_half(uint word) { return unpackHalf2x16(word).y; }

// Of a sample: no sample, and the signs of both halves: what the samples of the block of 8x8 pixels around it are.
const float NO_SAMPLE = 2.0;
const uint BLOCK_HAS_LIT = 0x8000u;
const uint BLOCK_HAS_OCCLUDED = 0x80000000u;
const uint BLOCK_BITS = BLOCK_HAS_LIT | BLOCK_HAS_OCCLUDED;

bool is_sample(VISIBLE v) { return first_of(v) <= 1.0; }

// What one pixel remembers of the visibility of a light: 12, 6, 6 and 8 bits; in colour the mean is that of red, and 12 bits each are green and blue.
struct VisibilityHistory {
    VISIBLE mean;             // 0..1
    float deviation;          // of a sample, 0..0.5
    float history_length;     // frames
    float occluder_distance;  // scene units; 0: nothing is in the way
};

const float LONGEST_VISIBILITY_HISTORY = 63.0;
const float MEAN_STEPS = 4095.0;
const float DEVIATION_STEPS = 126.0;
// Steps of an octave of the distance, and the step of distance 1.
const float DISTANCE_STEPS = 8.0;
const float DISTANCE_ONE = 97.0;

uint pack_distance(float d) { return d > 0.0 ? uint(clamp(floor(log2(d) * DISTANCE_STEPS + (DISTANCE_ONE + 0.5)), 1.0, 255.0)) : 0u; }
float unpack_distance(uint steps) { return steps == 0u ? 0.0 : exp2((float(steps) - DISTANCE_ONE) / DISTANCE_STEPS); }

uint pack_mean(float mean) { return uint(clamp(mean, 0.0, 1.0) * MEAN_STEPS + 0.5); }
float unpack_mean(uint steps) { return float(steps & 0xfffu) / MEAN_STEPS; }

uint pack_visibility(VisibilityHistory h) {
    uint mean = pack_mean(first_of(h.mean)), deviation = uint(clamp(h.deviation, 0.0, 0.5) * DEVIATION_STEPS + 0.5);
    uint frames = uint(clamp(h.history_length, 1.0, LONGEST_VISIBILITY_HISTORY) + 0.5);
    return mean | deviation << 12 | frames << 18 | pack_distance(h.occluder_distance) << 24;
}

#if COLOUR
uint pack_mean_colours(VISIBLE mean) { return pack_mean(mean.y) | pack_mean(mean.z) << 12; }
VISIBLE unpack_means(uint word, uint colours) { return vec3(unpack_mean(word), unpack_mean(colours), unpack_mean(colours >> 12)); }
#else
uint pack_mean_colours(VISIBLE mean) { return 0u; }
VISIBLE unpack_means(uint word, uint colours) { return unpack_mean(word); }
#endif

VisibilityHistory unpack_visibility_history(uint word, uint colours) {
    return VisibilityHistory(unpack_means(word, colours), float(word >> 12 & 0x3fu) / DEVIATION_STEPS, float(word >> 18 & 0x3fu),
                             unpack_distance(word >> 24));
}

// Between two places on a surface that tilts as `gradient` says: where it recedes, a pixel is a longer way.
float squared_distance(vec2 size, vec2 gradient, vec2 offset) {
    vec2 across = size * offset;
    float away = dot(gradient, offset);
    return dot(across, across) + away * away;
}

#endif
