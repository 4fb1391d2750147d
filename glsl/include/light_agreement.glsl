// How many frames a past is worth by the light of now around a pixel. Twin: src/nodes/specular_accumulation/twin/agreement.rs. Needs the types
// Centre and Past, and the images guide, noisy and history, and ratio_at_pixel.glsl.
#ifndef LIGHT_AGREEMENT_GLSL
#define LIGHT_AGREEMENT_GLSL
#include "frame.glsl"
#include "guide.glsl"
#include "history_blend.glsl"
#include "luminance.glsl"

// Standard errors by which the light of now may differ from a past that counts in full; twice as many, and it does not count. The widest lobe
// mirrors no place, so that chance would cost more than what moves.
const float AGREES = 2.0;
const float AGREES_WIDEST = 4.0;
// Of the light, how far half precision and taps between pixels may be off.
const float ROUNDED = 1e-3;
// Pixels to each side, and the fewest that tell a change.
const int AGREEMENT_REACH = 2;
const int AGREEMENT_SIDE = 2 * AGREEMENT_REACH + 1;
const float FEWEST_AGREEING = 9.0;
// Of the light of a past: logarithms of less are next to equal.
const float DARK = 0.02;
// Of the pixels around the 3x3 nearest ones, beside those.
const float RING_WEIGHT = 0.25;
// By how much the mean of a logarithm to base 2 may lie below the logarithm of a mean, of the variance: four times that of a log-normal
// distribution, since rare light is skewed more.
const float LOG_BIAS = 1.386;
// Smallest variances of logarithms to base 2: of a mean of pixels, and of a sample.
const float LOG_ROUNDED = 1e-3;
const float LOG_NOISE = 1e-2;
// Pixels that rare light should have hit by the past, of those compared: up to the first, that it hit none is chance, from the second on it is a change.
const float FEW_HITS = 2.0;
const float ENOUGH_HITS = 4.0;
// Three in a row that tell how white noise is.
const float FEWEST_ROWS = 6.0;

// Logarithms of light of now beside those of the past, over pixels.
struct LogDifference {
    float sum;
    vec2 weights;     // and their squares
    vec2 before;      // of now, of the two pixels to the left
    int row;          // of how many pixels to the left
    float bends;      // squared second differences of now
    float triples;
};

void add_pair(inout LogDifference logs, float now, float past, float weight) {
    logs.sum += weight * (now - past);
    logs.weights += vec2(weight, weight * weight);
    if (logs.row >= 2) {
        float bend = now - 2.0 * logs.before.y + logs.before.x;
        logs.bends += bend * bend;
        logs.triples += 1.0;
    }
    logs.before = vec2(logs.before.y, now);
    logs.row += 1;
}

// What the light of now tells of a past.
struct ByLight {
    float frames;  // that it is worth
    float noise;   // variance of a sample of now, as a ratio of light to base 2; -1: untold
};

// Frames until the error of a past is as large as the noise of a sample, both as ratios of light. Rare light has noise without bounds by this
// measure, and a highlight, which is smooth as a ratio, next to none. `hits`: the share of samples that brought the light of the past.
float frames_by_logs(LogDifference logs, float noise, float hits) {
    if (noise < 0.0) return 65504.0;
    float difference = logs.sum / logs.weights.x;
    float pixels = logs.weights.x * logs.weights.x / logs.weights.y;
    float missed = clamp((hits * pixels - FEW_HITS) / (ENOUGH_HITS - FEW_HITS), 0.0, 1.0);
    float outside = max(max(difference, -(difference + LOG_BIAS * noise) * missed), 0.0);
    float error = max(outside - sqrt(noise / pixels + LOG_ROUNDED), 0.0);
    return (noise + LOG_NOISE) / max(error * error, 1e-9);
}

// A past by the light of now around a position: by the mean difference over 5x5 pixels in standard errors, of the channel
// that differs most; where nobody knows the place of what is seen (`by_logs`), by logarithms as well. What a surface mirrors may move or turn
// while the surface does neither.
ByLight by_light(Centre c, vec2 position, Past past, float agrees, bool by_logs) {
    History light = in_light(past.light, c.ratio, light_scale(c.ratio));
    ivec2 shift = ivec2(floor(position + 0.5)) - c.mirror.p;
    vec3 sum = vec3(0.0), squares = vec3(0.0);
    float count = 0.0, dark = DARK * max(luminance(light.irradiance), 0.0) + 1e-6;
    LogDifference logs = LogDifference(0.0, vec2(0.0), vec2(0.0), 0, 0.0, 0.0);
    [[dont_unroll]] for (int i = 0; i < AGREEMENT_SIDE * AGREEMENT_SIDE; ++i) {
        ivec2 offset = ivec2(i % AGREEMENT_SIDE, i / AGREEMENT_SIDE) - AGREEMENT_REACH, q = c.mirror.p + offset, before = q + shift;
        if (offset.x == -AGREEMENT_REACH) logs.row = 0;
        bool exists = is_inside(q) && is_inside_previous(before);
        vec4 value = texelFetch(noisy, nearest_inside(q), 0);
        GuideBits packed = GuideBits(packed_at(guide, nearest_inside(q)));
        if (!exists || value.a < 0.0 || guide_depth(packed) == 0.0 || guide_id(packed) != guide_id(c.mirror.packed)) {
            logs.row = 0;
            continue;
        }
        vec3 then = signed_half_range(texelFetch(history, before, 0).rgb * c.ratio * frame.exposure_ratio), difference = value.rgb - then;
        sum += difference;
        squares += difference * difference;
        count += 1.0;
        if (!by_logs) continue;
        float weight = max(abs(offset.x), abs(offset.y)) < AGREEMENT_REACH ? 1.0 : RING_WEIGHT;
        add_pair(logs, log2(luminance(value.rgb) + dark), log2(max(luminance(then), 0.0) + dark), weight);
    }
    if (count < FEWEST_AGREEING) return ByLight(past.frames, -1.0);
    vec3 mean = sum / count, rounded = ROUNDED * light.irradiance;
    // Samples that a rare light missed all look alike: the past knows how much they differ.
    vec3 variance = max(squares / count - mean * mean, vec3(light.variance));
    vec3 errors = abs(mean) * inversesqrt(variance / count + rounded * rounded + 1e-20);
    float agreement = clamp(2.0 - max(max(errors.x, errors.y), errors.z) / agrees, 0.0, 1.0);
    if (!by_logs) return ByLight(past.frames * agreement, -1.0);
    float squared = light.mean * light.mean, hits = squared / max(squared + light.variance, 1e-20);
    float noise = logs.triples < FEWEST_ROWS ? -1.0 : logs.bends / (6.0 * logs.triples);
    return ByLight(min(past.frames * agreement, frames_by_logs(logs, noise, hits)), noise);
}

#endif
