// The surface point of a pixel in view space, for distances. Twin: src/reference/projection.rs.
#ifndef VIEW_POSITION_GLSL
#define VIEW_POSITION_GLSL
#include "frame.glsl"
#include "conventions.glsl"

vec3 view_position(ivec2 p, float linear_depth) {
    vec2 ndc = (vec2(p) + 0.5 + frame.jitter) / vec2(frame.render_extent) * 2.0 - 1.0;
    mat4 clip = frame.clip_from_view;
    // Farther away, squares of differences are not finite.
    linear_depth = min(linear_depth, 1e15);
    float z = forward_sign() * linear_depth;
    float w = clip[2][3] * z + clip[3][3];
    vec2 xy = (ndc * w - vec2(clip[2][0], clip[2][1]) * z - vec2(clip[3][0], clip[3][1])) / vec2(clip[0][0], clip[1][1]);
    return vec3(xy, z);
}

#endif
