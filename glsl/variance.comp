#version 450
// Standard deviation of luminance: from the pixel's own past, or from 7x7 pixels around it while its past is short.
// Source: [SVGF] 4.2. Deviation: the spatial estimate is scaled by spatial_variance_frames / N.
// In:  guide, new_luminance; irradiance, accumulated, with the history length in alpha. Out: estimate, the same with the
//      deviation in alpha; luminance_history, for the next frame; a counter in statistics.
// Constants: ESTIMATOR: 0: as above; 1: [PSVGF], 5x5 pixels always take part, with a share that shrinks as the past grows; 2: the pixel's own
// past alone; 3: of the accumulated mean, from 5x5 pixels without the structure that they show (ours); with FILLED neighbours
// repeat each other, so that what is smooth may be noise as well. MARKED: the deviation says whether light is rare. VOLUME: weights by the depth
// of the surface behind alone; the background takes part.
// variants: SIGNALS=1 SIGNALS=2
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const uint ESTIMATOR = 0u;
layout(constant_id = 2) const bool VOLUME = false;
layout(constant_id = 3) const bool FILLED = false;
layout(constant_id = 4) const bool MARKED = false;

layout(push_constant) uniform Push {
    float sigma_n;
    float sigma_z;
    float volume_sigma_z;
    float spatial_variance_frames;
    float alpha;
    float sample_frames;
} push;

#include "frame.glsl"
#include "centre_geometry.glsl"
#include "luminance_history.glsl"
#include "luminance.glsl"
#include "packed_image.glsl"
#include "rare_light.glsl"
#include "statistics.glsl"

PACKED_IMAGE(2, guide);
PACKED_IMAGE_32(3, new_luminance_0);
layout(set = 0, binding = 4) uniform texture2D irradiance_0;
layout(set = 0, binding = 5, r32ui) uniform writeonly uimage2D luminance_history_0;
layout(set = 0, binding = 6, rgba16f) uniform writeonly image2D estimate_0;
#if SIGNALS == 2
PACKED_IMAGE_32(7, new_luminance_1);
layout(set = 0, binding = 8) uniform texture2D irradiance_1;
layout(set = 0, binding = 9, r32ui) uniform writeonly uimage2D luminance_history_1;
layout(set = 0, binding = 10, rgba16f) uniform writeonly image2D estimate_1;
#endif

const bool FADE = ESTIMATOR == 1u;
const bool TEMPORAL = ESTIMATOR == 2u;
const bool OF_MEAN = ESTIMATOR == 3u;

// Negative, so that a filter sees the background without the guide, and next to 0, so that it is no deviation to anyone else.
const float BACKGROUND_DEVIATION = -1.0 / 16384.0;

const int RADIUS = FADE ? 2 : 3;

// Moments are taken about the mean of the centre: the difference of squares would cancel otherwise.
struct Window {
    vec2 origins;
    vec2 sums[2];
    float weight;
};

void add_moments(inout vec2 sum, uint packed, float origin, float weight) {
    vec2 m = unpack_new_luminance(packed);
    float difference = m.x - origin, deviation = max(m.y, 0.0);
    sum += weight * vec2(difference, deviation * deviation + difference * difference);
}

void add_tap(inout Window window, ivec2 p, Geometry geometry, ivec2 offset) {
    ivec2 q = p + offset, tap = nearest_inside(q);
    GuideBits packed_q = GuideBits(packed_at(guide, tap));
    float weight = offset == ivec2(0) ? 1.0 : exp2(log2_weight(geometry, packed_q, depth_sharpness(geometry, vec2(offset))));
    weight = q == tap && takes_part(geometry, packed_q) ? weight : 0.0;
    window.weight += weight;
    add_moments(window.sums[0], packed_at(new_luminance_0, tap).x, window.origins.x, weight);
#if SIGNALS == 2
    add_moments(window.sums[1], packed_at(new_luminance_1, tap).x, window.origins.y, weight);
#endif
}

// First and second moment of each signal over the neighbourhood, about the means of the centre.
void spatial_moments(ivec2 p, GuideBits packed, vec2 means, out vec2 sums[2]) {
    Geometry geometry = geometry_of(packed);
    Window window = Window(means, vec2[](vec2(0.0), vec2(0.0)), 0.0);
    if (FADE) {
        [[unroll]] for (int y = -RADIUS; y <= RADIUS; ++y)
            [[unroll]] for (int x = -RADIUS; x <= RADIUS; ++x) add_tap(window, p, geometry, ivec2(x, y));
    } else {
        // Rare, and where branches are masked instead of skipped every unrolled tap costs.
        [[dont_unroll]] for (int y = -RADIUS; y <= RADIUS; ++y)
            [[dont_unroll]] for (int x = -RADIUS; x <= RADIUS; ++x) add_tap(window, p, geometry, ivec2(x, y));
    }
    sums[0] = window.sums[0] / window.weight;
    sums[1] = window.sums[1] / window.weight;
}

float deviation_of(vec2 moments, float history_length) {
    float variance = max(0.0, moments.y - moments.x * moments.x);
    return sqrt(variance * push.spatial_variance_frames / max(history_length, 1.0));
}

// The spatial estimate where the past is short; with FADE both, so that no estimate jumps and none is 0 among neighbours that are not.
float combined(float temporal, vec2 sums, float history_length) {
    float spatial = deviation_of(sums, history_length);
    if (!FADE) return spatial;
    float share = min(push.spatial_variance_frames / max(history_length, 1.0), 1.0);
    return sqrt(mix(temporal * temporal, spatial * spatial, share));
}

const int SIDE = 5;
const int PIXELS = SIDE * SIDE;

ivec2 pixel_of(ivec2 p, int i) { return nearest_inside(p + ivec2(i % SIDE, i / SIDE) - SIDE / 2); }

// Geometry weights of 5x5 pixels.
void weigh(ivec2 p, GuideBits packed, out float weights[PIXELS]) {
    Geometry geometry = geometry_of(packed);
    [[unroll]] for (int i = 0; i < PIXELS; ++i) {
        ivec2 offset = ivec2(i % SIDE, i / SIDE) - SIDE / 2, q = p + offset, tap = nearest_inside(q);
        GuideBits packed_q = GuideBits(packed_at(guide, tap));
        float weight = exp2(log2_weight(geometry, packed_q, depth_sharpness(geometry, vec2(offset))));
        weights[i] = i == PIXELS / 2 ? 1.0 : q == tap && takes_part(geometry, packed_q) ? weight : 0.0;
    }
}

// Where neighbours repeat each other they differ by less than their noise.
const float FILLED_NOISE = 2.0;

// Shares of a spread of logarithms that bends as noise does: up to the first it is an edge, a texture or a highlight that no guide knows, from
// the second on it is noise.
const float STRUCTURE = 0.6;
const float WHITE_NOISE = 0.8;
// The same shares: a window between them is a picture with some noise, and of a deviation there, or below them, at least a part counts.
const float PICTURE = 0.15;
const float MIXTURE = 0.45;
const float NARROWEST = 0.2;
// Of the mean: logarithms of less are next to equal.
const float DARK = 0.1;
// Variances of logarithms to base 2: from the first to the second, a picture or noise counts as one. It spans a factor of 1.6, and 2.7.
const float FAINT = 0.5;
const float CLEAR = 2.0;

// Estimates from 5x5 pixels of how the luminance of one of them varies.
struct Surroundings {
    float within;  // variance of the samples that a mean was made of; less where a picture is
    float noise;   // variance of the means, without what is smooth, and less likewise
    float seen;    // of that noise, without edges and textures
    float doubt;   // how much wider that variance is, as a share of it, since few pixels tell it
    bool rare;     // few pixels have its light
    float detail;  // of what bends, the share that the past does not explain as noise, -1 to 1
};

// How far neighbours differ as noise does and not as a picture, 0 to 1, and the part of a variance that counts: less in a picture, and none in a clear
// one. Told by logarithms, in which a highlight is as smooth as its foot, and rare light is not. `noise`: the part of their spread that bends.
vec2 whiteness(float spread, float noise) {
    float share = noise / max(spread, 1e-20), white = smoothstep(STRUCTURE, WHITE_NOISE, share);
    float narrowed = mix(NARROWEST, 1.0, smoothstep(PICTURE, MIXTURE, share));
    // From the end, where next to nothing is left: one less what is next to one would be rounding.
    float unclear = smoothstep(-CLEAR, -FAINT, noise - spread);
    return vec2(white, mix(white, 1.0, unclear) * narrowed * narrowed);
}

// How much wider a variance is that is in doubt, and that of rare light: a window that has a single pixel of it says next to nothing.
const float DOUBT = 3.0;
const float RARE_DOUBT = 24.0;

// `error`: relative standard error of a variance. `log_noise`: variance of logarithms that bends.
float doubt_of(float error, float log_noise) {
    float rare = min(error, 1.0) * smoothstep(FAINT, CLEAR, log_noise);
    rare *= rare;
    rare *= rare;
    return DOUBT * error + RARE_DOUBT * rare * rare;
}

// White noise bends by six times its variance.
const float BEND_OF_NOISE = 6.0;
// Samples vary by no more than so many times their variance against their own pasts.
const float MOST_OF_PAST = 2.0;
// The least weight of all bends together that tell something: on a small ball the normals of three pixels differ, and its shading is no noise.
const float LEAST_BENDS = 0.05;

// `luminances`: of unpack_new_luminance. `m`: of the pixel in the middle.
Surroundings surroundings_of(vec2 luminances[PIXELS], float weights[PIXELS], LuminanceHistory m) {
    float sum = 0.0, mean = 0.0, past = 0.0;
    [[unroll]] for (int i = 0; i < PIXELS; ++i) {
        sum += weights[i];
        mean += weights[i] * luminances[i].x;
        past += weights[i] * luminances[i].y * luminances[i].y;
    }
    mean /= sum;
    past /= sum;
    // From here on, luminances with their logarithms.
    float log_mean = 0.0, dark = max(DARK * mean, 0.0) + 1e-12;
    [[unroll]] for (int i = 0; i < PIXELS; ++i) {
        luminances[i].y = log2(max(luminances[i].x, 0.0) + dark);
        log_mean += weights[i] * luminances[i].y;
    }
    vec2 means = vec2(mean, log_mean / sum), spreads = vec2(0.0), bends = vec2(0.0);
    float fourth = 0.0, triples = 0.0;
    [[unroll]] for (int i = 0; i < PIXELS; ++i) {
        vec2 squares = (luminances[i] - means) * (luminances[i] - means);
        spreads += weights[i] * squares;
        fourth += weights[i] * squares.x * squares.x;
        // Along x and y: what is a slope has none.
        [[unroll]] for (int step = 1; step <= SIDE; step += SIDE - 1) {
            int place = step == 1 ? i % SIDE : i / SIDE;
            if (place == 0 || place == SIDE - 1) continue;
            float weight = weights[i - step] * weights[i] * weights[i + step];
            vec2 bend = luminances[i - step] - 2.0 * luminances[i] + luminances[i + step];
            bends += weight * bend * bend;
            triples += weight;
        }
    }
    spreads /= sum;
    // The sum of squares, by the spread.
    bool rare = sum * mean * mean <= FEW_LIT * (spreads.x + mean * mean);
    float error = sqrt(max(fourth / max(sum * spreads.x * spreads.x, 1e-36) - 1.0, 0.0) / sum);
    // The mean of one frame is its sample: what it varies by is seen in its neighbours already.
    bool is_sample = m.outside >= 0.0;
    float within = is_sample ? 0.0 : past;
    if (FILLED) return Surroundings(within, FILLED_NOISE * spreads.x, FILLED_NOISE * spreads.x, doubt_of(error, 0.0), rare, UNTOLD_DETAIL);
    vec2 white = vec2(1.0);
    float noise = spreads.x, log_noise = 0.0, detail = UNTOLD_DETAIL;
    if (triples > LEAST_BENDS) {
        bends /= BEND_OF_NOISE * triples;
        white = whiteness(spreads.y, bends.y);
        noise = min(noise, bends.x);
        log_noise = bends.y;
        if (is_sample) detail = max(1.0 - past / max(noise, 1e-20), UNTOLD_DETAIL);
    }
    if (is_sample) white *= min(MOST_OF_PAST * past / max(noise, 1e-20), 1.0);
    return Surroundings(within * white.y, noise * white.y, noise * white.x, doubt_of(error, log_noise), rare, detail);
}

// Of the noise that neighbouring means still show: noise that repeats is not averaged away, and few neighbours show too little of it.
const float SEEN_NOISE = 1.75;

// Of a history of so many frames, noise that is seen beyond so many times its variance came again from frame to frame.
const float SETTLED_FRAMES = 8.0;
const float REPEATED_NOISE = 8.0;

// Standard deviation of the accumulated mean: never below the noise of neighbouring means.
float deviation_of_mean(LuminanceHistory m, Surroundings around) {
    float frames = max(m.history_length / push.sample_frames, 1.0), share = min(push.spatial_variance_frames / frames, 1.0);
    float spatial = (around.within + around.noise) * share * (1.0 + around.doubt / frames);
    float of_sample = mix(m.deviation * m.deviation, spatial, share);
    float averaging = min(max(1.0 / frames, push.sample_frames * push.alpha / (2.0 - push.alpha)), 1.0);
    float known = of_sample * averaging, seen = SEEN_NOISE * around.seen;
    if (m.history_length >= SETTLED_FRAMES && seen > REPEATED_NOISE * known) count_bad(REPEATED_SAMPLE);
    return sqrt(max(known, seen));
}

uint history_of(uint new_luminance, float length_or_reason, float detail, ivec2 p) {
    uint packed = pack_luminance_history(new_luminance, length_or_reason, p);
    return detail > UNTOLD_DETAIL ? with_detail(packed, detail) : packed;
}

bool needs_neighbours(float history_length) { return !TEMPORAL && (FADE || history_length < push.spatial_variance_frames); }

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    GuideBits packed = GuideBits(packed_at(guide, p));
    bool background = !is_filtered(packed);
    vec4 value_0 = texelFetch(irradiance_0, p, 0);
    uint packed_0 = packed_at(new_luminance_0, p).x;
    LuminanceHistory m = luminance_history_of(packed_0, value_0.a);
    vec2 means = vec2(m.mean), deviations = vec2(m.deviation), lengths = vec2(m.history_length), details = vec2(UNTOLD_DETAIL);
#if SIGNALS == 2
    vec4 value_1 = texelFetch(irradiance_1, p, 0);
    uint packed_1 = packed_at(new_luminance_1, p).x;
    LuminanceHistory m_1 = luminance_history_of(packed_1, value_1.a);
    means.y = m_1.mean;
    deviations.y = m_1.deviation;
    lengths.y = m_1.history_length;
#endif
    if (background) {
        deviations = vec2(BACKGROUND_DEVIATION);
    } else if (OF_MEAN) {
        float weights[PIXELS];
        weigh(p, packed, weights);
        vec2 luminances[PIXELS];
        [[unroll]] for (int i = 0; i < PIXELS; ++i) luminances[i] = unpack_new_luminance(packed_at(new_luminance_0, pixel_of(p, i)).x);
        Surroundings around = surroundings_of(luminances, weights, m);
        deviations.x = deviation_of_mean(m, around);
        details.x = around.detail;
        if (MARKED) deviations.x = marked(deviations.x, around.rare);
#if SIGNALS == 2
        [[unroll]] for (int i = 0; i < PIXELS; ++i) luminances[i] = unpack_new_luminance(packed_at(new_luminance_1, pixel_of(p, i)).x);
        around = surroundings_of(luminances, weights, m_1);
        deviations.y = deviation_of_mean(m_1, around);
        details.y = around.detail;
#endif
    } else if (needs_neighbours(min(lengths.x, lengths.y))) {
        vec2 sums[2];
        spatial_moments(p, packed, means, sums);
        if (needs_neighbours(lengths.x)) deviations.x = combined(deviations.x, sums[0], lengths.x);
        if (needs_neighbours(lengths.y)) deviations.y = combined(deviations.y, sums[1], lengths.y);
    }
    deviations = min(deviations, 65504.0);
    imageStore(estimate_0, p, vec4(value_0.rgb, deviations.x));
    imageStore(luminance_history_0, p, uvec4(history_of(packed_0, value_0.a, details.x, p)));
#if SIGNALS == 2
    imageStore(luminance_history_1, p, uvec4(history_of(packed_1, value_1.a, details.y, p)));
    imageStore(estimate_1, p, vec4(value_1.rgb, deviations.y));
#endif
}
