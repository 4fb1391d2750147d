// Blocks of 8x8 pixels, which are the workgroups, and their percentiles. Twin: src/reference/blocks.rs.
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

// [PSVGF] IPR: by how much a luminance may leave the percentiles and still be usual.
float percentile_range(vec2 low_up) { return (low_up.y - low_up.x) * frame.percentile_range; }

// [PSVGF] The brightest luminance that is usual in a block. 0: the block does not say, since next to all of its samples are black.
float firefly_limit_of(utexture2D block_percentiles, ivec2 block) {
    vec2 low_up = unpackHalf2x16(texelFetch(block_percentiles, block, 0).x);
    return low_up.y > 0.0 ? frame.firefly_bias + low_up.y + percentile_range(low_up) : 0.0;
}

// The largest limit of the 3x3 blocks around; 0: none.
float firefly_limit(utexture2D block_percentiles, ivec2 block) {
    float limit = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            if (is_block(block + ivec2(x, y))) limit = max(limit, firefly_limit_of(block_percentiles, block + ivec2(x, y)));
    return limit;
}

#endif
