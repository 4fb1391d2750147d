// A mirror and the thing in it, where they were in the previous frame. Twin: src/reference/scenery.rs.
// Needs the inputs specular_hit_id, specular_motion, surface_id and instance_transforms at the bindings SPECULAR_HIT_ID, SPECULAR_MOTION, SURFACE_ID
// and INSTANCE_TRANSFORMS.
#ifndef SCENERY_GLSL
#define SCENERY_GLSL
#include "virtual_motion.glsl"
#include "instance_transform.glsl"

// Pixels that a lobe may cover whose thing is followed: in a wider one each pixel draws another thing, and their ids would tear its light apart.
const float NARROW_LOBE = 1.0;

// A mirror and the thing in it, in the previous frame.
struct Scenery {
    MirrorBefore mirror;
    vec3 thing;
    vec3 image;     // of the thing, as in virtual_position
    bool followed;  // the thing
};

Scenery at_rest(Mirror c, Curvature curvature, float hit_distance) {
    // A direction tells no more of what is farther away.
    vec3 thing = c.position + reflect(c.sight, c.normal) * min(hit_distance, 1e4 * guide_depth(c.packed));
    return Scenery(mirror_at_rest(c, curvature), thing, image_at_rest(hit_distance), false);
}

// What of the motion of a thing cannot be used.
struct BadMotion {
    bool transform;  // it should have one, and has none
    bool motion;     // of the host
};

// Both as they were: the thing by the host's motion, else by its instance; the mirror by its instance. The surface of the thing is that of the pixel's
// own path.
Scenery scenery_before(Mirror c, Curvature curvature, Reflection seen, out BadMotion bad) {
    bad = BadMotion(false, false);
    Scenery rest = at_rest(c, curvature, seen.hit_distance);
    bool has_transforms = is_present(INSTANCE_TRANSFORMS), has_ids = is_present(SPECULAR_HIT_ID) && has_transforms;
    if ((!has_ids && !is_present(SPECULAR_MOTION)) || !(seen.hit_distance > 0.0)) return rest;
    vec3 motion = is_present(SPECULAR_MOTION) ? texelFetch(specular_motion, host_pixel(SPECULAR_MOTION, c.p), 0).xyz : vec3(0.0);
    bad.motion = !is_finite(motion);
    bool has_motion = is_present(SPECULAR_MOTION) && !bad.motion;
    uint thing_id = has_ids && !has_motion ? texelFetch(specular_hit_id, host_pixel(SPECULAR_HIT_ID, c.p), 0).x : 0u;
    uint mirror_id = is_present(SURFACE_ID) && has_transforms ? texelFetch(surface_id, host_pixel(SURFACE_ID, guide_pixel(c.p)), 0).x : 0u;
    vec4 rows[3], thing = vec4(c.position + reflect(c.sight, c.normal) * seen.hit_distance, 1.0), to;
    Scenery before = rest;
    bool thing_moves = thing_id != 0u && instance_rows(thing_id, rows) && carried(rows, thing, to);
    if (thing_moves) thing = to;
    bad.transform = thing_id != 0u && !thing_moves;
    if (has_motion) thing.xyz += motion;
    thing_moves = thing_moves || has_motion;
    vec3 normal = c.normal;
    bool mirror_moves = mirror_id != 0u && instance_rows(mirror_id, rows) && carried(rows, vec4(c.position, 1.0), to);
    if (mirror_moves) {
        vec3 sight = normalize(turned(rows, c.sight)), across = turned(rows, curvature.across);
        across = normalize(across - dot(across, sight) * sight);
        before.mirror = MirrorBefore(to.xyz, sight, cross(sight, across), across);
        normal = normalize(turned(rows, c.normal));
    }
    vec3 way = reflect(thing.xyz - before.mirror.position, normal);
    before.image = vec3(dot(way, before.mirror.along), dot(way, before.mirror.across), dot(way, before.mirror.sight));
    before.thing = thing.xyz;
    before.followed = thing_moves;
    // Behind the mirror there was nothing to be seen in it; a transform that makes no turn of axes has no such place either.
    bool usable = (thing_moves || mirror_moves) && before.image.z > 0.0 && is_finite(before.image);
    return usable && lobe_radius(guide_depth(c.packed), seen) <= NARROW_LOBE ? before : rest;
}

#endif
