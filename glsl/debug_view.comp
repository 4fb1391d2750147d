#version 450
// What the denoiser knows of a pixel, as a picture: one view, chosen per frame. No stage reads it.
// Source: none. False colours: Viridis (van der Walt, Smith 2015) at nine places.
// In:  guide, surface_motion, statistics; luminance_history, block_percentiles, firefly_limits and irradiance_history per signal, history_confidence,
//      gradient, noisy radiance per signal and albedo, reflection, visibility_history, and the ids and transforms by which what is mirrored
//      moves, each where the graph has it.
// Out: debug_view. rgb: display-referred, linear 0..1; a: the number behind it. Constants: STRATUM_SIZE.
// optional: surface_motion, luminance_history_0, luminance_history_1, block_percentiles_0, block_percentiles_1, history_0, history_1, history_confidence
// optional: gradient, noisy_1, albedo, reflection, visibility_history, specular_motion, firefly_limits_0, firefly_limits_1
// optional: specular_hit_id, surface_id, instance_transforms
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
// Of sampled images in packed_image.glsl.
#define SIGNALS 2

layout(push_constant) uniform Push {
    uint view;
    uint present;
    float alpha;
    float light_radius;
} push;

#include "both_confidences.glsl"
#include "frame.glsl"
#include "viewport.glsl"
#include "packed_image.glsl"
#include "optional.glsl"
#include "finite.glsl"
#include "surface_motion.glsl"
#include "luminance_history.glsl"
#include "luminance.glsl"
#include "demodulation.glsl"
#include "blocks.glsl"
#include "strata.glsl"
#include "reflection.glsl"
#include "visibility.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint FRAME = 0u;
const uint SURFACE_MOTION = 3u;
const uint MOMENTS_0 = 4u;
const uint MOMENTS_1 = 5u;
const uint BLOCK_PERCENTILES_0 = 6u;
const uint BLOCK_PERCENTILES_1 = 7u;
const uint HISTORY_0 = 8u;
const uint HISTORY_1 = 9u;
const uint HISTORY_CONFIDENCE = 10u;
const uint GRADIENT = 11u;
const uint NOISY_0 = 12u;
const uint NOISY_1 = 13u;
const uint ALBEDO = 14u;
const uint DEBUG_VIEW = 15u;
const uint REFLECTION = 16u;
const uint VISIBILITY_HISTORY = 17u;
const uint FIREFLY_LIMITS_0 = 18u;
const uint FIREFLY_LIMITS_1 = 19u;
const uint SPECULAR_HIT_ID = 20u;
const uint SURFACE_ID = 21u;
const uint INSTANCE_TRANSFORMS = 22u;
const uint SPECULAR_MOTION = 23u;

layout(set = 0, binding = 1, std430) readonly buffer Statistics { uint counts[12]; } statistics;
PACKED_IMAGE(2, guide);
layout(set = 0, binding = SURFACE_MOTION) uniform utexture2D surface_motion;
layout(set = 0, binding = MOMENTS_0) uniform utexture2D luminance_history_0;
layout(set = 0, binding = MOMENTS_1) uniform utexture2D luminance_history_1;
layout(set = 0, binding = BLOCK_PERCENTILES_0) uniform utexture2D block_percentiles_0;
layout(set = 0, binding = BLOCK_PERCENTILES_1) uniform utexture2D block_percentiles_1;
layout(set = 0, binding = HISTORY_0) uniform texture2D history_0;
layout(set = 0, binding = HISTORY_1) uniform texture2D history_1;
layout(set = 0, binding = HISTORY_CONFIDENCE) uniform texture2D history_confidence;
layout(set = 0, binding = GRADIENT) uniform texture2D gradient;
layout(set = 0, binding = NOISY_0) uniform texture2D noisy_0;
layout(set = 0, binding = NOISY_1) uniform texture2D noisy_1;
layout(set = 0, binding = ALBEDO) uniform texture2D albedo;
layout(set = 0, binding = DEBUG_VIEW, rgba16f) uniform writeonly image2D debug_view;
layout(set = 0, binding = REFLECTION) uniform utexture2D reflection;
layout(set = 0, binding = VISIBILITY_HISTORY) uniform utexture2D visibility_history;
layout(set = 0, binding = FIREFLY_LIMITS_0) uniform utexture2D firefly_limits_0;
layout(set = 0, binding = FIREFLY_LIMITS_1) uniform utexture2D firefly_limits_1;
layout(set = 0, binding = SPECULAR_HIT_ID) uniform utexture2D specular_hit_id;
layout(set = 0, binding = SPECULAR_MOTION) uniform texture2D specular_motion;
layout(set = 0, binding = SURFACE_ID) uniform utexture2D surface_id;
layout(set = 0, binding = INSTANCE_TRANSFORMS, std430) readonly buffer InstanceTransforms { vec4 rows[]; } instance_transforms;

#include "scenery.glsl"

// In the order of DebugView in src/contract/debug_view.rs: the binding without which a view has nothing to show; FRAME: none.
const uint NEEDED[20] = uint[](MOMENTS_0, HISTORY_0, MOMENTS_0, GRADIENT, HISTORY_CONFIDENCE, MOMENTS_0, BLOCK_PERCENTILES_0,
                               FIREFLY_LIMITS_0, MOMENTS_0, SURFACE_MOTION, FRAME, FRAME, FRAME, FRAME, REFLECTION, REFLECTION,
                               REFLECTION, REFLECTION, VISIBILITY_HISTORY, VISIBILITY_HISTORY);
const uint VIEW_HISTORY_LENGTH = 0u;
const uint VIEW_DEVIATION = 1u;
const uint VIEW_MEAN_AND_DEVIATION = 2u;
const uint VIEW_GRADIENT = 3u;
const uint VIEW_LAMBDA = 4u;
const uint VIEW_ALPHA = 5u;
const uint VIEW_PERCENTILES = 6u;
const uint VIEW_FIREFLIES = 7u;
const uint VIEW_DISOCCLUSION = 8u;
const uint VIEW_MOTION = 9u;
const uint VIEW_NORMAL = 10u;
const uint VIEW_DEPTH = 11u;
const uint VIEW_SURFACE_ID = 12u;
const uint VIEW_BAD_VALUES = 13u;
const uint VIEW_HIT_DISTANCE = 14u;
const uint VIEW_LOBE_ANGLE = 15u;
const uint VIEW_VIRTUAL_MOTION = 16u;
const uint VIEW_REFLECTION_HISTORY = 17u;
const uint VIEW_VISIBILITY = 18u;
const uint VIEW_PENUMBRA = 19u;

const float LONG_HISTORY = 32.0;    // frames; from here on histories look alike
const float WIDEST_LOBE = 45.0;     // degrees
const float LARGE_MOTION = 64.0;    // pixels; from here on motions look alike
const float WIDE_PENUMBRA = 16.0;   // pixels
const float DEVIATION_SCALE = 4.0;   // deviations of 1/4 are in the middle of the colours
const uint BAD_KINDS = 12u;

const vec3 VIRIDIS[9] = vec3[](vec3(68, 1, 84), vec3(71, 45, 123), vec3(59, 82, 139), vec3(44, 114, 142), vec3(33, 145, 140),
                               vec3(40, 174, 128), vec3(94, 201, 98), vec3(173, 220, 48), vec3(253, 231, 37));
// Okabe and Ito's: history, off screen, background or id, depth, normal, reset.
const vec3 REASON_COLOURS[6] = vec3[](vec3(60, 60, 60), vec3(230, 159, 0), vec3(86, 180, 233), vec3(0, 158, 115),
                                      vec3(240, 228, 66), vec3(213, 94, 0));

// Pasts of a reflection, linear: where the surface was, where the image was.
const vec3 SURFACE_PAST = vec3(0.8, 0.35, 0.02);
const vec3 IMAGE_PAST = vec3(0.05, 0.3, 0.8);

// Of a colour in sRGB, 0..255; every component is beyond the linear part of its curve or black.
vec3 from_srgb(vec3 c) { return pow((c / 255.0 + 0.055) / 1.055, vec3(2.4)); }

vec3 false_colour(float t) {
    float x = clamp(t, 0.0, 1.0) * 8.0;
    int i = min(int(x), 7);
    return from_srgb(mix(VIRIDIS[i], VIRIDIS[i + 1], x - float(i)));
}

float compressed(float x) { return x / (1.0 + x); }

float change_at(ivec2 p) { return is_present(HISTORY_CONFIDENCE) ? change_by(texelFetch(history_confidence, host_pixel(HISTORY_CONFIDENCE, p), 0).x) : 0.0; }

float history_length_at(ivec2 p) { return unpack_luminance_history(texelFetch(luminance_history_0, p, 0).x).history_length; }

// The signals add up: their means, and as independent ones their variances.
vec2 mean_and_deviation(ivec2 p) {
    LuminanceHistory m = unpack_luminance_history(texelFetch(luminance_history_0, p, 0).x);
    vec2 sum = vec2(m.mean, m.deviation * m.deviation);
    if (is_present(MOMENTS_1)) {
        m = unpack_luminance_history(texelFetch(luminance_history_1, p, 0).x);
        sum += vec2(m.mean, m.deviation * m.deviation);
    }
    return vec2(sum.x, sqrt(sum.y));
}

float filter_deviation(ivec2 p) {
    // Negative in the background.
    float first = max(texelFetch(history_0, p, 0).a, 0.0);
    float second = is_present(HISTORY_1) ? max(texelFetch(history_1, p, 0).a, 0.0) : 0.0;
    return sqrt(first * first + second * second);
}

vec4 percentiles_at(ivec2 p) {
    vec2 low_up = unpack_block_percentiles(texelFetch(block_percentiles_0, p / BLOCK_SIZE, 0).x).low_up;
    float other = is_present(BLOCK_PERCENTILES_1) ? unpack_block_percentiles(texelFetch(block_percentiles_1, p / BLOCK_SIZE, 0).x).low_up.y : 0.0;
    return vec4(compressed(low_up.x), compressed(low_up.y), compressed(other), low_up.y);
}

// The part of the luminance that firefly.comp cuts off.
float excess(ivec2 p, uint binding, texture2D noisy, utexture2D firefly_limits) {
    vec3 radiance = texelFetch(noisy, host_pixel(binding, p), 0).rgb, divisor = vec3(1.0);
    if (!is_finite(radiance)) return 0.0;
    if (is_present(ALBEDO)) divisor = divisor_of(texelFetch(albedo, host_pixel(ALBEDO, guide_pixel(p)), 0).rgb);
    float l = luminance(half_range(exposed(radiance) / divisor)), limit = unpack_firefly_limits(texelFetch(firefly_limits, p / CELL_SIZE, 0).x).limit;
    return limit > 0.0 && l > limit ? 1.0 - limit / l : 0.0;
}

vec4 fireflies_at(ivec2 p) {
    float share = excess(p, NOISY_0, noisy_0, firefly_limits_0);
    if (is_present(FIREFLY_LIMITS_1) && is_present(NOISY_1)) share = max(share, excess(p, NOISY_1, noisy_1, firefly_limits_1));
    return vec4(false_colour(share), share);
}

// Red: brighter than before; blue: darker.
vec4 gradient_at(ivec2 p) {
    vec2 value = texelFetch(gradient, p / int(STRATUM_SIZE), 0).xy;
    float t = value.y > 0.0 ? clamp(value.x / value.y, -1.0, 1.0) : 0.0;
    return vec4(max(t, 0.0), 0.15 * abs(t), max(-t, 0.0), value.x);
}

vec4 coloured_motion(vec2 motion) {
    float pixels = length(motion), t = min(log2(1.0 + pixels) / log2(1.0 + LARGE_MOTION), 1.0);
    vec2 direction = pixels > 0.0 ? motion / pixels : vec2(0.0);
    return vec4(0.5 + 0.5 * t * direction, 0.5 - 0.5 * t, pixels);
}

vec2 motion_at(ivec2 p) { return unpack_surface_motion(texelFetch(surface_motion, p, 0)).motion; }

vec4 id_at(uint id) {
    uint hash = pcg(id);
    return vec4(vec3(hash & 255u, hash >> 8 & 255u, hash >> 16 & 255u) / 255.0, float(id));
}

// One bar for each kind of input, as long as the logarithm of what was not finite, against that of all pixels.
vec4 bad_values_at(ivec2 p) {
    uint kind = min(uint(p.y) * BAD_KINDS / frame.render_extent.y, BAD_KINDS - 1u);
    float count = float(statistics.counts[kind]), pixels = float(frame.render_extent.x) * float(frame.render_extent.y);
    bool lit = (float(p.x) + 0.5) / float(frame.render_extent.x) < log2(1.0 + count) / log2(1.0 + pixels);
    vec3 ground = vec3((kind & 1u) == 0u ? 0.02 : 0.04);
    return vec4(lit ? from_srgb(REASON_COLOURS[5]) : ground, count);
}

vec4 hit_distance_at(ivec2 p, GuideBits packed) {
    float distance = unpack_reflection(texelFetch(reflection, p, 0).x).hit_distance;
    return distance > 0.0 ? vec4(false_colour(nearness_of(guide_depth(packed), distance)), distance) : vec4(0.0);
}

vec4 lobe_angle_at(ivec2 p) {
    float angle = degrees(atan(lobe_width(unpack_reflection(texelFetch(reflection, p, 0).x).roughness)));
    return vec4(false_colour(angle / WIDEST_LOBE), angle);
}

// Of the image behind the surface; of the surface, where nothing is known of it.
vec4 virtual_motion_at(ivec2 p, GuideBits packed) {
    Reflection r = unpack_reflection(texelFetch(reflection, p, 0).x);
    vec2 motion = is_present(SURFACE_MOTION) ? motion_at(p) : vec2(0.0), position;
    Mirror mirror = mirror_at(p, packed, motion);
    Curvature curvature = curvature_at(mirror);
    BadMotion bad;
    Scenery before = scenery_before(mirror, curvature, r, bad);
    bool known = r.hit_distance > 0.0 && virtual_position(mirror, curvature, before.mirror, before.image, r.roughness, position);
    return coloured_motion(known ? position - mirror.surface_position + motion : motion);
}

vec4 reflection_history_at(ivec2 p) {
    float share = unpack_image_share(texelFetch(reflection, p, 0).x);
    return share < 0.0 ? vec4(from_srgb(REASON_COLOURS[5]), share) : vec4(mix(SURFACE_PAST, IMAGE_PAST, share), share);
}

// Of a surface that faces the camera: radii of the filter are measured in such pixels.
vec4 penumbra_at(ivec2 p, GuideBits packed) {
    float distance = unpack_visibility_history(texelFetch(visibility_history, p, 0).x, 0u).occluder_distance;
    vec2 size = pixel_size(guide_depth(packed));
    float pixels = push.light_radius * distance / max(size.x, size.y);
    return distance > 0.0 ? vec4(false_colour(pixels / WIDE_PENUMBRA), pixels) : vec4(0.0);
}

vec4 shown(ivec2 p, GuideBits packed, uint view) {
    float value = 0.0;
    switch (view) {
    case VIEW_HISTORY_LENGTH: value = history_length_at(p); return vec4(false_colour(value / LONG_HISTORY), value);
    case VIEW_DEVIATION: value = filter_deviation(p); return vec4(false_colour(compressed(DEVIATION_SCALE * value)), value);
    case VIEW_MEAN_AND_DEVIATION: {
        vec2 m = mean_and_deviation(p);
        return vec4(compressed(m.x), compressed(m.y), 0.0, m.x);
    }
    case VIEW_GRADIENT: return gradient_at(p);
    case VIEW_LAMBDA: value = change_at(p); return vec4(false_colour(value), value);
    case VIEW_ALPHA: {
        value = max(push.alpha + change_at(p) * (1.0 - push.alpha), 1.0 / max(history_length_at(p), 1.0));
        return vec4(false_colour(value), value);
    }
    case VIEW_PERCENTILES: return percentiles_at(p);
    case VIEW_FIREFLIES: return fireflies_at(p);
    case VIEW_DISOCCLUSION: {
        uint reason = min(unpack_luminance_history(texelFetch(luminance_history_0, p, 0).x).reason, REASON_RESET);
        return vec4(from_srgb(REASON_COLOURS[reason]), float(reason));
    }
    case VIEW_MOTION: return coloured_motion(motion_at(p));
    case VIEW_VIRTUAL_MOTION: return virtual_motion_at(p, packed);
    case VIEW_REFLECTION_HISTORY: return reflection_history_at(p);
    case VIEW_VISIBILITY: value = unpack_visibility_history(texelFetch(visibility_history, p, 0).x, 0u).mean; return vec4(false_colour(value), value);
    case VIEW_PENUMBRA: return penumbra_at(p, packed);
    case VIEW_HIT_DISTANCE: return hit_distance_at(p, packed);
    case VIEW_LOBE_ANGLE: return lobe_angle_at(p);
    case VIEW_NORMAL: return vec4(guide_normal(packed) * 0.5 + 0.5, 0.0);
    case VIEW_DEPTH: value = guide_depth(packed); return vec4(false_colour(compressed(value)), value);
    default: return id_at(guide_id(packed));
    }
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    uint view = min(push.view, VIEW_PENUMBRA);
    GuideBits packed = GuideBits(packed_at(guide, p));
    vec4 value = vec4(0.0);
    if (!is_present(NEEDED[view])) value.rgb = vec3(((p.x >> 3 ^ p.y >> 3) & 1) == 0 ? 0.02 : 0.05);
    else if (view == VIEW_BAD_VALUES) value = bad_values_at(p);
    else if (guide_depth(packed) > 0.0) value = shown(p, packed, view);
    imageStore(debug_view, host_pixel(DEBUG_VIEW, p), vec4(clamp(value.rgb, 0.0, 1.0), clamp(value.a, -65504.0, 65504.0)));
}
