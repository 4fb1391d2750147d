// Where the image of what is seen in a surface was in the previous frame. Twin: src/reference/virtual_motion.rs.
// Source: [Zimmer et al. 2015]. Needs `guide` of this frame, by packed_image.glsl.
#ifndef VIRTUAL_MOTION_GLSL
#define VIRTUAL_MOTION_GLSL
#include "frame.glsl"
#include "reflection.glsl"
#include "surface_motion.glsl"
#include "view_position.glsl"

// The surface of a pixel.
struct Mirror {
    ivec2 p;
    uvec4 packed;
    vec3 position;  // world space
    vec3 sight;     // from the eye, of unit length
    vec3 normal;
    vec2 surface_position;  // in the previous frame, pixels; centres are whole numbers
};

vec3 world_position(ivec2 p, float linear_depth) { return (frame.world_from_view * vec4(view_position(p, linear_depth), 1.0)).xyz; }

Mirror mirror_at(ivec2 p, uvec4 packed, vec2 motion) {
    vec2 surface_position = previous_position(p, motion, frame.render_extent, frame.previous_render_extent) - 0.5;
    return Mirror(p, packed, world_position(p, unpack_depth(packed)), line_of_sight(p), unpack_normal(packed), surface_position);
}

// Pixels between normals of which the curvature is made: the guide's are rounded to half a degree.
const int CURVATURE_REACH = 3;

// Curvature towards one side, 1 / scene unit; positive: convex. False: another surface is there.
bool curvature_towards(Mirror c, ivec2 offset, out float curvature) {
    ivec2 q = c.p + offset;
    curvature = 0.0;
    if (!is_inside(q)) return false;
    uvec4 packed = packed_at(guide, q);
    float z = unpack_depth(packed);
    if (z == 0.0 || unpack_id(packed) != unpack_id(c.packed)) return false;
    vec3 way = world_position(q, z) - c.position;
    curvature = dot(unpack_normal(packed) - c.normal, way) / max(dot(way, way), 1e-20);
    return true;
}

// The flatter side of each axis counts: where two faces meet, the other one tells of the edge. At an outline, the side that there is.
float curvature_along(Mirror c, ivec2 axis) {
    float before, behind;
    bool has_before = curvature_towards(c, -CURVATURE_REACH * axis, before);
    bool has_behind = curvature_towards(c, CURVATURE_REACH * axis, behind);
    if (!has_before || !has_behind) return has_before ? before : behind;
    return abs(before) < abs(behind) ? before : behind;
}

float mean_curvature(Mirror c) { return 0.5 * (curvature_along(c, ivec2(1, 0)) + curvature_along(c, ivec2(0, 1))); }

// Where a point of the world that stands still was on the screen; false: behind the camera.
bool previous_pixel_position(vec3 world, out vec2 position) {
    vec4 clip = frame.previous_clip_from_world * vec4(world, 1.0);
    vec2 extent = vec2(frame.previous_render_extent);
    position = (clip.xy / clip.w * 0.5 + 0.5) * extent - frame.jitter * (extent / vec2(frame.render_extent)) - 0.5;
    // What lies far outside has no pixel, and its number none either.
    return clip.w > 0.0 && all(lessThan(abs(position), vec2(1e6)));
}

// Where the image behind the surface was. A surface that moves by itself takes along what is not mirrored alone.
bool virtual_position(Mirror c, float distance, float share, out vec2 position) {
    vec2 still;
    if (!previous_pixel_position(c.position, still)) return false;
    if (!previous_pixel_position(c.position + c.sight * distance, position)) return false;
    position += (c.surface_position - still) * (1.0 - share);
    return true;
}

#endif
