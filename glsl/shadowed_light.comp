#version 450
// Adds the light of the source whose visibility was filtered: what it would give if nothing stood in between, times its visibility.
// Source: ours. In: denoised_visibility; unshadowed_direct of the host, linear Rec. 709, times albedo and BSDF. In place: radiance.
// variants: FLOAT=0 FLOAT=1
// optional: unshadowed_direct
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    uint present;
} push;

#define GUIDE_PIXELS
#include "frame.glsl"
#include "optional.glsl"
#include "outgoing.glsl"
#include "statistics.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint UNSHADOWED_DIRECT = 3u;

layout(set = 0, binding = 2) uniform texture2D denoised_visibility;
layout(set = 0, binding = UNSHADOWED_DIRECT) uniform texture2D unshadowed_direct;
layout(set = 0, binding = 4, OUTGOING_FORMAT) uniform image2D radiance;

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p) || !is_present(UNSHADOWED_DIRECT)) return;
    vec3 light = texelFetch(unshadowed_direct, p, 0).rgb;
    if (!is_finite(light)) {
        count_bad(BAD_RADIANCE);
        return;
    }
    vec3 sum = imageLoad(radiance, p).rgb + outgoing_range(light) * texelFetch(denoised_visibility, p, 0).x;
    imageStore(radiance, p, vec4(outgoing(sum), 1.0));
}
