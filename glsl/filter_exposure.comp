#version 450
// Chooses the exposure of the filter: a power of 2 by which light is multiplied where it comes in, and divided where it goes out, so that half
// floats hold it in whatever unit the host counts.
// Source: ours. In: noisy radiance of all signals; the exponent of the previous frame. Out: the exponent + 128, one texel; in place: the
// constants of the frame: filter_exposure, its inverse, and exposure_ratio, by which the history follows.
// It stays while the mean of log2 of the luminance of what is not black lies between -DARK_BAND and BAND, and else becomes what makes that mean 0. Whole
// numbers all the way: any order of execution gives the same bits.
// optional: noisy_1, noisy_2
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 128) in;

layout(push_constant) uniform Push {
    uint present;
} push;

#define FRAME_ACCESS buffer
#include "finite.glsl"
#include "frame.glsl"
#include "viewport.glsl"
#include "optional.glsl"

const uint NOISY_0 = 2u;
const uint NOISY_1 = 3u;
const uint NOISY_2 = 4u;

layout(set = 0, binding = 1) uniform utexture2D previous_exposure;
layout(set = 0, binding = NOISY_0) uniform texture2D noisy_0;
layout(set = 0, binding = NOISY_1) uniform texture2D noisy_1;
layout(set = 0, binding = NOISY_2) uniform texture2D noisy_2;
layout(set = 0, binding = 5, r32ui) uniform writeonly uimage2D exposure;

// Pixels looked at along either side, spread over the picture.
const uint SIDE = 64u;
// Powers of 2 that the mean may be away from 1 before the exposure changes.
const int BAND = 6;
// More where it is dark: a brighter filter leaves less room for a sky or a lamp that is seen directly.
const int DARK_BAND = 10;
const int LARGEST = 40;
// Darker is black.
const float DARKEST = 1e-36;
const int OFFSET = 128;

shared int sum;
shared int count;

// Rows that the invocations look at together, and rows of an invocation whose texels are on their way at the same time.
const uint ROWS = gl_WorkGroupSize.x / SIDE;
const uint BATCH = 8u;

// Exponents of what is lit, and their number.
ivec2 exponent_of(vec3 c) {
    bool finite = is_finite(c);
    c = min(max(c, 0.0), 1e38);
    precise float l = 0.2126 * c.r;
    l = l + 0.7152 * c.g;
    l = l + 0.0722 * c.b;
    return finite && l >= DARKEST ? ivec2(int(floatBitsToUint(l) >> 23) - 127, 1) : ivec2(0);
}

ivec2 exponents_of(uint binding, texture2D noisy, int column, uint row, uint rows) {
    vec3 c[BATCH];
    [[unroll]] for (uint k = 0u; k < BATCH; ++k) {
        uint y = min(row + k * ROWS, rows - 1u);
        c[k] = texelFetch(noisy, host_pixel(binding, ivec2(column, (2u * y + 1u) * frame.render_extent.y / (2u * rows))), 0).rgb;
    }
    ivec2 own = ivec2(0);
    [[unroll]] for (uint k = 0u; k < BATCH; ++k) own += row + k * ROWS < rows ? exponent_of(c[k]) : ivec2(0);
    return own;
}

float power_of_2(int exponent) { return uintBitsToFloat(uint(exponent + 127) << 23); }

int chosen(int before) {
    int lit = sum + before * count;
    if (count == 0 || (lit >= -DARK_BAND * count && lit <= BAND * count)) return before;
    // Rounded, and of a positive number, since the quotient of others is the device's choice.
    int mean = (2 * (sum + OFFSET * count) + count) / (2 * count) - OFFSET;
    return clamp(-mean, -LARGEST, LARGEST);
}

void main() {
    uint i = gl_LocalInvocationIndex;
    if (i == 0u) {
        sum = 0;
        count = 0;
    }
    barrier();
    uvec2 cells = min(frame.render_extent, uvec2(SIDE));
    uint x = i % SIDE;
    ivec2 own = ivec2(0);
    if (x < cells.x) {
        int column = int((2u * x + 1u) * frame.render_extent.x / (2u * cells.x));
        for (uint row = i / SIDE; row < cells.y; row += ROWS * BATCH) {
            own += exponents_of(NOISY_0, noisy_0, column, row, cells.y);
            if (is_present(NOISY_1)) own += exponents_of(NOISY_1, noisy_1, column, row, cells.y);
            if (is_present(NOISY_2)) own += exponents_of(NOISY_2, noisy_2, column, row, cells.y);
        }
    }
    atomicAdd(sum, own.x);
    atomicAdd(count, own.y);
    barrier();
    if (i != 0u) return;
    int before = has_flag(FLAG_RESET) ? 0 : int(texelFetch(previous_exposure, ivec2(0), 0).x) - OFFSET;
    int now = chosen(before);
    imageStore(exposure, ivec2(0), uvec4(uint(now + OFFSET), 0u, 0u, 0u));
    frame.filter_exposure = power_of_2(now);
    frame.inverse_filter_exposure = power_of_2(-now);
    frame.exposure_ratio = min(frame.exposure_ratio * power_of_2(now - before), 3e38);
}
