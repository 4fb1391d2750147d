#version 450
// How far the history of a pixel is still true: 1 where light did not change, 0 where nothing of it is left.
// Source: [ASVGF] 3.5, eq. 14: λ = |δ| / Δ, and its maximum over 3x3 pixels; confidence is 1 - λ.
// In:  SOURCE 0: gradient, δ and Δ per stratum. SOURCE 1: confidence of the host per pixel. Out: history_confidence, 0..1.
// Constants: STRATUM_SIZE, with SOURCE 0.
// variants: SOURCE=0 SOURCE=1
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "finite.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

#if SOURCE == 0
#include "strata.glsl"

layout(push_constant) uniform Push {
    float gradient_scale;
} push;

layout(set = 0, binding = 1) uniform texture2D gradient;
#else
layout(set = 0, binding = 1) uniform texture2D confidence;
#endif
layout(set = 0, binding = 2, r32f) uniform writeonly image2D history_confidence;

#if SOURCE == 0
float change_at(ivec2 s) {
    vec2 value = texelFetch(gradient, s, 0).xy;
    return value.y > 0.0 ? min(1.0, push.gradient_scale * abs(value.x) / value.y) : 0.0;
}

// The 3x3 pixels lie in at most four strata.
float confidence_at(ivec2 p) {
    ivec2 first = max(p - 1, ivec2(0)) / int(STRATUM_SIZE);
    ivec2 last = min(p + 1, ivec2(frame.render_extent) - 1) / int(STRATUM_SIZE);
    float change = 0.0;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) change = max(change, change_at(ivec2(x, y)));
    return 1.0 - change;
}
#else
float confidence_at(ivec2 p) {
    float value = texelFetch(confidence, p, 0).x;
    return is_finite(value) ? clamp(value, 0.0, 1.0) : 1.0;
}
#endif

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    imageStore(history_confidence, p, vec4(confidence_at(p), 0.0, 0.0, 0.0));
}
