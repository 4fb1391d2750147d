// Reflectance of a coat or metal under light from everywhere, which divides specular radiance. Twin: src/reference/specular_albedo.rs.
// Source: [Karis 2014], "Physically Based Shading on Mobile", fit of the split sum of [Karis 2013].
#ifndef SPECULAR_ALBEDO_GLSL
#define SPECULAR_ALBEDO_GLSL
#include "view_position.glsl"
#include "guide.glsl"
#include "finite.glsl"

// `f0`: reflectance at normal incidence.
vec3 environment_reflectance(vec3 f0, float roughness, float view_cosine) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * view_cosine)) * r.x + r.y;
    vec2 scale_bias = vec2(-1.04, 1.04) * a + r.zw;
    return max(f0 * scale_bias.x + scale_bias.y, 0.0);
}

// Cosine between the normal of a pixel and its line of sight.
float view_cosine(ivec2 p, GuideBits packed) {
    return clamp(-dot(line_of_sight(p), guide_normal(packed)), 0.0, 1.0);
}

// 1 where the reflectance is not finite.
vec3 specular_albedo_from(vec3 f0, float roughness, ivec2 p, GuideBits packed) {
    if (!is_finite(f0)) return vec3(1.0);
    return environment_reflectance(f0, roughness, view_cosine(p, packed));
}

#endif
