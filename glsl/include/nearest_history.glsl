// The pixel of the previous frame nearest to where a surface was, where it still shows that surface. Twin: src/reference/nearest_history.rs.
// Coarser than the history of temporal_accumulation.comp, for statistics over many pixels. Needs `float depth_tolerance` in the
// shader's block `push`.
#ifndef NEAREST_HISTORY_GLSL
#define NEAREST_HISTORY_GLSL
#include "frame.glsl"
#include "surface_motion.glsl"

bool nearest_history(ivec2 p, uvec4 packed, utexture2D surface_motion, utexture2D depth_gradient, utexture2D previous_guide, out ivec2 tap) {
    tap = ivec2(-1);
    float z = unpack_depth(packed);
    if (z == 0.0 || has_flag(FLAG_RESET)) return false;
    SurfaceMotion m = unpack_surface_motion(texelFetch(surface_motion, p, 0));
    tap = ivec2(floor(previous_position(p, m.motion, frame.render_extent, frame.previous_render_extent)));
    if (!is_inside_previous(tap)) return false;
    uvec4 previous = texelFetch(previous_guide, tap, 0);
    float previous_z = unpack_depth(previous), expected = z * (1.0 + m.depth_ratio);
    vec2 gradient = unpackHalf2x16(texelFetch(depth_gradient, p, 0).x);
    float tolerance = push.depth_tolerance * expected + abs(gradient.x) + abs(gradient.y);
    return previous_z != 0.0 && unpack_id(previous) == unpack_id(packed) && abs(previous_z - expected) <= tolerance;
}

#endif
