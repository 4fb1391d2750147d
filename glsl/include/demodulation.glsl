// Irradiance is radiance divided by albedo; the floor keeps the round trip exact where the albedo is black. [SVGF] 3.
#ifndef DEMODULATION_GLSL
#define DEMODULATION_GLSL

#include "finite.glsl"
#include "luminance.glsl"

const float ALBEDO_EPSILON = 0.01;

// The divisor of radiance, with which it is multiplied again.
vec3 divisor_of(vec3 albedo) {
    for (int i = 0; i < 3; ++i) albedo[i] = is_finite(albedo[i]) ? max(albedo[i], ALBEDO_EPSILON) : 1.0;
    return albedo;
}

// For temporal gradients. What is not finite is black, as it is for the filters.
float radiance_luminance(vec3 radiance) { return is_finite(radiance) ? luminance(storable(radiance)) : 0.0; }

float albedo_luminance(vec3 divisor) { return luminance(min(divisor, 65504.0)); }

#endif
