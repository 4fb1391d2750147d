// What the light of a pixel is divided by: what the host says that its surface reflects. Twin: divisor_at in
// src/nodes/demodulate/twin.rs.
// Needs the bindings ALBEDO, SPECULAR_ALBEDO, SPECULAR_F0 and ROUGHNESS, which are optional, and two constants. SPECULAR: whether the second of two
// signals is specular light, with a divisor of its own. COAT: whether the first signal is, by ALBEDO.
#ifndef DIVISOR_GLSL
#define DIVISOR_GLSL
#include "demodulation.glsl"
#include "finite.glsl"
#include "frame.glsl"
#include "guide.glsl"
#include "optional.glsl"
#include "roughness.glsl"
#include "specular_albedo.glsl"
#include "viewport.glsl"

layout(set = 0, binding = ALBEDO) uniform texture2D albedo;
layout(set = 0, binding = SPECULAR_ALBEDO) uniform texture2D specular_albedo;
layout(set = 0, binding = SPECULAR_F0) uniform texture2D specular_f0;
layout(set = 0, binding = ROUGHNESS) uniform texture2D roughness;

vec3 coat_at(ivec2 traced) { return texelFetch(specular_albedo, host_pixel(SPECULAR_ALBEDO, traced), 0).rgb; }

// Of base and coat together, where one signal holds the light of both.
vec3 albedo_at(ivec2 traced) {
    vec3 base = texelFetch(albedo, host_pixel(ALBEDO, traced), 0).rgb;
    return !SPECULAR && is_present(SPECULAR_ALBEDO) ? base + coat_at(traced) : base;
}

float roughness_at(ivec2 traced) {
    return is_present(ROUGHNESS) ? roughness_of(stored_roughness(texelFetch(roughness, host_pixel(ROUGHNESS, traced), 0))) : 1.0;
}

// 1 without anything to divide by, and in the background. `second`: of the second signal, where that is specular light. `bad`: what the host gave is
// not finite.
vec3 divisor_at(ivec2 p, GuideBits packed, bool second, out bool bad) {
    bool has_albedo = is_present(second ? SPECULAR_ALBEDO : ALBEDO), from_f0 = !has_albedo && second == SPECULAR && is_present(SPECULAR_F0);
    bad = false;
    if ((!has_albedo && !from_f0) || guide_depth(packed) == 0.0) return vec3(1.0);
    ivec2 traced = guide_pixel(p);
    vec3 a;
    if (from_f0) a = texelFetch(specular_f0, host_pixel(SPECULAR_F0, traced), 0).rgb;
    else if (second) a = coat_at(traced);
    else a = albedo_at(traced);
    bad = !is_finite(a);
    if (from_f0) a = specular_albedo_from(a, roughness_at(traced), p, packed);
    return second || COAT ? coat_divisor_of(a) : divisor_of(a);
}

#endif
