#version 450
// Scales outliers down to the brightest luminance that is usual around them, before they reach the history.
// Source: [PSVGF], firefly filter. Deviation: the largest limit of the 3x3 blocks, so that a small lit corner of a dark block is kept.
// In:  guide, block_percentiles. In place: filter_ping, noisy irradiance, own pixel only.
// Constants: VOLUME: of every pixel, whatever the guide says.
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(constant_id = 1) const bool VOLUME = false;

layout(push_constant) uniform Push {
    float percentile_range;
    float firefly_bias;
} push;

#include "frame.glsl"
#include "guide.glsl"
#include "luminance.glsl"
#include "firefly_limit.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 1) uniform utexture2D guide;
layout(set = 0, binding = 2) uniform utexture2D block_percentiles;
layout(set = 0, binding = 3, rgba16f) uniform image2D irradiance;

bool takes_part(ivec2 p) { return is_inside(p) && (VOLUME || unpack_depth(texelFetch(guide, p, 0)) != 0.0); }

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!takes_part(p)) return;
    vec4 value = imageLoad(irradiance, p);
    float l = luminance(value.rgb);
    ivec2 block = p / BLOCK_SIZE;
    // Most pixels end here.
    if (l <= firefly_limit_of(block_percentiles, block)) return;
    float limit = firefly_limit(block_percentiles, block);
    if (limit > 0.0 && l > limit) imageStore(irradiance, p, vec4(value.rgb * (limit / l), value.a));
}
