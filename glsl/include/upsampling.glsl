// Joint bilateral upsampling of filtered light, by planes and normals. An invocation has a pixel of light, and a cell of the rendered pixels
// that it stands for: their taps are the same. Needs the bindings `guide` of the pixels with light, `filtered_0` and `filtered_1`, and
// those of rendered_guide.glsl. Twin: src/nodes/upsample/twin.rs.
#ifndef UPSAMPLING_GLSL
#define UPSAMPLING_GLSL
#include "guide.glsl"
#include "rendered_guide.glsl"
#include "view_position.glsl"
#include "volume.glsl"

// Of a volume, whose light depends on how far one sees through it, and on no surface.
layout(constant_id = 3) const bool VOLUME = false;

const float LOG2_E = 1.4426950;
// Of the Gauss, 1/(2σ²) with σ = 0.8 pixels of light.
const float SHARPNESS = LOG2_E * 0.78125;
// Of 1 - cos of two normals, which is half of their squared distance, in steps.
const float NORMAL_SHARPNESS = LOG2_E * 16.0 * 0.5 / (NORMAL_STEPS * NORMAL_STEPS);
// Distance from the plane of a surface, in shares of its depth, at which a weight is down to 1/e.
const float PLANE_TOLERANCE = 0.02;
// Of the difference of two depths behind a volume, as a share of the larger one: down to 1/e at an eighth.
const float VOLUME_SHARPNESS = LOG2_E * 8.0;
// Of taps that lie on other surfaces, and of those that have no light of this surface's kind: so there always is some light.
const float LEAST_ALIKE = 1e-3;
const float LEAST = 1e-6;

// A rendered pixel of the cell that a pixel of light stands for, and its sums.
struct Centre {
    GuideBits packed;
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
    GuideBits packed = rendered_guide_at(p);
    Centre c;
    c.packed = packed;
    c.depth = guide_depth(packed);
    c.side = guide_is_apart(packed) ? -1.0 : 1.0;
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
    if (VOLUME) return LEAST + exp2(-VOLUME_SHARPNESS * relative_difference(sight(c.depth), sight(abs(signed_depth))));
    float depth = signed_depth * c.side;
    if (c.depth == 0.0) return depth == 0.0 ? 1.0 + LEAST : LEAST;
    vec3 chord = c.steps - steps;
    float distance = abs(dot(c.normal, position - c.position));
    float alike = exp2(-(dot(chord, chord) * NORMAL_SHARPNESS + distance * c.plane_sharpness));
    return depth > 0.0 ? LEAST + LEAST_ALIKE + alike : LEAST;
}

float gauss(float d) { return exp2(-SHARPNESS * d * d); }

// The sums of each rendered pixel of a pixel of light.
void gather(ivec2 p, out Centre centres[CELL]) {
    ivec2 ratio = ivec2(frame.light_ratio), last = ivec2(frame.guide_extent) / ratio - 1;
    [[unroll]] for (int k = 0; k < CELL; ++k)
        centres[k] = centre_at(p * ratio + min(ivec2(k % 2, k / 2), ratio - 1), vec2(p) + 0.5);
    vec2 offsets[2] = { centres[0].offset, centres[CELL - 1].offset };
    [[dont_unroll]] for (int y = -1; y <= 1; ++y)
        [[unroll]] for (int x = -1; x <= 1; ++x) {
            ivec2 q = p + ivec2(x, y), tap = clamp(q, ivec2(0), last);
            float exists = q == tap ? 1.0 : 0.0;
            GuideBits packed = GuideBits(texelFetch(guide, tap, 0));
            vec3 steps = guide_normal_steps(packed);
            float signed_depth = signed_guide_depth(packed);
            vec3 position = view_position(tap * ratio + ivec2(frame.light_offset), abs(signed_depth));
            vec3 light_0 = texelFetch(filtered_0, tap, 0).rgb, light_1 = vec3(0.0);
            if (is_present(FILTERED_1)) light_1 = texelFetch(filtered_1, tap, 0).rgb;
            [[unroll]] for (int k = 0; k < CELL; ++k) {
                float weight = exists * gauss(offsets[k % 2].x + float(x)) * gauss(offsets[k / 2].y + float(y));
                weight *= likeness(centres[k], steps, position, signed_depth);
                centres[k].sum_0 += weight * vec4(light_0, 1.0);
                centres[k].sum_1 += weight * light_1;
            }
        }
}

bool has_light(ivec2 p) { return all(lessThan(p, ivec2(frame.guide_extent / frame.light_ratio))); }

// The place of a rendered pixel in its cell; false: the cell is smaller.
bool is_in_cell(int k, out ivec2 place) {
    place = ivec2(k % 2, k / 2);
    return all(lessThan(place, ivec2(frame.light_ratio)));
}

#endif
