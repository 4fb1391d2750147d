#version 450
// Takes in the visibility of one light, and how far away its occluder is; stops what is no visibility.
// Source: ours. In: guide; of the host noisy_visibility, 0 (occluded) to 1 (lit); occluder_distance, scene units along the shadow ray, 0 or
// infinite where nothing was hit.
// Out: visibility_samples: half2(visibility, or -1 for no sample; distance, 0 for none).
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "frame.glsl"
#include "guide.glsl"
#include "statistics.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 2) uniform utexture2D guide;
layout(set = 0, binding = 3) uniform texture2D noisy_visibility;
layout(set = 0, binding = 4) uniform texture2D occluder_distance;
layout(set = 0, binding = 5, r32ui) uniform writeonly uimage2D visibility_samples;

const float NO_SAMPLE = -1.0;

float visibility_at(ivec2 p) {
    float v = texelFetch(noisy_visibility, p, 0).x;
    // Not v < 0 || v > 1, which a NaN passes.
    bool usable = v >= 0.0 && v <= 1.0;
    if (!usable) count_bad(BAD_VISIBILITY);
    return usable ? v : is_finite(v) ? clamp(v, 0.0, 1.0) : NO_SAMPLE;
}

float distance_at(ivec2 p) {
    float d = texelFetch(occluder_distance, p, 0).x;
    if (is_nan(d) || d < 0.0) count_bad(BAD_OCCLUDER_DISTANCE);
    return is_finite(d) && d > 0.0 ? min(d, 65504.0) : 0.0;
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    vec2 taken = vec2(1.0, 0.0);
    if (guide_depth(GuideBits(texelFetch(guide, p, 0))) != 0.0) taken = vec2(visibility_at(p), distance_at(p));
    imageStore(visibility_samples, p, uvec4(packHalf2x16(taken)));
}
