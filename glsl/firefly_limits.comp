#version 450
// The brightest luminance that is no outlier, in cells of 4x4 pixels: that which is usual around in this frame, or returns at its place
// from frame to frame.
// Source: ours, on [PSVGF], firefly filter, which takes the limit of the own block. The largest one of the 3x3 blocks keeps a small lit corner
// of a dark block; the wider neighbourhood tells a cluster of outliers, which lifts the percentiles of its own blocks; and light that comes
// again at its place, as that of a caustic does, is no outlier.
// In:  block_percentiles, irradiance. With RETURNING also guide (current, previous), surface_motion, firefly_limits (previous).
// Out: firefly_limits, half2(limit, returning) of luminance, one texel a cell; a limit of 0 is none, and one below is that of a
//      cluster.
// variants: RETURNING=0 RETURNING=1
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    float percentile_range;
    float firefly_bias;
#if RETURNING
    float depth_tolerance;
#endif
} push;

#include "blocks.glsl"

layout(local_size_x = ROW_PIXELS) in;

layout(set = 0, binding = 1, r32ui) uniform writeonly uimage2D firefly_limits;
layout(set = 0, binding = 2) uniform utexture2D block_percentiles;
layout(set = 0, binding = 3) uniform texture2D irradiance;
#if RETURNING
layout(set = 0, binding = 4) uniform utexture2D guide;
layout(set = 0, binding = 5) uniform utexture2D previous_guide;
layout(set = 0, binding = 6) uniform utexture2D surface_motion;
layout(set = 0, binding = 8) uniform utexture2D previous_firefly_limits;
#endif

#define guide_at(p) texelFetch(guide, p, 0)
#define irradiance_at(p) texelFetch(irradiance, p, 0)
#include "firefly_limits.glsl"

void main() {
    ivec2 cell;
    FireflyLimit limit;
    if (limit_of_cell(cell, limit)) imageStore(firefly_limits, cell, uvec4(pack_firefly_limit(limit)));
}
