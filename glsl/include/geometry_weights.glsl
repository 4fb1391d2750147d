// Edge stopping by depth and normal: [SVGF] eq. 3 and 4; with edge_falloff [PSVGF], depth-dependent edge functions.
// Twin: src/reference/geometry_weights.rs. Needs `float sigma_n`, `float sigma_z` and `float edge_falloff` in the shader's block `push`.
#ifndef GEOMETRY_WEIGHTS_GLSL
#define GEOMETRY_WEIGHTS_GLSL
#include "frame.glsl"
#include "guide.glsl"

// Relative to the depth: what counts as equal where the surface faces the camera.
const float DEPTH_EPSILON = 1e-3;

// Influence of the edge functions at the depth of the centre pixel: 1 near, towards 0 far away.
float edge_influence(float z) { return 1.0 / (1.0 + push.edge_falloff * z); }

const float LOG2_E = 1.4426950;
// As a power of 2 it is 0 whatever is added to it.
const float NO_WEIGHT = -1.0e6;

// Of depth, in powers of 2 per unit of difference; the same on both sides of the centre.
float depth_sharpness(float z, vec2 depth_gradient, vec2 offset) {
    return LOG2_E / (push.sigma_z * abs(dot(depth_gradient, offset)) + DEPTH_EPSILON * z);
}

// log2(w_z * w_n): transcendentals are what a tap costs, so every tap takes one exp2 of this and of its luminance weight together, and a
// normal that is read needs no root: the cosine is squared. log2(0) differs between devices, so a cosine that is not positive is decided
// here.
float log2_geometry_weight(vec3 n, vec3 direction_tap, float z, float z_tap, float depth_sharpness) {
    float along = dot(n, direction_tap);
    float squared_cosine = min(along * along / dot(direction_tap, direction_tap), 1.0);
    float log2_normal = push.sigma_n > 0.0 ? 0.5 * push.sigma_n * log2(squared_cosine) : 0.0;
    float weight = edge_influence(z) * (log2_normal - abs(z - z_tap) * depth_sharpness);
    return along <= 0.0 && push.sigma_n > 0.0 ? NO_WEIGHT : weight;
}

#endif
