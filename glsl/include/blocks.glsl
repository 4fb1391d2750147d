// Blocks of 8x8 pixels, which are the workgroups, or eight of which in a row are a workgroup with an invocation a column: what invocations
// share then is an eighth, and software Vulkan runs a workgroup once more for each barrier. Twin: src/reference/blocks.rs.
#ifndef BLOCKS_GLSL
#define BLOCKS_GLSL
#include "frame.glsl"

const int BLOCK_SIZE = 8;
const uint BLOCK_PIXELS = 64u;
const uint ROW_BLOCKS = 8u;
const uint ROW_PIXELS = 64u;

// Blocks that hold at least one pixel of the render extent.
ivec2 block_extent() { return (ivec2(frame.render_extent) + (BLOCK_SIZE - 1)) / BLOCK_SIZE; }

bool is_block(ivec2 block) { return all(greaterThanEqual(block, ivec2(0))) && all(lessThan(block, block_extent())); }

// Position among the centres of the blocks.
vec2 block_position(ivec2 p) { return (vec2(p) + 0.5) / float(BLOCK_SIZE) - 0.5; }

vec2 unpack_block_percentiles(uint packed) { return unpackHalf2x16(packed); }  // low, up

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
