// The light of a pixel at one path, from its sample; with GLASS at one path for what is seen through glass and one for its reflection.
#ifndef PIXEL_LIGHTING_GLSL
#define PIXEL_LIGHTING_GLSL
#include "pixel_sample.glsl"
#include "path.glsl"
#include "camera.glsl"
#ifdef GLASS
#include "glass.glsl"
#endif

struct PixelLighting {
    vec3 direct;
    vec3 indirect;
    vec3 specular;  // the part of both that is specular
    Seen seen;      // in the surface
    vec3 moved;     // previous - current place of that, world space
};

// Previous less current place of a point that moves along with an instance; 0 for none.
vec3 moved_with(uint surface_id, vec3 point) {
    if (surface_id == 0u) return vec3(0.0);
    vec4 now[3] = load_instance(surface_id - 1u).world_from_object, before[3] = load_previous_world_from_object(surface_id - 1u);
    if (now == before) return vec3(0.0);
    mat3 object_from_world = inverse(transpose(mat3(now[0].xyz, now[1].xyz, now[2].xyz)));
    return transform_point(before, object_from_world * (point - vec3(now[0].w, now[1].w, now[2].w))) - point;
}

#ifdef GLASS

PixelLighting light_pixel(ivec2 pixel, PixelSample pixel_sample, uint lamps_left_out, inout Rng rng) {
    PixelLighting result = PixelLighting(vec3(0.0), vec3(0.0), vec3(0.0), NOTHING_SEEN, vec3(0.0));
    vec3 direction = normalize(ray_direction(frame.camera, vec2(pixel) + 0.5 + frame.jitter_epsilon_weight.xy));
    uint mode = frame.glass.x;
    float behind = 0.0;
    vec3 normal = vec3(0.0);
    for (uint layer = 0u; layer < 2u; layer++) {
        bool mirrored = layer == 1u;
        Sight sight = follow(frame.camera.eye.xyz, direction, mirrored, GLASS_LIMIT);
        bool glass = sight.meetings > 0u;
        if (mirrored && !glass) break;
        if (mode == GLASS_THROUGH && mirrored) break;
        if (mode == GLASS_REFLECTION && !mirrored) continue;
        bool nothing = sight.hit.instance == NO_INSTANCE;
        vec3 emitted = environment(sight.direction);
        if (!mirrored) behind = sight.to_glass;
        Lighting lighting = Lighting(vec3(0.0), vec3(0.0), vec3(0.0), NOTHING_SEEN);
        uint id = 0u;
        vec3 end = vec3(0.0);
        if (!nothing) {
            Surface s = surface_at(Visibility(sight.hit.instance, sight.hit.triangle, sight.hit.barycentrics), sight.from);
            emitted = s.emission;
            // What is seen through glass has no lamps apart.
            lighting = trace_path(s, sight.from, glass ? 0u : lamps_left_out, rng);
            id = s.surface_id;
            end = s.position;
            if (!mirrored) {
                behind = sight.distance + sight.hit.distance;
                normal = sight.turn * s.normal;
            }
        }
        // What has guides of its own shines by itself there; all else is light of the glass.
        bool own_guides = mode == GLASS_REFLECTION || (!mirrored && mode != GLASS_ITSELF);
        vec3 direct = sight.weight * (lighting.direct + (glass && !own_guides ? emitted : vec3(0.0)));
        vec3 indirect = sight.weight * lighting.indirect;
        result.direct += direct;
        result.indirect += indirect;
        if (!glass) {
            result.specular = lighting.specular;
            result.seen = lighting.seen;
        } else if (mode == GLASS_ITSELF) {
            Seen seen = Seen(nothing ? NOWHERE : sight.distance + sight.hit.distance - sight.to_glass, id);
            result.seen = seen_of(result.specular, result.seen, direct + indirect, seen);
            result.specular += direct + indirect;
        } else if (mirrored && mode == GLASS_LAYERS) {
            // As far behind the thing that is seen through the glass, or behind glass before the sky: that place the guides have.
            float distance = sight.distance + sight.hit.distance - behind;
            result.specular = direct + indirect;
            result.seen = Seen(nothing ? NOWHERE : max(distance, 0.001), 0u);
            // The denoiser mirrors it once more, at the surface that it knows.
            result.moved = mirror_at(normal) * (sight.turn * moved_with(id, end));
        }
    }
    return result;
}

#else

PixelLighting light_pixel(ivec2 pixel, PixelSample pixel_sample, uint lamps_left_out, inout Rng rng) {
    PixelLighting result = PixelLighting(vec3(0.0), vec3(0.0), vec3(0.0), NOTHING_SEEN, vec3(0.0));
    if (pixel_sample.visibility.instance == NO_INSTANCE) return result;
    Surface s = surface_at(pixel_sample.visibility, pixel_sample.eye);
    Lighting lighting = trace_path(s, pixel_sample.eye, lamps_left_out, rng);
    vec3 mirrored = reflect(normalize(s.position - pixel_sample.eye), s.normal);
    vec3 moved = moved_with(lighting.seen.surface_id, s.position + mirrored * min(lighting.seen.distance, 1.0e9));
    return PixelLighting(lighting.direct, lighting.indirect, lighting.specular, lighting.seen, moved);
}

#endif
#endif
