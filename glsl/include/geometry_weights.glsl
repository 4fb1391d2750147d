// Edge stopping by depth and normal: [SVGF] eq. 3 and 4.
// Deviation: w_n is exp(-sigma_n (1 - cos)), which is cos^sigma_n to the second order, and takes no logarithm.
// Twin: src/reference/geometry_weights.rs. Needs `float sigma_n` and `float sigma_z` in the shader's block `push`.
#ifndef GEOMETRY_WEIGHTS_GLSL
#define GEOMETRY_WEIGHTS_GLSL
#include "frame.glsl"
#include "guide.glsl"

// Relative to the depth: what counts as equal where the surface faces the camera.
const float DEPTH_EPSILON = 1e-3;

const float LOG2_E = 1.4426950;

// What the surface in the centre of a window is compared with, and how much less a tap weighs, in powers of 2.
struct EdgeCentre {
    float depth;
    float side;             // -1: kept apart, else 1
    vec3 normal;            // in steps
    vec2 gradient;          // of depth, scene units per pixel
    float normal_sharpness; // per squared step
};

EdgeCentre edge_centre(GuideBits packed) {
    EdgeCentre centre;
    centre.depth = guide_depth(packed);
    centre.side = guide_is_apart(packed) ? -1.0 : 1.0;
    centre.normal = guide_normal_steps(packed);
    centre.gradient = guide_gradient(packed);
    centre.normal_sharpness = LOG2_E * push.sigma_n * (0.5 / (NORMAL_STEPS * NORMAL_STEPS));
    return centre;
}

// Light that an albedo divides is not that which none divides: surfaces take from their like.
bool is_alike(EdgeCentre centre, GuideBits packed_tap) { return centre.side * guide_side(packed_tap) > 0.0; }

// Per unit of depth; the same on both sides of the centre.
float depth_sharpness(EdgeCentre centre, vec2 offset) {
    return LOG2_E / (push.sigma_z * abs(dot(centre.gradient, offset)) + DEPTH_EPSILON * centre.depth);
}

// log2(w_z * w_n): transcendentals are what a tap costs, so every tap takes one exp2 of this and of its luminance weight together, and
// normals are compared by their distance, which needs neither a root nor a logarithm.
float log2_edge_weight(EdgeCentre centre, GuideBits packed_tap, float depth_sharpness) {
    vec3 chord = centre.normal - guide_normal_steps(packed_tap);
    return -(dot(chord, chord) * centre.normal_sharpness + abs(centre.depth - guide_depth(packed_tap)) * depth_sharpness);
}

#endif
