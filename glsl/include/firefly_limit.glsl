// The brightest luminance that is usual. Twin: src/reference/blocks.rs.
// Needs `float percentile_range` and `float firefly_bias` in the shader's block `push`.
#ifndef FIREFLY_LIMIT_GLSL
#define FIREFLY_LIMIT_GLSL
#include "blocks.glsl"
#include "percentile_range.glsl"

// [PSVGF] Of one block. 0: the block does not say, since next to all of its samples are black.
float firefly_limit_of(utexture2D block_percentiles, ivec2 block) {
    vec2 low_up = unpack_block_percentiles(texelFetch(block_percentiles, block, 0).x);
    return low_up.y > 0.0 ? push.firefly_bias * frame.filter_exposure + low_up.y + percentile_range(low_up) : 0.0;
}

// The largest limit of the 3x3 blocks around; 0: none.
float firefly_limit(utexture2D block_percentiles, ivec2 block) {
    float limit = 0.0;
    // Few pixels come here, and where branches are masked instead of skipped only a loop ends.
    [[dont_unroll]] for (int y = -1; y <= 1; ++y)
        [[dont_unroll]] for (int x = -1; x <= 1; ++x)
            if (is_block(block + ivec2(x, y))) limit = max(limit, firefly_limit_of(block_percentiles, block + ivec2(x, y)));
    return limit;
}

#endif
