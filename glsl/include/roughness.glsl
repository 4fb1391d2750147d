// Perceptual roughness from a host's image. Twin: src/reference/reflection.rs.
#ifndef ROUGHNESS_GLSL
#define ROUGHNESS_GLSL
#include "conventions.glsl"
#include "finite.glsl"

float stored_roughness(vec4 texel) { return texel[convention(ROUGHNESS_CHANNEL_SHIFT)]; }

// Where a host does not know it, as where it has none at all.
const float UNKNOWN_ROUGHNESS = -1.0;

bool is_roughness(float stored) { return is_finite(stored) && (stored == UNKNOWN_ROUGHNESS || stored >= 0.0 && stored <= 1.0); }

// What is not known or not finite counts as rough, which is filtered most.
float roughness_of(float stored) {
    float roughness = is_finite(stored) && stored != UNKNOWN_ROUGHNESS ? clamp(stored, 0.0, 1.0) : 1.0;
    return has_convention(ROUGHNESS_ALPHA) ? sqrt(roughness) : roughness;
}

#endif
