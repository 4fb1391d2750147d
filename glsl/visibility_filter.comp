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
} push;

#include "frame.glsl"
#include "geometry_weights.glsl"
#include "packed_image.glsl"
#include "visibility.glsl"

PACKED_IMAGE(1, guide);
layout(set = 0, binding = 2) uniform utexture2D depth_gradient;
// The first level has it as filter_in as well: in one layout.
PACKED_IMAGE_32(3, visibility_history);
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
// Along an edge light changes little: variance of the kernel in that direction at least, squared steps of the level, on the first levels; and
// how far a tap may lie aside for that, squared pixels.
const float ALONG = 1.0;
const float ASIDE = 0.1;
const uint ALONG_LEVELS = 2u;

// Visibility and its deviation.
vec2 estimate_at(ivec2 p) {
    uint packed = packed_at(filter_in, p).x;
    if (!FIRST) return unpackHalf2x16(packed);
    VisibilityHistory h = unpack_visibility_history(packed);
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

// Exponent of 2 by geometry of a tap that exists, else what makes its weight 0.
float geometry_at(EdgeCentre centre, ivec2 p, ivec2 offset) {
    ivec2 q = p + offset, tap = nearest_inside(q);
    GuideBits packed = GuideBits(packed_at(guide, tap));
    float weight = log2_edge_weight(centre, packed, depth_sharpness(centre, vec2(offset)));
    return q == tap && guide_depth(packed) != 0.0 ? weight : -1e30;
}

// The way into the light, of unit length; 0 where there is none.
vec2 towards_light(EdgeCentre centre, ivec2 p, float visibility) {
    vec2 slope = vec2(0.0);
    [[dont_unroll]] for (int i = 0; i < 25; ++i) {
        ivec2 offset = ivec2(i % 5 - 2, i / 5 - 2);
        float weight = exp2(geometry_at(centre, p, offset << push.level));
        slope += weight * (estimate_at(nearest_inside(p + (offset << push.level))).x - visibility) * vec2(offset);
    }
    float squared = dot(slope, slope);
    return squared > 1e-6 ? slope * inversesqrt(squared) : vec2(0.0);
}

vec2 filtered(ivec2 p, GuideBits packed, vec2 estimate, vec2 size, float variance) {
    EdgeCentre centre = edge_centre(packed, unpack_depth_gradient(texelFetch(depth_gradient, p, 0).x));
    float longer = max(size.x, size.y), full = float(1 << (2 * push.level));
    vec2 light = push.level < ALONG_LEVELS ? towards_light(centre, p, estimate.x) : vec2(0.0);
    float sharpness = LOG2_E / (2.0 * max(variance, 1e-6) * longer * longer);
    float tolerance = LOG2_E / (push.visibility_sigma * estimate.y + VISIBILITY_EPSILON);
    vec2 sum = vec2(estimate.x, estimate.y * estimate.y);
    float weights = 1.0;
    [[dont_unroll]] for (int i = 0; i < 25; ++i) {
        ivec2 offset = ivec2(i % 5 - 2, i / 5 - 2) << push.level;
        vec2 other = estimate_at(nearest_inside(p + offset)), step = vec2(offset);
        float way = squared_distance(size, centre.gradient, step) * sharpness;
        if (light != vec2(0.0)) {
            float across = dot(step, light), along = dot(step, vec2(-light.y, light.x));
            float aside = min(squared_distance(size, centre.gradient, across * light) * sharpness, across * across * (LOG2_E / (2.0 * ASIDE)));
            way = min(way, aside + along * along * (LOG2_E / (2.0 * ALONG * full)));
        }
        float weight = geometry_at(centre, p, offset) - way - abs(other.x - estimate.x) * tolerance;
        weight = i != 12 ? exp2(weight) : 0.0;
        sum += vec2(weight * other.x, weight * weight * other.y * other.y);
        weights += weight;
    }
    return vec2(sum.x, sqrt(sum.y)) / weights;
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    GuideBits packed = GuideBits(packed_at(guide, p));
    vec2 estimate = estimate_at(p);
    vec2 size = pixel_size(guide_depth(packed));
    float distance = unpack_visibility_history(packed_at(visibility_history, p).x).occluder_distance;
    float deviation = push.penumbra_blur * push.light_radius * distance / max(size.x, size.y);
    float variance = share_of_level(min(deviation * deviation, 1e6));
    bool is_edge = push.level < ALONG_LEVELS && distance > 0.0;
    if (guide_depth(packed) != 0.0 && (variance > NARROW || is_edge)) estimate = filtered(p, packed, estimate, size, variance);
    store(p, estimate);
}
