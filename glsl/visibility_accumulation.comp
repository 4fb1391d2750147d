#version 450
// Blends the visibility of a light with its past, as far as the shadows of this frame bear it out, and measures its penumbra.
// Source: [Mehta et al. 2012], the filter's width from the distances of occluders; the search is that of [Fernando 2005]; history by [SVGF]
// 4.1, bounded by the interval of [Wilson 1927]. Ours: how far a penumbra reaches, and that motion may not blur more than a penumbra does.
// What casts a shadow is followed as [Zeng et al. 2021] 4.1.
// In:  visibility_samples, guide (current, previous), surface_motion, depth_gradient, visibility_history of the previous frame; of the host
// occluder_distance, which samples have rounded; occluder_id; occluder_motion, scene units; instance_transforms.
// Out: visibility_history (visibility.glsl).
// optional: occluder_id, occluder_motion, instance_transforms
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
// Of storage images in packed_image.glsl.
#define SIGNALS 1

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform Push {
    float light_radius;
    float visibility_alpha;
    float depth_tolerance;
    float normal_tolerance;
    float sigma_n;
    float sigma_z;
    uint present;
} push;

#include "cubic.glsl"
#include "frame.glsl"
#include "geometry_weights.glsl"
#include "optional.glsl"
#include "packed_image.glsl"
#include "statistics.glsl"
#include "surface_test.glsl"
#include "visibility.glsl"

const uint OCCLUDER_ID = 8u;
const uint OCCLUDER_MOTION = 9u;
const uint INSTANCE_TRANSFORMS = 10u;

PACKED_IMAGE(2, guide);
PACKED_IMAGE(3, previous_guide);
layout(set = 0, binding = 4) uniform utexture2D surface_motion;
layout(set = 0, binding = 5) uniform utexture2D depth_gradient;
PACKED_IMAGE_32(6, visibility_samples);
layout(set = 0, binding = 7) uniform utexture2D previous_visibility_history;
layout(set = 0, binding = OCCLUDER_ID) uniform utexture2D occluder_id;
layout(set = 0, binding = OCCLUDER_MOTION) uniform texture2D occluder_motion;
layout(set = 0, binding = INSTANCE_TRANSFORMS, std430) readonly buffer InstanceTransforms { vec4 rows[]; } instance_transforms;
layout(set = 0, binding = 11) uniform texture2D occluder_distance;
layout(set = 0, binding = 12, r32ui) uniform writeonly uimage2D visibility_history;

#include "shadow_motion.glsl"

// Of weights of taps: less is nothing.
const float NOTHING = 1e-3;
// Of weights of samples that may be equal but for rounding: the first one counts.
const float CLEARLY = 1.001;
// Pixels that always count as near: an edge that is sharp, and stands still, runs between them.
const float NEAR = 1.5;
// Standard deviations of the interval that history is clamped to, by the radius of the penumbra in pixels: where motion blurs as much as the
// penumbra does, the few samples of this frame know better.
const vec2 CONFIDENCE_Z = vec2(1.0, 2.0);
// Frames up to which the deviation is at least that of the surroundings: a few samples may be equal by chance.
const float SHORT_HISTORY = 8.0;
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

// What is around a pixel: weights of occluded and of lit samples whose penumbra may reach it.
struct Search {
    float occluded;
    float lit;
    float occluder_distance;
    float nearest_weight;    // of the occluded sample that weighs most, and whose occluder is known
    ivec2 nearest;
};

// Samples around a pixel, within its penumbra.
struct Window {
    float weight;
    float lit;
};

struct Gathered {
    float weight;
    float mean;
    float plain_mean;  // of 2x2 taps
    float second_moment;
    float history_length;
    float occluder_distance;
    bool is_sharp;
};

// 1 at the pixel itself, falling to 0 at a distance.
float reach(float squared, float radius) { return max(0.0, 1.0 - squared / (radius * radius)); }

vec2 sample_at(ivec2 p) { return unpack_visibility_samples(packed_at(visibility_samples, p).x); }

// Weight by geometry of a tap; 0 where there is none, or no sample.
float tap_weight(Centre centre, ivec2 p, ivec2 offset, out vec2 taken) {
    ivec2 q = p + offset, tap = nearest_inside(q);
    GuideBits packed = GuideBits(packed_at(guide, tap));
    taken = sample_at(tap);
    bool counts = q == tap && guide_depth(packed) != 0.0 && taken.x >= 0.0;
    return counts ? exp2(log2_edge_weight(centre.edges, packed, depth_sharpness(centre.edges, vec2(offset)))) : 0.0;
}

void search_tap(inout Search found, inout float known, Centre centre, ivec2 p, ivec2 offset, float own_reach) {
    vec2 taken;
    float weight = tap_weight(centre, p, offset, taken);
    float squared = squared_distance(centre.size, centre.edges.gradient, vec2(offset));
    float occluded = weight * (1.0 - taken.x) * reach(squared, 2.0 * push.light_radius * taken.y + NEAR * centre.longer);
    found.occluded += occluded;
    found.lit += weight * taken.x * reach(squared, own_reach);
    found.occluder_distance += occluded * taken.y;
    known += taken.y > 0.0 ? occluded : 0.0;
    if (taken.y > 0.0 && occluded > CLEARLY * found.nearest_weight) {
        found.nearest_weight = occluded;
        found.nearest = p + offset;
    }
}

// 5x5 pixels, and 5x5 three pixels apart. A penumbra is twice as wide as the light's disc is seen from its occluder on either side.
Search search(Centre centre, ivec2 p, vec2 own) {
    Search found = Search(0.0, 0.0, 0.0, 0.0, p);
    float known = 0.0, own_reach = 2.0 * push.light_radius * (own.x < 1.0 ? own.y : 0.0) + NEAR * centre.longer;
    [[dont_unroll]] for (int i = 0; i < 50; ++i) {
        int place = i % 25, stride = i < 25 ? 1 : 3;
        ivec2 offset = ivec2(place % 5 - 2, place / 5 - 2) * stride;
        if (i != 37) search_tap(found, known, centre, p, offset, own_reach);
    }
    found.occluder_distance = known > 0.0 ? found.occluder_distance / known : 0.0;
    return found;
}

Window window(Centre centre, ivec2 p, float radius) {
    Window sum = Window(0.0, 0.0);
    [[dont_unroll]] for (int i = 0; i < 25; ++i) {
        ivec2 offset = ivec2(i % 5 - 2, i / 5 - 2);
        vec2 taken;
        float weight = tap_weight(centre, p, offset, taken);
        weight *= reach(squared_distance(centre.size, centre.edges.gradient, vec2(offset)), radius + NEAR * centre.longer);
        sum.weight += weight;
        sum.lit += weight * max(taken.x, 0.0);
    }
    return sum;
}

// What the mean may be, by the samples of this frame. All of one kind, as far as a penumbra reaches: nothing else.
vec2 bounds(Search found, Window around, float pixels) {
    if (found.occluded <= NOTHING && found.lit > NOTHING) return vec2(1.0);
    if (found.lit <= NOTHING && found.occluded > NOTHING) return vec2(0.0);
    if (around.weight <= NOTHING) return vec2(0.0, 1.0);
    float z = clamp(pixels, CONFIDENCE_Z.x, CONFIDENCE_Z.y), squared = z * z, n = around.weight, inverse = 1.0 / (n + squared);
    float middle = (around.lit + 0.5 * squared) * inverse;
    float half_width = z * inverse * sqrt(max(0.0, around.lit * (n - around.lit) / n + 0.25 * squared));
    return clamp(vec2(middle - half_width, middle + half_width), 0.0, 1.0);
}

bool is_refused(ivec2 tap, Expected expected, float slack) {
    if (!is_inside_previous(tap)) return true;
    GuideBits packed = GuideBits(packed_at(previous_guide, tap));
    return surface_refusal(packed, expected, slack) != REASON_NONE || normal_refusal(guide_normal(packed), expected) != REASON_NONE;
}

void add_tap(inout Gathered sum, ivec2 tap, float weight, Expected expected) {
    if (is_refused(tap, expected, 0.0)) return;
    VisibilityHistory h = unpack_visibility_history(texelFetch(previous_visibility_history, tap, 0).x);
    sum.weight += weight;
    sum.mean += weight * h.mean;
    sum.plain_mean += weight * h.mean;
    sum.second_moment += weight * (h.deviation * h.deviation + h.mean * h.mean);
    sum.history_length += weight * h.history_length;
    sum.occluder_distance = max(sum.occluder_distance, h.occluder_distance);
}

// Replaces the mean that 2x2 taps gave, unless one of 4x4 is another surface: a look that blurs less.
void sharpen(inout Gathered sum, ivec2 corner, vec2 f, Expected expected) {
    vec4 x_weights = cubic_weights(f.x), y_weights = cubic_weights(f.y);
    float slack = 2.0 * (abs(expected.gradient.x) + abs(expected.gradient.y)), mean = 0.0;
    bool whole = true;
    [[dont_unroll]] for (int i = 0; i < 16; ++i) {
        ivec2 tap = corner + ivec2(i % 4, i / 4) - 1;
        whole = whole && !is_refused(tap, expected, slack);
        VisibilityHistory h = unpack_visibility_history(texelFetch(previous_visibility_history, nearest_inside_previous(tap), 0).x);
        mean += x_weights[i % 4] * y_weights[i / 4] * h.mean;
    }
    if (!whole) return;
    sum.mean = sum.weight * clamp(mean, 0.0, 1.0);
    sum.is_sharp = true;
}

// The tested 2x2 taps; where they carry nothing, 3x3 around the nearest pixel.
Gathered gather(vec2 position, Expected expected) {
    Gathered sum = Gathered(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, false);
    vec2 corner = floor(position), f = position - corner;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        float weight = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
        if (weight > 0.0) add_tap(sum, ivec2(corner) + offset, weight, expected);
    }
    if (sum.weight > WHOLE_WEIGHT && f != vec2(0.0)) sharpen(sum, ivec2(corner), f, expected);
    if (sum.weight >= SMALLEST_WEIGHT_SUM) return sum;
    sum = Gathered(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, false);
    ivec2 nearest = ivec2(floor(position + 0.5));
    [[dont_unroll]] for (int i = 0; i < 9; ++i) add_tap(sum, nearest + ivec2(i % 3 - 1, i / 3 - 1), 1.0, expected);
    return sum;
}

// Of the ways from a pixel to the next on the surface.
vec2 squared_lengths(Centre centre) { return centre.size * centre.size + centre.edges.gradient * centre.edges.gradient; }

// The variance that a look between pixels adds to the profile of a shadow's edge, squared scene units.
float blur_of(vec2 position, Centre centre) {
    vec2 f = position - floor(position);
    return dot(f * (1.0 - f), squared_lengths(centre));
}

// The variance that a profile of a shadow's edge may gain, squared scene units.
float tolerated_blur(Centre centre, float radius) {
    vec2 lengths = squared_lengths(centre);
    return TOLERATED_BLUR * radius * radius + TOLERATED_BLUR_OF_ANY * 0.5 * (lengths.x + lengths.y);
}

VisibilityHistory accumulate(float v, VisibilityHistory before, vec2 allowed, float blur, float tolerated) {
    float history_length = min(before.history_length + 1.0, LONGEST_VISIBILITY_HISTORY);
    float alpha = max(push.visibility_alpha, 1.0 / history_length);
    // What is blurred in every frame adds up to blur / alpha.
    alpha = max(alpha, min(1.0, blur / tolerated));
    float mean = clamp(before.mean, allowed.x, allowed.y), difference = v - before.mean;
    float variance = (1.0 - alpha) * (before.deviation * before.deviation + alpha * difference * difference);
    return VisibilityHistory(alpha < 1.0 ? mix(mean, v, alpha) : v, sqrt(variance), min(history_length, 1.0 / alpha), before.occluder_distance);
}

// A pixel's own occluder that should have a motion or a transform, and has none that can be used.
void count_bad_occluder(ivec2 p, vec2 own) {
    if (own.x < 0.0 || own.x >= 1.0 || own.y == 0.0) return;
    if (is_present(OCCLUDER_MOTION) && !is_finite(texelFetch(occluder_motion, p, 0).xyz)) count_bad(BAD_OCCLUDER_MOTION);
    vec4 rows[3];
    uint id = is_present(OCCLUDER_ID) && is_present(INSTANCE_TRANSFORMS) ? texelFetch(occluder_id, p, 0).x : 0u;
    if (id != 0u && !instance_rows(id, rows)) count_bad(BAD_OCCLUDER_ID);
}

// The past of the shadow that reaches the pixel, where that moved; else, and where it lay on no such surface, of the surface.
Gathered past_of(ivec2 p, GuideBits packed, vec2 gradient, Search found, Centre centre, out float blur) {
    SurfaceMotion m = unpack_surface_motion(texelFetch(surface_motion, p, 0));
    vec2 position = previous_position(p, m.motion, frame.render_extent, frame.previous_render_extent) - 0.5, shadow_position;
    Expected expected = expected_surface(packed, m, gradient, m.previous_normal), there = expected;
    Receiver receiver = receiver_at(p, guide_depth(packed), m, position);
    vec3 shadow;
    bool moved = found.nearest_weight > 0.0 && shadow_before(receiver, found.nearest, shadow) && previous_pixel_position(shadow, shadow_position);
    there.depth = (frame.previous_view_from_world * vec4(shadow, 1.0)).z * forward_sign();
    Gathered past = Gathered(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, false);
    [[dont_unroll]] for (int i = moved ? 0 : 1; i < 2 && past.weight == 0.0; ++i) {
        vec2 place = i == 0 ? shadow_position : position;
        past = gather(place, i == 0 ? there : expected);
        blur = blur_of(place, centre) * (past.is_sharp ? CUBIC_BLUR : 1.0);
    }
    return past;
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    GuideBits packed = GuideBits(packed_at(guide, p));
    if (guide_depth(packed) == 0.0) {
        imageStore(visibility_history, p, uvec4(pack_visibility(VisibilityHistory(1.0, 0.0, 1.0, 0.0))));
        return;
    }
    vec2 gradient = unpack_depth_gradient(texelFetch(depth_gradient, p, 0).x), size = pixel_size(guide_depth(packed));
    Centre centre = Centre(edge_centre(packed, gradient), size, max(size.x, size.y));
    vec2 own = sample_at(p);
    Search found = search(centre, p, own);
    Gathered past = Gathered(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, false);
    float blur = 0.0;
    if (!has_flag(FLAG_RESET)) {
        past = past_of(p, packed, gradient, found, centre, blur);
        count_bad_occluder(p, own);
    }
    float distance = found.occluder_distance;
    if (past.occluder_distance > 0.0 && distance > 0.0) distance = mix(past.occluder_distance, distance, DISTANCE_ALPHA);
    float radius = push.light_radius * distance;
    Window around = window(centre, p, radius);
    float share = around.weight > NOTHING ? around.lit / around.weight : 1.0;
    float v = own.x >= 0.0 ? own.x : share;
    VisibilityHistory result = VisibilityHistory(v, 0.0, 1.0, distance);
    if (past.weight > 0.0) {
        vec2 lengths = squared_lengths(centre);
        float inverse = 1.0 / past.weight, mean = past.mean * inverse;
        float deviation = sqrt(max(0.0, past.second_moment * inverse - past.plain_mean * past.plain_mean * inverse * inverse));
        VisibilityHistory before = VisibilityHistory(mean, deviation, past.history_length * inverse, distance);
        result = accumulate(v, before, bounds(found, around, radius * inversesqrt(max(lengths.x, lengths.y))), blur, tolerated_blur(centre, radius));
    }
    if (result.history_length < SHORT_HISTORY) result.deviation = max(result.deviation, sqrt(max(0.0, share * (1.0 - share))));
    imageStore(visibility_history, p, uvec4(pack_visibility(result)));
}
