#version 450
// Brings light that was filtered at fewer pixels to each pixel of the guides: joint bilateral, by planes and normals. An invocation has a
// pixel of light, and writes the rendered pixels that it stands for: their taps are the same.
// Source: [Kopf 2007], joint bilateral upsampling; the weights are ours.
// In:  rendered_guide of every pixel; guide of the pixels with light; filtered irradiance per signal, or with NUMBER one visibility.
// Out: upsampled, the same for every pixel.
// variants: NUMBER=0 NUMBER=1
// optional: filtered_1, upsampled_1
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(push_constant) uniform Push {
    uint present;
} push;

#define GUIDE_PIXELS
#include "frame.glsl"
#include "luminance.glsl"
#include "guide.glsl"
#include "optional.glsl"
#include "view_position.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint FILTERED_1 = 4u;
const uint UPSAMPLED_1 = 6u;

layout(set = 0, binding = 1) uniform utexture2D rendered_guide;
layout(set = 0, binding = 2) uniform utexture2D guide;
layout(set = 0, binding = 3) uniform texture2D filtered_0;
layout(set = 0, binding = FILTERED_1) uniform texture2D filtered_1;
#if NUMBER
#define FORMAT r32f
#else
#define FORMAT rgba16f
#endif
layout(set = 0, binding = 5, FORMAT) uniform writeonly image2D upsampled_0;
layout(set = 0, binding = UPSAMPLED_1, FORMAT) uniform writeonly image2D upsampled_1;

const float LOG2_E = 1.4426950;
// Of the Gauss, 1/(2σ²) with σ = 0.8 pixels of light.
const float SHARPNESS = LOG2_E * 0.78125;
// Of 1 - cos of two normals, which is half of their squared distance, in steps.
const float NORMAL_SHARPNESS = LOG2_E * 4.0 * 0.5 / (NORMAL_STEPS * NORMAL_STEPS);
// Distance from the plane of a surface, in shares of its depth, at which a weight is down to 1/e.
const float PLANE_TOLERANCE = 0.02;
// Of taps that lie on other surfaces, and of those that have no light of this surface's kind: so there always is some light.
const float LEAST_ALIKE = 1e-3;
const float LEAST = 1e-6;

// A rendered pixel of the cell that a pixel of light stands for, and its sums.
struct Centre {
    vec3 steps;     // normal, in steps
    vec3 normal;    // view space
    vec3 position;  // view space
    float depth;    // 0: background
    float side;     // -1: dark, else 1
    float plane_sharpness;
    // From it to the middle of the pixel of light, in pixels of light: there lies its filtered light, since the history averaged over
    // offsets and jitter, and not where this frame's was traced.
    vec2 offset;
    vec4 sum_0;     // rgb, weight
    vec3 sum_1;
};

const int CELL = 4;

Centre centre_at(ivec2 p, vec2 middle) {
    GuideBits packed = GuideBits(texelFetch(rendered_guide, p, 0));
    Centre c;
    c.depth = guide_depth(packed);
    c.side = guide_is_dark(packed) ? -1.0 : 1.0;
    c.steps = guide_normal_steps(packed);
    c.normal = (c.steps / NORMAL_STEPS - 1.0) * mat3(frame.world_from_view);
    c.position = view_position(p, c.depth);
    c.plane_sharpness = c.depth == 0.0 ? 0.0 : LOG2_E / (PLANE_TOLERANCE * c.depth);
    c.offset = middle - (vec2(p) + 0.5) / vec2(frame.light_ratio);
    c.sum_0 = vec4(0.0);
    c.sum_1 = vec3(0.0);
    return c;
}

float likeness(Centre c, vec3 steps, vec3 position, float signed_depth) {
    float depth = signed_depth * c.side;
    if (c.depth == 0.0) return depth == 0.0 ? 1.0 + LEAST : LEAST;
    vec3 chord = c.steps - steps;
    float distance = abs(dot(c.normal, position - c.position));
    float alike = exp2(-(dot(chord, chord) * NORMAL_SHARPNESS + distance * c.plane_sharpness));
    return depth > 0.0 ? LEAST + LEAST_ALIKE + alike : LEAST;
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy), ratio = ivec2(frame.light_ratio);
    ivec2 last = ivec2(frame.guide_extent) / ratio - 1;
    if (any(greaterThan(p, last))) return;
    Centre centres[CELL];
    [[unroll]] for (int k = 0; k < CELL; ++k)
        centres[k] = centre_at(p * ratio + min(ivec2(k % 2, k / 2), ratio - 1), vec2(p) + 0.5);
    [[dont_unroll]] for (int i = 0; i < 9; ++i) {
        ivec2 to = ivec2(i % 3 - 1, i / 3 - 1), q = p + to;
        if (any(lessThan(q, ivec2(0))) || any(greaterThan(q, last))) continue;
        GuideBits packed = GuideBits(texelFetch(guide, q, 0));
        vec3 steps = guide_normal_steps(packed);
        float signed_depth = signed_guide_depth(packed);
        vec3 position = view_position(q * ratio + ivec2(frame.light_offset), abs(signed_depth));
        vec3 light_0 = texelFetch(filtered_0, q, 0).rgb, light_1 = vec3(0.0);
        if (is_present(FILTERED_1)) light_1 = texelFetch(filtered_1, q, 0).rgb;
        [[unroll]] for (int k = 0; k < CELL; ++k) {
            vec2 d = centres[k].offset + vec2(to);
            float weight = exp2(-SHARPNESS * dot(d, d)) * likeness(centres[k], steps, position, signed_depth);
            centres[k].sum_0 += weight * vec4(light_0, 1.0);
            centres[k].sum_1 += weight * light_1;
        }
    }
    [[unroll]] for (int k = 0; k < CELL; ++k) {
        ivec2 place = ivec2(k % 2, k / 2);
        if (any(greaterThanEqual(place, ratio))) continue;
        ivec2 to = p * ratio + place;
        float total = centres[k].sum_0.a;
#if NUMBER
        imageStore(upsampled_0, to, vec4(centres[k].sum_0.rgb / total, 0.0));
#else
        imageStore(upsampled_0, to, vec4(storable(centres[k].sum_0.rgb / total), 0.0));
        if (is_present(FILTERED_1)) imageStore(upsampled_1, to, vec4(storable(centres[k].sum_1 / total), 0.0));
#endif
    }
}
