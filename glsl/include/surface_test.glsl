// What the previous frame must show where a surface was. Twin: Reprojected in src/nodes/temporal_accumulation/twin.rs.
// Needs `float depth_tolerance` and `float normal_tolerance` in the shader's block `push`.
#ifndef SURFACE_TEST_GLSL
#define SURFACE_TEST_GLSL
#include "frame.glsl"
#include "luminance_history.glsl"
#include "surface_motion.glsl"

// Below this sum of bilinear weights a reprojection rests on next to nothing.
const float SMALLEST_WEIGHT_SUM = 0.01;

struct Expected {
    float depth;
    float depth_tolerance;
    vec2 gradient;  // of depth, scene units per pixel
    vec3 normal;
    float normal_tolerance;
    uint id8;
    bool is_apart;
};

Expected expected_surface(GuideBits packed, SurfaceMotion m, vec2 gradient, vec3 normal) {
    float previous_z = guide_depth(packed) * (1.0 + m.depth_ratio);
    float tolerance = push.depth_tolerance * previous_z + abs(gradient.x) + abs(gradient.y);
    return Expected(previous_z, tolerance, gradient, normal, push.normal_tolerance, guide_id(packed), guide_is_apart(packed));
}

// With factors of the tolerated differences of depth and of 1 - cosine of normals.
Expected with_tolerances(Expected expected, float depth, float normal) {
    expected.depth_tolerance += (depth - 1.0) * push.depth_tolerance * expected.depth;
    expected.normal_tolerance += (1.0 - normal) * (1.0 - push.normal_tolerance);
    return expected;
}

// Of a pixel of the previous frame without a look at its normal. `slack`: depth that the surface may have gained on the way to a tap that
// lies aside.
uint surface_refusal(GuideBits packed, Expected expected, float slack) {
    float z = guide_depth(packed);
    bool other = guide_id(packed) != expected.id8 || guide_is_apart(packed) != expected.is_apart;
    if (z == 0.0 || other) return REASON_ID;
    return !(abs(z - expected.depth) <= expected.depth_tolerance + slack) ? REASON_DEPTH : REASON_NONE;
}

uint normal_refusal(vec3 n, Expected expected) { return dot(n, expected.normal) < expected.normal_tolerance ? REASON_NORMAL : REASON_NONE; }

// Light turns with the surface, and the history of one that is thinner than a pixel creeps from face to face: it counts for less.
const float SMALLEST_LIKENESS = 0.02;
// Share of the tolerance beyond which normals that rounding sets apart are alike.
const float FULL_LIKENESS = 0.95;

float normal_likeness(vec3 n, Expected expected) {
    float spare = dot(n, expected.normal) - expected.normal_tolerance;
    return clamp(spare / (FULL_LIKENESS * max(1.0 - expected.normal_tolerance, 1e-3)), SMALLEST_LIKENESS, 1.0);
}

#endif
