#version 450
// How far the light of this frame departs from its own history, block by block: mean and deviation of the paired differences.
// Source: ours, in the place of the percentile rule of [PSVGF], which sees no light that comes on (src/nodes/block_difference/specification.md).
// In:  guide (current, previous), surface_motion, depth_gradient, noisy irradiance, irradiance_history, luminance_history (previous).
//      Pixels without a sample (alpha -1) do not count.
// Out: block_difference, one texel a block: mean, deviation, pixels, noise, mean luminance of the brighter side.
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    float depth_tolerance;
} push;

#include "frame.glsl"
#include "luminance_history.glsl"
#include "luminance.glsl"
#include "nearest_history.glsl"
#include "blocks.glsl"

layout(local_size_x = ROW_PIXELS) in;

layout(set = 0, binding = 1, rgba16ui) uniform restrict readonly uimage2D guide;
layout(set = 0, binding = 2) uniform utexture2D previous_guide;
layout(set = 0, binding = 3) uniform utexture2D surface_motion;
layout(set = 0, binding = 4) uniform utexture2D depth_gradient;
layout(set = 0, binding = 5, rgba16f) uniform restrict readonly image2D irradiance;
layout(set = 0, binding = 6, rgba16f) uniform restrict readonly image2D history;
layout(set = 0, binding = 7) uniform utexture2D previous_luminance_history;
layout(set = 0, binding = 8, rgba16ui) uniform writeonly uimage2D block_difference;

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
    bool counts = nearest_history(p, GuideBits(imageLoad(guide, p)), surface_motion, depth_gradient, previous_guide, tap);
    vec4 texel = imageLoad(irradiance, p);
    float now = luminance(texel.rgb);
    float before = min(luminance(imageLoad(history, tap).rgb) * frame.exposure_ratio, 65504.0);
    LuminanceHistory luminance_history = unpack_luminance_history(texelFetch(previous_luminance_history, tap, 0));
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

void main() {
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
    float past_noise = is_known ? sqrt(sum.variance * inverse) / brighter : LOUD;
    BlockDifference difference = BlockDifference(mean, sqrt(variance), sum.count, brighter, noise, past_noise);
    imageStore(block_difference, block, pack_block_difference(difference));
}
