// Motion of a pixel's surface, from the host's image or its matrices. Needs the bindings `motion` at MOTION and `instance_transforms`, the id of
// a pixel as `id_at`, optional.glsl and statistics.glsl. Twin: src/reference/reprojection.rs.
#ifndef HOST_MOTION_GLSL
#define HOST_MOTION_GLSL
#include "host_depth.glsl"
#include "instance_transform.glsl"
#include "surface_motion.glsl"
#include "viewport.glsl"

const uint MOTION_PIXELS = 0u;
const uint MOTION_UV = 1u;
const uint MOTION_DEPTH_NONE = 0u;
const uint MOTION_DEPTH_DIFFERENCE = 1u;

// The surface point of a pixel in world space seen from the eye, homogeneous. The background lies at infinity; orthographic lines of sight show the same
// at all depths.
vec4 world_point(ivec2 p, float z) {
    bool at_infinity = z == 0.0 && !is_orthographic();
    return frame.world_from_view * vec4(view_position(p, z == 0.0 ? 1.0 : z), at_infinity ? 0.0 : 1.0);
}

vec4 carry(vec4 world, uint id, inout vec3 n) {
#if SURFACE_ID
    vec4 rows[3], to;
    if (world.w == 0.0 || !instance_rows(id, rows)) return world;
    vec3 previous = turned(rows, n);
    float squared = dot(previous, previous);
    if (is_finite(squared) && squared >= 1e-8) n = previous * inversesqrt(squared);
    return carried(rows, world, to) ? to : world;
#else
    return world;
#endif
}

// Motion in pixels of the previous frame, from the host's image. False: there is none that can be used.
bool host_motion(ivec2 p, out vec3 m) {
    m = vec3(0.0);
    if (!is_present(MOTION)) return false;
    m = texelFetch(motion, host_pixel(MOTION, p), 0).xyz;
    bool bad = !is_finite(m.xy);
    if (bad) count_bad(BAD_MOTION);
    vec2 previous_extent = vec2(frame.previous_render_extent);
    uint unit = convention(MOTION_UNIT_SHIFT);
    vec2 ratio = extent_ratio(frame.render_extent, frame.previous_render_extent);
    vec2 scale = unit == MOTION_PIXELS ? ratio : unit == MOTION_UV ? previous_extent : previous_extent * 0.5;
    m.xy *= scale * frame.motion_scale;
    if (has_convention(MOTION_NEGATED)) m.xy = -m.xy;
    if (has_convention(MOTION_Y_UP)) m.y = -m.y;
    // A sample lies jitter beside its pixel's centre, so a rasterised position is the true one minus jitter.
    if (has_convention(MOTION_JITTERED)) m.xy += frame.previous_jitter - frame.jitter * ratio;
    return !bad;
}

// From the matrices: right for everything that stands still or has a transform.
vec2 matrix_motion(ivec2 p, vec4 previous_world) {
    vec4 clip = frame.previous_clip_from_world * previous_world;
    vec2 position = (clip.xy / clip.w * 0.5 + 0.5) * vec2(frame.previous_render_extent);
    vec2 current = (vec2(p) + 0.5 + frame.jitter) * extent_ratio(frame.render_extent, frame.previous_render_extent);
    vec2 m = position - current;
    return clip.w > 0.0 && is_finite(m) ? m : vec2(16384.0);
}

float previous_depth(vec4 previous_world, float z, bool from_host, float host_z) {
    uint kind = convention(MOTION_DEPTH_SHIFT);
    float previous = forward_sign() * (frame.previous_view_from_world * previous_world).z;
    if (kind != MOTION_DEPTH_NONE && from_host) previous = kind == MOTION_DEPTH_DIFFERENCE ? z + host_z : host_z;
    return is_finite(previous) && previous > 0.0 ? previous : z;
}

SurfaceMotion motion_of(ivec2 p, float z, uint id, vec3 n) {
    SurfaceMotion result = SurfaceMotion(vec2(0.0), 0.0, n);
    vec4 previous_world = carry(world_point(p, z), id, result.previous_normal);
    vec3 m;
    bool from_host = host_motion(p, m);
    result.motion = clamp(from_host ? m.xy : matrix_motion(p, previous_world), -16384.0, 16384.0);
    if (z != 0.0) result.depth_ratio = previous_depth(previous_world, z, from_host, m.z) / z - 1.0;
    return result;
}

#endif
