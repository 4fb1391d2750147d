// Where the image of what is seen in a surface was in the previous frame. Twin: src/reference/virtual_motion.rs.
// Source: [Zimmer et al. 2015]. Needs `guide` of this frame, by packed_image.glsl.
#ifndef VIRTUAL_MOTION_GLSL
#define VIRTUAL_MOTION_GLSL
#include "curvature.glsl"
#include "frame.glsl"
#include "reflection.glsl"
#include "surface_motion.glsl"
#include "view_position.glsl"

// The surface of a pixel.
struct Mirror {
    ivec2 p;
    GuideBits packed;
    vec3 position;  // world space
    vec3 sight;     // from the eye, of unit length
    vec3 normal;
    vec2 surface_position;  // in the previous frame, pixels; centres are whole numbers
};

Mirror mirror_at(ivec2 p, GuideBits packed, vec2 motion) {
    vec2 surface_position = previous_position(p, motion, frame.render_extent, frame.previous_render_extent) - 0.5;
    return Mirror(p, packed, world_position(p, guide_depth(packed)), line_of_sight(p), guide_normal(packed), surface_position);
}

// Pixels between normals of which the curvature is made: the guide's are rounded to half a degree.
const int CURVATURE_REACH = 3;

// Towards one side. False: another surface is there.
bool step_towards(Mirror c, ivec2 offset, out Step to) {
    ivec2 q = c.p + offset;
    to = Step(vec3(0.0), vec3(0.0));
    if (!is_inside(q)) return false;
    GuideBits packed = GuideBits(packed_at(guide, q));
    float z = guide_depth(packed);
    if (z == 0.0 || guide_id(packed) != guide_id(c.packed)) return false;
    to = Step(world_position(q, z) - c.position, guide_normal(packed) - c.normal);
    return true;
}

// The flatter side of each axis counts: where two faces meet, the other one tells of the edge. At an outline, the side that there is.
Step step_along(Mirror c, ivec2 axis) {
    Step before, behind;
    bool has_before = step_towards(c, -CURVATURE_REACH * axis, before);
    bool has_behind = step_towards(c, CURVATURE_REACH * axis, behind);
    if (!has_before || !has_behind) return has_before ? before : behind;
    return abs(curvature_of(before)) < abs(curvature_of(behind)) ? before : behind;
}

Curvature curvature_at(Mirror c) { return curvature_by(c.normal, c.sight, step_along(c, ivec2(1, 0)), step_along(c, ivec2(0, 1))); }

// Where every line of sight of the previous frame came from, times the w of that homogeneous point: 0 where they are parallel.
vec3 previous_eye_from(vec3 world) {
    vec4 eye = vec4(0.0, 0.0, -frame.previous_clip_w_offset, frame.previous_clip_w_scale);
    return (frame.world_from_previous_sample * eye).xyz - world * eye.w;
}

// Where the surface of a mirror was in the previous frame, with the axes of its curvature.
struct MirrorBefore {
    vec3 position;
    vec3 sight;
    vec3 along;
    vec3 across;
};

MirrorBefore mirror_at_rest(Mirror c, Curvature curvature) { return MirrorBefore(c.position, c.sight, curvature.along, curvature.across); }

// Of a thing at rest before a mirror at rest, from its surface in the axes of MirrorBefore: along, across, sight.
vec3 image_at_rest(float hit_distance) { return vec3(0.0, 0.0, hit_distance); }

// Where the image behind the surface was: where a line of sight of the previous frame met the wave front of what is mirrored. `image`: of the
// thing as a flat mirror showed it, in the axes of `before`. Motion of the surface that `before` lacks takes along what is not mirrored alone.
bool virtual_position(Mirror c, Curvature curvature, MirrorBefore before, vec3 image, float roughness, out vec2 position) {
    float share = mirror_share(roughness), distance = share * image.z;
    vec2 still;
    if (!previous_pixel_position(before.position, still)) return false;
    vec3 eye = previous_eye_from(before.position);
    float ahead = -dot(eye, before.sight), behind = distance * frame.previous_clip_w_scale, both = ahead + behind;
    if (!(ahead > 0.0)) return false;
    vec3 nearer = bounded(UNIT_MATRIX + clamp(image.z * curvature.power, -1e6, 1e6), 0.1);
    vec2 eye_aside = vec2(dot(eye, before.along), dot(eye, before.across)) / both;
    vec2 thing_aside = image.xy * (share * ahead / both);
    vec2 aside = solved((ahead * nearer + behind * UNIT_MATRIX) / both, distance * eye_aside + thing_aside);
    if (!previous_pixel_position(before.position + aside.x * before.along + aside.y * before.across, position)) return false;
    position += (c.surface_position - still) * (1.0 - share);
    return true;
}

#endif
