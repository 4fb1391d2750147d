#version 450
// How far the history of a pixel is still true: 1 where light did not change, 0 where nothing of it is left.
// Source: [ASVGF] 3.5, eq. 14: λ = |δ| / Δ, and its maximum over 3x3 pixels; confidence is 1 - λ.
// In:  SOURCE 0: gradient, δ and Δ per stratum; light_ratio: history that it scales is true again; other_confidence, of which those pixels
//      take theirs that no gradient is known for; steadiness of blocks, where a gradient is no evidence of change, or misses one. SOURCE 1: confidence of the
//      host per pixel. SOURCE 2: SOURCE 0 with the change test in the place of other_confidence and steadiness, of the block_difference of each
//      signal. Out: history_confidence, 0..1.
// Constants: STRATUM_SIZE, with SOURCE 0 and 2. BOTH: block_difference_1 is of specular light, whose confidence is beside that of diffuse light; no
// light_ratio scales its history. Without that image all light is one, and both confidences are of it.
// optional: light_ratio, other_confidence, steadiness, block_difference_1
// variants: SOURCE=0 SOURCE=1 SOURCE=2
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "viewport.glsl"
#include "finite.glsl"
#include "both_confidences.glsl"

#if SOURCE == 2
#include "blocks.glsl"
layout(local_size_x = ROW_PIXELS) in;
#else
layout(local_size_x = 8, local_size_y = 8) in;
#endif

const uint CONFIDENCE = 1u;
const uint HISTORY_CONFIDENCE = 2u;

#if SOURCE != 1
layout(push_constant) uniform Push {
    uint present;
    float gradient_scale;
#if SOURCE == 2
    float adaptivity;
    float change_threshold;
#endif
} push;

#include "optional.glsl"
#include "light_ratio.glsl"
#include "strata.glsl"
#include "blocks.glsl"

const uint LIGHT_RATIO = 3u;
const uint OTHER_CONFIDENCE = 4u;
const uint STEADINESS = 5u;
const uint BLOCK_DIFFERENCE_1 = 5u;

layout(set = 0, binding = 1) uniform texture2D gradient;
layout(set = 0, binding = LIGHT_RATIO) uniform texture2D light_ratio;
#if SOURCE == 2
layout(set = 0, binding = 4) uniform utexture2D block_difference_0;
layout(set = 0, binding = BLOCK_DIFFERENCE_1) uniform utexture2D block_difference_1;
#else
layout(set = 0, binding = OTHER_CONFIDENCE) uniform texture2D other_confidence;
layout(set = 0, binding = STEADINESS) uniform texture2D steadiness;
#endif
#else
layout(set = 0, binding = CONFIDENCE) uniform texture2D confidence;
#endif
layout(set = 0, binding = HISTORY_CONFIDENCE, r32f) uniform writeonly image2D history_confidence;

#if SOURCE != 1
// What is known of changes besides the gradient.
#if SOURCE == 2
layout(constant_id = 2) const bool BOTH = false;
bool tests_each() { return BOTH; }
bool wants_steadiness() { return true; }
#include "change_test.glsl"

Column tested_columns[2];

bool has_other() { return true; }
uint test_of(uint light) { return is_wired(BLOCK_DIFFERENCE_1) ? light : 0u; }
float other_at(uint light, ivec2 p) { return tested_confidence(tested_columns[test_of(light)], ivec2(p.x, p.y - p.y % BLOCK_SIZE), p.y % BLOCK_SIZE); }

float steadiness_of(uint light, ivec2 block) {
    ivec2 place = block - first_block() + 1;
    return verdicts[place.x + place.y * int(CHANGES_WIDTH) + int(test_of(light) * CHANGES)];
}
#else
bool wants_steadiness() { return is_present(STEADINESS); }
bool has_other() { return is_present(OTHER_CONFIDENCE); }
float other_at(uint light, ivec2 p) { return texelFetch(other_confidence, host_pixel(OTHER_CONFIDENCE, p), 0).x; }
float steadiness_of(uint light, ivec2 block) { return texelFetch(steadiness, block, 0).x; }
#endif

// The strata around a pixel.
struct Surroundings {
    float change;     // largest λ
    float brightest;  // largest Δ
    vec4 least;       // of light_ratio
    vec4 largest;
};

void add_stratum(inout Surroundings around, ivec2 s) {
    vec2 value = texelFetch(gradient, s, 0).xy;
    float change = value.y > 0.0 ? min(1.0, push.gradient_scale * abs(value.x) / value.y) : 0.0;
    around.change = max(around.change, change);
    around.brightest = max(around.brightest, value.y);
    if (!is_present(LIGHT_RATIO)) return;
    vec4 ratio = texelFetch(light_ratio, s, 0);
    bool known = ratio.a >= 0.0;
    around.least = known ? min(around.least, ratio) : around.least;
    around.largest = known ? max(around.largest, ratio) : around.largest;
}

float steadiness_at(uint light, ivec2 p) {
    BlocksAround around = blocks_around(p);
    ivec2 first = around.first, second = around.second;
    float upper = mix(steadiness_of(light, first), steadiness_of(light, ivec2(second.x, first.y)), around.fraction.x);
    float lower = mix(steadiness_of(light, ivec2(first.x, second.y)), steadiness_of(light, second), around.fraction.x);
    return mix(upper, lower, around.fraction.y);
}

// The 3x3 pixels lie in at most 2x2 strata; one that is met again changes nothing.
Surroundings surroundings_of(ivec2 p) {
    ivec2 first = max(p - 1, ivec2(0)) / int(STRATUM_SIZE);
    ivec2 last = min(p + 1, ivec2(frame.render_extent) - 1) / int(STRATUM_SIZE);
    Surroundings around = Surroundings(0.0, 0.0, vec4(65504.0), vec4(0.0));
    [[unroll]] for (int i = 0; i < 4; ++i) add_stratum(around, ivec2((i & 1) == 0 ? first.x : last.x, i < 2 ? first.y : last.y));
    return around;
}

float confidence_at(uint light, ivec2 p, Surroundings around) {
    if (has_other() && around.brightest == 0.0) return other_at(light, p);
    float steadiness = wants_steadiness() ? steadiness_at(light, p) : 0.0, sure = min(steadiness, 0.0);
    float change = around.change * (1.0 - max(steadiness, 0.0));
    // Samples keep the eye that saw them first: what moves in a mirror as the eye does shades to the same again. A doubt is no change.
    float missed = (1.0 - around.change) * sure * sure;
    if (light == 1u || around.least.a > around.largest.a) return 1.0 - max(change, missed);
    vec3 differences = (around.largest.rgb - around.least.rgb) / max(around.largest.rgb, 1e-6);
    float difference = max(differences.r, max(differences.g, differences.b));
    // Between strata history is scaled by what lies between their ratios.
    return 1.0 - max(change * (1.0 - around.least.a * stratum_coherence(difference)), missed);
}
#else
float confidence_at(ivec2 p) {
    float value = texelFetch(confidence, host_pixel(CONFIDENCE, p), 0).x;
    return is_finite(value) ? clamp(value, 0.0, 1.0) : 1.0;
}
#endif

void write_confidence(ivec2 p) {
#if SOURCE == 1
    float confidence = confidence_at(p);
#else
    Surroundings around = surroundings_of(p);
    float confidence = confidence_at(0u, p, around);
#endif
#if SOURCE == 2
    if (BOTH) confidence = both_confidences(confidence, confidence_at(1u, p, around));
#endif
    imageStore(history_confidence, host_pixel(HISTORY_CONFIDENCE, p), vec4(confidence, 0.0, 0.0, 0.0));
}

void main() {
#if SOURCE == 2
    load_changes();
    ivec2 top = ivec2(gl_GlobalInvocationID.x, gl_WorkGroupID.y * uint(BLOCK_SIZE));
    if (!is_inside(top)) return;
    tested_columns[0] = column_of(0u, top);
    if (BOTH && is_wired(BLOCK_DIFFERENCE_1)) tested_columns[1] = column_of(1u, top);
    [[dont_unroll]] for (int y = 0; y < BLOCK_SIZE; ++y) {
        ivec2 p = top + ivec2(0, y);
        if (is_inside(p)) write_confidence(p);
    }
#else
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (is_inside(p)) write_confidence(p);
#endif
}
