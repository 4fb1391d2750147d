#version 450
// How far the history of a pixel is still true: unless the frame departs from it by more than noise explains. No re-shaded samples are needed.
// Source: ours, in the place of the rule of [PSVGF]: a test of the mean difference against its standard error, over 24x24 pixels, which works
// in both directions (docs/stages.md).
// In:  per signal block_difference. Out: history_confidence, 1 (keep) to 0 (drop); the least of the signals.
// optional: block_difference_1
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    uint present;
    float adaptivity;
    float change_threshold;
} push;

#include "frame.glsl"
#include "optional.glsl"
#include "guide.glsl"
#include "blocks.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint BLOCK_DIFFERENCE_1 = 3u;

layout(set = 0, binding = 1, r32f) uniform writeonly image2D history_confidence;
layout(set = 0, binding = 2) uniform utexture2D block_difference_0;
layout(set = 0, binding = BLOCK_DIFFERENCE_1) uniform utexture2D block_difference_1;

float lin(float a, float b, float x) { return clamp((x - a) / (b - a), 0.0, 1.0); }

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
    return lin(push.change_threshold, 2.0 * push.change_threshold, errors);
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
    if (is_present(BLOCK_DIFFERENCE_1)) {
        barrier();
        load_blocks(block_difference_1);
        barrier();
        if (i < 9u) change = max(change, change_of(centre));
    }
    if (i < 9u) changes[i] = change;
    barrier();
    return 1.0 - push.adaptivity * change_at(p);
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    // Every invocation of a workgroup takes part in the barriers.
    float confidence = confidence_at(p);
    if (is_inside(p)) imageStore(history_confidence, p, vec4(confidence));
}
