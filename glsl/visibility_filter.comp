#version 450
// One level of the filter of a visibility: along the surface, no wider than its penumbra, guided by variance.
// Source: [Mehta et al. 2012], filter width from the penumbra; levels and weights as [SVGF] 4.3. Ours: how the levels share the width.
// In:  guide, visibility_history (distance of the occluder; with FIRST, and history_colours, the visibility as well);
//      filter_in: half2(visibility, deviation of it), filter_in_colours: half2(green, blue). Out: filter_out, filter_out_colours: the same;
//      with LAST denoised_visibility, of further lights with _1 to _3 behind.
// variants: LAST=0,MANY=0,COLOUR=0 LAST=1,MANY=0,COLOUR=0 LAST=0,MANY=0,COLOUR=1 LAST=1,MANY=0,COLOUR=1
// variants: LAST=0,MANY=1,COLOUR=0 LAST=1,MANY=1,COLOUR=0 LAST=0,MANY=1,COLOUR=1 LAST=1,MANY=1,COLOUR=1
// optional: denoised_visibility_1, denoised_visibility_2, denoised_visibility_3
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
// Of storage images in packed_image.glsl.
#if MANY || COLOUR
#define SIGNALS 2
#else
#define SIGNALS 1
#endif

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const bool FIRST = false;

layout(push_constant) uniform Push {
    uint level;
    float light_radius;
#if MANY
    float light_radius_1;
    float light_radius_2;
    float light_radius_3;
#endif
    float penumbra_blur;
    float visibility_sigma;
    float sigma_n;
    float sigma_z;
#if MANY && LAST
    uint present;
#endif
} push;

#if MANY && LAST
#include "optional.glsl"
#endif
#include "frame.glsl"
#include "viewport.glsl"
#include "geometry_weights.glsl"
#include "packed_image.glsl"
#include "visibility.glsl"
#include "light_radius.glsl"

PACKED_IMAGE(1, guide);
// The first level has it as filter_in as well: in one layout.
#if SIGNALS == 1
PACKED_IMAGE_32(3, visibility_history);
PACKED_IMAGE_32(4, filter_in);
#else
layout(set = 0, binding = 3) uniform utexture2D visibility_history;
layout(set = 0, binding = 4) uniform utexture2D filter_in;
#endif
#if LAST
#if COLOUR
#define DENOISED_FORMAT rgba16f
#else
#define DENOISED_FORMAT r32f
#endif
const uint DENOISED_VISIBILITY = 5u;
layout(set = 0, binding = DENOISED_VISIBILITY, DENOISED_FORMAT) uniform writeonly image2D denoised_visibility;
#else
layout(set = 0, binding = 5, WORDS_FORMAT) uniform writeonly uimage2D filter_out;
#endif
#if COLOUR
layout(set = 0, binding = 6) uniform utexture2D filter_in_colours;
#if !LAST
layout(set = 0, binding = 7, WORDS_FORMAT) uniform writeonly uimage2D filter_out_colours;
#endif
#endif
#if MANY && LAST
const uint OF_OTHERS = 6u + COLOUR;
layout(set = 0, binding = OF_OTHERS, DENOISED_FORMAT) uniform writeonly image2D denoised_visibility_1;
layout(set = 0, binding = OF_OTHERS + 1u, DENOISED_FORMAT) uniform writeonly image2D denoised_visibility_2;
layout(set = 0, binding = OF_OTHERS + 2u, DENOISED_FORMAT) uniform writeonly image2D denoised_visibility_3;
#endif

// Visibility that is always tolerated.
const float VISIBILITY_EPSILON = 0.01;
// Squared pixels: a narrower filter changes nothing.
const float NARROW = 0.02;
// Along an edge light changes little: variance of the kernel in that direction at least, squared steps of the level, on the first
// levels; and how far a tap may lie aside for that, squared pixels.
const float ALONG = 1.0;
const float ASIDE = 0.1;
const uint ALONG_LEVELS = 2u;

struct Estimate {
    VISIBLE visibility;
    float deviation;
};

WORDS words_at(ivec2 p) { return words_of(packed_at(filter_in, p)); }

WORDS colour_words_at(ivec2 p) {
#if COLOUR
    return words_of(texelFetch(filter_in_colours, p, 0));
#else
    return WORDS(0u);
#endif
}

Estimate estimate_of(uint word, uint colours) {
    if (!FIRST) return Estimate(visible_halves(word, colours), number_half(word));
    VisibilityHistory h = unpack_visibility_history(word, colours);
    // Of a mean with the smallest weight 1/N.
    return Estimate(h.mean, h.deviation * inversesqrt(2.0 * h.history_length - 1.0));
}

#if LAST
vec4 shown(VISIBLE v) {
#if COLOUR
    return vec4(v, 1.0);
#else
    return vec4(v);
#endif
}

void store(ivec2 p, Estimate found[MOST_LIGHTS]) {
    imageStore(denoised_visibility, host_pixel(DENOISED_VISIBILITY, p), shown(found[0].visibility));
#if MANY
    if (LIGHTS > 1u && is_present(OF_OTHERS)) imageStore(denoised_visibility_1, host_pixel(OF_OTHERS, p), shown(found[1].visibility));
    if (LIGHTS > 2u && is_present(OF_OTHERS + 1u)) imageStore(denoised_visibility_2, host_pixel(OF_OTHERS + 1u, p), shown(found[2].visibility));
    if (LIGHTS > 3u && is_present(OF_OTHERS + 2u)) imageStore(denoised_visibility_3, host_pixel(OF_OTHERS + 2u, p), shown(found[3].visibility));
#endif
}
#else
void put(inout WORDS words, inout WORDS colours, const int light, Estimate found) {
    word_of(words, light) = pack_halves(found.visibility, found.deviation);
    word_of(colours, light) = pack_colour_halves(found.visibility);
}

void store(ivec2 p, Estimate found[MOST_LIGHTS]) {
    WORDS words = WORDS(0u), colours = WORDS(0u);
    EACH_LIGHT(put(words, colours, light, found[light]))
    imageStore(filter_out, p, uvec4(words));
#if COLOUR
    imageStore(filter_out_colours, p, uvec4(colours));
#endif
}
#endif

// The variance that this level adds to the kernel, squared pixels. A level is good for 4^level, and finer ones come first.
float share_of_level(float wanted) {
    float full = float(1 << (2 * push.level));
    return clamp(wanted - (full - 1.0) / 3.0, 0.0, full);
}

// Exponent of 2 by geometry of a tap that exists, else what makes its weight 0.
float geometry_at(EdgeCentre centre, ivec2 p, ivec2 offset) {
    ivec2 q = p + offset, tap = nearest_inside(q);
    GuideBits packed = GuideBits(packed_at(guide, tap));
    float weight = log2_edge_weight(centre, packed, depth_sharpness(centre, vec2(offset)));
    return q == tap && guide_depth(packed) != 0.0 ? weight : -1e30;
}

// How a light is filtered, at one pixel.
struct Kernel {
    bool filters;
    vec2 light;       // the way into it, of unit length; 0 where there is none
    float sharpness;  // by distance
    float tolerance;  // by visibility
};

// Sums over the taps of a light.
struct Sum {
    VISIBLE visibility;
    float squares;
    float weights;
};

void slope_tap(inout vec2 slope, Estimate centre, Estimate other, float weight, vec2 offset) {
    slope += weight * mean_of(other.visibility - centre.visibility) * offset;
}

// The ways into the lights.
void towards_lights(inout Kernel kernels[MOST_LIGHTS], EdgeCentre centre, ivec2 p, Estimate own[MOST_LIGHTS]) {
    vec2 slopes[MOST_LIGHTS];
    EACH_LIGHT(slopes[light] = vec2(0.0))
    [[dont_unroll]] for (int y = -2; y <= 2; ++y)
        IN_A_ROW for (int x = -2; x <= 2; ++x) {
            ivec2 offset = ivec2(x, y), tap = nearest_inside(p + (offset << push.level));
            float weight = exp2(geometry_at(centre, p, offset << push.level));
            WORDS words = words_at(tap), colours = colour_words_at(tap);
            EACH_LIGHT(slope_tap(slopes[light], own[light], estimate_of(word_of(words, light), word_of(colours, light)), weight,
                vec2(offset)))
        }
    EACH_LIGHT(kernels[light].light = dot(slopes[light], slopes[light]) > 1e-6 ? slopes[light] * inversesqrt(dot(slopes[light],
        slopes[light])) : vec2(0.0))
}

void filter_tap(inout Sum sum, Kernel kernel, Estimate own, Estimate other, EdgeCentre centre, vec2 size, vec2 offset, float squared,
    float geometry) {
    float way = squared * kernel.sharpness, full = float(1 << (2 * push.level));
    if (kernel.light != vec2(0.0)) {
        float across = dot(offset, kernel.light), along = dot(offset, vec2(-kernel.light.y, kernel.light.x));
        float aside = min(squared_distance(size, centre.gradient, across * kernel.light) * kernel.sharpness,
            across * across * (LOG2_E / (2.0 * ASIDE)));
        way = min(way, aside + along * along * (LOG2_E / (2.0 * ALONG * full)));
    }
    float weight = geometry - way - largest(abs(other.visibility - own.visibility)) * kernel.tolerance;
    weight = offset != vec2(0.0) ? exp2(weight) : 0.0;
    sum.visibility += weight * other.visibility;
    sum.squares += weight * weight * other.deviation * other.deviation;
    sum.weights += weight;
}

void filter_lights(inout Estimate found[MOST_LIGHTS], Kernel kernels[MOST_LIGHTS], EdgeCentre centre, ivec2 p, vec2 size) {
    Sum sums[MOST_LIGHTS];
    EACH_LIGHT(sums[light] = Sum(found[light].visibility, found[light].deviation * found[light].deviation, 1.0))
    [[dont_unroll]] for (int y = -2; y <= 2; ++y)
        IN_A_ROW for (int x = -2; x <= 2; ++x) {
            ivec2 offset = ivec2(x, y) << push.level, tap = nearest_inside(p + offset);
            WORDS words = words_at(tap), colours = colour_words_at(tap);
            float squared = squared_distance(size, centre.gradient, vec2(offset)), geometry = geometry_at(centre, p, offset);
            EACH_LIGHT(filter_tap(sums[light], kernels[light], found[light], estimate_of(word_of(words, light), word_of(colours, light)),
                centre, size, vec2(offset), squared, geometry))
        }
    EACH_LIGHT(if (kernels[light].filters) found[light] = Estimate(sums[light].visibility / sums[light].weights,
        sqrt(sums[light].squares) / sums[light].weights))
}

Kernel kernel_of(const int light, uint history, Estimate own, vec2 size, inout bool any) {
    float longer = max(size.x, size.y), distance = unpack_distance(history >> 24);
    float deviation = push.penumbra_blur * radius_of(light) * distance / longer;
    float variance = share_of_level(min(deviation * deviation, 1e6));
    bool filters = variance > NARROW || push.level < ALONG_LEVELS && distance > 0.0;
    any = any || filters;
    float sharpness = LOG2_E / (2.0 * max(variance, 1e-6) * longer * longer);
    return Kernel(filters, vec2(0.0), sharpness, LOG2_E / (push.visibility_sigma * own.deviation + VISIBILITY_EPSILON));
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    GuideBits packed = GuideBits(packed_at(guide, p));
    WORDS words = words_at(p), colours = colour_words_at(p), history = words_of(packed_at(visibility_history, p));
    Estimate found[MOST_LIGHTS];
    Kernel kernels[MOST_LIGHTS];
    vec2 size = pixel_size(guide_depth(packed));
    bool any = false;
    EACH_LIGHT(found[light] = estimate_of(word_of(words, light), word_of(colours, light)))
    EACH_LIGHT(kernels[light] = kernel_of(light, word_of(history, light), found[light], size, any))
    if (guide_depth(packed) != 0.0 && any) {
        EdgeCentre centre = edge_centre(packed);
        if (push.level < ALONG_LEVELS) towards_lights(kernels, centre, p, found);
        filter_lights(found, kernels, centre, p, size);
    }
    store(p, found);
}
