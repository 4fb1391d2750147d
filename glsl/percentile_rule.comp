#version 450
// How far the history of a pixel is still true: as far as it lies within the percentiles of this frame. No re-shaded samples are needed.
// Source: [PSVGF], adaptive accumulation, the published rule.
// In:  guide (current, previous), surface_motion; per signal block_percentiles, irradiance_history (previous).
// Out: history_confidence, 1 (keep) to 0 (drop); the least of the signals.
// optional: block_percentiles_1, history_1
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    uint present;
    float depth_tolerance;
    float percentile_range;
    float adaptivity;
} push;

#include "frame.glsl"
#include "viewport.glsl"
#include "optional.glsl"
#include "luminance.glsl"
#include "nearest_history.glsl"
#include "blocks.glsl"
#include "percentile_range.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint HISTORY_CONFIDENCE = 1u;
const uint BLOCK_PERCENTILES_1 = 8u;
const uint HISTORY_1 = 9u;

layout(set = 0, binding = HISTORY_CONFIDENCE, r32f) uniform writeonly image2D history_confidence;
layout(set = 0, binding = 2) uniform utexture2D guide;
layout(set = 0, binding = 3) uniform utexture2D previous_guide;
layout(set = 0, binding = 4) uniform utexture2D surface_motion;
layout(set = 0, binding = 6) uniform utexture2D block_percentiles_0;
layout(set = 0, binding = 7) uniform texture2D history_0;
layout(set = 0, binding = BLOCK_PERCENTILES_1) uniform utexture2D block_percentiles_1;
layout(set = 0, binding = HISTORY_1) uniform texture2D history_1;

float lin(float a, float b, float x) { return clamp((x - a) / (b - a), 0.0, 1.0); }

// A block of one luminance has no range: this share of it always counts as usual.
const float RANGE_EPSILON = 0.01;

vec2 percentiles_at(ivec2 p, utexture2D blocks) {
    BlocksAround around = blocks_around(p);
    vec2 sum = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        bvec2 is_second = bvec2((i & 1) == 1, i >> 1 == 1);
        ivec2 block = mix(around.first, around.second, is_second);
        vec2 weights = mix(1.0 - around.fraction, around.fraction, is_second);
        sum += weights.x * weights.y * unpack_block_percentiles(texelFetch(blocks, block, 0).x).low_up;
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
    return (1.0 - push.adaptivity * too_bright) * (1.0 - push.adaptivity * too_dark);
}

float confidence_at(ivec2 p) {
    ivec2 tap;
    if (!nearest_history(p, GuideBits(texelFetch(guide, p, 0)), surface_motion, previous_guide, tap)) return 1.0;
    float confidence = kept(p, tap, block_percentiles_0, history_0);
    if (is_present(BLOCK_PERCENTILES_1) && is_present(HISTORY_1)) confidence = min(confidence, kept(p, tap, block_percentiles_1, history_1));
    return confidence;
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (is_inside(p)) imageStore(history_confidence, host_pixel(HISTORY_CONFIDENCE, p), vec4(confidence_at(p)));
}
