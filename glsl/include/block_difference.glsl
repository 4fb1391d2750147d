// How far the light of a block departs from its own history: mean and deviation of the paired differences. Twin:
// src/nodes/block_difference/twin.rs. Needs `float depth_tolerance` in the shader's block `push`, a workgroup of eight blocks with an invocation
// a column, the images of block_difference.comp, `guide_at`, `irradiance_at` and `history_at`.
#ifndef BLOCK_DIFFERENCE_GLSL
#define BLOCK_DIFFERENCE_GLSL
#include "frame.glsl"
#include "luminance_history.glsl"
#include "luminance.glsl"
#include "nearest_history.glsl"
#include "blocks.glsl"

struct Sums {
    float count;
    float now;
    float before;
    float squared_difference;
    float uncertainty;  // 1/N: what the noise of the history adds, relative to that of one sample
    float curvature;    // squared second differences along columns
    float curved;       // their number
    float variance;     // of samples, up to the previous frame
};

const Sums NONE = Sums(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);

// Of the columns of the blocks in a row.
shared Sums sums[ROW_PIXELS];

// Without branches: software Vulkan masks them, and then reads images a lane at a time.
Sums sums_of(ivec2 pixel) {
    ivec2 p = nearest_inside(pixel), tap;
    bool counts = nearest_history(p, GuideBits(guide_at(p)), surface_motion, previous_guide, tap);
    vec4 texel = irradiance_at(p);
    float now = luminance(texel.rgb);
    float before = min(luminance(history_at(tap).rgb) * frame.exposure_ratio, 65504.0);
    LuminanceHistory luminance_history = unpack_luminance_history(texelFetch(previous_luminance_history, tap, 0).x);
    float deviation = luminance_history.deviation * frame.exposure_ratio;
    float uncertainty = 1.0 / max(luminance_history.history_length, 1.0);
    Sums of_sample = Sums(1.0, now, before, (now - before) * (now - before), uncertainty, 0.0, 0.0, deviation * deviation);
    if (counts && p == pixel && texel.a >= 0.0) return of_sample;
    return NONE;
}

void add(inout Sums sum, Sums other) {
    sum.count += other.count;
    sum.now += other.now;
    sum.before += other.before;
    sum.squared_difference += other.squared_difference;
    sum.uncertainty += other.uncertainty;
    sum.curvature += other.curvature;
    sum.curved += other.curved;
    sum.variance += other.variance;
}

void write_block_difference() {
    uint i = gl_LocalInvocationIndex;
    ivec2 top = ivec2(gl_GlobalInvocationID.x, gl_WorkGroupID.y * uint(BLOCK_SIZE));
    // Columns, then the sums of a block's columns: the order is fixed, and one barrier does.
    Sums sum = sums_of(top), above = NONE, middle = sum;
    for (int y = 1; y < BLOCK_SIZE; ++y) {
        Sums below = sums_of(top + ivec2(0, y));
        float curve = above.now - 2.0 * middle.now + below.now, counts = above.count * middle.count * below.count;
        sum.curvature += counts * curve * curve;
        sum.curved += counts;
        above = middle;
        middle = below;
        add(sum, below);
    }
    sums[i] = sum;
    barrier();
    if (i >= ROW_BLOCKS) return;
    ivec2 block = ivec2(gl_WorkGroupID.x * ROW_BLOCKS + i, gl_WorkGroupID.y);
    if (!is_block(block)) return;
    sum = sums[i * uint(BLOCK_SIZE)];
    for (uint x = 1u; x < uint(BLOCK_SIZE); ++x) add(sum, sums[i * uint(BLOCK_SIZE) + x]);
    float inverse = 1.0 / max(sum.count, 1.0);
    float mean = (sum.now - sum.before) * inverse;
    float variance = max(0.0, sum.squared_difference * inverse - mean * mean) * (1.0 + sum.uncertainty * inverse);
    float brighter = max(sum.now, sum.before) * inverse;
    // Of white noise, a second difference has six times its variance. Without one, nothing is known of it.
    bool is_known = sum.curved > 0.0 && brighter > 0.0;
    float noise = is_known ? sqrt(sum.curvature / (6.0 * sum.curved)) / brighter : LOUD;
    float past_noise = is_known ? sqrt(sum.variance * inverse) / brighter : RARE;
    BlockDifference difference = BlockDifference(mean, sqrt(variance), sum.count, brighter, noise, past_noise);
    imageStore(block_difference, block, pack_block_difference(difference));
}

#endif
