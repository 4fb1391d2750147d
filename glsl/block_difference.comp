#version 450
// How far the light of this frame departs from its own history, block by block: mean and deviation of the paired differences.
// Source: ours, in the place of the percentile rule of [PSVGF], which sees no light that comes on (src/nodes/block_difference/specification.md).
// In:  guide (current, previous), surface_motion, depth_gradient, noisy irradiance (filter_ping), irradiance_history, moments (previous).
//      Pixels without a sample (alpha -1) do not count.
// Out: block_difference, four half floats a block: mean, deviation, pixels, mean luminance of the brighter side.
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    float depth_tolerance;
} push;

#include "frame.glsl"
#include "moments.glsl"
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
layout(set = 0, binding = 7) uniform utexture2D previous_moments;
layout(set = 0, binding = 8, rgba16ui) uniform writeonly uimage2D block_difference;

struct Sums {
    float count;
    float now;
    float before;
    float squared_difference;
    float uncertainty;  // 1/N: what the noise of the history adds, relative to that of one sample
};

// Of the columns of the blocks in a row.
shared Sums sums[ROW_PIXELS];

// Without branches: software Vulkan masks them, and then reads images a lane at a time.
Sums sums_of(ivec2 pixel) {
    ivec2 p = nearest_inside(pixel), tap;
    bool counts = nearest_history(p, GuideBits(imageLoad(guide, p)), surface_motion, depth_gradient, previous_guide, tap);
    vec4 texel = imageLoad(irradiance, p);
    float now = luminance(texel.rgb);
    float before = min(luminance(imageLoad(history, tap).rgb) * frame.exposure_ratio, 65504.0);
    float history_length = unpack_moments(texelFetch(previous_moments, tap, 0)).history_length;
    Sums of_sample = Sums(1.0, now, before, (now - before) * (now - before), 1.0 / max(history_length, 1.0));
    if (counts && p == pixel && texel.a >= 0.0) return of_sample;
    return Sums(0.0, 0.0, 0.0, 0.0, 0.0);
}

void add(inout Sums sum, Sums other) {
    sum.count += other.count;
    sum.now += other.now;
    sum.before += other.before;
    sum.squared_difference += other.squared_difference;
    sum.uncertainty += other.uncertainty;
}

void main() {
    uint i = gl_LocalInvocationIndex;
    ivec2 top = ivec2(gl_GlobalInvocationID.x, gl_WorkGroupID.y * uint(BLOCK_SIZE));
    // Columns, then the sums of a block's columns: the order is fixed, and one barrier does.
    Sums sum = sums_of(top);
    for (int y = 1; y < BLOCK_SIZE; ++y) add(sum, sums_of(top + ivec2(0, y)));
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
    vec3 values = clamp(vec3(mean, sqrt(variance), brighter), -65504.0, 65504.0);
    uvec4 packed = uvec4(half_bits(values.x), half_bits(values.y), half_bits(sum.count), half_bits(values.z));
    imageStore(block_difference, block, packed);
}
