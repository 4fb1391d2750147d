#version 450
// Standard deviation of luminance: from the pixel's own past, or from 7x7 pixels around it while its past is short.
// Source: [SVGF] 4.2. Deviation: the spatial estimate is scaled by spatial_variance_frames / N.
// In:  guide, depth_gradient, new_moments. In place: filter_ping: accumulated irradiance, its alpha from history length to deviation, own
//      pixel only. Out: moments, for the next frame.
// Constants: ESTIMATOR: 0: as above; 1: [PSVGF], 5x5 pixels always take part, with a share that shrinks as the past grows; 2: the pixel's own
// past alone. AVERAGED: half-way to the deviation of the accumulated mean (ours). VOLUME: weights by the depth of the surface behind alone; the background takes part.
// variants: SIGNALS=1 SIGNALS=2
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const uint ESTIMATOR = 0u;
layout(constant_id = 2) const bool VOLUME = false;
layout(constant_id = 3) const bool AVERAGED = false;

layout(push_constant) uniform Push {
    float sigma_n;
    float sigma_z;
    float edge_falloff;
    float volume_sigma_z;
    float spatial_variance_frames;
    float alpha;
} push;

#include "frame.glsl"
#include "centre_geometry.glsl"
#include "moments.glsl"
#include "luminance.glsl"
#include "packed_image.glsl"

PACKED_IMAGE(1, guide);
layout(set = 0, binding = 2) uniform utexture2D depth_gradient;
PACKED_IMAGE_32(3, new_moments_0);
layout(set = 0, binding = 4, rgba16f) uniform image2D irradiance_0;
layout(set = 0, binding = 5, rgba16ui) uniform writeonly uimage2D moments_0;
#if SIGNALS == 2
PACKED_IMAGE_32(6, new_moments_1);
layout(set = 0, binding = 7, rgba16f) uniform image2D irradiance_1;
layout(set = 0, binding = 8, rgba16ui) uniform writeonly uimage2D moments_1;
#endif

const bool FADE = ESTIMATOR == 1u;
const bool TEMPORAL = ESTIMATOR == 2u;

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
    vec2 m = unpack_new_moments(packed);
    float difference = m.x - origin;
    sum += weight * vec2(difference, m.y * m.y + difference * difference);
}

void add_tap(inout Window window, ivec2 p, Geometry geometry, ivec2 offset) {
    ivec2 q = p + offset, tap = nearest_inside(q);
    GuideBits packed_q = GuideBits(packed_at(guide, tap));
    float weight = offset == ivec2(0) ? 1.0 : exp2(log2_weight(geometry, packed_q, depth_sharpness(geometry, vec2(offset))));
    weight = q == tap && is_filtered(packed_q) ? weight : 0.0;
    window.weight += weight;
    add_moments(window.sums[0], packed_at(new_moments_0, tap).x, window.origins.x, weight);
#if SIGNALS == 2
    add_moments(window.sums[1], packed_at(new_moments_1, tap).x, window.origins.y, weight);
#endif
}

// First and second moment of each signal over the neighbourhood, about the means of the centre.
void spatial_moments(ivec2 p, GuideBits packed, vec2 means, out vec2 sums[2]) {
    Geometry geometry = geometry_of(packed, texelFetch(depth_gradient, p, 0).x);
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
    return sqrt(variance * push.spatial_variance_frames / history_length);
}

// The spatial estimate where the past is short; with FADE both, so that no estimate jumps and none is 0 among neighbours that are not.
float combined(float temporal, vec2 sums, float history_length) {
    float spatial = deviation_of(sums, history_length);
    if (!FADE) return spatial;
    float share = min(push.spatial_variance_frames / history_length, 1.0);
    return sqrt(mix(temporal * temporal, spatial * spatial, share));
}

// Half-way, in factors, from the deviation of a sample to that of the mean of so many, whose smallest weight is alpha.
float averaging(float history_length) {
    return AVERAGED ? sqrt(sqrt(max(1.0 / history_length, push.alpha / (2.0 - push.alpha)))) : 1.0;
}

bool needs_neighbours(float history_length) { return !TEMPORAL && (FADE || history_length < push.spatial_variance_frames); }

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    GuideBits packed = GuideBits(packed_at(guide, p));
    bool background = !is_filtered(packed);
    vec4 value_0 = imageLoad(irradiance_0, p);
    Moments m = moments_of(packed_at(new_moments_0, p).x, value_0.a);
    imageStore(moments_0, p, pack_moments(m));
    vec2 means = vec2(m.mean), deviations = vec2(m.deviation), lengths = vec2(m.history_length);
#if SIGNALS == 2
    vec4 value_1 = imageLoad(irradiance_1, p);
    Moments m_1 = moments_of(packed_at(new_moments_1, p).x, value_1.a);
    imageStore(moments_1, p, pack_moments(m_1));
    means.y = m_1.mean;
    deviations.y = m_1.deviation;
    lengths.y = m_1.history_length;
#endif
    if (background) {
        deviations = vec2(BACKGROUND_DEVIATION);
    } else if (needs_neighbours(min(lengths.x, lengths.y))) {
        vec2 sums[2];
        spatial_moments(p, packed, means, sums);
        if (needs_neighbours(lengths.x)) deviations.x = combined(deviations.x, sums[0], lengths.x);
        if (needs_neighbours(lengths.y)) deviations.y = combined(deviations.y, sums[1], lengths.y);
    }
    if (AVERAGED && !background) deviations *= vec2(averaging(lengths.x), averaging(lengths.y));
    deviations = min(deviations, 65504.0);
    imageStore(irradiance_0, p, vec4(value_0.rgb, deviations.x));
#if SIGNALS == 2
    imageStore(irradiance_1, p, vec4(value_1.rgb, deviations.y));
#endif
}
