#version 450
// Two percentiles of luminance in every block of 8x8 pixels: what is usual around here, in this frame alone.
// Source: [PSVGF], block percentiles. Deviations: ranks by counting, for the bits of the published odd-even sort.
// A bit says whether the brightest pixels are a cluster.
// In:  guide, noisy irradiance of one signal or two. Out: block_percentiles of each, half2(low, up) of luminance, one texel a block; up is
// negative where the pixels from up on lie beside each other in a darker block.
// Pixels outside the render extent, background and pixels without a sample (alpha -1) do not take part. Without any: 0, 0.
// Constants: VOLUME: the background takes part, since fog lies before it.
// optional: irradiance_1, block_percentiles_1
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "guide.glsl"
#include "luminance.glsl"
#include "blocks.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const bool VOLUME = false;

layout(push_constant) uniform Push {
    uint present;
    float percentile_low;
    float percentile_up;
} push;

#include "optional.glsl"

const uint IRRADIANCE_1 = 4u;

layout(set = 0, binding = 1) uniform utexture2D guide;
layout(set = 0, binding = 2) uniform texture2D irradiance_0;
layout(set = 0, binding = 3, r32ui) uniform writeonly uimage2D block_percentiles_0;
layout(set = 0, binding = IRRADIANCE_1) uniform texture2D irradiance_1;
layout(set = 0, binding = 5, r32ui) uniform writeonly uimage2D block_percentiles_1;

bool takes_part(ivec2 p) { return is_inside(p) && (VOLUME || guide_depth(GuideBits(texelFetch(guide, p, 0))) != 0.0); }

// A cluster of outliers, such as a sample that a pixel filter spread over 3x3 pixels, is less than the rest of a block, and far above it.
const float REST_SHARE = 0.7;
const float CLUMP_EXCESS = 3.0;

// Behind every luminance that a half float holds.
const float NO_PIXEL = 1e30;

shared float keys[BLOCK_PIXELS];
shared float sorted_keys[BLOCK_PIXELS];
// Pixels that take part.
shared uint pixels;
// Pixels of a cluster, less those that are scattered.
shared int clumped;

// One barrier: each key finds its own place.
void sort_by_counting(uint i) {
    float key = keys[i];
    uint rank = 0u;
    [[unroll]] for (uint j = 0u; j < BLOCK_PIXELS; ++j) {
        float other = keys[j];
        rank += uint(other < key || (other == key && j < i));
    }
    sorted_keys[rank] = key;
    // Few blocks lack pixels.
    if (!(key < NO_PIXEL)) atomicMin(pixels, rank);
    barrier();
}

float percentile(float share, uint count) {
    return count == 0u ? 0.0 : sorted_keys[uint(share * float(count - 1u) + 0.5)];
}

bool is_pixel(uint i) { return keys[i] < NO_PIXEL; }

bool is_bright(uint i, float least) { return is_pixel(i) && keys[i] > least; }

// Whether two pixels beside are bright as well.
bool is_clumped(uint i, float least) {
    uint x = i % 8u, y = i / 8u, beside = 0u;
    if (x > 0u) beside += uint(is_bright(i - 1u, least));
    if (x < 7u) beside += uint(is_bright(i + 1u, least));
    if (y > 0u) beside += uint(is_bright(i - 8u, least));
    if (y < 7u) beside += uint(is_bright(i + 8u, least));
    return beside >= 2u;
}

// Of the block, in its first invocation.
uint packed_percentiles(vec4 texel) {
    uint i = gl_LocalInvocationIndex;
    keys[i] = texel.a >= 0.0 ? luminance(texel.rgb) : NO_PIXEL;
    if (i == 0u) {
        clumped = 0;
        pixels = BLOCK_PIXELS;
    }
    barrier();
    sort_by_counting(i);
    uint count = pixels;
    float low = min(push.percentile_low, push.percentile_up);
    vec2 percentiles = vec2(percentile(low, count), percentile(push.percentile_up, count));
    float far_above = CLUMP_EXCESS * percentile(REST_SHARE, count);
    if (is_pixel(i) && keys[i] >= percentiles.y) atomicAdd(clumped, is_clumped(i, far_above) ? 1 : -1);
    barrier();
    return pack_block_percentiles(BlockPercentiles(percentiles, clumped > 0));
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy), block = ivec2(gl_WorkGroupID.xy);
    bool counts = takes_part(p), writes = gl_LocalInvocationIndex == 0u;
    uint percentiles = packed_percentiles(counts ? texelFetch(irradiance_0, p, 0) : vec4(-1.0));
    if (writes) imageStore(block_percentiles_0, block, uvec4(percentiles));
    if (!is_wired(IRRADIANCE_1)) return;
    barrier();
    percentiles = packed_percentiles(counts ? texelFetch(irradiance_1, p, 0) : vec4(-1.0));
    if (writes) imageStore(block_percentiles_1, block, uvec4(percentiles));
}
