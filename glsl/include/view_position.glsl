// The surface point of a pixel in view space and in the world, the size of a pixel, and where a point of the world was. Twin: src/reference/projection.rs.
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

vec3 world_position(ivec2 p, float linear_depth) { return (frame.world_from_view * vec4(view_position(p, linear_depth), 1.0)).xyz; }

// Where a point of the world that stands still was on the screen; false: behind the camera.
bool previous_pixel_position(vec3 world, out vec2 position) {
    vec4 clip = frame.previous_clip_from_world * vec4(world, 1.0);
    vec2 extent = vec2(frame.previous_render_extent);
    position = (clip.xy / clip.w * 0.5 + 0.5) * extent - frame.jitter * (extent / vec2(frame.render_extent)) - 0.5;
    // What lies far outside has no pixel, and its number none either.
    return clip.w > 0.0 && all(lessThan(abs(position), vec2(1e6)));
}

// Where a surface was in the world, by its place on the screen of the previous frame: pixels; centres are whole numbers.
vec3 previous_surface(vec2 position, float previous_depth) {
    vec2 extent = vec2(frame.previous_render_extent);
    vec2 pixel = position + 0.5 + frame.jitter * (extent / vec2(frame.render_extent)) - frame.previous_jitter;
    float w = frame.previous_clip_w_scale * previous_depth + frame.previous_clip_w_offset;
    return (frame.world_from_previous_sample * vec4(pixel * w, previous_depth, 1.0)).xyz;
}

#endif
