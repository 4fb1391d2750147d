// Irradiance is radiance divided by albedo. [SVGF] 3. Twin: src/nodes/demodulate/twin.rs.
#ifndef DEMODULATION_GLSL
#define DEMODULATION_GLSL

#include "finite.glsl"
#include "luminance.glsl"

// The largest component below which an albedo divides no more than one that has this: little of the light of a dark surface is a reflection. Below
// half of it, it does not divide at all.
const float DARK_ALBEDO = 0.05;
// The least component that divides: at all, and as a share of the largest one.
const float LEAST_ALBEDO = 0.02;
const float SATURATED_ALBEDO = 0.1;

vec3 reflectance_of(vec3 albedo) {
    for (int i = 0; i < 3; ++i) albedo[i] = is_finite(albedo[i]) ? clamp(albedo[i], 0.0, 1.0) : 1.0;
    return albedo;
}

float largest_of(vec3 reflectance) { return max(reflectance.r, max(reflectance.g, reflectance.b)); }

bool is_black(vec3 reflectance) { return largest_of(reflectance) < 0.5 * DARK_ALBEDO; }

// Whether light is kept apart from all other: its albedo does not divide it, or is unknown.
bool is_apart(vec3 albedo) { return !is_finite(albedo) || is_black(reflectance_of(albedo)); }

vec3 limited(vec3 reflectance) { return max(reflectance, max(LEAST_ALBEDO, SATURATED_ALBEDO * largest_of(reflectance))); }

// The divisor of radiance, with which it is multiplied again.
vec3 divisor_of(vec3 albedo) {
    albedo = reflectance_of(albedo);
    return is_black(albedo) ? vec3(1.0) : limited(albedo * max(DARK_ALBEDO / largest_of(albedo), 1.0));
}

// The same of specular light, of which there is little where little is reflected: black divides as a dark albedo does.
vec3 coat_divisor_of(vec3 albedo) { return limited(max(reflectance_of(albedo), DARK_ALBEDO)); }

#endif
