#version 450
// Tells an upscaler where its own history of the denoised picture is worth little: for FSR, XeSS and DLSS.
// Source: none; the share of new light is that of [SVGF] 4.1, the change of light that of [ASVGF] 3.5.
// In:  guide of the pixels with light; where those are fewer also depth and surface_id of the host; luminance_history per signal;
//      history_confidence; denoised radiance; emission of the host. Out: reactive_mask: r: share of the pixel that is new in this frame; g: share of its light that no filter has seen,
//      since it is emitted; b: 0; a: 1.
// optional: luminance_history_1, history_confidence, emission, depth, surface_id
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    uint present;
} push;

#define GUIDE_PIXELS
#include "both_confidences.glsl"
#include "frame.glsl"
#include "viewport.glsl"
#include "optional.glsl"
#include "finite.glsl"
#include "guide.glsl"
#include "luminance.glsl"
#include "luminance_history.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint LUMINANCE_HISTORY_1 = 3u;
const uint HISTORY_CONFIDENCE = 4u;
const uint RADIANCE = 5u;
const uint EMISSION = 6u;
const uint REACTIVE_MASK = 7u;
const uint DEPTH = 8u;
const uint SURFACE_ID_IMAGE = 9u;

layout(set = 0, binding = 1) uniform utexture2D guide;
layout(set = 0, binding = 2) uniform utexture2D luminance_history_0;
layout(set = 0, binding = LUMINANCE_HISTORY_1) uniform utexture2D luminance_history_1;
layout(set = 0, binding = HISTORY_CONFIDENCE) uniform texture2D history_confidence;
layout(set = 0, binding = RADIANCE) uniform texture2D radiance;
layout(set = 0, binding = EMISSION) uniform texture2D emission;
layout(set = 0, binding = REACTIVE_MASK, rgba16f) uniform writeonly image2D reactive_mask;
layout(set = 0, binding = DEPTH) uniform texture2D depth;
layout(set = 0, binding = SURFACE_ID_IMAGE) uniform utexture2D surface_id;

#include "surface_id.glsl"
#include "host_depth.glsl"

float frames_of(uint packed) { return max(unpack_luminance_history(packed).history_length, 1.0); }

// Of a rendered pixel.
float depth_at(ivec2 p) {
    return is_present(DEPTH) ? host_depth_at(p) : guide_depth(GuideBits(texelFetch(guide, p, 0)));
}

// Of the 2x2 pixels of light around a rendered pixel the one whose surface is nearest to its depth. With light of every pixel, its own.
ivec2 light_pixel(ivec2 p, float z) {
    ivec2 ratio = ivec2(frame.light_ratio), last = ivec2(frame.guide_extent) / ratio - 1, best = p;
    if (ratio == ivec2(1)) return best;
    ivec2 corner = ivec2(floor((vec2(p) + 0.5) / vec2(ratio) - 0.5));
    float least = 3e38;
    for (int i = 0; i < 4; ++i) {
        ivec2 q = clamp(corner + ivec2(i % 2, i / 2), ivec2(0), last);
        float difference = abs(guide_depth(GuideBits(texelFetch(guide, q, 0))) - z);
        best = difference < least ? q : best;
        least = min(least, difference);
    }
    return best;
}

float new_share(ivec2 at) {
    float z = depth_at(at);
    if (z == 0.0) return 0.0;
    ivec2 p = light_pixel(at, z);
    float frames = frames_of(texelFetch(luminance_history_0, p, 0).x);
    if (is_present(LUMINANCE_HISTORY_1)) frames = min(frames, frames_of(texelFetch(luminance_history_1, p, 0).x));
    float change = is_present(HISTORY_CONFIDENCE) ? change_by(texelFetch(history_confidence, host_pixel(HISTORY_CONFIDENCE, p), 0).x) : 0.0;
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
