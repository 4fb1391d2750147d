#version 450
// How far the light of this frame departs from its own history, block by block: mean and deviation of the paired differences.
// Source: ours, in the place of the percentile rule of [PSVGF], which sees no light that comes on (src/nodes/block_difference/specification.md).
// In:  guide (current, previous), surface_motion, noisy irradiance, irradiance_history, luminance_history (previous).
//      Pixels without a sample (alpha -1) do not count.
// Out: block_difference, one texel a block: mean, deviation, pixels, noise, mean luminance of the brighter side.
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    float depth_tolerance;
} push;

#include "frame.glsl"
#include "blocks.glsl"

layout(local_size_x = ROW_PIXELS) in;

layout(set = 0, binding = 1, rgba16ui) uniform restrict readonly uimage2D guide;
layout(set = 0, binding = 2) uniform utexture2D previous_guide;
layout(set = 0, binding = 3) uniform utexture2D surface_motion;
layout(set = 0, binding = 5, rgba16f) uniform restrict readonly image2D irradiance;
layout(set = 0, binding = 6, rgba16f) uniform restrict readonly image2D history;
layout(set = 0, binding = 7) uniform utexture2D previous_luminance_history;
layout(set = 0, binding = 8, rgba32ui) uniform writeonly uimage2D block_difference;

#define guide_at(p) imageLoad(guide, p)
#define irradiance_at(p) imageLoad(irradiance, p)
#define history_at(p) imageLoad(history, p)
#include "block_difference.glsl"

void main() { write_block_difference(); }
