// Next event estimation: one light is chosen by its power, one point on it by area, and one shadow ray is sent to it.
// Emissive triangles may also be hit by a sampled direction; the balance heuristic weighs the two [Veach 1997].
#ifndef LIGHTS_GLSL
#define LIGHTS_GLSL
#include "bsdf.glsl"
#include "bvh.glsl"

struct LightSample {
    vec3 direction; // to the light
    float distance;
    vec3 radiance;  // divided by the density in solid angle (by the probability of choosing it for a point or a sun)
    float density;  // solid angle; 0: only light sampling finds it
    uint surface_id;  // 0: no mesh
};

// What is seen in a surface.
struct Seen {
    float distance;  // scene units; NOWHERE: beyond the scene
    uint surface_id; // 0: nothing, or no mesh
};

const float NOWHERE = 1.0e30;
const Seen NOTHING_SEEN = Seen(NOWHERE, 0u);

uint select_light(inout float u) {
    uint low = 0u;
    uint high = frame.counts.x - 1u;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (u < fetch_floats(lights, 4u * middle + 1u).w) high = middle; else low = middle + 1u;
    }
    float upper = fetch_floats(lights, 4u * low + 1u).w;
    float probability = fetch_floats(lights, 4u * low + 2u).w;
    u = clamp((u - (upper - probability)) / max(probability, 1.0e-12), 0.0, 0.99999994);
    return low;
}

vec2 light_uv(Light light, vec2 barycentrics) {
    uint triangle = floatBitsToUint(light.position_kind.w) >> 2u;
    TriangleAttributes t = load_triangle(triangle);
    vec2 a = vec2(t.position_u[0].w, t.normal_v[0].w);
    return a + barycentrics.x * (vec2(t.position_u[1].w, t.normal_v[1].w) - a) + barycentrics.y * (vec2(t.position_u[2].w, t.normal_v[2].w) - a);
}

LightSample sample_triangle(Light light, vec3 from, vec2 u) {
    float root = sqrt(u.x);
    vec2 barycentrics = vec2(1.0 - root, u.y * root);
    vec3 edge1 = light.edge1_cdf.xyz;
    vec3 edge2 = light.edge2_probability.xyz;
    vec3 offset = light.position_kind.xyz + barycentrics.x * edge1 + barycentrics.y * edge2 - from;
    vec3 face = cross(edge1, edge2);
    float twice_area = length(face);
    float distance2 = dot(offset, offset);
    float distance = sqrt(distance2);
    vec3 direction = offset / max(distance, 1.0e-12);
    Material material = load_material(floatBitsToUint(light.radiance_material.w));
    float cosine = -light.radiance_material.x * dot(face, direction) / max(twice_area, 1.0e-20);
    cosine = material.two_sided_emission ? abs(cosine) : cosine;
    if (cosine <= 1.0e-5 || distance2 <= 0.0) return LightSample(direction, 0.0, vec3(0.0), 0.0, 0u);
    float density = light.edge2_probability.w * distance2 / (cosine * 0.5 * twice_area);
    vec3 radiance = material.emission;
    if (material.emission_texture != NO_TEXTURE) radiance = emitted_radiance(material, light_uv(light, barycentrics));
    return LightSample(direction, distance, radiance / density, density, floatBitsToUint(light.radiance_material.y));
}

LightSample sample_sun(Light light, vec2 u) {
    float r = sqrt(u.x) * light.edge2_probability.x;
    float phi = 2.0 * PI * u.y;
    vec3 direction = normalize(basis(light.position_kind.xyz) * vec3(r * cos(phi), r * sin(phi), sqrt(1.0 - r * r)));
    return LightSample(direction, NOWHERE, light.radiance_material.rgb / light.edge2_probability.w, 0.0, 0u);
}

// A disc that faces the surface; it shines as a point in its middle does.
LightSample sample_point(Light light, vec3 from, vec2 u) {
    vec3 middle = light.position_kind.xyz - from;
    float distance2 = max(dot(middle, middle), 1.0e-6);
    float r = sqrt(u.x) * light.edge2_probability.z;
    float phi = 2.0 * PI * u.y;
    vec3 direction = middle * inversesqrt(distance2);
    vec3 offset = middle + basis(direction) * vec3(r * cos(phi), r * sin(phi), 0.0);
    float distance = length(offset);
    vec2 cone = light.edge2_probability.xy;
    float spot = clamp((-dot(direction, light.edge1_cdf.xyz) - cone.y) / max(cone.x - cone.y, 1.0e-4), 0.0, 1.0);
    float falloff = cone.y <= -1.0 ? 1.0 : spot * spot;
    return LightSample(offset / max(distance, 1.0e-6), distance, light.radiance_material.rgb * (falloff / distance2 / light.edge2_probability.w), 0.0, 0u);
}

// Density in solid angle with which light sampling finds an emitter that a sampled direction has hit.
float emitter_density(Surface emitter, vec3 direction, float distance) {
    float cosine = max(dot(emitter.geometric_normal, -direction), 1.0e-5);
    return emitter.emission_weight / frame.jitter_epsilon_weight.w * distance * distance / cosine;
}

// One light as it is seen without anything in the way. False: there is none, it faces away, or it is one of the first lamps, which are left out.
bool sample_light(vec3 from, vec2 u, uint lamps_left_out, out LightSample found) {
    if (frame.counts.x == 0u) return false;
    uint index = select_light(u.x);
    if (index - frame.counts.z < lamps_left_out) return false;
    Light light = load_light(index);
    uint kind = floatBitsToUint(light.position_kind.w) & 3u;
    if (kind == LIGHT_TRIANGLE) found = sample_triangle(light, from, u);
    else if (kind == LIGHT_SUN) found = sample_sun(light, u);
    else found = sample_point(light, from, u);
    return found.distance > 0.0;
}

// What a shadow ray meets.
struct Shadow {
    vec3 tint;        // share of light that comes through, of each colour
    float distance;   // of the thing that takes most of it, scene units; 0: nothing does
    uint surface_id;  // of that thing
};

const uint PANES = 4u;

// Panes colour light; it passes through bodies of glass as if they were not there.
Shadow tinted_visibility(vec3 origin, vec3 direction, float distance) {
    Shadow shadow = Shadow(vec3(1.0), 0.0, 0u);
    float from = 0.0;
    for (uint i = 0u; i <= PANES; i++) {
        Hit hit = closest_hit_or_glass(origin + direction * from, direction, distance - from);
        if (hit.instance == NO_INSTANCE) break;
        from += hit.distance;
        bool opaque = hit.mask < MASK_PANE || i == PANES;
        if (opaque || (shadow.surface_id == 0u && hit.mask == MASK_PANE)) {
            shadow.distance = from;
            shadow.surface_id = hit.instance + 1u;
        }
        if (opaque) {
            shadow.tint = vec3(0.0);
            break;
        }
        if (hit.mask == MASK_PANE) shadow.tint *= load_material(load_instance(hit.instance).material).base_color;
        from += frame.jitter_epsilon_weight.z;
    }
    return shadow;
}

// Reflected radiance from one sampled light, and what that is. `weighted`: sampled directions find area lights, too.
Reflected next_event(Surface s, vec3 view, vec2 u, bool weighted, uint lamps_left_out, out Seen light) {
    const Reflected nothing = Reflected(vec3(0.0), vec3(0.0));
    vec3 origin = ray_origin(s);
    LightSample found;
    light = NOTHING_SEEN;
    if (!sample_light(origin, u, lamps_left_out, found)) return nothing;
    light = Seen(found.distance, found.surface_id);
    float density;
    vec3 arriving = found.radiance * medium_transmittance(found.distance);
    Reflected reflected = scaled(evaluate_bsdf(s, view, found.direction, density), arriving);
    if (weighted && found.density > 0.0) reflected = scaled(reflected, vec3(found.density / (found.density + density)));
    if (max(reflected.all.r, max(reflected.all.g, reflected.all.b)) <= 0.0) return nothing;
#ifdef GLASS
    return scaled(reflected, tinted_visibility(origin, found.direction, found.distance * 0.9995).tint);
#else
    if (occluded(origin, found.direction, found.distance * 0.9995)) return nothing;
    return reflected;
#endif
}

#endif
