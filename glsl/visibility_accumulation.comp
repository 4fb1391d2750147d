#version 450
// Blends the visibility of lights with its past, as far as the shadows of this frame bear it out, and measures its penumbrae.
// Source: [Mehta et al. 2012], the filter's width from the distances of occluders; the search is that of [Fernando 2005]; history by [SVGF]
// 4.1, bounded by the interval of [Wilson 1927]. Ours: how far a penumbra reaches, and that motion may not blur more than a penumbra does.
// What casts a shadow is followed as [Zeng et al. 2021] 4.1.
// In:  visibility_samples, sample_colours, guide (current, previous), surface_motion, visibility_history and
// history_colours of the previous frame; of the host occluder_distance, which samples have rounded; occluder_id; occluder_motion, scene units;
// instance_transforms; of further lights the same with _1 to _3 behind.
// Out: visibility_history, history_colours (visibility.glsl).
// variants: MANY=0,COLOUR=0 MANY=0,COLOUR=1 MANY=1,COLOUR=0 MANY=1,COLOUR=1
// optional: occluder_distance_1, occluder_distance_2, occluder_distance_3, occluder_id, occluder_id_1, occluder_id_2, occluder_id_3
// optional: occluder_motion, occluder_motion_1, occluder_motion_2, occluder_motion_3, instance_transforms
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
// Of storage images in packed_image.glsl.
#define SIGNALS 1

layout(local_size_x = 8, local_size_y = 8) in;

// The visibility is that of all directions: no light, whose shadows have edges and move.
layout(constant_id = 1) const bool AMBIENT = false;

layout(push_constant) uniform Push {
    float light_radius;
#if MANY
    float light_radius_1;
    float light_radius_2;
    float light_radius_3;
#endif
    float visibility_alpha;
    float depth_tolerance;
    float normal_tolerance;
    float sigma_n;
    float sigma_z;
    uint present;
} push;

#include "cubic.glsl"
#include "frame.glsl"
#include "viewport.glsl"
#include "geometry_weights.glsl"
#include "optional.glsl"
#include "packed_image.glsl"
#include "statistics.glsl"
#include "surface_test.glsl"
#include "visibility.glsl"
#include "light_radius.glsl"

const uint OCCLUDER_DISTANCE = 8u;
const uint INSTANCE_TRANSFORMS = 9u;
// Of the first light; those of others follow.
const uint OCCLUDER_ID = 11u + 3u * COLOUR;
const uint OCCLUDER_MOTION = OCCLUDER_ID + MOST_LIGHTS;

PACKED_IMAGE(2, guide);
// A storage image where four of them are enough.
#if COLOUR
layout(set = 0, binding = 3) uniform utexture2D previous_guide;
#define previous_guide_at(p) texelFetch(previous_guide, p, 0)
#else
PACKED_IMAGE(3, previous_guide);
#define previous_guide_at(p) packed_at(previous_guide, p)
#endif
layout(set = 0, binding = 4) uniform utexture2D surface_motion;
layout(set = 0, binding = 6, WORDS_FORMAT) uniform restrict readonly uimage2D visibility_samples;
layout(set = 0, binding = 7) uniform utexture2D previous_visibility_history;
layout(set = 0, binding = OCCLUDER_DISTANCE) uniform texture2D occluder_distance;
layout(set = 0, binding = INSTANCE_TRANSFORMS, std430) readonly buffer InstanceTransforms { vec4 rows[]; } instance_transforms;
layout(set = 0, binding = 10, WORDS_FORMAT) uniform writeonly uimage2D visibility_history;
#if COLOUR
layout(set = 0, binding = 11) uniform utexture2D sample_colours;
layout(set = 0, binding = 12) uniform utexture2D previous_history_colours;
layout(set = 0, binding = 13, WORDS_FORMAT) uniform writeonly uimage2D history_colours;
#endif
layout(set = 0, binding = OCCLUDER_ID) uniform utexture2D occluder_id;
layout(set = 0, binding = OCCLUDER_MOTION) uniform texture2D occluder_motion;
#if MANY
layout(set = 0, binding = OCCLUDER_ID + 1u) uniform utexture2D occluder_id_1;
layout(set = 0, binding = OCCLUDER_ID + 2u) uniform utexture2D occluder_id_2;
layout(set = 0, binding = OCCLUDER_ID + 3u) uniform utexture2D occluder_id_3;
layout(set = 0, binding = OCCLUDER_MOTION + 1u) uniform texture2D occluder_motion_1;
layout(set = 0, binding = OCCLUDER_MOTION + 2u) uniform texture2D occluder_motion_2;
layout(set = 0, binding = OCCLUDER_MOTION + 3u) uniform texture2D occluder_motion_3;
layout(set = 0, binding = OCCLUDER_MOTION + 4u) uniform texture2D occluder_distance_1;
layout(set = 0, binding = OCCLUDER_MOTION + 5u) uniform texture2D occluder_distance_2;
layout(set = 0, binding = OCCLUDER_MOTION + 6u) uniform texture2D occluder_distance_3;
#endif

float occluder_distance_of(const int light, ivec2 p) {
#if MANY
    if (light > 0 && !is_present(OCCLUDER_MOTION + 3u + uint(light))) return 0.0;
    if (light == 1) return texelFetch(occluder_distance_1, host_pixel(OCCLUDER_MOTION + 4u, p), 0).x;
    if (light == 2) return texelFetch(occluder_distance_2, host_pixel(OCCLUDER_MOTION + 5u, p), 0).x;
    if (light == 3) return texelFetch(occluder_distance_3, host_pixel(OCCLUDER_MOTION + 6u, p), 0).x;
#endif
    return texelFetch(occluder_distance, host_pixel(OCCLUDER_DISTANCE, p), 0).x;
}

bool has_occluder_motion(const int light) { return is_present(OCCLUDER_MOTION + uint(light)); }

vec3 occluder_motion_of(const int light, ivec2 p) {
    if (!has_occluder_motion(light)) return vec3(0.0);
#if MANY
    if (light == 1) return texelFetch(occluder_motion_1, host_pixel(OCCLUDER_MOTION + 1u, p), 0).xyz;
    if (light == 2) return texelFetch(occluder_motion_2, host_pixel(OCCLUDER_MOTION + 2u, p), 0).xyz;
    if (light == 3) return texelFetch(occluder_motion_3, host_pixel(OCCLUDER_MOTION + 3u, p), 0).xyz;
#endif
    return texelFetch(occluder_motion, host_pixel(OCCLUDER_MOTION, p), 0).xyz;
}

// 0 where the host gives none.
uint occluder_id_of(const int light, ivec2 p) {
    if (!is_present(OCCLUDER_ID + uint(light))) return 0u;
#if MANY
    if (light == 1) return texelFetch(occluder_id_1, host_pixel(OCCLUDER_ID + 1u, p), 0).x;
    if (light == 2) return texelFetch(occluder_id_2, host_pixel(OCCLUDER_ID + 2u, p), 0).x;
    if (light == 3) return texelFetch(occluder_id_3, host_pixel(OCCLUDER_ID + 3u, p), 0).x;
#endif
    return texelFetch(occluder_id, host_pixel(OCCLUDER_ID, p), 0).x;
}

#include "shadow_motion.glsl"

// Of weights of taps: less is nothing.
const float NOTHING = 1e-3;
// Of weights of samples that may be equal but for rounding: the first one counts.
const float CLEARLY = 1.001;
// Pixels that always count as near: an edge that is sharp, and stands still, runs between them.
const float NEAR = 1.5;
// Standard deviations of the interval that history is clamped to, by the radius of the penumbra in pixels: where motion blurs as much
// as the penumbra does, the few samples of this frame know better.
const vec2 CONFIDENCE_Z = vec2(1.0, 2.0);
// The same of all directions, whose visibility is near 1 in most places: a narrow interval would pull it down.
const float CONFIDENCE_Z_OF_AMBIENT = 3.0;
// Frames up to which the deviation is at least that of the surroundings: a few samples may be equal by chance. No whole number, which rounding
// would make a matter of the driver.
const float SHORT_HISTORY = 7.5;
// Variance of a look by the cubic, as a share of that by 2x2 pixels.
const float CUBIC_BLUR = 0.2;
// Variance by which motion may blur an edge: as a share of the squared radius of the penumbra, and of any edge in squared pixels.
const float TOLERATED_BLUR = 0.5;
const float TOLERATED_BLUR_OF_ANY = 0.15;
// Smallest weight of this frame in the distance of the occluder.
const float DISTANCE_ALPHA = 0.25;

struct Centre {
    EdgeCentre edges;
    vec2 size;    // of a pixel, scene units
    float longer; // of its sides
};

struct Sample {
    VISIBLE visibility; // NO_SAMPLE: none
    float distance;     // of the occluder; 0: none
};

// What is around a pixel: weights of occluded and of lit samples whose penumbra may reach it.
struct Search {
    VISIBLE occluded;
    VISIBLE lit;
    float occluder_distance;
    float known;             // weights of occluded samples whose occluder is known
    float nearest_weight;    // of that of them which weighs most
    ivec2 nearest;
};

// Samples around a pixel, within its penumbra.
struct Window {
    float weight;
    VISIBLE lit;
};

// Tested taps in the previous frame: 2x2, or where they carry nothing 3x3 around the nearest pixel.
struct Look {
    vec2 position;
    bool is_wide;
    bool is_sharp;  // asked for, and no tap of 4x4 is another surface
    uint taken;     // bit i: tap i counts
};

struct Gathered {
    float weight;
    VISIBLE mean;
    VISIBLE plain_mean;  // of the tested taps
    VISIBLE second_moment;
    float history_length;
    float occluder_distance;
    float blur;
};

const Gathered NO_PAST = Gathered(0.0, VISIBLE(0.0), VISIBLE(0.0), VISIBLE(0.0), 0.0, 0.0, 0.0);

// 1 at the pixel itself, falling to 0 at a distance.
float reach(float squared, float radius) { return max(0.0, 1.0 - squared / (radius * radius)); }

WORDS sample_words(ivec2 p) { return words_of(imageLoad(visibility_samples, p)); }

#if COLOUR
WORDS sample_colour_words(ivec2 p) { return words_of(texelFetch(sample_colours, p, 0)); }
WORDS previous_colour_words(ivec2 p) { return words_of(texelFetch(previous_history_colours, p, 0)); }
#else
WORDS sample_colour_words(ivec2 p) { return WORDS(0u); }
WORDS previous_colour_words(ivec2 p) { return WORDS(0u); }
#endif

Sample sample_of(uint word, uint colours) {
    uint halves = word & ~BLOCK_BITS;
    return Sample(visible_halves(halves, colours), number_half(halves));
}

bool exists(Sample taken) { return is_sample(taken.visibility); }

// Pixels that the search reaches to each side.
const int SEARCH_REACH = 6;

// Whether all samples of a light that the search may reach are of one kind, which no penumbra is.
bool is_uniform(Sample own, uint bits) { return !AMBIENT && exists(own) && bits != BLOCK_BITS; }

// Kinds of samples in the blocks around a pixel, of each light: of nine pixels so far apart, each block within reach holds one.
WORDS kinds_around(ivec2 p) {
    WORDS bits = WORDS(0u);
    [[dont_unroll]] for (int i = 0; i < 9; ++i)
        bits |= sample_words(nearest_inside(p + SEARCH_REACH * ivec2(i % 3 - 1, i / 3 - 1)));
    return bits & WORDS(BLOCK_BITS);
}

// Weight by geometry of a tap; 0 where there is none.
float tap_weight(Centre centre, ivec2 p, ivec2 offset, out WORDS words, out WORDS colours) {
    ivec2 q = p + offset, tap = nearest_inside(q);
    GuideBits packed = GuideBits(packed_at(guide, tap));
    words = sample_words(tap);
    colours = sample_colour_words(tap);
    bool counts = q == tap && guide_depth(packed) != 0.0;
    return counts ? exp2(log2_edge_weight(centre.edges, packed, depth_sharpness(centre.edges, vec2(offset)))) : 0.0;
}

// Of the penumbra of the pixel itself.
float own_reach(const int light, Centre centre, Sample own) {
    return 2.0 * radius_of(light) * (!exists(own) || largest(1.0 - own.visibility) > 0.0 ? own.distance : 0.0) + NEAR * centre.longer;
}

void search_tap(inout Search found, const int light, Centre centre, float own_reach, Sample taken, float weight, float squared, ivec2 q) {
    weight = exists(taken) ? weight : 0.0;
    VISIBLE occluded = weight * (1.0 - taken.visibility) * reach(squared, 2.0 * radius_of(light) * taken.distance + NEAR * centre.longer);
    float most = largest(occluded);
    found.occluded += occluded;
    found.lit += weight * taken.visibility * reach(squared, own_reach);
    found.occluder_distance += most * taken.distance;
    found.known += taken.distance > 0.0 ? most : 0.0;
    if (taken.distance > 0.0 && most > CLEARLY * found.nearest_weight) {
        found.nearest_weight = most;
        found.nearest = q;
    }
}

// 5x5 pixels, and 5x5 three pixels apart. A penumbra is twice as wide as the light's disc is seen from its occluder on either side.
void search(inout Search found[MOST_LIGHTS], Centre centre, ivec2 p, Sample own[MOST_LIGHTS]) {
    float reaches[MOST_LIGHTS];
    EACH_LIGHT(reaches[light] = own_reach(light, centre, own[light]))
    [[dont_unroll]] for (int row = 0; row < 10; ++row)
        IN_A_ROW for (int x = -2; x <= 2; ++x) {
            ivec2 offset = ivec2(x, row % 5 - 2) * (row < 5 ? 1 : 3);
            if (x == 0 && row == 7) continue;
            WORDS words, colours;
            float weight = tap_weight(centre, p, offset, words, colours), squared = squared_distance(centre.size, centre.edges.gradient,
                vec2(offset));
            EACH_LIGHT(search_tap(found[light], light, centre, reaches[light], sample_of(word_of(words, light), word_of(colours, light)),
                weight, squared, p + offset))
        }
}

void window_tap(inout Window sum, Sample taken, float weight, float reached) {
    weight = exists(taken) ? weight * reached : 0.0;
    sum.weight += weight;
    sum.lit += weight * min(taken.visibility, 1.0);
}

void window(inout Window sum[MOST_LIGHTS], Centre centre, ivec2 p, float radius[MOST_LIGHTS]) {
    [[dont_unroll]] for (int y = -2; y <= 2; ++y)
        IN_A_ROW for (int x = -2; x <= 2; ++x) {
            ivec2 offset = ivec2(x, y);
            WORDS words, colours;
            float weight = tap_weight(centre, p, offset, words, colours), squared = squared_distance(centre.size, centre.edges.gradient,
                vec2(offset));
            EACH_LIGHT(window_tap(sum[light], sample_of(word_of(words, light), word_of(colours, light)), weight, reach(squared,
                radius[light] + NEAR * centre.longer)))
        }
}

// What the mean may be, by the samples of this frame. All of one kind, as far as a penumbra reaches: nothing else.
vec2 bounds(float occluded, float lit, float weight, float of_lit, float pixels) {
    // Of all directions a few may be hidden from no pixel around.
    if (!AMBIENT && occluded <= NOTHING && lit > NOTHING) return vec2(1.0);
    if (!AMBIENT && lit <= NOTHING && occluded > NOTHING) return vec2(0.0);
    if (weight <= NOTHING) return vec2(0.0, 1.0);
    float z = AMBIENT ? CONFIDENCE_Z_OF_AMBIENT : clamp(pixels, CONFIDENCE_Z.x, CONFIDENCE_Z.y), squared = z * z, n = weight,
        inverse = 1.0 / (n + squared);
    float middle = (of_lit + 0.5 * squared) * inverse;
    float half_width = z * inverse * sqrt(max(0.0, of_lit * (n - of_lit) / n + 0.25 * squared));
    return clamp(vec2(middle - half_width, middle + half_width), 0.0, 1.0);
}

VISIBLE bounded(VISIBLE mean, Search found, Window around, float pixels) {
#if COLOUR
    vec3 result;
    for (int i = 0; i < 3; ++i) {
        vec2 allowed = bounds(found.occluded[i], found.lit[i], around.weight, around.lit[i], pixels);
        result[i] = clamp(mean[i], allowed.x, allowed.y);
    }
    return result;
#else
    vec2 allowed = bounds(found.occluded, found.lit, around.weight, around.lit, pixels);
    return clamp(mean, allowed.x, allowed.y);
#endif
}

bool is_refused(ivec2 tap, Expected expected, float slack) {
    if (!is_inside_previous(tap)) return true;
    GuideBits packed = GuideBits(previous_guide_at(tap));
    return surface_refusal(packed, expected, slack) != REASON_NONE || normal_refusal(guide_normal(packed), expected) != REASON_NONE;
}

float bilinear(vec2 f, ivec2 offset) { return (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y); }

Look look_at(vec2 position, Expected expected, bool sharpens) {
    Look look = Look(position, false, false, 0u);
    vec2 corner = floor(position), f = position - corner;
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        float weight = bilinear(f, offset);
        if (weight > 0.0 && !is_refused(ivec2(corner) + offset, expected, 0.0)) {
            look.taken |= 1u << i;
            sum += weight;
        }
    }
    if (sharpens && sum > WHOLE_WEIGHT && f != vec2(0.0)) {
        float slack = 2.0 * (abs(expected.gradient.x) + abs(expected.gradient.y));
        look.is_sharp = true;
        [[dont_unroll]] for (int i = 0; i < 16; ++i)
            look.is_sharp = look.is_sharp && !is_refused(ivec2(corner) + ivec2(i % 4, i / 4) - 1, expected, slack);
    }
    if (sum >= SMALLEST_WEIGHT_SUM) return look;
    look.is_wide = true;
    look.taken = 0u;
    ivec2 nearest = ivec2(floor(position + 0.5));
    [[dont_unroll]] for (int i = 0; i < 9; ++i)
        if (!is_refused(nearest + ivec2(i % 3 - 1, i / 3 - 1), expected, 0.0)) look.taken |= 1u << i;
    return look;
}

void gather_tap(inout Gathered sum, uint word, uint colours, float weight) {
    VisibilityHistory h = unpack_visibility_history(word, colours);
    sum.weight += weight;
    sum.mean += weight * h.mean;
    sum.plain_mean += weight * h.mean;
    sum.second_moment += weight * (h.deviation * h.deviation + h.mean * h.mean);
    sum.history_length += weight * h.history_length;
    sum.occluder_distance = max(sum.occluder_distance, h.occluder_distance);
}

// Replaces the means that tested taps gave: a look by the cubic blurs less.
void sharpen(inout Gathered past[MOST_LIGHTS], bool wanted[MOST_LIGHTS], ivec2 corner, vec2 f) {
    vec4 x_weights = cubic_weights(f.x), y_weights = cubic_weights(f.y);
    VISIBLE means[MOST_LIGHTS];
    EACH_LIGHT(means[light] = VISIBLE(0.0))
    [[dont_unroll]] for (int i = 0; i < 16; ++i) {
        ivec2 tap = corner + ivec2(i % 4, i / 4) - 1;
        WORDS words = words_of(texelFetch(previous_visibility_history, tap, 0)), colours = previous_colour_words(tap);
        float weight = x_weights[i % 4] * y_weights[i / 4];
        EACH_LIGHT(means[light] += weight * unpack_means(word_of(words, light), word_of(colours, light)))
    }
    EACH_LIGHT(if (wanted[light]) past[light].mean = past[light].weight * clamp(means[light], 0.0, 1.0))
}

// Of the ways from a pixel to the next on the surface.
vec2 squared_lengths(Centre centre) { return centre.size * centre.size + centre.edges.gradient * centre.edges.gradient; }

// The variance that a profile of a shadow's edge may gain, squared scene units.
float tolerated_blur(Centre centre, float radius) {
    vec2 lengths = squared_lengths(centre);
    return TOLERATED_BLUR * radius * radius + TOLERATED_BLUR_OF_ANY * 0.5 * (lengths.x + lengths.y);
}

// Adds what the taps of a look hold of the lights that are wanted.
void gather(inout Gathered past[MOST_LIGHTS], bool wanted[MOST_LIGHTS], Look look, Centre centre) {
    vec2 corner = floor(look.position), f = look.position - corner;
    ivec2 nearest = ivec2(floor(look.position + 0.5));
    [[dont_unroll]] for (int i = 0; i < (look.is_wide ? 9 : 4); ++i) {
        if ((look.taken >> i & 1u) == 0u) continue;
        ivec2 offset = ivec2(i & 1, i >> 1), tap = look.is_wide ? nearest + ivec2(i % 3 - 1, i / 3 - 1) : ivec2(corner) + offset;
        WORDS words = words_of(texelFetch(previous_visibility_history, tap, 0)), colours = previous_colour_words(tap);
        float weight = look.is_wide ? 1.0 : bilinear(f, offset);
        EACH_LIGHT(if (wanted[light]) gather_tap(past[light], word_of(words, light), word_of(colours, light), weight))
    }
    float blur = dot(f * (1.0 - f), squared_lengths(centre)) * (look.is_sharp ? CUBIC_BLUR : 1.0);
    EACH_LIGHT(if (wanted[light]) past[light].blur = blur)
    if (look.is_sharp) sharpen(past, wanted, ivec2(corner), f);
}

// A pixel's own occluder that should have a motion or a transform, and has none that can be used.
void count_bad_occluder(const int light, ivec2 p, Sample own) {
    if (!exists(own) || largest(1.0 - own.visibility) <= 0.0 || own.distance == 0.0) return;
    if (has_occluder_motion(light) && !is_finite(occluder_motion_of(light, p))) count_bad(BAD_OCCLUDER_MOTION);
    vec4 rows[3];
    uint id = is_present(INSTANCE_TRANSFORMS) ? occluder_id_of(light, p) : 0u;
    if (id != 0u && !instance_rows(id, rows)) count_bad(BAD_OCCLUDER_ID);
}

// Where the shadow that reaches the pixel lay in the previous frame, pixels, and its linear depth there. False: where the surface was.
bool shadow_place(const int light, Receiver receiver, Search found, out vec2 place, out float depth) {
    vec3 shadow;
    bool moved = !AMBIENT && found.nearest_weight > 0.0 && shadow_before(receiver, light, found.nearest,
        shadow) && previous_pixel_position(shadow, place);
    depth = (frame.previous_view_from_world * vec4(shadow, 1.0)).z * forward_sign();
    return moved;
}

void choose(inout bool wanted, inout bool any, bool counts) {
    wanted = counts;
    any = any || counts;
}

void place_at(inout vec2 place, inout Expected expected, vec2 shadow, float depth) {
    place = shadow;
    expected.depth = depth;
}

// The past of the shadows that reach the pixel, where they moved; else, and where one lay on no such surface, of the surface.
void gather_pasts(inout Gathered past[MOST_LIGHTS], ivec2 p, GuideBits packed, Search found[MOST_LIGHTS], Centre centre,
    bool sharpens) {
    SurfaceMotion m = unpack_surface_motion(texelFetch(surface_motion, p, 0));
    vec2 position = previous_position(p, m.motion, frame.render_extent, frame.previous_render_extent) - 0.5, shadows[MOST_LIGHTS];
    Expected expected = expected_surface(packed, m, centre.edges.gradient, m.previous_normal);
    Receiver receiver = receiver_at(p, guide_depth(packed), m, position);
    bool moved[MOST_LIGHTS], wanted[MOST_LIGHTS];
    float depths[MOST_LIGHTS];
    EACH_LIGHT(moved[light] = shadow_place(light, receiver, found[light], shadows[light], depths[light]))
    [[dont_unroll]] for (int i = 0; i <= int(LIGHTS); ++i) {
        bool any = false;
        vec2 place = position;
        Expected there = expected;
        EACH_LIGHT(choose(wanted[light], any, i == int(LIGHTS) ? past[light].weight == 0.0 : i == light && moved[light]))
        EACH_LIGHT(if (i == light) place_at(place, there, shadows[light], depths[light]))
        if (any) gather(past, wanted, look_at(place, there, sharpens), centre);
    }
}

VisibilityHistory accumulate(VISIBLE v, VisibilityHistory before, Search found, Window around, float pixels, float blur, float tolerated) {
    float history_length = min(before.history_length + 1.0, LONGEST_VISIBILITY_HISTORY);
    float alpha = max(push.visibility_alpha, 1.0 / history_length);
    // What is blurred in every frame adds up to blur / alpha.
    alpha = max(alpha, min(1.0, blur / tolerated));
    VISIBLE mean = bounded(before.mean, found, around, pixels);
    float difference = largest(abs(v - before.mean));
    float variance = (1.0 - alpha) * (before.deviation * before.deviation + alpha * difference * difference);
    return VisibilityHistory(alpha < 1.0 ? mix(mean, v, alpha) : v, sqrt(variance), min(history_length, 1.0 / alpha),
        before.occluder_distance);
}

float distance_of(Search found, Gathered past) {
    float distance = found.occluder_distance;
    return past.occluder_distance > 0.0 && distance > 0.0 ? mix(past.occluder_distance, distance, DISTANCE_ALPHA) : distance;
}

void put(inout WORDS words, inout WORDS colours, const int light, VisibilityHistory h) {
    word_of(words, light) = pack_visibility(h);
    word_of(colours, light) = pack_mean_colours(h.mean);
}

// What is around a pixel beside which all samples are alike: no penumbra is known.
Search search_of_one_kind(Sample own) { return Search(1.0 - own.visibility, own.visibility, 0.0, 0.0, 0.0, ivec2(0)); }

// The same of the rest; what is nowhere an edge is blurred by no motion.
void settle(inout Gathered past, inout Window around, Sample own) {
    around = Window(1.0, own.visibility);
    past.mean = past.plain_mean;
    past.blur = 0.0;
}

// What the next frame finds of a light.
void finish(inout WORDS words, inout WORDS colours, const int light, Centre centre, Sample own, Search found, Gathered past,
    Window around) {
    float distance = distance_of(found, past), radius = radius_of(light) * distance;
    VISIBLE share = around.weight > NOTHING ? around.lit / around.weight : VISIBLE(1.0), v = exists(own) ? own.visibility : share;
    VisibilityHistory result = VisibilityHistory(v, 0.0, 1.0, distance);
    if (past.weight > 0.0) {
        vec2 lengths = squared_lengths(centre);
        float inverse = 1.0 / past.weight;
        VISIBLE variance = past.second_moment * inverse - past.plain_mean * past.plain_mean * inverse * inverse;
        VisibilityHistory before = VisibilityHistory(past.mean * inverse, sqrt(max(0.0, largest(variance))), past.history_length * inverse,
            distance);
        float pixels = radius * inversesqrt(max(lengths.x, lengths.y));
        result = accumulate(v, before, found, around, pixels, past.blur, tolerated_blur(centre, radius));
    }
    if (result.history_length < SHORT_HISTORY) result.deviation = max(result.deviation, sqrt(max(0.0, largest(share * (1.0 - share)))));
    put(words, colours, light, result);
}

void store(ivec2 p, WORDS words, WORDS colours) {
    imageStore(visibility_history, p, uvec4(words));
#if COLOUR
    imageStore(history_colours, p, uvec4(colours));
#endif
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    GuideBits packed = GuideBits(packed_at(guide, p));
    if (guide_depth(packed) == 0.0) {
        WORDS words = WORDS(0u), colours = WORDS(0u);
        EACH_LIGHT(put(words, colours, light, VisibilityHistory(VISIBLE(1.0), 0.0, 1.0, 0.0)))
        store(p, words, colours);
        return;
    }
    vec2 size = pixel_size(guide_depth(packed));
    Centre centre = Centre(edge_centre(packed), size, max(size.x, size.y));
    WORDS words = sample_words(p), colours = sample_colour_words(p);
    Sample own[MOST_LIGHTS];
    Search found[MOST_LIGHTS];
    Gathered past[MOST_LIGHTS];
    Window around[MOST_LIGHTS];
    float radius[MOST_LIGHTS];
    bool uniform_light[MOST_LIGHTS], searches = false;
    EACH_LIGHT(own[light] = sample_of(word_of(words, light), word_of(colours, light)))
    WORDS kinds = kinds_around(p);
    EACH_LIGHT(uniform_light[light] = is_uniform(own[light], word_of(kinds, light)); searches = searches || !uniform_light[light])
    EACH_LIGHT(found[light] = Search(VISIBLE(0.0), VISIBLE(0.0), 0.0, 0.0, 0.0, p))
    if (searches) search(found, centre, p, own);
    EACH_LIGHT(found[light].occluder_distance = found[light].known > 0.0 ? found[light].occluder_distance / found[light].known : 0.0)
    EACH_LIGHT(past[light] = NO_PAST)
    EACH_LIGHT(around[light] = Window(0.0, VISIBLE(0.0)))
    EACH_LIGHT(if (uniform_light[light]) found[light] = search_of_one_kind(own[light]))
    if (!has_flag(FLAG_RESET)) {
        gather_pasts(past, p, packed, found, centre, searches);
        EACH_LIGHT(count_bad_occluder(light, p, own[light]))
    }
    EACH_LIGHT(radius[light] = radius_of(light) * distance_of(found[light], past[light]))
    if (searches) window(around, centre, p, radius);
    EACH_LIGHT(if (uniform_light[light]) settle(past[light], around[light], own[light]))
    words = WORDS(0u);
    colours = WORDS(0u);
    EACH_LIGHT(finish(words, colours, light, centre, own[light], found[light], past[light], around[light]))
    store(p, words, colours);
}
