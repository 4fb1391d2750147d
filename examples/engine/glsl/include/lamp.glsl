// One shadow ray to a lamp, and what it would give the surface if nothing were in the way.
#ifndef LAMP_GLSL
#define LAMP_GLSL
#include "pixel_sample.glsl"
#include "lights.glsl"
#include "random.glsl"

// Tells the lamps' random numbers from those of the path in the same pixel, and each lamp's from another's.
const uint LAMP_SEED = 0x68e31da4u;

layout(push_constant) uniform Push {
    uint lamp;
} push;

uint lamp_seed() { return LAMP_SEED ^ pcg_hash(push.lamp) * min(push.lamp, 1u); }

struct LampSample {
    vec3 visibility;          // 0 to 1; coloured behind panes
    float occluder_distance;  // scene units along the ray; 0: nothing is in the way
    uint occluder_id;         // its surface_id; 0: nothing is in the way
    vec3 unshadowed;          // radiance towards the eye, as it reaches it
};

// The ray goes to a point of the disc; light is reflected as from its middle, which has no noise. Not `traced`: there is no ray.
LampSample sample_visible_lamp(Surface s, bool traced, inout Rng rng) {
    Light light = load_light(frame.counts.z + push.lamp);
    bool is_sun = (floatBitsToUint(light.position_kind.w) & 3u) == LIGHT_SUN;
    vec2 u = random2(rng);
    LightSample to, middle;
    if (is_sun) {
        to = sample_sun(light, u);
        middle = LightSample(light.position_kind.xyz, NOWHERE, to.radiance, 0.0, 0u);
    } else {
        to = sample_point(light, ray_origin(s), u);
        middle = sample_point(light, s.position, vec2(0.0));
    }
    vec3 view = normalize(frame.camera.eye.xyz - s.position);
    float density;
    // Undoes the division by the probability of choosing this light.
    vec3 arriving = middle.radiance * light.edge2_probability.w * medium_transmittance(middle.distance);
    vec3 reflected = evaluate_bsdf(s, view, middle.direction, density).all * arriving;
    reflected *= medium_transmittance(distance(frame.camera.eye.xyz, s.position));
    if (!traced) return LampSample(vec3(1.0), 0.0, 0u, reflected);
    Shadow shadow = tinted_visibility(ray_origin(s), to.direction, min(to.distance * 0.9995, 3.0e37));
    return LampSample(shadow.tint, shadow.distance, shadow.surface_id, reflected);
}

#endif
