// Blocks of 8x8 pixels, which are the workgroups. Twin: src/reference/blocks.rs.
#ifndef BLOCKS_GLSL
#define BLOCKS_GLSL
#include "frame.glsl"

const int BLOCK_SIZE = 8;
const uint BLOCK_PIXELS = 64u;

// Blocks that hold at least one pixel of the render extent.
ivec2 block_extent() { return (ivec2(frame.render_extent) + (BLOCK_SIZE - 1)) / BLOCK_SIZE; }

bool is_block(ivec2 block) { return all(greaterThanEqual(block, ivec2(0))) && all(lessThan(block, block_extent())); }

// Position among the centres of the blocks.
vec2 block_position(ivec2 p) { return (vec2(p) + 0.5) / float(BLOCK_SIZE) - 0.5; }

#endif
