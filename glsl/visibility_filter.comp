#version 450
// One level of the filter of a visibility: along the surface, no wider than its penumbra, guided by variance.
// Source: [Mehta et al. 2012], filter width from the penumbra; levels and weights as [SVGF] 4.3. Ours: how the levels share the width.
// In:  guide, depth_gradient, visibility_history (distance of the occluder; with FIRST the visibility as well), filter_in: half2(visibility,
//      deviation of it). Out: filter_out: the same, or with LAST denoised_visibility.
// variants: LAST=0 LAST=1
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
// Of storage images in packed_image.glsl.
#define SIGNALS 1

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const bool FIRST = false;

layout(push_constant) uniform Push {
    uint level;
    float light_radius;
    float penumbra_blur;
    float visibility_sigma;
    float sigma_n;
    float sigma_z;
    float edge_falloff;
} push;

#include "frame.glsl"
#include "geometry_weights.glsl"
#include "packed_image.glsl"
#include "visibility.glsl"

PACKED_IMAGE(1, guide);
layout(set = 0, binding = 2) uniform utexture2D depth_gradient;
layout(set = 0, binding = 3) uniform utexture2D visibility_history;
PACKED_IMAGE_32(4, filter_in);
#if LAST
layout(set = 0, binding = 5, r32f) uniform writeonly image2D denoised_visibility;
#else
layout(set = 0, binding = 5, r32ui) uniform writeonly uimage2D filter_out;
#endif

// Visibility that is always tolerated.
const float VISIBILITY_EPSILON = 0.01;
// Squared pixels: a narrower filter changes nothing.
const float NARROW = 0.02;

// Visibility and its deviation.
vec2 estimate_at(ivec2 p) {
    uint packed = packed_at(filter_in, p).x;
    if (!FIRST) return unpackHalf2x16(packed);
    VisibilityHistory h = unpack_visibility(packed);
    // Of a mean with the smallest weight 1/N.
    return vec2(h.mean, h.deviation * inversesqrt(2.0 * h.history_length - 1.0));
}

void store(ivec2 p, vec2 estimate) {
#if LAST
    imageStore(denoised_visibility, p, vec4(estimate.x));
#else
    imageStore(filter_out, p, uvec4(packHalf2x16(estimate)));
#endif
}

// The variance that this level adds to the kernel, squared pixels. A level is good for 4^level, and finer ones come first.
float share_of_level(float wanted) {
    float full = float(1 << (2 * push.level));
    return clamp(wanted - (full - 1.0) / 3.0, 0.0, full);
}

vec2 filtered(ivec2 p, uvec4 packed, vec2 estimate, vec2 size, float variance) {
    EdgeCentre centre = edge_centre(packed, unpackHalf2x16(texelFetch(depth_gradient, p, 0).x));
    float longer = max(size.x, size.y);
    float sharpness = LOG2_E / (2.0 * variance * longer * longer);
    float tolerance = LOG2_E / (push.visibility_sigma * estimate.y + VISIBILITY_EPSILON);
    vec2 sum = vec2(estimate.x, estimate.y * estimate.y);
    float weights = 1.0;
    [[dont_unroll]] for (int i = 0; i < 25; ++i) {
        ivec2 offset = ivec2(i % 5 - 2, i / 5 - 2) << push.level, q = p + offset, tap = nearest_inside(q);
        uvec4 packed_q = packed_at(guide, tap);
        vec2 other = estimate_at(tap);
        float weight = log2_edge_weight(centre, packed_q, depth_sharpness(centre, vec2(offset)));
        weight -= squared_distance(size, centre.gradient, vec2(offset)) * sharpness + abs(other.x - estimate.x) * tolerance;
        weight = q == tap && i != 12 && unpack_depth(packed_q) != 0.0 ? exp2(weight) : 0.0;
        sum += vec2(weight * other.x, weight * weight * other.y * other.y);
        weights += weight;
    }
    return vec2(sum.x, sqrt(sum.y)) / weights;
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    uvec4 packed = packed_at(guide, p);
    vec2 estimate = estimate_at(p);
    vec2 size = pixel_size(unpack_depth(packed));
    float distance = unpack_visibility(texelFetch(visibility_history, p, 0).x).occluder_distance;
    float deviation = push.penumbra_blur * push.light_radius * distance / max(size.x, size.y);
    float variance = share_of_level(min(deviation * deviation, 1e6));
    if (unpack_depth(packed) != 0.0 && variance > NARROW) estimate = filtered(p, packed, estimate, size, variance);
    store(p, estimate);
}
