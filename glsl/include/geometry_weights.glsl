// Edge stopping by depth and normal: [SVGF] eq. 3 and 4; with edge_falloff [PSVGF], depth-dependent edge functions. Twin: src/reference/geometry_weights.rs.
#ifndef GEOMETRY_WEIGHTS_GLSL
#define GEOMETRY_WEIGHTS_GLSL
#include "frame.glsl"
#include "guide.glsl"

// Relative to the depth: what counts as equal where the surface faces the camera.
const float DEPTH_EPSILON = 1e-3;

// Influence of the edge functions at the depth of the centre pixel: 1 near, towards 0 far away.
float edge_influence(float z) { return 1.0 / (1.0 + frame.edge_falloff * z); }

float depth_weight_exponent(float z, float z_tap, vec2 depth_gradient, vec2 offset) {
    return edge_influence(z) * abs(z - z_tap) / (frame.sigma_z * abs(dot(depth_gradient, offset)) + DEPTH_EPSILON * z);
}

// pow(0, 0) differs between devices, so a cosine that is not positive is decided here.
float normal_weight(vec3 n, vec3 n_tap, float z) {
    float cosine = dot(n, n_tap);
    return cosine > 0.0 ? pow(min(cosine, 1.0), frame.sigma_n * edge_influence(z)) : 0.0;
}

#endif
