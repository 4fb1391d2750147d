#version 450
// The guide of every rendered pixel, where light has fewer: from the host's images, as import has it of the pixels with light.
// Source: ours. In: depth, normal, surface_id as the host encodes them; albedo. Out: rendered_guide
// (docs/specification/packed_images.md).
// optional: albedo
// variants: SURFACE_ID=0 SURFACE_ID=1
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    uint present;
} push;

#define GUIDE_PIXELS
#include "frame.glsl"
#include "viewport.glsl"
#include "demodulation.glsl"
#include "optional.glsl"

layout(local_size_x = 64) in;

const uint DEPTH = 1u;
const uint NORMAL = 2u;
const uint ALBEDO = 4u;
const uint SURFACE_ID_IMAGE = 6u;

layout(set = 0, binding = DEPTH) uniform texture2D depth;
layout(set = 0, binding = NORMAL) uniform texture2D normal;
layout(set = 0, binding = ALBEDO) uniform texture2D albedo;
layout(set = 0, binding = 5, rgba16ui) uniform writeonly uimage2D rendered_guide;
#if SURFACE_ID
layout(set = 0, binding = SURFACE_ID_IMAGE) uniform utexture2D surface_id;
#endif

#include "host_depth.glsl"
#include "host_normal.glsl"
#include "surface_id.glsl"

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    uint id = id_at(p);
    float z = depth_of(texelFetch(depth, host_pixel(DEPTH, p), 0).x, id, p);
    bool bad;
    vec3 n = world_normal(p, bad);
    bool apart = is_present(ALBEDO) && is_apart(texelFetch(albedo, host_pixel(ALBEDO, p), 0).rgb);
    imageStore(rendered_guide, p, z == 0.0 ? uvec4(0u) : pack_guide(Guide(z, apart, n, vec2(0.0), fold_id(id))).bits);
}
