#version 450
// Takes in the light that a volume scatters towards the camera, and where: the points that the next frame carries forward.
// Source: [PSVGF], volumes: virtual points of high contribution, chosen by transmittance sampling.
// In:  noisy_volume of the host, linear Rec. 709; scattering_depth of the host, linear depth in scene units, 0, infinite or NaN for no point.
// Out: filter_ping_volume: radiance, 0; volume_points: depth, contribution (the upper half of the luminance as a float), 0.
// optional: scattering_depth
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    uint present;
} push;

#include "frame.glsl"
#include "optional.glsl"
#include "statistics.glsl"
#include "luminance.glsl"
#include "volume_point.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint SCATTERING_DEPTH = 3u;

layout(set = 0, binding = 2) uniform texture2D noisy_volume;
layout(set = 0, binding = SCATTERING_DEPTH) uniform texture2D scattering_depth;
layout(set = 0, binding = 4, rgba16f) uniform writeonly image2D radiance;
layout(set = 0, binding = 5, rgba16ui) uniform writeonly uimage2D volume_points;

vec3 radiance_at(ivec2 p) {
    vec3 c = texelFetch(noisy_volume, p, 0).rgb;
    if (is_finite(c)) return half_range(c);
    count_bad(BAD_RADIANCE);
    return vec3(0.0);
}

// Linear depth of the pixel's point; 0: there is none.
float depth_at(ivec2 p) {
    if (!is_present(SCATTERING_DEPTH)) return 0.0;
    float z = texelFetch(scattering_depth, p, 0).x;
    if (is_nan(z)) count_bad(BAD_SCATTERING_DEPTH);
    return is_finite(z) && z > 0.0 ? z : 0.0;
}

// Ranks points: rises with the luminance. Cut, not rounded, so that every device gives the same bits.
uint contribution(vec3 c) {
    precise float l = 0.2126 * c.r;
    l = l + 0.7152 * c.g;
    l = l + 0.0722 * c.b;
    return floatBitsToUint(l) >> 16;
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    vec3 c = radiance_at(p);
    imageStore(radiance, p, vec4(storable(c), 0.0));
    imageStore(volume_points, p, pack_point(depth_at(p), contribution(c)).bits);
}
