// Blocks of 8x8 pixels, which are the workgroups, or eight of which in a row are a workgroup with an invocation a column: what invocations
// share then is an eighth, and software Vulkan runs a workgroup once more for each barrier. Twin: src/reference/blocks.rs.
#ifndef BLOCKS_GLSL
#define BLOCKS_GLSL
#include "frame.glsl"
#include "guide.glsl"

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
    float mean;       // this frame minus the history
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

uvec4 pack_block_difference(BlockDifference d) {
    vec3 values = clamp(vec3(d.mean, d.deviation, d.brighter), -65504.0, 65504.0);
    uint noise = steps_of(d.noise, LOUD, NOISE_STEPS), past_noise = steps_of(d.past_noise, RARE, PAST_NOISE_STEPS);
    uint packed = uint(d.count) | noise << 7 | past_noise << 12;
    return uvec4(half_bits(values.x), half_bits(values.y), packed, half_bits(values.z));
}

BlockDifference unpack_block_difference(uvec4 packed) {
    float noise = float(packed.z >> 7 & 31u) * (LOUD / NOISE_STEPS), past_noise = float(packed.z >> 12) * (RARE / PAST_NOISE_STEPS);
    return BlockDifference(half_value(packed.x), half_value(packed.y), float(packed.z & 127u), half_value(packed.w), noise, past_noise);
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
