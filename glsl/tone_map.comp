#version 450
// Tone map: HDR radiance to display-referred linear values, for what comes after the denoiser (TAA, a swapchain).
// Source: x/(1+luminance) [Reinhard 2002], and the fit of the ACES curve of [Narkowicz 2015].
// In:  denoised_radiance, linear Rec. 709; VOLUME: and denoised_volume, which is added. Out: tone_mapped, linear 0..1.
// variants: VOLUME=0 VOLUME=1
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "push_constants.glsl"
#include "luminance.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 1) uniform texture2D denoised_radiance;
#if VOLUME
layout(set = 0, binding = 2) uniform texture2D denoised_volume;
#endif
layout(set = 0, binding = 2 + VOLUME, rgba16f) uniform writeonly image2D tone_mapped;

vec3 aces(vec3 x) { return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); }

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    vec3 radiance = texelFetch(denoised_radiance, p, 0).rgb;
#if VOLUME
    radiance += texelFetch(denoised_volume, p, 0).rgb;
#endif
    vec3 x = max(radiance * frame.exposure, 0.0);
    if (frame.tone_curve == 0u) x = aces(min(x, 1e4));
    else if (frame.tone_curve == 1u) x /= 1.0 + luminance(x);
    imageStore(tone_mapped, p, vec4(clamp(x, 0.0, 1.0), 1.0));
}
