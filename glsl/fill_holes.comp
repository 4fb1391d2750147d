#version 450
// Gives pixels without a sample the mean of the samples around them that show the same surface: what a hole shows until it has a past.
// Source: ours; weights by distance of [Shepard 1968], edges of [SVGF] eq. 3 and 4. Deviation: without edges where these let nothing pass.
// In:  guide; holed: irradiance, alpha -1 in holes. Out: filled (filled_irradiance): the same, without holes; alpha
//      stays -1, so that the accumulation knows what is no sample, and is -2 in a hole without any sample around it, which is counted as
//      radiance that is not finite.
// Constant: RADIUS of the window, pixels.
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const int RADIUS = 1;

layout(push_constant) uniform Push {
    float sigma_n;
    float sigma_z;
} push;

#include "frame.glsl"
#include "statistics.glsl"
#include "guide.glsl"
#include "hole_filling.glsl"

layout(set = 0, binding = 2) uniform utexture2D guide;
layout(set = 0, binding = 4) uniform texture2D holed;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D filled;

void add_tap(inout Filling sum, ivec2 p, ivec2 offset, EdgeCentre centre) {
    ivec2 q = p + offset;
    if (offset == ivec2(0) || !is_inside(q)) return;
    vec4 tap = texelFetch(holed, q, 0);
    GuideBits packed = GuideBits(texelFetch(guide, q, 0));
    if (tap.a >= 0.0 && is_of_same_kind(centre, packed)) add_sample(sum, tap.rgb, packed, vec2(offset), centre);
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    vec4 texel = texelFetch(holed, p, 0);
    if (texel.a < 0.0) {
        EdgeCentre centre = edge_centre(GuideBits(texelFetch(guide, p, 0)));
        Filling sum = no_filling();
        [[dont_unroll]] for (int y = -RADIUS; y <= RADIUS; ++y)
            [[dont_unroll]] for (int x = -RADIUS; x <= RADIUS; ++x) add_tap(sum, p, ivec2(x, y), centre);
        texel = filled_hole(sum);
        if (texel.a == EMPTY_HOLE) count_bad(BAD_RADIANCE);
    }
    imageStore(filled, p, texel);
}
