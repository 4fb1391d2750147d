// Blocks of 8x8 pixels, which are the workgroups, or eight of which in a row are a workgroup with an invocation a column: what invocations
// share then is an eighth, and software Vulkan runs a workgroup once more for each barrier. Twin: src/reference/blocks.rs.
#ifndef BLOCKS_GLSL
#define BLOCKS_GLSL
#include "frame.glsl"
#include "guide.glsl"
#include "luminance.glsl"

const int BLOCK_SIZE = 8;
const uint BLOCK_PIXELS = 64u;
const uint ROW_BLOCKS = 8u;
const uint ROW_PIXELS = 64u;

// Side of the cells in which outliers are told from light that returns.
const int CELL_SIZE = 4;

// Blocks that hold at least one pixel of the render extent.
ivec2 block_extent() { return (ivec2(frame.render_extent) + (BLOCK_SIZE - 1)) / BLOCK_SIZE; }

bool is_block(ivec2 block) { return all(greaterThanEqual(block, ivec2(0))) && all(lessThan(block, block_extent())); }

// Position among the centres of the blocks.
vec2 block_position(ivec2 p) { return (vec2(p) + 0.5) / float(BLOCK_SIZE) - 0.5; }

// Of the luminance of a block.
struct BlockPercentiles {
    vec2 low_up;
    bool is_clumped;  // its brightest pixels lie beside each other in a darker block
};

uint pack_block_percentiles(BlockPercentiles p) {
    return packHalf2x16(min(p.low_up, 65504.0) * vec2(1.0, p.is_clumped ? -1.0 : 1.0));
}

BlockPercentiles unpack_block_percentiles(uint packed) {
    vec2 both = unpackHalf2x16(packed);
    return BlockPercentiles(abs(both), both.y < 0.0);
}

// How far the light of a block departs from its history.
struct BlockDifference {
    vec3 now;         // mean light of this frame
    vec3 before;      // and of the history
    float mean;       // luminance of this frame minus that of the history
    float deviation;  // of one difference, the noise of the history included
    float count;      // pixels with a history
    float brighter;   // the larger of the mean luminances of both sides
    // As shares of the brighter side, of which LOUD, and RARE, and more are one:
    float noise;       // deviation of a pixel from those above and below
    float past_noise;  // deviation of samples up to the previous frame, which knows of rare light
};

const float LOUD = 0.2;
const float RARE = 1.5;
const float NOISE_STEPS = 31.0;
const float PAST_NOISE_STEPS = 15.0;

uint steps_of(float noise, float most, float steps) { return uint(floor(min(noise, most) / most * steps + 0.5)); }

uvec4 pack_block_difference(vec3 now, vec3 before, float deviation, uint count, float noise, float past_noise) {
    now = clamp(now, -65504.0, 65504.0);
    before = clamp(before, -65504.0, 65504.0);
    uint packed = count | steps_of(noise, LOUD, NOISE_STEPS) << 7 | steps_of(past_noise, RARE, PAST_NOISE_STEPS) << 12;
    uint last = half_bits(min(deviation, 65504.0)) | packed << 16;
    return uvec4(packHalf2x16(now.rg), packHalf2x16(vec2(now.b, before.r)), packHalf2x16(before.gb), last);
}

BlockDifference unpack_block_difference(uvec4 packed) {
    uint last = packed.w >> 16;
    float noise = float(last >> 7 & 31u) * (LOUD / NOISE_STEPS), past_noise = float(last >> 12) * (RARE / PAST_NOISE_STEPS);
    vec2 middle = unpackHalf2x16(packed.y);
    vec3 now = vec3(unpackHalf2x16(packed.x), middle.x), before = vec3(middle.y, unpackHalf2x16(packed.z));
    vec2 luminances = vec2(luminance(now), luminance(before));
    float brighter = max(luminances.x, luminances.y), deviation = half_value(packed.w & 0xffffu);
    return BlockDifference(now, before, luminances.x - luminances.y, deviation, float(last & 127u), brighter, noise, past_noise);
}

struct FireflyLimit {
    float limit;      // 0: none
    float returning;  // the luminance that comes again at its place from frame to frame
    bool is_cluster;  // what is above the limit is one sample in several pixels
};

uint pack_firefly_limit(FireflyLimit l) {
    return packHalf2x16(min(vec2(l.limit, l.returning), 65504.0) * vec2(l.is_cluster ? -1.0 : 1.0, 1.0));
}

FireflyLimit unpack_firefly_limits(uint packed) {
    vec2 both = unpackHalf2x16(packed);
    return FireflyLimit(abs(both.x), both.y, both.x < 0.0);
}

struct BlocksAround {
    ivec2 first;
    ivec2 second;
    vec2 fraction;  // of the way from the centre of the first to that of the second
};

// The four blocks whose centres are nearest to a pixel; beyond the edge the last block stands in.
BlocksAround blocks_around(ivec2 p) {
    vec2 position = block_position(p), corner = floor(position);
    ivec2 last = block_extent() - 1;
    return BlocksAround(clamp(ivec2(corner), ivec2(0), last), clamp(ivec2(corner) + 1, ivec2(0), last), position - corner);
}

#endif
