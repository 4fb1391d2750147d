#version 450
// Picks the guides of the pixels that light was traced for, where the light has fewer pixels than the guides.
// Source: ours. In: rendered guides of every pixel. Out: the same for each pixel of the light; motion and change of depth per pixel of it.
// optional: rendered_object_normal_guide, object_normal_guide
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    uint present;
} push;

#include "frame.glsl"
#include "guide.glsl"
#include "optional.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint RENDERED_OBJECT_NORMAL_GUIDE = 7u;
const uint OBJECT_NORMAL_GUIDE = 8u;

layout(set = 0, binding = 1) uniform utexture2D rendered_guide;
layout(set = 0, binding = 2) uniform utexture2D rendered_surface_motion;
layout(set = 0, binding = 3) uniform utexture2D rendered_depth_gradient;
layout(set = 0, binding = 4, rgba16ui) uniform writeonly uimage2D guide;
layout(set = 0, binding = 5, rgba16ui) uniform writeonly uimage2D surface_motion;
layout(set = 0, binding = 6, r32ui) uniform writeonly uimage2D depth_gradient;
layout(set = 0, binding = RENDERED_OBJECT_NORMAL_GUIDE) uniform utexture2D rendered_object_normal_guide;
layout(set = 0, binding = OBJECT_NORMAL_GUIDE, r32ui) uniform writeonly uimage2D object_normal_guide;

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    ivec2 traced = guide_pixel(p);
    vec2 ratio = vec2(frame.light_ratio);
    imageStore(guide, p, texelFetch(rendered_guide, traced, 0));
    uvec4 motion = texelFetch(rendered_surface_motion, traced, 0);
    motion.xy = uvec2(half_bits(half_value(motion.x) / ratio.x), half_bits(half_value(motion.y) / ratio.y));
    imageStore(surface_motion, p, motion);
    vec2 gradient = unpack_depth_gradient(texelFetch(rendered_depth_gradient, traced, 0).x) * ratio;
    imageStore(depth_gradient, p, uvec4(packHalf2x16(clamp(gradient, -65504.0, 65504.0)), 0u, 0u, 0u));
    if (!is_present(RENDERED_OBJECT_NORMAL_GUIDE) || !is_present(OBJECT_NORMAL_GUIDE)) return;
    imageStore(object_normal_guide, p, texelFetch(rendered_object_normal_guide, traced, 0));
}
