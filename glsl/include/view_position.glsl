// The surface point of a pixel in view space, and the size of a pixel. Twin: src/reference/projection.rs.
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

// Scene units from one pixel to the next, across and down, where a surface faces the camera.
vec2 pixel_size(float linear_depth) {
    mat4 clip = frame.clip_from_view;
    float w = clip[2][3] * (forward_sign() * min(linear_depth, 1e15)) + clip[3][3];
    return clamp(abs(2.0 * w / (vec2(frame.render_extent) * vec2(clip[0][0], clip[1][1]))), 1e-15, 1e15);
}

// From the eye through a pixel, of unit length, world space.
vec3 line_of_sight(ivec2 p) { return normalize(mat3(frame.world_from_view) * (view_position(p, 1.0) - view_position(p, 0.0))); }

#endif
