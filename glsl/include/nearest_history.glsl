// The pixel of the previous frame nearest to where a surface was, where it still shows that surface. Twin: src/reference/nearest_history.rs.
// Coarser than the history of temporal_accumulation.comp, for statistics over many pixels. Needs `float depth_tolerance` in the
// shader's block `push`.
#ifndef NEAREST_HISTORY_GLSL
#define NEAREST_HISTORY_GLSL
#include "frame.glsl"
#include "surface_motion.glsl"

bool nearest_history(ivec2 p, GuideBits packed, utexture2D surface_motion, utexture2D previous_guide, out ivec2 tap) {
    float z = guide_depth(packed);
    SurfaceMotion m = unpack_surface_motion(texelFetch(surface_motion, p, 0));
    ivec2 wanted = ivec2(floor(previous_position(p, m.motion, frame.render_extent, frame.previous_render_extent)));
    tap = nearest_inside_previous(wanted);
    GuideBits previous = GuideBits(texelFetch(previous_guide, tap, 0));
    float previous_z = guide_depth(previous), expected = z * (1.0 + m.depth_ratio);
    vec2 gradient = guide_gradient(packed);
    float tolerance = push.depth_tolerance * expected + abs(gradient.x) + abs(gradient.y);
    bool exists = z != 0.0 && previous_z != 0.0 && !has_flag(FLAG_RESET) && tap == wanted;
    return exists && guide_id(previous) == guide_id(packed) && abs(previous_z - expected) <= tolerance;
}

#endif
