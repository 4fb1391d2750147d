// The guide of a rendered pixel, without id and gradient. Where light has fewer pixels no image has it: then it is made of the host's images,
// as import makes those of the pixels with light. Needs GUIDE_PIXELS, optional.glsl, the bindings `guide` and `albedo`, and places for those of
// the host, which are left out where `guide` has every pixel. Twin: rendered_guide in src/nodes/import/twin.rs.
#ifndef RENDERED_GUIDE_GLSL
#define RENDERED_GUIDE_GLSL
#include "demodulation.glsl"
#include "guide.glsl"
#include "viewport.glsl"

// Whether what the albedo hardly divides is kept apart, as import does.
layout(constant_id = 4) const bool APART = true;

layout(set = 0, binding = DEPTH) uniform texture2D depth;
layout(set = 0, binding = NORMAL) uniform texture2D normal;
layout(set = 0, binding = SURFACE_ID_IMAGE) uniform utexture2D surface_id;

#include "surface_id.glsl"
#include "host_depth.glsl"
#include "host_normal.glsl"

GuideBits rendered_guide_at(ivec2 p) {
    if (!is_present(NORMAL)) return GuideBits(texelFetch(guide, p, 0));
    float z = host_depth_at(p);
    bool bad, apart = APART && is_present(ALBEDO) && is_apart(texelFetch(albedo, host_pixel(ALBEDO, p), 0).rgb);
    vec3 n = world_normal(p, bad);
    return z == 0.0 ? GuideBits(uvec4(0u)) : pack_guide(Guide(z, apart, n, vec2(0.0), 0u), 0u);
}

#endif
