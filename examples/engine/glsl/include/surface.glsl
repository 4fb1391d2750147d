// From a visibility sample (instance, triangle, barycentrics) to everything that shading needs to know of the point.
// The attributes are in object space, so a sample of an earlier frame gives the same point where it is now.
#ifndef SURFACE_GLSL
#define SURFACE_GLSL
#include "scene.glsl"

struct Visibility {
    uint instance; // NO_INSTANCE: background
    uint triangle;
    vec2 barycentrics;
};

struct Surface {
    vec3 position;
    vec3 geometric_normal; // both normals face the viewer
    vec3 normal;
    vec3 object_normal;
    vec3 diffuse;          // reflectance
    vec3 f0;               // specular reflectance at normal incidence
    float roughness;
    vec3 emission;
    float emission_weight; // selection weight per area when it is an emitter that faces the viewer; else 0
    uint surface_id;
};

vec3 transform_point(vec4 rows[3], vec3 p) {
    vec4 h = vec4(p, 1.0);
    return vec3(dot(rows[0], h), dot(rows[1], h), dot(rows[2], h));
}

// By the cofactors: right for any scale, and keeps the facing of mirrored instances. Not normalised.
vec3 transform_normal(vec4 rows[3], vec3 n) {
    vec3 r0 = rows[0].xyz, r1 = rows[1].xyz, r2 = rows[2].xyz;
    vec3 world = vec3(dot(cross(r1, r2), n), dot(cross(r2, r0), n), dot(cross(r0, r1), n));
    return dot(r0, cross(r1, r2)) < 0.0 ? -world : world;
}

vec3 texel(uvec4 header, ivec2 at) {
    ivec2 size = ivec2(header.yz);
    ivec2 wrapped = at - size * ivec2(floor(vec2(at) / vec2(size)));
    wrapped = clamp(wrapped, ivec2(0), size - 1);
    vec3 srgb = unpackUnorm4x8(texels[header.x + uint(wrapped.y * size.x + wrapped.x)]).rgb;
    return mix(srgb / 12.92, pow((srgb + 0.055) / 1.055, vec3(2.4)), greaterThan(srgb, vec3(0.04045)));
}

vec3 sample_texture(uint index, vec2 uv) {
    uvec4 header = texture_headers[index];
    // Clamped: coordinates from a file may be anything.
    vec2 at = clamp(uv, vec2(-4096.0), vec2(4096.0)) * vec2(header.yz) - 0.5;
    ivec2 corner = ivec2(floor(at));
    vec2 f = at - vec2(corner);
    vec3 low = mix(texel(header, corner), texel(header, corner + ivec2(1, 0)), f.x);
    vec3 high = mix(texel(header, corner + ivec2(0, 1)), texel(header, corner + ivec2(1, 1)), f.x);
    return mix(low, high, f.y);
}

vec3 base_color(Material material, vec2 uv) {
    vec3 color = material.base_color;
    if (material.base_color_texture == NO_TEXTURE) return color;
    if (material.base_color_texture == CHECKER_TEXTURE) {
        ivec2 square = ivec2(floor(uv * material.checker_scale));
        return ((square.x + square.y) & 1) == 0 ? color : material.checker_color;
    }
    return color * sample_texture(material.base_color_texture, uv);
}

vec3 emitted_radiance(Material material, vec2 uv) {
    vec3 radiance = material.emission;
    return material.emission_texture == NO_TEXTURE ? radiance : radiance * sample_texture(material.emission_texture, uv);
}

vec3 interpolate(vec3 a, vec3 b, vec3 c, vec2 barycentrics) {
    return a * (1.0 - barycentrics.x - barycentrics.y) + b * barycentrics.x + c * barycentrics.y;
}

vec3 object_position(TriangleAttributes t, vec2 barycentrics) {
    return interpolate(t.position_u[0].xyz, t.position_u[1].xyz, t.position_u[2].xyz, barycentrics);
}

void fill_material(inout Surface s, Material material, vec2 uv, bool emitting_side) {
    vec3 color = base_color(material, uv);
    s.roughness = clamp(material.roughness, 0.05, 1.0);
    s.diffuse = color * (1.0 - material.metallic);
    s.f0 = mix(vec3(material.specular), color, material.metallic);
    s.emission = vec3(0.0);
    s.emission_weight = 0.0;
    if (material.emission_weight > 0.0 && emitting_side) {
        s.emission = emitted_radiance(material, uv);
        s.emission_weight = material.emission_weight;
    }
}

// `viewer` is the point from which the surface is seen: the eye, or the previous vertex of the path.
Surface surface_at(Visibility v, vec3 viewer) {
    Instance instance = load_instance(v.instance);
    TriangleAttributes t = load_triangle(instance.first_triangle + v.triangle);
    Surface s;
    s.position = transform_point(instance.world_from_object, object_position(t, v.barycentrics));
    vec3 object_face = cross(t.position_u[1].xyz - t.position_u[0].xyz, t.position_u[2].xyz - t.position_u[0].xyz);
    vec3 face = normalize(transform_normal(instance.world_from_object, object_face));
    vec3 to_viewer = viewer - s.position;
    bool front = dot(face, to_viewer) >= 0.0;
    s.geometric_normal = front ? face : -face;
    vec3 object_normal = interpolate(t.normal_v[0].xyz, t.normal_v[1].xyz, t.normal_v[2].xyz, v.barycentrics);
    s.object_normal = object_normal / max(length(object_normal), 1.0e-20);
    vec3 normal = normalize(transform_normal(instance.world_from_object, s.object_normal));
    normal = dot(normal, s.geometric_normal) < 0.0 ? -normal : normal;
    // An interpolated normal may look away from the viewer at a silhouette: bend it back, or shading would be black there.
    vec3 view = normalize(to_viewer);
    float cosine = dot(normal, view);
    if (cosine < 0.02) normal = normalize(normal + view * (0.02 - cosine));
    s.normal = normal;
    vec2 uv = interpolate(
        vec3(t.position_u[0].w, t.normal_v[0].w, 0.0), vec3(t.position_u[1].w, t.normal_v[1].w, 0.0),
        vec3(t.position_u[2].w, t.normal_v[2].w, 0.0), v.barycentrics).xy;
    Material material = load_material(instance.material);
    fill_material(s, material, uv, front || material.two_sided_emission);
    s.surface_id = instance.surface_id;
    return s;
}

// Where a ray may leave the surface without meeting it again.
vec3 ray_origin(Surface s) { return s.position + s.geometric_normal * frame.jitter_epsilon_weight.z; }

#endif
