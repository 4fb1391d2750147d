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
    vec3 specular;  // the part of both that the coat or metal of the surface reflects
    Seen seen;
};

// What two parts of the light come from: the one that counts more has more to say of the distance, infinity says 0; and it alone gives the id.
Seen seen_of(vec3 light_a, Seen seen_a, vec3 light_b, Seen seen_b) {
    float a = luminance(light_a), b = luminance(light_b);
    // A ray that met a surface which no light reached by chance still tells what is seen.
    if (!(b > 0.0) && (!(a > 0.0) || seen_b.distance < NOWHERE)) return seen_b;
    float distance = (a + b) / max(a / seen_a.distance + b / seen_b.distance, 1.0 / NOWHERE);
    return Seen(distance, a > b ? seen_a.surface_id : seen_b.surface_id);
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
    Seen unused;
    vec3 radiance = next_event(s, view, random2(rng), false, 0u, unused).all;
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

// As it leaves the surface towards the eye, but for what the first lamps give it directly.
Lighting surface_lighting(Surface s, vec3 eye, uint lamps_left_out, inout Rng rng) {
    Lighting result = Lighting(vec3(0.0), vec3(0.0), vec3(0.0), NOTHING_SEEN);
    vec3 view = normalize(eye - s.position);
    vec2 light_u = random2(rng);
    Seen light = NOTHING_SEEN;
    Reflected reflected = Reflected(vec3(0.0), vec3(0.0));
    if (frame.counts.y != LIGHT_SAMPLING_BSDF)
        reflected = next_event(s, view, light_u, frame.counts.y == LIGHT_SAMPLING_MIS, lamps_left_out, light);
    result.direct = reflected.all;
    result.specular = reflected.specular;
    Reflected weight;
    float density;
    vec3 direction = sample_bsdf(s, view, random2(rng), weight, density);
    result.seen = light;
    if (luminance(weight.all) <= 0.0) return result;
    vec3 origin = ray_origin(s);
    Hit hit = closest_hit(origin, direction);
    if (hit.instance == NO_INSTANCE) {
        vec3 sky = environment(direction) * medium_transmittance(NOWHERE);
        result.direct += weight.all * sky;
        result.specular += weight.specular * sky;
        result.seen = seen_of(reflected.specular, light, weight.specular * sky, NOTHING_SEEN);
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
    result.seen = seen_of(reflected.specular, light, specular, Seen(hit.distance, second.surface_id));
    return result;
}

// As it reaches the eye.
Lighting trace_path(Surface s, vec3 eye, uint lamps_left_out, inout Rng rng) {
    Lighting lighting = surface_lighting(s, eye, lamps_left_out, rng);
    float seen = medium_transmittance(distance(eye, s.position));
    return Lighting(lighting.direct * seen, lighting.indirect * seen, lighting.specular * seen, lighting.seen);
}

#endif
