// The uniform block of the frame: camera, extents, conventions. What a host tunes is in the push constants of the shaders that read it.
// Twin: FrameConstants in src/frame_constants.rs; the build asserts equal offsets.
#ifndef FRAME_GLSL
#define FRAME_GLSL

layout(set = 0, binding = 0, std140) uniform FrameConstants {
    mat4 clip_from_view;            // unjittered
    mat4 world_from_clip;           // unjittered
    mat4 world_from_view;
    mat4 previous_clip_from_world;  // unjittered
    mat4 previous_view_from_world;
    mat4 world_from_previous_sample;  // from (x·w, y·w, linear depth, 1) of the previous frame, x and y in pixels
    mat4 sample_from_world;           // to (x·w, y·w, linear depth, w), x and y in pixels
    uvec2 render_extent;            // pixels
    uvec2 previous_render_extent;   // pixels
    vec2 jitter;                    // pixels
    vec2 previous_jitter;           // pixels
    uint frame_index;
    uint flags;                     // FLAG_*
    float exposure_ratio;           // this frame's exposure / the previous one's
    float background_depth;         // scene units; linear depths from here on are background
    float previous_clip_w_scale;    // w = scale·linear depth + offset in the previous frame's clip space
    float previous_clip_w_offset;
} frame;

const uint FLAG_RESET = 1u;
const uint FLAG_DEPTH_SHIFT = 1u;
const uint FLAG_NORMAL_SHIFT = 3u;
const uint FLAG_NORMAL_VIEW = 1u << 5;
const uint FLAG_MOTION_UNIT_SHIFT = 6u;
const uint FLAG_MOTION_NEGATED = 1u << 8;
const uint FLAG_MOTION_Y_UP = 1u << 9;
const uint FLAG_MOTION_JITTERED = 1u << 10;
const uint FLAG_MOTION_DEPTH_SHIFT = 11u;
const uint FLAG_VIEW_POSITIVE_Z = 1u << 13;
const uint FLAG_RESHADED = 1u << 16;

bool has_flag(uint flag) { return (frame.flags & flag) != 0u; }

bool is_inside(ivec2 p) { return all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, ivec2(frame.render_extent))); }

bool is_inside_previous(ivec2 p) {
    return all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, ivec2(frame.previous_render_extent)));
}

#endif
