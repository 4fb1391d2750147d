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
    float outside;         // within a frame, of a history of one frame: see UNTOLD
};

// How far a sample lies outside of its past, as a deviation, is not told.
const float UNTOLD = -1.0;

const uint REASON_NONE = 0u;
const uint REASON_OFF_SCREEN = 1u;
const uint REASON_ID = 2u;
const uint REASON_DEPTH = 3u;
const uint REASON_NORMAL = 4u;
const uint REASON_RESET = 5u;

// Within a frame: mean and deviation in a texel, and in the alpha of the irradiance the history length, or the negative reason of a loss,
// whose length is 1. A history of one frame has no deviation: where it is told, how far its sample lies outside of its past takes that place,
// negative and never 0.
const float LEAST_OUTSIDE = 1.0 / 16384.0;

uint pack_new_luminance(LuminanceHistory m) {
    return packHalf2x16(min(vec2(m.mean, m.outside < 0.0 ? m.deviation : -max(m.outside, LEAST_OUTSIDE)), 65504.0));
}

vec2 unpack_new_luminance(uint packed) { return unpackHalf2x16(packed); }

float length_or_reason(LuminanceHistory m) { return m.reason == REASON_NONE ? half_value(half_bits(m.history_length)) : -float(m.reason); }

LuminanceHistory luminance_history_of(uint packed, float length_or_reason) {
    vec2 luminance = unpack_new_luminance(packed);
    float outside = luminance.y < 0.0 ? -luminance.y : UNTOLD;
    bool lost = length_or_reason < 0.0;
    return LuminanceHistory(luminance.x, max(luminance.y, 0.0), lost ? 1.0 : length_or_reason, lost ? uint(-length_or_reason) : REASON_NONE, outside);
}

// The code of a length is the upper part of its half, of which the smallest is this one, 1/16 of a frame; 0: none. Above all of them are reasons.
const uint SHORTEST_LENGTH = 351u;
const uint NO_REASON_CODE = 506u;
// A history of one frame has no deviation. With this code the detail around the pixel is told in its place: a share from -1 to 1, of which noise
// explains the rest.
const uint DETAIL_CODE = NO_REASON_CODE;
const float UNTOLD_DETAIL = -1.0;

// A half without its sign and its lowest bits. They are rounded up as often as they would fill the next step: small weights add up so.
uint upper_bits(uint half_bits, uint dropped, uint random) {
    return min((half_bits & 0x7fffu) + (random & (1u << dropped) - 1u), 0x7bffu) >> dropped;
}

// From frame to frame, of what a stage hands on within one. What is rounded decides how, with its pixel, and not the number of the frame. Of mean
// and deviation all but the lowest bits decide: two devices that differ by a step of a half mostly agree.
uint pack_luminance_history(uint new_luminance, float length_or_reason, ivec2 p) {
    new_luminance = (new_luminance & 0x80000000u) != 0u ? new_luminance & 0xffffu : new_luminance;
    uint pixel = uint(p.x) | uint(p.y) << 16;
    uint random = pcg(pixel + pcg((new_luminance & 0xffe0fff8u) + half_bits(length_or_reason)));
    uint mean = upper_bits(new_luminance, 2u, random), deviation = upper_bits(new_luminance >> 16, 5u, random >> 2);
    uint history_length = max(upper_bits(half_bits(length_or_reason), 5u, pcg(pixel + pcg(new_luminance))), SHORTEST_LENGTH) - SHORTEST_LENGTH;
    uint code = length_or_reason < 0.0 ? NO_REASON_CODE + uint(-length_or_reason) : history_length;
    return mean << 19 | deviation << 9 | code;
}

uint with_detail(uint packed, float detail) { return packed & 0xfff80000u | uint(511.5 * detail + 512.0) << 9 | DETAIL_CODE; }

float detail_of(uint packed) { return (packed & 511u) == DETAIL_CODE ? float(packed >> 9 & 1023u) / 511.5 - 1.0 : UNTOLD_DETAIL; }

LuminanceHistory unpack_luminance_history(uint packed) {
    float mean = half_value(packed >> 19 << 2), deviation = half_value((packed >> 9 & 1023u) << 5);
    uint code = packed & 511u;
    if (code == DETAIL_CODE) return LuminanceHistory(mean, 0.0, 1.0, REASON_NONE, UNTOLD);
    if (code > NO_REASON_CODE) return LuminanceHistory(mean, deviation, 1.0, code - NO_REASON_CODE, UNTOLD);
    return LuminanceHistory(mean, deviation, code == 0u ? 0.0 : half_value((code + SHORTEST_LENGTH) << 5), REASON_NONE, UNTOLD);
}

#endif
