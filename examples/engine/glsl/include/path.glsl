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
    vec3 specular;       // the part of both that the coat or metal of the surface reflects
    float hit_distance;  // to what is seen in it, scene units; NOWHERE: beyond the scene
};

const float NOWHERE = 1.0e30;

// Distance of what two parts of the light come from: the one that counts more has more to say, and infinity says 0.
float mean_distance(vec3 light_a, float distance_a, vec3 light_b, float distance_b) {
    float a = luminance(light_a), b = luminance(light_b);
    return a + b > 0.0 ? (a + b) / max(a / distance_a + b / distance_b, 1.0 / NOWHERE) : distance_b;
}

// Weight of an emitter that a sampled direction has hit.
float hit_weight(Surface emitter, vec3 direction, float distance, float bsdf_density) {
    if (frame.counts.y == LIGHT_SAMPLING_LIGHTS) return 0.0;
    if (frame.counts.y == LIGHT_SAMPLING_BSDF) return 1.0;
    return bsdf_density / (bsdf_density + emitter_density(emitter, direction, distance));
}

// Light scattered at the end of the bounce towards its start.
vec3 second_vertex(Surface s, vec3 view, inout Rng rng) {
    s.roughness = max(s.roughness, REGULARISED_ROUGHNESS);
    float unused;
    vec3 radiance = next_event(s, view, random2(rng), false, NO_LIGHT, unused).all;
    vec2 u = random2(rng);
    if (frame.sky_zenith.a > 0.0) {
        Reflected weight;
        float density;
        vec3 direction = sample_bsdf(s, view, u, weight, density);
        if (luminance(weight.all) > 0.0 && !occluded(ray_origin(s), direction, NOWHERE))
            radiance += weight.all * environment(direction) * medium_transmittance(NOWHERE);
    }
    return radiance;
}

// As it leaves the surface towards the eye, but for what one light gives it directly.
Lighting surface_lighting(Surface s, vec3 eye, uint left_out, inout Rng rng) {
    Lighting result = Lighting(vec3(0.0), vec3(0.0), vec3(0.0), NOWHERE);
    vec3 view = normalize(eye - s.position);
    vec2 light_u = random2(rng);
    float light_distance = NOWHERE;
    Reflected reflected = Reflected(vec3(0.0), vec3(0.0));
    if (frame.counts.y != LIGHT_SAMPLING_BSDF)
        reflected = next_event(s, view, light_u, frame.counts.y == LIGHT_SAMPLING_MIS, left_out, light_distance);
    result.direct = reflected.all;
    result.specular = reflected.specular;
    Reflected weight;
    float density;
    vec3 direction = sample_bsdf(s, view, random2(rng), weight, density);
    if (light_distance > 0.0) result.hit_distance = light_distance;
    if (luminance(weight.all) <= 0.0) return result;
    vec3 origin = ray_origin(s);
    Hit hit = closest_hit(origin, direction);
    if (hit.instance == NO_INSTANCE) {
        vec3 sky = environment(direction) * medium_transmittance(NOWHERE);
        result.direct += weight.all * sky;
        result.specular += weight.specular * sky;
        result.hit_distance = mean_distance(reflected.specular, max(light_distance, 1.0e-6), weight.specular * sky, NOWHERE);
        return result;
    }
    weight = scaled(weight, vec3(medium_transmittance(hit.distance)));
    Surface second = surface_at(Visibility(hit.instance, hit.triangle, hit.barycentrics), origin);
    vec3 emitted = vec3(0.0);
    if (second.emission_weight > 0.0) emitted = second.emission * hit_weight(second, direction, hit.distance, density);
    vec3 scattered = second_vertex(second, -direction, rng);
    result.direct += weight.all * emitted;
    result.indirect = weight.all * scattered;
    vec3 specular = weight.specular * (emitted + scattered);
    result.specular += specular;
    result.hit_distance = mean_distance(reflected.specular, max(light_distance, 1.0e-6), specular, hit.distance);
    return result;
}

// As it reaches the eye.
Lighting trace_path(Surface s, vec3 eye, uint left_out, inout Rng rng) {
    Lighting lighting = surface_lighting(s, eye, left_out, rng);
    float seen = medium_transmittance(distance(eye, s.position));
    return Lighting(lighting.direct * seen, lighting.indirect * seen, lighting.specular * seen, lighting.hit_distance);
}

#endif
