// Packing of visibility, and lengths on a surface, by which penumbrae are measured. Bits: docs/specification/packed_images.md. Twin: src/reference/visibility.rs.
#ifndef VISIBILITY_GLSL
#define VISIBILITY_GLSL
#include "frame.glsl"
#include "view_position.glsl"

// What one pixel remembers of its visibility: 12, 6, 6 and 8 bits.
struct VisibilityHistory {
    float mean;               // 0..1
    float deviation;          // of a sample, 0..0.5
    float history_length;     // frames
    float occluder_distance;  // scene units; 0: nothing is in the way
};

const float LONGEST_VISIBILITY_HISTORY = 63.0;
const float MEAN_STEPS = 4095.0;
const float DEVIATION_STEPS = 126.0;
// Steps of an octave of the distance, and the step of distance 1.
const float DISTANCE_STEPS = 8.0;
const float DISTANCE_ONE = 97.0;

uint pack_distance(float d) { return d > 0.0 ? uint(clamp(floor(log2(d) * DISTANCE_STEPS + (DISTANCE_ONE + 0.5)), 1.0, 255.0)) : 0u; }
float unpack_distance(uint steps) { return steps == 0u ? 0.0 : exp2((float(steps) - DISTANCE_ONE) / DISTANCE_STEPS); }

uint pack_visibility(VisibilityHistory h) {
    uint mean = uint(clamp(h.mean, 0.0, 1.0) * MEAN_STEPS + 0.5), deviation = uint(clamp(h.deviation, 0.0, 0.5) * DEVIATION_STEPS + 0.5);
    uint frames = uint(clamp(h.history_length, 1.0, LONGEST_VISIBILITY_HISTORY) + 0.5);
    return mean | deviation << 12 | frames << 18 | pack_distance(h.occluder_distance) << 24;
}

VisibilityHistory unpack_visibility_history(uint packed) {
    return VisibilityHistory(float(packed & 0xfffu) / MEAN_STEPS, float(packed >> 12 & 0x3fu) / DEVIATION_STEPS,
                             float(packed >> 18 & 0x3fu), unpack_distance(packed >> 24));
}

vec2 unpack_visibility_samples(uint packed) { return unpackHalf2x16(packed); }  // visibility, or -1; distance of the occluder

// Between two places on a surface that tilts as `gradient` says: where it recedes, a pixel is a longer way.
float squared_distance(vec2 size, vec2 gradient, vec2 offset) {
    vec2 across = size * offset;
    float away = dot(gradient, offset);
    return dot(across, across) + away * away;
}

#endif
