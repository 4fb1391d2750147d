// Blends a pixel with its past. Source: [SVGF] 4.1; by pixel [ASVGF] 3.5. Twin: src/nodes/temporal_accumulation/twin/blend.rs.
#ifndef HISTORY_BLEND_GLSL
#define HISTORY_BLEND_GLSL
#include "frame.glsl"
#include "holes.glsl"
#include "luminance.glsl"
#include "luminance_history.glsl"

struct History {
    vec3 irradiance;
    float mean;  // of luminance
    float variance;
    vec2 range;  // of the mean luminances of what is added
};

const History NO_HISTORY = History(vec3(0.0), 0.0, 0.0, vec2(65504.0, 0.0));

// The luminance of this frame's sample in the light of the previous one: what moments about it lose in rounding is little beside the difference of the two.
float luminance_origin(vec3 irradiance) { return min(luminance(irradiance) / max(frame.exposure_ratio, 1e-20), 65504.0); }

// What lies between the means of taps is no noise: by chance, a lamp beside a dark wall would be a light of which some samples are bright.
void add_history(inout History sum, vec3 irradiance, LuminanceHistory m, float weight) {
    sum.irradiance += weight * irradiance;
    sum.mean += weight * m.mean;
    sum.variance += weight * m.deviation * m.deviation;
}

// The same where it counts as noise, as in [SVGF] 4.1: moments about a luminance that is the same for all taps, in the place of mean and variance.
void add_moments(inout History sum, vec3 irradiance, LuminanceHistory m, float origin, float weight) {
    float difference = m.mean - origin;
    sum.irradiance += weight * irradiance;
    sum.mean += weight * difference;
    sum.variance += weight * (m.deviation * m.deviation + difference * difference);
}

History scaled(History sum, float scale) { return History(sum.irradiance * scale, sum.mean * scale, sum.variance * scale, sum.range); }

History of_moments(History moments, float origin) {
    float variance = max(0.0, moments.variance - moments.mean * moments.mean);
    return History(moments.irradiance, origin + moments.mean, variance, moments.range);
}

void widen_range(inout History sum, float mean) { sum.range = vec2(min(sum.range.x, mean), max(sum.range.y, mean)); }

// How far light changed, 0 to 1, raises the weight of the new sample.
float adapted(float alpha, float change) { return alpha + change * (1.0 - alpha); }
vec2 adapted(vec2 alpha, float change) { return alpha + change * (1.0 - alpha); }

// The history in the light of this frame. A ratio of exposures may be as large as a float: the clamps keep infinity minus infinity away.
History in_light(History history, vec3 ratio, float scale) {
    // Squared it is finite, and all but 0 is beyond the clamp by then.
    float gain = min(scale, 1e18);
    float variance = history.variance * (gain * gain);
    vec3 irradiance = signed_half_range(history.irradiance * ratio * frame.exposure_ratio);
    return History(irradiance, min(history.mean * scale, 65504.0), min(variance, 65504.0 * 65504.0), min(history.range * gain, 65504.0));
}

// Of a pixel without a history; without a sample either, its next one is its first.
LuminanceHistory first_luminance(vec3 irradiance, float worth, uint reason) {
    bool sampled = worth > 0.0;
    return LuminanceHistory(luminance(irradiance), 0.0, sampled ? 1.0 : 0.0, sampled ? reason : REASON_NONE, UNTOLD);
}

// Up to here, a history is one of this frame alone.
const float ONE_FRAME = 1.05;
// Even noise lies outside of four samples of itself by this part of its deviation.
const float OUTSIDE_OF_FOUR = 0.535;

// `worth`: frames that this one counts for; 0: there is no sample, and the history stays. `least`: smallest weights of this frame, in the
// irradiance and in its moments.
vec3 blend(vec3 irradiance, History history, float history_length, float worth, vec2 least, out LuminanceHistory luminance_history) {
    vec2 weights = worth > 0.0 ? max(least, worth / history_length) : vec2(0.0);
    float alpha_moments = weights.y;
    float difference = luminance(irradiance) - history.mean;
    luminance_history.mean = history.mean + alpha_moments * difference;
    luminance_history.deviation = sqrt((1.0 - alpha_moments) * (history.variance + alpha_moments * difference * difference));
    luminance_history.history_length = history_length;
    luminance_history.reason = REASON_NONE;
    // A past that moved was resampled: what lies between its pixels is no noise.
    float outside = max(max(luminance(irradiance) - history.range.y, history.range.x - luminance(irradiance)), 0.0);
    luminance_history.outside = worth > 0.0 && history_length < ONE_FRAME ? min(outside / OUTSIDE_OF_FOUR, 65504.0) : UNTOLD;
    float alpha = weights.x;
    // What is dropped leaves no rounding error behind.
    return alpha < 1.0 ? mix(history.irradiance, irradiance, alpha) : irradiance;
}

#endif
