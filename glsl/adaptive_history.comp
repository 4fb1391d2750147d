#version 450
// How far the history of a pixel is still true, from statistics of blocks alone: no re-shaded samples are needed.
// Source: [PSVGF], adaptive accumulation. RULE=0: the published rule, which compares the history with the percentiles of this frame.
// RULE=1: a test of the mean difference against its standard error, over 24x24 pixels, which works in both directions (docs/stages.md).
// In:  RULE=0: guide (current, previous), surface_motion, depth_gradient; per signal block_percentiles, irradiance_history (previous).
//      RULE=1: per signal block_difference. Out: history_confidence, 1 (keep) to 0 (drop); the least of the signals.
// variants: SIGNALS=1,RULE=0 SIGNALS=2,RULE=0 SIGNALS=1,RULE=1 SIGNALS=2,RULE=1
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "luminance.glsl"
#include "nearest_history.glsl"
#include "blocks.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 1, r32f) uniform writeonly image2D history_confidence;
#if RULE == 0
layout(set = 0, binding = 2) uniform utexture2D guide;
layout(set = 0, binding = 3) uniform utexture2D previous_guide;
layout(set = 0, binding = 4) uniform utexture2D surface_motion;
layout(set = 0, binding = 5) uniform utexture2D depth_gradient;
layout(set = 0, binding = 6) uniform utexture2D block_percentiles_0;
layout(set = 0, binding = 7) uniform texture2D history_0;
#if SIGNALS == 2
layout(set = 0, binding = 8) uniform utexture2D block_percentiles_1;
layout(set = 0, binding = 9) uniform texture2D history_1;
#endif
#else
layout(set = 0, binding = 2) uniform utexture2D block_difference_0;
#if SIGNALS == 2
layout(set = 0, binding = 3) uniform utexture2D block_difference_1;
#endif
#endif

float lin(float a, float b, float x) { return clamp((x - a) / (b - a), 0.0, 1.0); }

#if RULE == 0
// A block of one luminance has no range: this share of it always counts as usual.
const float RANGE_EPSILON = 0.01;

vec2 percentiles_at(ivec2 p, utexture2D blocks) {
    vec2 position = block_position(p), corner = floor(position), f = position - corner;
    vec2 sum = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec2 block = clamp(ivec2(corner) + offset, ivec2(0), block_extent() - 1);
        float weight = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
        sum += weight * unpackHalf2x16(texelFetch(blocks, block, 0).x);
    }
    return sum;
}

// A, the weight of the history.
float kept(ivec2 p, ivec2 tap, utexture2D blocks, texture2D history) {
    vec2 low_up = percentiles_at(p, blocks);
    float range = percentile_range(low_up) + RANGE_EPSILON * low_up.y + 1e-4;
    float l = luminance(texelFetch(history, tap, 0).rgb) * frame.exposure_ratio;
    float too_bright = lin(low_up.y, low_up.y + range, l);
    float too_dark = 1.0 - lin(low_up.x - range, low_up.x, l);
    return (1.0 - frame.adaptivity * too_bright) * (1.0 - frame.adaptivity * too_dark);
}

float confidence_at(ivec2 p) {
    ivec2 tap;
    if (!nearest_history(p, texelFetch(guide, p, 0), surface_motion, depth_gradient, previous_guide, tap)) return 1.0;
    float confidence = kept(p, tap, block_percentiles_0, history_0);
#if SIGNALS == 2
    confidence = min(confidence, kept(p, tap, block_percentiles_1, history_1));
#endif
    return confidence;
}
#else
// A change of the mean that is smaller than this share of it is not worth the history, however certain it is.
const float CHANGE_EPSILON = 0.01;

// The 5x5 blocks around this one, and the change of the inner 3x3.
shared vec4 blocks[25];
shared float changes[9];

void load_blocks(utexture2D differences) {
    uint i = gl_LocalInvocationIndex;
    if (i >= 25u) return;
    ivec2 block = ivec2(gl_WorkGroupID.xy) + ivec2(int(i % 5u), int(i / 5u)) - 2;
    uvec4 packed = is_block(block) ? texelFetch(differences, block, 0) : uvec4(0u);
    blocks[i] = vec4(half_value(packed.x), half_value(packed.y), half_value(packed.z), half_value(packed.w));
}

// 0 to 1: the mean difference over 3x3 blocks, in standard errors, against the threshold.
float change_of(uint centre) {
    float count = 0.0, sum = 0.0, variance = 0.0, brighter = 0.0;
    for (uint i = 0u; i < 9u; ++i) {
        vec4 block = blocks[centre + i % 3u + 5u * (i / 3u) - 6u];
        count += block.z;
        sum += block.z * block.x;
        variance += block.z * block.y * block.y;
        brighter += block.z * block.w;
    }
    float floor_of_error = CHANGE_EPSILON * brighter;
    float errors = abs(sum) / max(sqrt(variance + floor_of_error * floor_of_error), 1e-6);
    return lin(frame.change_threshold, 2.0 * frame.change_threshold, errors);
}

float change_at(ivec2 p) {
    vec2 position = block_position(p), corner = floor(position), f = position - corner;
    ivec2 origin = ivec2(gl_WorkGroupID.xy) - 1;
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        ivec2 block = clamp(ivec2(corner) + offset, ivec2(0), block_extent() - 1) - origin;
        float weight = (offset.x == 1 ? f.x : 1.0 - f.x) * (offset.y == 1 ? f.y : 1.0 - f.y);
        sum += weight * changes[block.x + 3 * block.y];
    }
    return sum;
}

float confidence_at(ivec2 p) {
    uint i = gl_LocalInvocationIndex;
    float change = 0.0;
    uint centre = 6u + i % 3u + 5u * (i / 3u);
    load_blocks(block_difference_0);
    barrier();
    if (i < 9u) change = change_of(centre);
#if SIGNALS == 2
    barrier();
    load_blocks(block_difference_1);
    barrier();
    if (i < 9u) change = max(change, change_of(centre));
#endif
    if (i < 9u) changes[i] = change;
    barrier();
    return 1.0 - frame.adaptivity * change_at(p);
}
#endif

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
#if RULE == 0
    if (!is_inside(p)) return;
#endif
    float confidence = confidence_at(p);
    if (is_inside(p)) imageStore(history_confidence, p, vec4(confidence));
}
