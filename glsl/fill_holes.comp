#version 450
// Gives pixels without a sample the mean of the samples around them that show the same surface: what a hole shows until it has a past.
// Source: ours; weights by distance of [Shepard 1968], edges of [SVGF] eq. 3 and 4. Deviation: without edges where these let nothing pass.
// In:  guide, depth_gradient; holed: irradiance, alpha -1 in holes (filter_ping). Out: filled (filter_filled): the same, without holes; alpha
//      stays -1, so that the accumulation knows what is no sample.
// Counts a hole without any sample around it as radiance that is not finite; it is black.
// Constant: RADIUS of the window, pixels.
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const int RADIUS = 1;

layout(push_constant) uniform Push {
    float sigma_n;
    float sigma_z;
    float edge_falloff;
} push;

#include "frame.glsl"
#include "statistics.glsl"
#include "guide.glsl"
#include "geometry_weights.glsl"
#include "luminance.glsl"

layout(set = 0, binding = 2) uniform utexture2D guide;
layout(set = 0, binding = 3) uniform utexture2D depth_gradient;
layout(set = 0, binding = 4) uniform texture2D holed;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D filled;

struct Sum {
    vec4 edges;  // rgb, weight
    vec4 plain;  // the same of all samples of surfaces, or of the background
};

void add_tap(inout Sum sum, ivec2 p, ivec2 offset, EdgeCentre centre) {
    ivec2 q = p + offset;
    if (offset == ivec2(0) || !is_inside(q)) return;
    vec4 tap = texelFetch(holed, q, 0);
    GuideBits packed = GuideBits(texelFetch(guide, q, 0));
    bool background = centre.depth == 0.0;
    if (tap.a < 0.0 || (guide_depth(packed) == 0.0) != background) return;
    vec2 way = vec2(offset);
    float weight = 1.0 / dot(way, way);
    sum.plain += weight * vec4(tap.rgb, 1.0);
    if (!background) weight *= exp2(log2_edge_weight(centre, packed, depth_sharpness(centre, way)));
    sum.edges += weight * vec4(tap.rgb, 1.0);
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    vec4 texel = texelFetch(holed, p, 0);
    if (texel.a < 0.0) {
        EdgeCentre centre = edge_centre(GuideBits(texelFetch(guide, p, 0)), unpack_depth_gradient(texelFetch(depth_gradient, p, 0).x));
        Sum sum = Sum(vec4(0.0), vec4(0.0));
        [[dont_unroll]] for (int y = -RADIUS; y <= RADIUS; ++y)
            [[dont_unroll]] for (int x = -RADIUS; x <= RADIUS; ++x) add_tap(sum, p, ivec2(x, y), centre);
        if (sum.plain.a == 0.0) count_bad(BAD_RADIANCE);
        vec4 mean = sum.edges.a >= 1e-6 ? sum.edges : sum.plain;
        if (mean.a > 0.0) texel.rgb = storable(mean.rgb / mean.a);
    }
    imageStore(filled, p, texel);
}
