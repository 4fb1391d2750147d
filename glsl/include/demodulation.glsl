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

float albedo_luminance(vec3 divisor) { return luminance(min(divisor, 65504.0)); }

#endif
