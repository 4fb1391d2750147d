// Reflectance of a coat or metal under light from everywhere, which divides specular radiance. Twin: src/reference/specular_albedo.rs.
// Source: [Karis 2014], "Physically Based Shading on Mobile", fit of the split sum of [Karis 2013].
// Needs the constant ROUGHNESS, the binding of the host's roughness.
#ifndef SPECULAR_ALBEDO_GLSL
#define SPECULAR_ALBEDO_GLSL
#include "view_position.glsl"
#include "guide.glsl"
#include "finite.glsl"
#include "demodulation.glsl"
#include "optional.glsl"
#include "roughness.glsl"

layout(set = 0, binding = ROUGHNESS) uniform texture2D roughness;

float roughness_at(ivec2 traced) {
    return is_present(ROUGHNESS) ? roughness_of(stored_roughness(texelFetch(roughness, host_pixel(ROUGHNESS, traced), 0))) : 1.0;
}

// `f0`: reflectance at normal incidence.
vec3 environment_reflectance(vec3 f0, float rough, float view_cosine) {
    vec4 r = rough * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * view_cosine)) * r.x + r.y;
    vec2 scale_bias = vec2(-1.04, 1.04) * a + r.zw;
    return max(f0 * scale_bias.x + scale_bias.y, 0.0);
}

// Cosine between the normal of a pixel and its line of sight.
float view_cosine(ivec2 p, GuideBits packed) {
    return clamp(-dot(line_of_sight(p), guide_normal(packed)), 0.0, 1.0);
}

// 1 where the reflectance is not finite.
vec3 specular_albedo_from(vec3 f0, ivec2 p, GuideBits packed) {
    if (!is_finite(f0)) return vec3(1.0);
    return environment_reflectance(f0, roughness_at(guide_pixel(p)), view_cosine(p, packed));
}

// The divisor of a pixel: from an albedo, or else from the reflectance at normal incidence; 1 without either, and in the background.
vec3 divisor_from(ivec2 p, GuideBits packed, bool has_albedo, uint albedo_binding, texture2D albedo, bool has_f0, uint f0_binding, texture2D f0) {
    if (guide_depth(packed) == 0.0) return vec3(1.0);
    if (has_albedo) return divisor_of(texelFetch(albedo, host_pixel(albedo_binding, guide_pixel(p)), 0).rgb);
    return has_f0 ? divisor_of(specular_albedo_from(texelFetch(f0, host_pixel(f0_binding, guide_pixel(p)), 0).rgb, p, packed)) : vec3(1.0);
}

#endif
