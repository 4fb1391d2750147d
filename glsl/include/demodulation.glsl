// Irradiance is radiance divided by albedo. [SVGF] 3. Twin: src/nodes/demodulate/twin.rs.
#ifndef DEMODULATION_GLSL
#define DEMODULATION_GLSL

#include "finite.glsl"
#include "luminance.glsl"

// The largest component below which an albedo divides less and less: light from a black surface is not what it reflects.
const float DARK_ALBEDO = 0.05;
// The least component that divides: at all, and as a share of the largest one.
const float LEAST_ALBEDO = 0.02;
const float SATURATED_ALBEDO = 0.1;

vec3 reflectance_of(vec3 albedo) {
    for (int i = 0; i < 3; ++i) albedo[i] = is_finite(albedo[i]) ? clamp(albedo[i], 0.0, 1.0) : 1.0;
    return albedo;
}

// How little an albedo divides: 1 where it is black.
float darkness_of(vec3 reflectance) {
    return 1.0 - min(max(reflectance.r, max(reflectance.g, reflectance.b)) / DARK_ALBEDO, 1.0);
}

// Whether light is kept apart from all other: its albedo divides next to nothing, or is unknown.
bool is_apart(vec3 albedo) { return !is_finite(albedo) || darkness_of(reflectance_of(albedo)) > 0.5; }

// The divisor of radiance, with which it is multiplied again.
vec3 divisor_of(vec3 albedo) {
    albedo = reflectance_of(albedo);
    float largest = max(albedo.r, max(albedo.g, albedo.b)), darkness = darkness_of(albedo);
    return mix(max(albedo, max(LEAST_ALBEDO, SATURATED_ALBEDO * largest)), vec3(1.0), darkness * darkness);
}

#endif
