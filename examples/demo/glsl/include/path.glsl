// One light path from a primary surface: next event estimation there, one bounce, next event estimation at its end.
// Direct is light scattered once, indirect light scattered twice. The roughness of the second vertex is raised
// (path-space regularisation, [Kaplanyan and Dachsbacher 2013]), as SVGF's and A-SVGF's path tracers do.
#ifndef PATH_GLSL
#define PATH_GLSL
#include "lights.glsl"
#include "random.glsl"

const float REGULARISED_ROUGHNESS = 0.5;

struct Lighting {
    vec3 direct;
    vec3 indirect;
};

// Weight of an emitter that a sampled direction has hit.
float hit_weight(Surface emitter, vec3 direction, float distance, float bsdf_density) {
    if (frame.counts.y == LIGHT_SAMPLING_LIGHTS) return 0.0;
    if (frame.counts.y == LIGHT_SAMPLING_BSDF) return 1.0;
    return bsdf_density / (bsdf_density + emitter_density(emitter, direction, distance));
}

// Light scattered at the end of the bounce towards its start.
vec3 second_vertex(Surface s, vec3 view, inout Rng rng) {
    s.roughness = max(s.roughness, REGULARISED_ROUGHNESS);
    vec3 radiance = next_event(s, view, random2(rng), false, NO_LIGHT);
    vec2 u = random2(rng);
    if (frame.sky_zenith.a > 0.0) {
        vec3 weight;
        float density;
        vec3 direction = sample_bsdf(s, view, u, weight, density);
        if (luminance(weight) > 0.0 && !occluded(ray_origin(s), direction, 1.0e30)) radiance += weight * environment(direction) * medium_transmittance(1.0e30);
    }
    return radiance;
}

// As it leaves the surface towards the eye, but for what one light gives it directly.
Lighting surface_lighting(Surface s, vec3 eye, uint left_out, inout Rng rng) {
    Lighting result = Lighting(vec3(0.0), vec3(0.0));
    vec3 view = normalize(eye - s.position);
    vec2 light_u = random2(rng);
    if (frame.counts.y != LIGHT_SAMPLING_BSDF) result.direct = next_event(s, view, light_u, frame.counts.y == LIGHT_SAMPLING_MIS, left_out);
    vec3 weight;
    float density;
    vec3 direction = sample_bsdf(s, view, random2(rng), weight, density);
    if (luminance(weight) <= 0.0) return result;
    vec3 origin = ray_origin(s);
    Hit hit = closest_hit(origin, direction);
    if (hit.instance == NO_INSTANCE) {
        result.direct += weight * environment(direction) * medium_transmittance(1.0e30);
        return result;
    }
    weight *= medium_transmittance(hit.distance);
    Surface second = surface_at(Visibility(hit.instance, hit.triangle, hit.barycentrics), origin);
    if (second.emission_weight > 0.0)
        result.direct += weight * second.emission * hit_weight(second, direction, hit.distance, density);
    result.indirect = weight * second_vertex(second, -direction, rng);
    return result;
}

// As it reaches the eye.
Lighting trace_path(Surface s, vec3 eye, uint left_out, inout Rng rng) {
    Lighting lighting = surface_lighting(s, eye, left_out, rng);
    float seen = medium_transmittance(distance(eye, s.position));
    return Lighting(lighting.direct * seen, lighting.indirect * seen);
}

#endif
