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

// log2(w_z * w_n): transcendentals are what a tap costs, so every tap takes one exp2 of this and of its luminance weight together.
// log2(0) differs between devices, so a cosine that is not positive is decided here.
float log2_geometry_weight(vec3 n, vec3 n_tap, float z, float z_tap, vec2 depth_gradient, vec2 offset) {
    float cosine = dot(n, n_tap);
    float depth_exponent = abs(z - z_tap) / (push.sigma_z * abs(dot(depth_gradient, offset)) + DEPTH_EPSILON * z);
    float log2_normal = push.sigma_n > 0.0 ? push.sigma_n * log2(min(cosine, 1.0)) : 0.0;
    float weight = edge_influence(z) * (log2_normal - LOG2_E * depth_exponent);
    return cosine <= 0.0 && push.sigma_n > 0.0 ? NO_WEIGHT : weight;
}

#endif
