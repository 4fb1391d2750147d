#version 450
// Takes in the light that a volume scatters towards the camera, and where: the points that the next frame carries forward.
// Source: [PSVGF], volumes: virtual points of high contribution, chosen by transmittance sampling.
// In:  noisy_volume of the host, linear Rec. 709; scattering_depth of the host, linear depth in scene units, 0, infinite or NaN for no point.
//      Radiance that is not finite is no sample: the mean of the 3x3 pixels around it stands in for it.
// Out: irradiance_volume: radiance; alpha: 0, -1 where it was filled in, -2 where nothing around it is finite; volume_points: depth, contribution (the upper half of the luminance as a float), 0.
// optional: scattering_depth
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    uint present;
} push;

#include "frame.glsl"
#include "viewport.glsl"
#include "optional.glsl"
#include "statistics.glsl"
#include "holes.glsl"
#include "luminance.glsl"
#include "volume_point.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint NOISY_VOLUME = 2u;
const uint SCATTERING_DEPTH = 3u;

layout(set = 0, binding = NOISY_VOLUME) uniform texture2D noisy_volume;
layout(set = 0, binding = SCATTERING_DEPTH) uniform texture2D scattering_depth;
layout(set = 0, binding = 4, rgba16f) uniform writeonly image2D radiance;
layout(set = 0, binding = 5, rgba16ui) uniform writeonly uimage2D volume_points;

// Of the samples around a pixel that has none.
vec4 filled(ivec2 p) {
    vec4 sum = vec4(0.0);
    [[dont_unroll]] for (int i = 0; i < 9; ++i) {
        ivec2 offset = ivec2(i % 3 - 1, i / 3 - 1), q = p + offset;
        vec3 c = texelFetch(noisy_volume, host_pixel(NOISY_VOLUME, nearest_inside(q)), 0).rgb;
        if (i == 4 || !is_inside(q) || !is_finite(c)) continue;
        sum += vec4(storable(exposed(c)), 1.0) / float(offset.x * offset.x + offset.y * offset.y);
    }
    return sum.a > 0.0 ? vec4(storable(sum.rgb / sum.a), HOLE) : vec4(vec3(0.0), EMPTY_HOLE);
}

vec4 radiance_at(ivec2 p) {
    vec3 c = texelFetch(noisy_volume, host_pixel(NOISY_VOLUME, p), 0).rgb;
    if (is_finite(c)) {
        if (is_saturated(exposed(c))) count_bad(SATURATED);
        return vec4(half_range(exposed(c)), 0.0);
    }
    count_bad(BAD_RADIANCE);
    return filled(p);
}

// Linear depth of the pixel's point; 0: there is none.
float depth_at(ivec2 p) {
    if (!is_present(SCATTERING_DEPTH)) return 0.0;
    float z = texelFetch(scattering_depth, host_pixel(SCATTERING_DEPTH, p), 0).x;
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
    vec4 c = radiance_at(p);
    imageStore(radiance, p, vec4(storable(c.rgb), c.a));
    imageStore(volume_points, p, pack_point(depth_at(p), c.a < 0.0 ? 0u : contribution(c.rgb)).bits);
}
