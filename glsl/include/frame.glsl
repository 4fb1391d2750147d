// The uniform block of the frame: camera, extents, conventions. What a host tunes is in the push constants of the shaders that read it.
// "World" in shaders is world space seen from this frame's eye: its axes, with the eye as the origin. The matrices are composed in double
// precision, so that what is near the eye is exact however far both are from the host's origin.
// Twin: FrameConstants in src/frame_constants.rs; the build asserts equal offsets.
#ifndef FRAME_GLSL
#define FRAME_GLSL

// The stage filter_exposure alone writes it.
#ifndef FRAME_ACCESS
#define FRAME_ACCESS uniform
#endif

layout(set = 0, binding = 0, std140) FRAME_ACCESS FrameConstants {
    mat4 clip_from_view;            // unjittered
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
    uint flags;                     // FLAG_*, and the conventions, which shaders have as a constant
    float exposure_ratio;           // this frame's exposure / the previous one's, with those of the filter
    float background_depth;         // scene units; linear depths from here on are background
    float previous_clip_w_scale;    // w = scale·linear depth + offset in the previous frame's clip space
    float previous_clip_w_offset;
    float filter_exposure;          // a power of 2: light in the filter / light of the host
    float inverse_filter_exposure;
    vec4 eye;                       // of this frame, in the host's world space; w is 0
    vec4 lights[4];                 // of which a host gives the visibility: homogeneous places; 0: not known
    vec4 previous_lights[4];        // in the previous frame
    vec4 materials[16];             // by class: factors of depth, normal and light; longest history, frames
    uvec2 output_extent;            // pixels
    uvec2 previous_output_extent;   // pixels
    uvec2 guide_extent;             // pixels; render_extent and jitter are those of the light, which may have fewer
    uvec2 previous_guide_extent;    // pixels
    vec2 guide_jitter;              // pixels of the guides
    vec2 previous_guide_jitter;     // pixels of the guides
    uvec2 light_ratio;              // pixels of the guides for each of the light
    uvec2 light_offset;             // pixels of the guides
    uvec2 viewport_origin;          // pixels of the host's images
    float motion_scale;             // factor of the host's motion
} frame;

// A stage that runs once for each pixel of the guides defines this, and reads their extents and jitter by the same names.
#ifdef GUIDE_PIXELS
#define render_extent guide_extent
#define previous_render_extent previous_guide_extent
#define jitter guide_jitter
#define previous_jitter previous_guide_jitter
#endif

// The pixel of the guides that a pixel of light was traced for; of one of the guides, itself.
#ifdef GUIDE_PIXELS
ivec2 guide_pixel(ivec2 p) { return p; }
#else
ivec2 guide_pixel(ivec2 p) { return p * ivec2(frame.light_ratio) + ivec2(frame.light_offset); }
#endif

const uint FLAG_RESET = 1u;
const uint FLAG_RESHADED = 1u << 16;

bool has_flag(uint flag) { return (frame.flags & flag) != 0u; }

// Light of the host as the filter counts it: so that half floats hold it. What is finite stays finite.
vec3 exposed(vec3 radiance) { return min(max(radiance * frame.filter_exposure, -3e38), 3e38); }

bool is_inside(ivec2 p) { return all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, ivec2(frame.render_extent))); }

// The pixel that a tap reads without a branch, which vector units would mask and not skip: where it is another one, the weight is 0.
ivec2 nearest_inside(ivec2 q) { return clamp(q, ivec2(0), ivec2(frame.render_extent) - 1); }

bool is_inside_previous(ivec2 p) {
    return all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, ivec2(frame.previous_render_extent)));
}

ivec2 nearest_inside_previous(ivec2 q) { return clamp(q, ivec2(0), ivec2(frame.previous_render_extent) - 1); }

#endif
