#version 450
// Tells an upscaler where its own history of the denoised picture is worth little: for FSR, XeSS and DLSS.
// Source: none; the share of new light is that of [SVGF] 4.1, the change of light that of [ASVGF] 3.5.
// In:  guide; luminance_history per signal; history_confidence; denoised radiance; emission of the host. Out: reactive_mask: r: share of the
//      pixel that is new in this frame; g: share of its light that no filter has seen, since it is emitted; b: 0; a: 1.
// optional: luminance_history_1, history_confidence, emission
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    uint present;
} push;

#include "frame.glsl"
#include "viewport.glsl"
#include "optional.glsl"
#include "finite.glsl"
#include "guide.glsl"
#include "luminance.glsl"
#include "luminance_history.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint RADIANCE = 5u;
const uint REACTIVE_MASK = 7u;
const uint LUMINANCE_HISTORY_1 = 3u;
const uint HISTORY_CONFIDENCE = 4u;
const uint EMISSION = 6u;

layout(set = 0, binding = 1) uniform utexture2D guide;
layout(set = 0, binding = 2) uniform utexture2D luminance_history_0;
layout(set = 0, binding = LUMINANCE_HISTORY_1) uniform utexture2D luminance_history_1;
layout(set = 0, binding = HISTORY_CONFIDENCE) uniform texture2D history_confidence;
layout(set = 0, binding = RADIANCE) uniform texture2D radiance;
layout(set = 0, binding = EMISSION) uniform texture2D emission;
layout(set = 0, binding = REACTIVE_MASK, rgba16f) uniform writeonly image2D reactive_mask;

float frames_of(uvec4 packed) { return max(unpack_luminance_history(packed).history_length, 1.0); }

float new_share(ivec2 p) {
    if (guide_depth(GuideBits(texelFetch(guide, p, 0))) == 0.0) return 0.0;
    float frames = frames_of(texelFetch(luminance_history_0, p, 0));
    if (is_present(LUMINANCE_HISTORY_1)) frames = min(frames, frames_of(texelFetch(luminance_history_1, p, 0)));
    float change = is_present(HISTORY_CONFIDENCE) ? 1.0 - texelFetch(history_confidence, host_pixel(HISTORY_CONFIDENCE, p), 0).x : 0.0;
    return clamp(max(1.0 / frames, change), 0.0, 1.0);
}

float emitted_share(ivec2 p) {
    if (!is_present(EMISSION)) return 0.0;
    vec3 e = texelFetch(emission, host_pixel(EMISSION, p), 0).rgb;
    float emitted = is_finite(e) ? luminance(e) : 0.0;
    return emitted > 0.0 ? emitted / max(luminance(texelFetch(radiance, host_pixel(RADIANCE, p), 0).rgb), emitted) : 0.0;
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    imageStore(reactive_mask, host_pixel(REACTIVE_MASK, p), vec4(new_share(p), emitted_share(p), 0.0, 1.0));
}
