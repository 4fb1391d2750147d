// How far the light of a block departs from its own history: mean and deviation of the paired differences. Twin:
// src/nodes/block_difference/twin.rs. Needs `float depth_tolerance` in the shader's block `push`, a workgroup of eight blocks with an invocation
// a column, the images of block_difference.comp, `guide_at`, `irradiance_at` and `history_at`.
#ifndef BLOCK_DIFFERENCE_GLSL
#define BLOCK_DIFFERENCE_GLSL
#include "frame.glsl"
#include "luminance_history.glsl"
#include "luminance.glsl"
#include "nearest_history.glsl"
#include "blocks.glsl"

struct Sums {
    float count;
    vec3 now;
    vec3 before;
    float squared_difference;  // of luminance
    float uncertainty;  // 1/N: what the noise of the history adds, relative to that of one sample
    float curvature;    // squared second differences along columns
    float curved;       // their number
    float variance;     // of samples, up to the previous frame
    float outside;      // squares of how far both sides lie outside of each other, as a variance
};

const Sums NONE = Sums(0.0, vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);

// Of the columns of the blocks in a row.
shared Sums sums[ROW_PIXELS];

// Luminance now and before as halves, of the pixels of these columns: shared memory decides how many workgroups run at once.
shared uint both[ROW_PIXELS * uint(BLOCK_SIZE)];

// Of a pixel that does not count.
const uint NEITHER = 0xffffffffu;

// A change is told from noise a little earlier than even noise would allow.
const float NOISE_THAT_HIDES = 0.7;

// Without branches: software Vulkan masks them, and then reads images a lane at a time.
Sums sums_of(ivec2 pixel) {
    ivec2 p = nearest_inside(pixel), tap;
    bool counts = nearest_history(p, GuideBits(guide_at(p)), surface_motion, previous_guide, tap);
    vec4 texel = irradiance_at(p);
    vec3 before = min(history_at(tap).rgb * frame.exposure_ratio, 65504.0);
    float difference = luminance(texel.rgb - before);
    LuminanceHistory luminance_history = unpack_luminance_history(texelFetch(previous_luminance_history, tap, 0).x);
    float deviation = luminance_history.deviation * frame.exposure_ratio;
    float uncertainty = 1.0 / max(luminance_history.history_length, 1.0);
    Sums of_sample = Sums(1.0, texel.rgb, before, difference * difference, uncertainty, 0.0, 0.0, deviation * deviation, 0.0);
    if (counts && p == pixel && texel.a >= 0.0) return of_sample;
    return NONE;
}

void add(inout Sums sum, Sums other) {
    sum.count += other.count;
    sum.now += other.now;
    sum.before += other.before;
    sum.squared_difference += other.squared_difference;
    sum.uncertainty += other.uncertainty;
    sum.curvature += other.curvature;
    sum.curved += other.curved;
    sum.variance += other.variance;
    sum.outside += other.outside;
}

uint both_of(Sums of_pixel) {
    vec2 luminances = vec2(luminance(of_pixel.now), luminance(of_pixel.before));
    return of_pixel.count > 0.0 ? packHalf2x16(min(luminances, 65504.0)) : NEITHER;
}

// How far each side of a pixel lies outside of the range of the other there and beside it, in the same block. Light that was resampled, and an edge that
// lies between two pixels, do not. Noise does: by its variance over n - 1/2, of n pixels.
float outside_at(uint x, uint y) {
    uint packed = both[x + ROW_PIXELS * y];
    if (packed == NEITHER) return 0.0;
    vec2 own = unpackHalf2x16(packed), least = own, most = own;
    float pixels = 1.0;
    [[unroll]] for (int k = 0; k < 4; ++k) {
        ivec2 place = ivec2(x % uint(BLOCK_SIZE), y) + (k < 2 ? ivec2(2 * k - 1, 0) : ivec2(0, 2 * k - 5));
        if (any(lessThan(place, ivec2(0))) || any(greaterThanEqual(place, ivec2(BLOCK_SIZE)))) continue;
        packed = both[x - x % uint(BLOCK_SIZE) + uint(place.x) + ROW_PIXELS * uint(place.y)];
        if (packed == NEITHER) continue;
        vec2 beside = unpackHalf2x16(packed);
        least = min(least, beside);
        most = max(most, beside);
        pixels += 1.0;
    }
    vec2 outside = max(max(own - most.yx, least.yx - own), 0.0);
    return (pixels - 0.5) * 0.5 * dot(outside, outside);
}

void write_block_difference() {
    uint i = gl_LocalInvocationIndex;
    ivec2 top = ivec2(gl_GlobalInvocationID.x, gl_WorkGroupID.y * uint(BLOCK_SIZE));
    // Columns, what lies outside of pixels beside it, then the sums of a block's columns: the order is fixed.
    Sums sum = sums_of(top), above = NONE, middle = sum;
    both[i] = both_of(sum);
    for (int y = 1; y < BLOCK_SIZE; ++y) {
        Sums below = sums_of(top + ivec2(0, y));
        both[i + ROW_PIXELS * uint(y)] = both_of(below);
        float curve = luminance(above.now - 2.0 * middle.now + below.now), counts = above.count * middle.count * below.count;
        sum.curvature += counts * curve * curve;
        sum.curved += counts;
        above = middle;
        middle = below;
        add(sum, below);
    }
    barrier();
    for (uint y = 0u; y < uint(BLOCK_SIZE); ++y) sum.outside += outside_at(i, y);
    sums[i] = sum;
    barrier();
    if (i >= ROW_BLOCKS) return;
    ivec2 block = ivec2(gl_WorkGroupID.x * ROW_BLOCKS + i, gl_WorkGroupID.y);
    if (!is_block(block)) return;
    sum = sums[i * uint(BLOCK_SIZE)];
    for (uint x = 1u; x < uint(BLOCK_SIZE); ++x) add(sum, sums[i * uint(BLOCK_SIZE) + x]);
    float inverse = 1.0 / max(sum.count, 1.0);
    vec3 now = sum.now * inverse, before = sum.before * inverse;
    float mean = luminance(now - before);
    float variance = max(0.0, sum.squared_difference * inverse - mean * mean) * (1.0 + sum.uncertainty * inverse);
    float brighter = max(luminance(now), luminance(before));
    // Of white noise, a second difference has six times its variance. Without one, nothing is known of it. An edge bends as noise does, and stays in
    // the range of its past.
    bool is_known = sum.curved > 0.0 && brighter > 0.0;
    float noise = is_known ? sqrt(min(sum.curvature / (6.0 * sum.curved), NOISE_THAT_HIDES * sum.outside * inverse)) / brighter : LOUD;
    float past_noise = is_known ? sqrt(sum.variance * inverse) / brighter : RARE;
    imageStore(block_difference, block, pack_block_difference(now, before, sqrt(variance), uint(sum.count), noise, past_noise));
}

#endif
