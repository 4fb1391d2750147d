#version 450
// Blends every pixel with its own past: back-projected by motion, tap by tap tested against depth, normal and id.
// Source: [SVGF] 4.1. Deviations: alpha is at least 1/N; moments are kept as mean and deviation.
// In:  guide (current, previous), surface_motion, irradiance_history and luminance_history of the previous frame; object normals in the
//      place of those of the guide; material_class; history_confidence: [ASVGF] 3.5, alpha by pixel; light_ratio per stratum: ours, history follows the light.
// In place: irradiance, from noisy to accumulated with the history length in alpha, own pixel only. Out: new_luminance.
// Counts in statistics: surfaces with a history of their own, and those without by reason.
// Constants: VOLUME: [PSVGF], along volume_motion; no test but that of the depth of the surface behind, and that less strict; no background.
// REPAIR: [PSVGF], disocclusion repair: a wider search, motion cut at the border of the image. SHARP: irradiance by the cubic of Catmull and
// Rom, where all its 4x4 taps show the surface, so that history does not blur as it moves; taps count as far as normals agree.
// STRATUM_SIZE: with light_ratio. A pixel with a negative alpha has no sample of its own, and what was filled in weighs less: so each
// signal has a history length of its own.
// optional: surface_motion, volume_motion, object_normal, previous_object_normal, history_confidence, light_ratio, material_class
// variants: SIGNALS=1 SIGNALS=2
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const bool VOLUME = false;
layout(constant_id = 2) const bool REPAIR = false;
layout(constant_id = 3) const bool SHARP = false;

layout(push_constant) uniform Push {
    uint present;
    float alpha;
    float alpha_moments;
    float max_history_length;
    float depth_tolerance;
    float normal_tolerance;
} push;

#include "both_confidences.glsl"
#include "cubic.glsl"
#include "frame.glsl"
#include "viewport.glsl"
#include "optional.glsl"
#include "surface_motion.glsl"
#include "luminance_history.glsl"
#include "luminance.glsl"
#include "history_blend.glsl"
#include "packed_image.glsl"
#include "statistics.glsl"
#include "surface_test.glsl"
#include "volume.glsl"

const uint SURFACE_MOTION = 4u;
const uint VOLUME_MOTION = 6u;
const uint OBJECT_NORMAL = 7u;
const uint PREVIOUS_OBJECT_NORMAL = 8u;
const uint HISTORY_CONFIDENCE = 9u;
const uint LIGHT_RATIO = 18u;
const uint MATERIAL_CLASS = 19u;

layout(set = 0, binding = 2) uniform utexture2D guide;
PACKED_IMAGE(3, previous_guide);
layout(set = 0, binding = SURFACE_MOTION) uniform utexture2D surface_motion;
layout(set = 0, binding = VOLUME_MOTION) uniform utexture2D volume_motion;
layout(set = 0, binding = OBJECT_NORMAL) uniform utexture2D object_normal;
layout(set = 0, binding = PREVIOUS_OBJECT_NORMAL) uniform utexture2D previous_object_normal;
layout(set = 0, binding = HISTORY_CONFIDENCE) uniform texture2D history_confidence;
layout(set = 0, binding = LIGHT_RATIO) uniform texture2D light_ratio;
layout(set = 0, binding = MATERIAL_CLASS) uniform utexture2D material_class;
layout(set = 0, binding = 10) uniform texture2D history_0;
PACKED_IMAGE_32(11, previous_luminance_history_0);
layout(set = 0, binding = 12, rgba16f) uniform image2D irradiance_0;
layout(set = 0, binding = 13, r32ui) uniform writeonly uimage2D new_luminance_0;
#if SIGNALS == 2
layout(set = 0, binding = 14) uniform texture2D history_1;
PACKED_IMAGE_32(15, previous_luminance_history_1);
layout(set = 0, binding = 16, rgba16f) uniform image2D irradiance_1;
layout(set = 0, binding = 17, r32ui) uniform writeonly uimage2D new_luminance_1;
#endif

#include "material.glsl"
#include "ratio_at_pixel.glsl"

Material material;

// What moments are taken about, of each signal: luminance_origin of the pixel.
float origins[SIGNALS];

struct Gathered {
    float weight;
    // Of the same taps, had all of them the expected normal; with SHARP alone.
    float whole;
    float history_lengths[SIGNALS];
    History signals[SIGNALS];
};

bool has_object_normals() { return is_present(OBJECT_NORMAL) && is_present(PREVIOUS_OBJECT_NORMAL); }

vec3 unpack_object_normal(uint packed) { return unpack_octahedral(packed, 511.0, 10u); }

vec3 normal_of(ivec2 tap, GuideBits packed) {
    return has_object_normals() ? unpack_object_normal(texelFetch(previous_object_normal, tap, 0).x) : guide_normal(packed);
}

// `slack`: depth that the surface may have gained on the way to a tap that lies aside.
uint refusal(ivec2 tap, Expected expected, float slack) {
    if (!is_inside_previous(tap)) return REASON_OFF_SCREEN;
    GuideBits packed = GuideBits(packed_at(previous_guide, tap));
    if (VOLUME) {
        float difference = relative_difference(volume_depth(packed), expected.depth);
        return difference <= expected.depth_tolerance ? REASON_NONE : REASON_DEPTH;
    }
    uint reason = surface_refusal(packed, expected, slack);
    if (reason != REASON_NONE) return reason;
    return normal_refusal(normal_of(tap, packed), expected);
}

float likeness(ivec2 tap, Expected expected) {
    if (!SHARP || VOLUME) return 1.0;
    return normal_likeness(normal_of(tap, GuideBits(packed_at(previous_guide, tap))), expected);
}

// `whole`: the weight of a tap whose normal is as expected.
void add_tap(inout Gathered sum, ivec2 tap, Expected expected, float whole) {
    float weight = whole * likeness(tap, expected);
    if (SHARP) sum.whole += whole;
    LuminanceHistory m = unpack_luminance_history(packed_at(previous_luminance_history_0, tap).x);
    sum.weight += weight;
    sum.history_lengths[0] += weight * m.history_length;
    add_moments(sum.signals[0], texelFetch(history_0, tap, 0).rgb, m, origins[0], weight);
    widen_range(sum.signals[0], m.mean);
#if SIGNALS == 2
    LuminanceHistory m_1 = unpack_luminance_history(packed_at(previous_luminance_history_1, tap).x);
    sum.history_lengths[1] += weight * m_1.history_length;
    add_moments(sum.signals[1], texelFetch(history_1, tap, 0).rgb, m_1, origins[1], weight);
    widen_range(sum.signals[1], m_1.mean);
#endif
}

float whole_of(Gathered sum) { return SHARP ? sum.whole : sum.weight; }

Gathered nothing() {
    Gathered sum;
    sum.weight = 0.0;
    sum.whole = 0.0;
    for (int i = 0; i < SIGNALS; ++i) {
        sum.history_lengths[i] = 0.0;
        sum.signals[i] = NO_HISTORY;
    }
    return sum;
}

// A motion that leaves the image ends where it crosses the border: at the last place of the surface that was seen.
vec2 cut_at_border(vec2 start, vec2 position) {
    vec2 last = vec2(frame.previous_render_extent) - 1.0;
    vec2 way = position - start, border = clamp(position, vec2(0.0), last), part = vec2(1.0);
    start = clamp(start, vec2(0.0), last);
    if (border.x != position.x) part.x = way.x == 0.0 ? 0.0 : (border.x - start.x) / way.x;
    if (border.y != position.y) part.y = way.y == 0.0 ? 0.0 : (border.y - start.y) / way.y;
    return start + clamp(min(part.x, part.y), 0.0, 1.0) * way;
}

// Frames that the history of a neighbour is worth: it soon gives way to what the pixel sees itself.
const float REPAIRED_HISTORY_LENGTH = 4.0;

// Around the end of the motion 3x3 pixels, then rings of eight, 2 and 4 pixels away, until one has a pixel that may be the same surface.
Gathered repair(vec2 start, vec2 position, Expected expected) {
    ivec2 nearest = ivec2(floor(cut_at_border(start, position) + 0.5));
    Gathered sum = nothing();
    [[dont_unroll]] for (int ring = 1; ring <= 4 && sum.weight == 0.0; ring *= 2)
        [[dont_unroll]] for (int i = 0; i < 9; ++i) {
            if (i == 4 && ring > 1) continue;
            ivec2 tap = nearest + ivec2(i % 3 - 1, i / 3 - 1) * ring;
            float slack = dot(abs(expected.gradient), abs(vec2(tap) - position));
            if (refusal(tap, expected, slack) == REASON_NONE) add_tap(sum, tap, expected, 1.0);
        }
    for (int i = 0; i < SIGNALS; ++i) sum.history_lengths[i] = min(sum.history_lengths[i], REPAIRED_HISTORY_LENGTH * whole_of(sum));
    return sum;
}

// Replaces the irradiance that 2x2 taps gave, unless one of 4x4 is another surface.
void sharpen(inout Gathered sum, ivec2 corner, vec2 f, Expected expected) {
    vec4 x_weights = cubic_weights(f.x), y_weights = cubic_weights(f.y);
    vec3 irradiance[SIGNALS];
    for (int i = 0; i < SIGNALS; ++i) irradiance[i] = vec3(0.0);
    bool whole = true;
    // The outer taps lie up to two pixels away.
    float slack = 2.0 * (abs(expected.gradient.x) + abs(expected.gradient.y));
    [[dont_unroll]] for (int i = 0; i < 16; ++i) {
        ivec2 tap = corner + ivec2(i % 4, i / 4) - 1;
        float weight = x_weights[i % 4] * y_weights[i / 4];
        whole = whole && refusal(tap, expected, slack) == REASON_NONE;
        irradiance[0] += weight * texelFetch(history_0, nearest_inside_previous(tap), 0).rgb;
#if SIGNALS == 2
        irradiance[1] += weight * texelFetch(history_1, nearest_inside_previous(tap), 0).rgb;
#endif
    }
    if (!whole) return;
    for (int i = 0; i < SIGNALS; ++i) sum.signals[i].irradiance = sum.weight * irradiance[i];
}

// The tested 2x2 taps; where they carry nothing, 3x3 around the nearest pixel.
Gathered gather(vec2 position, Expected expected) {
    Gathered sum = nothing();
    vec2 corner = floor(position);
    vec2 f = position - corner;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec2 tap = ivec2(corner) + offset;
        float weight = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
        if (weight > 0.0 && refusal(tap, expected, 0.0) == REASON_NONE) add_tap(sum, tap, expected, weight);
    }
    if (SHARP && !VOLUME && sum.whole > WHOLE_WEIGHT && f != vec2(0.0)) sharpen(sum, ivec2(corner), f, expected);
    if (whole_of(sum) >= SMALLEST_WEIGHT_SUM) return sum;
    sum = nothing();
    ivec2 nearest = ivec2(floor(position + 0.5));
    // Rare, and where branches are masked instead of skipped every unrolled tap costs.
    [[dont_unroll]] for (int y = -1; y <= 1; ++y)
        [[dont_unroll]] for (int x = -1; x <= 1; ++x) {
            ivec2 tap = nearest + ivec2(x, y);
            if (refusal(tap, expected, 0.0) == REASON_NONE) add_tap(sum, tap, expected, 1.0);
        }
    return sum;
}

bool is_filtered(GuideBits packed) { return VOLUME || guide_depth(packed) != 0.0; }

Expected volume_expectation(ivec2 p, GuideBits packed, out vec2 motion) {
    motion = is_present(VOLUME_MOTION) ? unpack_volume_motion(texelFetch(volume_motion, p, 0).x) : vec2(0.0);
    return Expected(volume_depth(packed), push.depth_tolerance, vec2(0.0), vec3(0.0), push.normal_tolerance, 0u, false);
}

Expected surface_expectation(ivec2 p, GuideBits packed, out vec2 motion) {
    SurfaceMotion m = SurfaceMotion(vec2(0.0), 0.0, guide_normal(packed));
    if (is_present(SURFACE_MOTION)) m = unpack_surface_motion(texelFetch(surface_motion, p, 0));
    motion = m.motion;
    vec2 gradient = guide_gradient(packed);
    vec3 n = has_object_normals() ? unpack_object_normal(texelFetch(object_normal, p, 0).x) : m.previous_normal;
    return with_tolerances(expected_surface(packed, m, gradient, n), material.depth, material.normal);
}

// What the previous frame must show, and where.
Expected expectation(ivec2 p, GuideBits packed, out vec2 motion) {
    if (VOLUME) return volume_expectation(p, packed, motion);
    return surface_expectation(p, packed, motion);
}

// How far light changed at a pixel: 0, not at all, to 1.
float change_at(ivec2 p) { return is_present(HISTORY_CONFIDENCE) ? change_by(texelFetch(history_confidence, host_pixel(HISTORY_CONFIDENCE, p), 0).x) : 0.0; }

float longest_history(float change) {
    float longest = min(push.max_history_length, material.longest_history);
    if (!is_present(HISTORY_CONFIDENCE)) return longest;
    // [PSVGF]: as long as the weight of this frame says, so that later frames react, too. Else: what alpha forgets is gone from the
    // length, too, so that the variance is estimated from the neighbourhood.
    float weight = REPAIR ? change : adapted(push.alpha, change);
    return min(longest, 1.0 / max(weight, 1e-6));
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    GuideBits packed = GuideBits(texelFetch(guide, p, 0));
    bool background = !is_filtered(packed);
    bool reset = has_flag(FLAG_RESET);
    material = USUAL_MATERIAL;
    if (is_present(MATERIAL_CLASS)) material = material_at(p);
    if (is_present(MATERIAL_CLASS) && !background && !is_class(class_at(p))) count_bad(BAD_MATERIAL_CLASS);
    vec4 texels[SIGNALS];
    texels[0] = imageLoad(irradiance_0, p);
#if SIGNALS == 2
    texels[1] = imageLoad(irradiance_1, p);
#endif
    for (int i = 0; i < SIGNALS; ++i) origins[i] = luminance_origin(texels[i].rgb);
    Gathered sum = nothing();
    uint reason = background ? REASON_NONE : REASON_RESET;
    if (!background && !reset) {
        vec2 motion;
        Expected expected = expectation(p, packed, motion);
        vec2 position = previous_position(p, motion, frame.render_extent, frame.previous_render_extent) - 0.5;
        sum = gather(position, expected);
        // Of what is repaired, too: neighbours stand in for a history that is lost.
        uint loss = sum.weight > 0.0 ? REASON_NONE : refusal(ivec2(floor(position + 0.5)), expected, 0.0);
        if (!VOLUME) count_history(loss);
        if (REPAIR && sum.weight == 0.0) {
            vec2 start = previous_position(p, vec2(0.0), frame.render_extent, frame.previous_render_extent) - 0.5;
            sum = repair(start, position, expected);
        }
        reason = sum.weight > 0.0 ? REASON_NONE : loss;
    }
    float inverse = sum.weight > 0.0 ? 1.0 / sum.weight : 0.0;
    float change = change_at(p), longest = longest_history(change);
    vec3 irradiance[SIGNALS];
    LuminanceHistory luminance_history[SIGNALS];
    vec3 ratio = light_ratio_at(p);
    for (int i = 0; i < SIGNALS; ++i) {
        irradiance[i] = texels[i].rgb;
        float worth = sample_worth(texels[i].a);
        luminance_history[i] = first_luminance(irradiance[i], worth, reason);
        if (sum.weight > 0.0) {
            float history_length = min(sum.history_lengths[i] / whole_of(sum) + worth, longest);
            History h = of_moments(scaled(sum.signals[i], inverse), origins[i]);
            vec2 least = adapted(vec2(push.alpha, push.alpha_moments) * worth, change);
            irradiance[i] = blend(irradiance[i], in_light(h, ratio, light_scale(ratio)), history_length, worth, least, luminance_history[i]);
        }
    }
    imageStore(irradiance_0, p, vec4(signed_storable(irradiance[0]), length_or_reason(luminance_history[0])));
    imageStore(new_luminance_0, p, uvec4(pack_new_luminance(luminance_history[0])));
#if SIGNALS == 2
    imageStore(irradiance_1, p, vec4(signed_storable(irradiance[1]), length_or_reason(luminance_history[1])));
    imageStore(new_luminance_1, p, uvec4(pack_new_luminance(luminance_history[1])));
#endif
}
