#version 450
// How far the light of this frame departs from its own history, block by block: mean and deviation of the paired differences.
// Source: ours, in the place of the percentile rule of [PSVGF], which sees no light that comes on (docs/stages.md).
// In:  guide (current, previous), surface_motion, depth_gradient, noisy irradiance (filter_ping), irradiance_history, moments (previous).
//      Pixels without a sample (alpha -1) do not count.
// Out: block_difference, four half floats a block: mean, deviation, pixels, mean luminance of the brighter side.
#extension GL_EXT_control_flow_attributes : require
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

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 1) uniform utexture2D guide;
layout(set = 0, binding = 2) uniform utexture2D previous_guide;
layout(set = 0, binding = 3) uniform utexture2D surface_motion;
layout(set = 0, binding = 4) uniform utexture2D depth_gradient;
layout(set = 0, binding = 5) uniform texture2D irradiance;
layout(set = 0, binding = 6) uniform texture2D history;
layout(set = 0, binding = 7) uniform utexture2D previous_moments;
layout(set = 0, binding = 8, rgba16ui) uniform writeonly uimage2D block_difference;

struct Sums {
    float count;
    float now;
    float before;
    float squared_difference;
    float uncertainty;  // 1/N: what the noise of the history adds, relative to that of one sample
};

shared Sums sums[BLOCK_PIXELS];

Sums sums_of(ivec2 p) {
    Sums result = Sums(0.0, 0.0, 0.0, 0.0, 0.0);
    ivec2 tap;
    if (!is_inside(p)) return result;
    if (!nearest_history(p, texelFetch(guide, p, 0), surface_motion, depth_gradient, previous_guide, tap)) return result;
    vec4 texel = texelFetch(irradiance, p, 0);
    if (texel.a < 0.0) return result;
    float now = luminance(texel.rgb);
    float before = min(luminance(texelFetch(history, tap, 0).rgb) * frame.exposure_ratio, 65504.0);
    float history_length = unpack_moments(texelFetch(previous_moments, tap, 0)).history_length;
    return Sums(1.0, now, before, (now - before) * (now - before), 1.0 / max(history_length, 1.0));
}

// Adds `count` entries, `stride` apart, to the first of them.
void reduce(uint first, uint stride, uint count) {
    Sums sum = sums[first];
    // Few invocations come here, and where branches are masked instead of skipped only a loop ends.
    [[dont_unroll]] for (uint i = 1u; i < count; ++i) {
        Sums other = sums[first + i * stride];
        sum.count += other.count;
        sum.now += other.now;
        sum.before += other.before;
        sum.squared_difference += other.squared_difference;
        sum.uncertainty += other.uncertainty;
    }
    sums[first] = sum;
}

void main() {
    uint i = gl_LocalInvocationIndex;
    sums[i] = sums_of(ivec2(gl_GlobalInvocationID.xy));
    barrier();
    // Rows, then the column of their sums: the order is fixed, and two barriers do.
    if (i < 8u) reduce(i * 8u, 1u, 8u);
    barrier();
    if (i != 0u) return;
    reduce(0u, 8u, 8u);
    Sums sum = sums[0];
    float inverse = 1.0 / max(sum.count, 1.0);
    float mean = (sum.now - sum.before) * inverse;
    float variance = max(0.0, sum.squared_difference * inverse - mean * mean) * (1.0 + sum.uncertainty * inverse);
    float brighter = max(sum.now, sum.before) * inverse;
    vec3 values = clamp(vec3(mean, sqrt(variance), brighter), -65504.0, 65504.0);
    uvec4 packed = uvec4(half_bits(values.x), half_bits(values.y), half_bits(sum.count), half_bits(values.z));
    imageStore(block_difference, ivec2(gl_WorkGroupID.xy), packed);
}
