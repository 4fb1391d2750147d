// One shadow ray to the sun, and what it would give the surface if nothing were in the way.
#ifndef SUN_GLSL
#define SUN_GLSL
#include "pixel_sample.glsl"
#include "lights.glsl"
#include "random.glsl"

// Tells the sun's random numbers from those of the path in the same pixel.
const uint SUN_SEED = 0x68e31da4u;

struct SunSample {
    float visibility;         // 0 or 1
    float occluder_distance;  // scene units along the ray; 0: nothing is in the way
    uint occluder_id;         // its surface_id; 0: nothing is in the way
    vec3 unshadowed;          // radiance towards the eye, as it reaches it
};

// The ray goes to a point of the disc; light is reflected as from its middle, which has no noise.
SunSample sample_visible_sun(Surface s, inout Rng rng) {
    Light light = load_light(frame.counts.z - 1u);
    vec3 view = normalize(frame.camera.eye.xyz - s.position);
    float density;
    vec3 reflected = evaluate_bsdf(s, view, light.position_kind.xyz, density).all * light.radiance_material.rgb;
    reflected *= medium_transmittance(1.0e30) * medium_transmittance(distance(frame.camera.eye.xyz, s.position));
    LightSample sun = sample_sun(light, random2(rng));
    Hit hit = closest_hit(ray_origin(s), sun.direction);
    bool lit = hit.instance == NO_INSTANCE;
    return SunSample(lit ? 1.0 : 0.0, lit ? 0.0 : hit.distance, lit ? 0u : hit.instance + 1u, reflected);
}

#endif
