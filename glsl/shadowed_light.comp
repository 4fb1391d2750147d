#version 450
// Adds the light of the sources whose visibility was filtered: what each would give if nothing stood in between, times its visibility.
// Source: ours. In: denoised_visibility; unshadowed_direct of the host, linear Rec. 709, times albedo and BSDF; of further lights the same with _1
// to _3 behind. In place: radiance. COLOURED: visibility has red, green and blue.
// variants: FLOAT=0 FLOAT=1
// optional: denoised_visibility_1, denoised_visibility_2, denoised_visibility_3
// optional: unshadowed_direct, unshadowed_direct_1, unshadowed_direct_2, unshadowed_direct_3
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    uint present;
} push;

#define GUIDE_PIXELS
#include "frame.glsl"
#include "viewport.glsl"
#include "optional.glsl"
#include "outgoing.glsl"
#include "statistics.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const bool COLOURED = false;

const uint DENOISED_VISIBILITY = 2u;
const uint RADIANCE = 3u;
const uint UNSHADOWED_DIRECT = 4u;
const uint OF_OTHERS = 8u;

layout(set = 0, binding = DENOISED_VISIBILITY) uniform texture2D denoised_visibility;
layout(set = 0, binding = RADIANCE, OUTGOING_FORMAT) uniform image2D radiance;
layout(set = 0, binding = UNSHADOWED_DIRECT) uniform texture2D unshadowed_direct;
layout(set = 0, binding = UNSHADOWED_DIRECT + 1u) uniform texture2D unshadowed_direct_1;
layout(set = 0, binding = UNSHADOWED_DIRECT + 2u) uniform texture2D unshadowed_direct_2;
layout(set = 0, binding = UNSHADOWED_DIRECT + 3u) uniform texture2D unshadowed_direct_3;
layout(set = 0, binding = OF_OTHERS) uniform texture2D denoised_visibility_1;
layout(set = 0, binding = OF_OTHERS + 1u) uniform texture2D denoised_visibility_2;
layout(set = 0, binding = OF_OTHERS + 2u) uniform texture2D denoised_visibility_3;

// Adds a light; false where it is none.
bool add(inout vec3 sum, vec3 light, vec3 visibility) {
    if (!is_finite(light)) {
        count_bad(BAD_RADIANCE);
        return false;
    }
    sum += outgoing_range(light) * (COLOURED ? visibility : visibility.xxx);
    return true;
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    vec3 sum = imageLoad(radiance, host_pixel(RADIANCE, p)).rgb;
    bool any = false;
    if (is_present(UNSHADOWED_DIRECT)) any = add(sum, texelFetch(unshadowed_direct, host_pixel(UNSHADOWED_DIRECT, p), 0).rgb, texelFetch(denoised_visibility, host_pixel(DENOISED_VISIBILITY, p), 0).rgb);
    if (is_present(UNSHADOWED_DIRECT + 1u) && is_present(OF_OTHERS)) any = add(sum, texelFetch(unshadowed_direct_1, host_pixel(UNSHADOWED_DIRECT + 1u, p), 0).rgb, texelFetch(denoised_visibility_1, host_pixel(OF_OTHERS, p), 0).rgb) || any;
    if (is_present(UNSHADOWED_DIRECT + 2u) && is_present(OF_OTHERS + 1u)) any = add(sum, texelFetch(unshadowed_direct_2, host_pixel(UNSHADOWED_DIRECT + 2u, p), 0).rgb, texelFetch(denoised_visibility_2, host_pixel(OF_OTHERS + 1u, p), 0).rgb) || any;
    if (is_present(UNSHADOWED_DIRECT + 3u) && is_present(OF_OTHERS + 2u)) any = add(sum, texelFetch(unshadowed_direct_3, host_pixel(UNSHADOWED_DIRECT + 3u, p), 0).rgb, texelFetch(denoised_visibility_3, host_pixel(OF_OTHERS + 2u, p), 0).rgb) || any;
    if (any) imageStore(radiance, host_pixel(RADIANCE, p), vec4(outgoing(sum), 1.0));
}
