// A homogeneous medium: what it scatters once towards the eye. One distance is chosen by transmittance, one light by its power.
// [Henyey and Greenstein 1941] for the phase function.
#ifndef MEDIUM_GLSL
#define MEDIUM_GLSL
#include "camera.glsl"
#include "lights.glsl"
#include "random.glsl"

// Tells the medium's random numbers from those of the surface in the same pixel.
const uint MEDIUM_SEED = 0x2545f491u;

struct Scattering {
    vec3 radiance;
    float linear_depth; // where; scene units along the view axis
};

// Per solid angle; `cosine` between the directions of the light before and after.
float phase(float cosine) {
    float g = frame.medium.y;
    float base = 1.0 + g * g - 2.0 * g * cosine;
    return (1.0 - g * g) / (4.0 * PI * base * sqrt(base));
}

// `linear_depth`: of the surface behind; 0: there is none.
Scattering scatter_once(vec2 pixel_position, float linear_depth, inout Rng rng) {
    vec3 ray = ray_direction(frame.camera, pixel_position);
    float unit = length(ray);
    float extinction = frame.medium.x;
    float reach = linear_depth > 0.0 ? linear_depth * unit : 1.0e30;
    // Distances that do not reach the surface, in proportion to transmittance [0, reach].
    float opacity = 1.0 - medium_transmittance(reach);
    float distance = -log(1.0 - random2(rng).x * opacity) / extinction;
    vec3 position = frame.camera.eye.xyz + ray * (distance / unit);
    Scattering result = Scattering(vec3(0.0), distance / unit);
    vec2 u = random2(rng);
    LightSample found;
    if (!sample_light(position, u, 0u, found)) return result;
    vec3 weight = frame.medium_scattering.rgb * (opacity / extinction);
    // It comes along -direction and goes on along -ray.
    float cosine = dot(found.direction, ray) / unit;
    vec3 radiance = weight * found.radiance * (phase(cosine) * medium_transmittance(found.distance));
    if (max(radiance.r, max(radiance.g, radiance.b)) <= 0.0) return result;
    if (!occluded(position, found.direction, found.distance * 0.9995)) result.radiance = radiance;
    return result;
}

#endif
