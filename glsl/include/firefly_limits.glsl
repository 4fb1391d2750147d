// The brightest luminance of each cell that is no outlier. Twin: src/nodes/firefly_limits/twin.rs. Needs `float percentile_range` and
// `float firefly_bias` in the shader's block `push`, a workgroup of eight blocks with an invocation a column, the images of
// firefly_limits.comp, `guide_at` and `irradiance_at`; RETURNING where it has those of the past.
#ifndef FIREFLY_LIMITS_GLSL
#define FIREFLY_LIMITS_GLSL
#include "frame.glsl"
#include "guide.glsl"
#include "luminance.glsl"
#include "blocks.glsl"
#include "percentile_range.glsl"
#if RETURNING
#include "nearest_history.glsl"
#endif

// A cluster of outliers lifts the limits of four blocks at most, and another one may be near.
const int CLUSTER_BLOCKS = 6;
// So many times the limit of the blocks around is that of a cluster.
const float CLUSTER_EXCESS = 2.0;
// The share of a frame in what returns.
const float RETURN_RATE = 0.2;
// The most by which what returns grows in a frame: an outlier of one frame counts for no more.
const float RETURN_GROWTH = 32.0;
// What returns is a mean over frames, and of noise.
const float RETURN_EXCESS = 2.8;
// A place so near to the border of a cell, in cells, is in both.
const float NEAR = 0.25;

// Of the blocks in the row, with two around them: the limit, and that where no cluster made it.
const uint WIDTH = ROW_BLOCKS + 4u;
shared vec2 limits[WIDTH * 5u];

ivec2 first_block() { return ivec2(gl_WorkGroupID.xy) * ivec2(ROW_BLOCKS, 1); }

// 0: next to all samples of the block are black, which does not say what is bright.
float limit_of(vec2 low_up) {
    return low_up.y > 0.0 ? push.firefly_bias * frame.filter_exposure + low_up.y + percentile_range(low_up) : 0.0;
}

void load_limits(uint i) {
    if (i >= WIDTH * 5u) return;
    ivec2 block = first_block() + ivec2(int(i % WIDTH), int(i / WIDTH)) - 2;
    if (!is_block(block)) {
        limits[i] = vec2(0.0);
        return;
    }
    BlockPercentiles p = unpack_block_percentiles(texelFetch(block_percentiles, block, 0).x);
    float limit = limit_of(p.low_up);
    limits[i] = vec2(limit, p.is_clumped ? 0.0 : limit);
}

// By this frame alone.
FireflyLimit usual_limit(uint own) {
    float nearby = 0.0, scattered = 0.0, largest[CLUSTER_BLOCKS + 1];
    for (int i = 0; i <= CLUSTER_BLOCKS; ++i) largest[i] = 0.0;
    // Few invocations come here, and where branches are masked instead of skipped only a loop ends.
    [[dont_unroll]] for (int j = 0; j < 25; ++j) {
        ivec2 offset = ivec2(j % 5, j / 5);
        vec2 limit = limits[own + uint(offset.x) + WIDTH * uint(offset.y)];
        if (abs(offset.x - 2) <= 1 && abs(offset.y - 2) <= 1) {
            nearby = max(nearby, limit.x);
            scattered = max(scattered, limit.y);
        }
        for (int i = 0; i <= CLUSTER_BLOCKS; ++i) {
            float smaller = min(largest[i], limit.x);
            largest[i] = max(largest[i], limit.x);
            limit.x = smaller;
        }
    }
    float wide = largest[CLUSTER_BLOCKS], usual = max(wide, scattered);
    bool is_cluster = wide > 0.0 && nearby > CLUSTER_EXCESS * usual;
    return FireflyLimit(is_cluster ? usual : nearby, 0.0, is_cluster);
}

// The luminance that returned where a cell was; negative where that is not known.
float returning_before(ivec2 cell) {
#if RETURNING
    ivec2 p = nearest_inside(cell * CELL_SIZE + CELL_SIZE / 2), tap;
    if (!nearest_history(p, GuideBits(guide_at(p)), surface_motion, previous_guide, tap)) return -1.0;
    // Between two cells, that of both.
    vec2 position = (vec2(tap) + 0.5) / float(CELL_SIZE) - 0.5;
    ivec2 last = (ivec2(frame.previous_render_extent) - 1) / CELL_SIZE;
    ivec2 first = clamp(ivec2(floor(position + NEAR)), ivec2(0), last), second = clamp(ivec2(floor(position + 1.0 - NEAR)), ivec2(0), last);
    float most = 0.0;
    for (int i = 0; i < 4; ++i) {
        bvec2 is_second = bvec2((i & 1) == 1, i >> 1 == 1);
        most = max(most, unpack_firefly_limits(texelFetch(previous_firefly_limits, mix(first, second, is_second), 0).x).returning);
    }
    return most * frame.exposure_ratio;
#else
    return -1.0;
#endif
}

// Not of the background: it is not filtered, and a bright sky beside an outline would let outliers of the surface pass.
float brightest_of(ivec2 cell) {
    float brightest = 0.0;
    [[dont_unroll]] for (int i = 0; i < CELL_SIZE * CELL_SIZE; ++i) {
        ivec2 p = nearest_inside(cell * CELL_SIZE + ivec2(i % CELL_SIZE, i / CELL_SIZE));
#if RETURNING
        if (guide_depth(GuideBits(guide_at(p))) == 0.0) continue;
#endif
        vec4 texel = irradiance_at(p);
        if (texel.a >= 0.0) brightest = max(brightest, luminance(texel.rgb));
    }
    return brightest;
}

// Two rows of cells.
const uint ROW_CELLS = ROW_BLOCKS * 2u;
const uint CELLS = 2u * ROW_CELLS;

// Of the cell that belongs to an invocation, in two rows of cells; false where none does.
bool limit_of_cell(out ivec2 cell, out FireflyLimit limit) {
    uint i = gl_LocalInvocationIndex;
    load_limits(i);
    barrier();
    cell = 2 * first_block() + ivec2(i % ROW_CELLS, i / ROW_CELLS);
    limit = FireflyLimit(0.0, 0.0, false);
    if (i >= CELLS || !is_inside(cell * CELL_SIZE)) return false;
    limit = usual_limit(i % ROW_CELLS / 2u);
    float usual = limit.limit, before = returning_before(cell), brightest = brightest_of(cell);
    bool is_known = before >= 0.0;
    if (usual > 0.0) limit.limit = max(usual, RETURN_EXCESS * before);
    float most = usual > 0.0 ? usual + RETURN_GROWTH * max(before, 0.0) : brightest;
    limit.returning = min(brightest, most);
    if (is_known) limit.returning = mix(before, limit.returning, RETURN_RATE);
    return true;
}

#endif
