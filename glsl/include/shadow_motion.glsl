// Where the shadow on a surface lay in the previous frame: where the ray from the light past the occluder, as both were, meets the plane of the
// surface. Twin: src/reference/shadow_motion.rs.
// Source: [Zeng et al. 2021] 4.1. Deviation: the ray goes to the middle of the light, so it holds for lit pixels beside a shadow, too.
// Needs occluder_distance_of(light, pixel), occluder_motion_of, has_occluder_motion(light) and occluder_id_of, and instance_transforms at
// the binding INSTANCE_TRANSFORMS.
#ifndef SHADOW_MOTION_GLSL
#define SHADOW_MOTION_GLSL
#include "finite.glsl"
#include "frame.glsl"
#include "instance_transform.glsl"
#include "surface_motion.glsl"
#include "view_position.glsl"

// Of a ray to a plane, cosine: where it is smaller, a shadow has no place.
const float GRAZING = 1e-3;

// A surface of this frame, and its plane in the previous one.
struct Receiver {
    vec3 position;
    vec3 position_before;
    vec3 normal_before;
};

// `position`: of the surface in the previous frame, pixels; centres are whole numbers.
Receiver receiver_at(ivec2 p, float linear_depth, SurfaceMotion m, vec2 position) {
    return Receiver(world_position(p, linear_depth), previous_surface(position, linear_depth * (1.0 + m.depth_ratio)), m.previous_normal);
}

// What the shadow ray of a pixel met, carried to the previous frame by the host's motion, else by its instance. False: it stood still.
bool occluder_before(const int light, ivec2 q, vec3 occluder, out vec3 before) {
    before = occluder;
    vec3 motion = occluder_motion_of(light, q);
    if (has_occluder_motion(light) && is_finite(motion)) {
        before += motion;
        return motion != vec3(0.0);
    }
    vec4 rows[3], to;
    uint id = occluder_id_of(light, q);
    if (id == 0u || !instance_rows(id, rows) || !carried(rows, vec4(occluder, 1.0), to)) return false;
    before = to.xyz;
    return before != occluder;
}

// The place of the shadow of the occluder that the ray of the pixel q met. False: neither it nor the light moved, or there was
// no shadow.
bool shadow_before(Receiver surface, const int light, ivec2 q, out vec3 shadow) {
    shadow = surface.position_before;
    vec4 to_light = frame.lights[light], to_light_before = frame.previous_lights[light];
    if (to_light == vec4(0.0)) return false;
    vec3 occluder = surface.position + occluder_distance_of(light, q) * normalize(to_light.xyz - to_light.w * surface.position), before;
    if (!occluder_before(light, q, occluder, before) && to_light == to_light_before) return false;
    vec3 ray = normalize(to_light_before.w * before - to_light_before.xyz);
    float cosine = dot(ray, surface.normal_before), way = dot(surface.position_before - before, surface.normal_before) / cosine;
    shadow = before + way * ray;
    return abs(cosine) > GRAZING && way >= 0.0 && is_finite(shadow);
}

#endif
