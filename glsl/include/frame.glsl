// The uniform block that every pass reads. Twin: FrameConstants in src/frame_constants.rs; the build asserts equal offsets.
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
    float alpha;                    // 0..1
    float alpha_moments;            // 0..1
    float max_history_length;       // frames
    float spatial_variance_frames;  // frames
    float sigma_l;
    float sigma_n;
    float sigma_z;
    float depth_tolerance;          // relative
    float normal_tolerance;         // cosine
    float edge_falloff;             // 1 / scene unit
    float percentile_low;           // 0..1
    float percentile_up;            // 0..1
    float percentile_range;         // interpercentile ranges
    float adaptivity;               // 0..1
    float change_threshold;         // standard errors
    float firefly_bias;             // luminance of irradiance
    float sigma_rt;                 // irradiance
    float sigma_rt_n;               // length of the difference of normals
    float sigma_rt_x;               // relative to the depth
    float volume_alpha;             // 0..1
    float volume_sigma_l;
    float volume_sigma_z;           // relative
    float volume_depth_tolerance;   // relative
    float exposure;
    float taa_alpha;
    float taa_gamma;                // standard deviations
    uint tone_curve;
    uint stratum_size;              // pixels
    float previous_clip_w_scale;    // w = scale·linear depth + offset in the previous frame's clip space
    float previous_clip_w_offset;
    float gradient_scale;
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

const uint FLAG_EAW_RADIANCE = 1u << 17;
const uint FLAG_EAW_NORMAL = 1u << 18;
const uint FLAG_EAW_POSITION = 1u << 19;
const uint FLAG_PAINTING_SHIFT = 20u;

bool has_flag(uint flag) { return (frame.flags & flag) != 0u; }

// Levels of [EAW] that paint in the holes of a sub-sampled input; 0 where it has none.
uint painting_levels() { return frame.flags >> FLAG_PAINTING_SHIFT & 3u; }

bool is_inside(ivec2 p) { return all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, ivec2(frame.render_extent))); }

bool is_inside_previous(ivec2 p) {
    return all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, ivec2(frame.previous_render_extent)));
}

#endif
