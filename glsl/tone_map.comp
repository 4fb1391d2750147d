#version 450
// Tone map: HDR radiance to display-referred linear values, for what comes after the denoiser (TAA, a swapchain).
// Source: x/(1+luminance) [Reinhard 2002], and the fit of the ACES curve of [Narkowicz 2015].
// In:  radiance of surfaces, of a volume, or of both, which are added; linear Rec. 709. Out: tone_mapped, linear 0..1.
// Constant OUTPUT: the radiance has the size of the output.
// optional: radiance_1
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(constant_id = 1) const bool OUTPUT = false;

layout(push_constant) uniform Push {
    uint present;
    uint tone_curve;
    float exposure;
} push;

#include "frame.glsl"
#include "viewport.glsl"
#include "optional.glsl"
#include "luminance.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint RADIANCE_0 = 1u;
const uint TONE_MAPPED = 3u;
const uint RADIANCE_1 = 2u;

layout(set = 0, binding = RADIANCE_0) uniform texture2D radiance_0;
layout(set = 0, binding = RADIANCE_1) uniform texture2D radiance_1;
layout(set = 0, binding = TONE_MAPPED, rgba16f) uniform writeonly image2D tone_mapped;

// As ToneCurve in src/contract/tuning.rs; what is neither is linear.
const uint CURVE_ACES = 0u;
const uint CURVE_REINHARD = 1u;

vec3 aces(vec3 x) { return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); }

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(p, ivec2(OUTPUT ? frame.output_extent : frame.guide_extent)))) return;
    vec3 radiance = texelFetch(radiance_0, host_pixel(RADIANCE_0, p), 0).rgb;
    if (is_present(RADIANCE_1)) radiance += texelFetch(radiance_1, host_pixel(RADIANCE_1, p), 0).rgb;
    // Beyond any light, so that what is made of it is finite.
    vec3 x = max(min(radiance, 1e30) * push.exposure, 0.0);
    if (push.tone_curve == CURVE_ACES) x = aces(min(x, 1e4));
    else if (push.tone_curve == CURVE_REINHARD) x /= 1.0 + luminance(x);
    imageStore(tone_mapped, host_pixel(TONE_MAPPED, p), vec4(clamp(x, 0.0, 1.0), 1.0));
}
