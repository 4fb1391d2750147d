// Mean and standard deviation of luminance with the history length. Bits: docs/specification/packed_images.md. Twin: src/reference/luminance_history.rs.
// Mean and deviation instead of E[l] and E[l^2]: their difference would cancel in half precision and overflow above 255.
#ifndef LUMINANCE_HISTORY_GLSL
#define LUMINANCE_HISTORY_GLSL
#include "guide.glsl"

struct LuminanceHistory {
    float mean;
    float deviation;
    float history_length;  // frames; 0: there never was a sample
    uint reason;           // REASON_*
};

const uint REASON_NONE = 0u;
const uint REASON_OFF_SCREEN = 1u;
const uint REASON_ID = 2u;
const uint REASON_DEPTH = 3u;
const uint REASON_NORMAL = 4u;
const uint REASON_RESET = 5u;

// Within a frame: mean and deviation in a texel, and in the alpha of the irradiance the history length, or the negative reason of a loss,
// whose length is 1.
uint pack_new_luminance(LuminanceHistory m) { return packHalf2x16(min(vec2(m.mean, m.deviation), 65504.0)); }

vec2 unpack_new_luminance(uint packed) { return unpackHalf2x16(packed); }  // mean, deviation

float length_or_reason(LuminanceHistory m) { return m.reason == REASON_NONE ? half_value(half_bits(m.history_length)) : -float(m.reason); }

LuminanceHistory luminance_history_of(uint packed, float length_or_reason) {
    vec2 luminance = unpack_new_luminance(packed);
    bool lost = length_or_reason < 0.0;
    return LuminanceHistory(luminance.x, luminance.y, lost ? 1.0 : length_or_reason, lost ? uint(-length_or_reason) : REASON_NONE);
}

uvec4 pack_luminance_history(LuminanceHistory m) {
    return uvec4(half_bits(min(m.mean, 65504.0)), half_bits(min(m.deviation, 65504.0)), half_bits(m.history_length), m.reason);
}

LuminanceHistory unpack_luminance_history(uvec4 packed) {
    return LuminanceHistory(half_value(packed.x), half_value(packed.y), half_value(packed.z), packed.w);
}

#endif
