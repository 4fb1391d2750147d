#version 450
// Sets the claims of strata or pixels to none. A dispatch, since clears of storage images take up to forty times as long on some GPUs.
// Source: ours. Out: claims. Constants: STRATUM_SIZE.
#extension GL_GOOGLE_include_directive : require

#include "frame.glsl"
#include "strata.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 1, r32ui) uniform writeonly uimage2D claims;

void main() {
    ivec2 s = ivec2(gl_GlobalInvocationID.xy);
    if (is_stratum(s)) imageStore(claims, s, uvec4(0u));
}
