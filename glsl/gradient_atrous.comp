#version 450
// One iteration of the reconstruction of the temporal gradient: strata without a sample take it from their surroundings, noise goes.
// Source: [ASVGF] 3.4, eq. 7 to 12. Deviation: a standard deviation is stored, not the variance.
// In:  gradient_guide, guide; δ, Δ, mean and deviation of luminance per stratum. Out: the same after this iteration. With RATIO
//      light_before and light_now as well, and out of the LAST iteration, instead of light_before, light_ratio: by which the light of each
//      component changed, in alpha its coherence, -1 in the background (ours; src/nodes/gradient_atrous/specification.md). Both are filtered no wider than the ratio
//      needs to be known.
// Constants: STRATUM_SIZE, LAST.
// variants: RATIO=0 RATIO=1
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(constant_id = 1) const bool LAST = false;

layout(push_constant) uniform Push {
    uint level;
    float sigma_l;
    float sigma_n;
    float sigma_z;
} push;

#include "frame.glsl"
#include "geometry_weights.glsl"
#include "light_ratio.glsl"
#include "strata.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 2) uniform utexture2D guide;
layout(set = 0, binding = 4, rgba16f) uniform writeonly image2D gradient_out;
#if RATIO
layout(set = 0, binding = 1) uniform utexture2D gradient_guide;
layout(set = 0, binding = 3) uniform texture2D gradient_in;
layout(set = 0, binding = 5) uniform texture2D before_in;
layout(set = 0, binding = 6) uniform texture2D now_in;
layout(set = 0, binding = 7, rgba16f) uniform writeonly image2D before_out;
layout(set = 0, binding = 8, rgba16f) uniform writeonly image2D now_out;
#define texel_at(name, s) texelFetch(name, s, 0)
#else
// Storage images are read, not sampled ones, as in atrous.comp; with RATIO there would be more than the four that Vulkan guarantees.
layout(set = 0, binding = 1, rgba16ui) uniform restrict readonly uimage2D gradient_guide;
layout(set = 0, binding = 3, rgba16f) uniform restrict readonly image2D gradient_in;
#define texel_at(name, s) imageLoad(name, s)
#endif

const float LUMINANCE_EPSILON = 1e-4;
// From this level on a gradient of exactly 0 is kept: all samples within 3 strata shaded to the same again, so that light did not change
// here, whatever it did farther away (ours).
const uint FIRST_KEPT_LEVEL = 2u;

ivec2 pixel_of(ivec2 s, GuideBits packed) { return pixel_at(s, packed.bits.x & 0xfu); }

#if RATIO
// Few samples that agree may do so by chance: a spread that each sample has besides.
const float LEAST_SPREAD = 0.3;
// The spread of a ratio that no sample has.
const float NO_SPREAD = 3.0;
// Rareness of samples up to which they are believed to agree: a single one, of twice as much, agrees with itself.
const float LARGEST_RARENESS = 0.5;
// Below this relative error a ratio is known, and taps that are farther away only blur it; above twice as much they count in full.
const float KNOWN_ERROR = 0.02;
// Up to this relative error a ratio is applied in full; from twice as much on only where samples agree.
const float LARGEST_ERROR = 0.05;
// The variance of a ratio, of the squared change, from which on its components are not told apart is 1 over this.
const float COLOUR_NOISE = 0.3;

float sum_of(vec3 light) { return dot(light, vec3(1.0)); }

// Relative spread of the ratio from sample to sample. By the inequality of Cauchy and Schwarz the mean of sqrt(before * now) is largest where
// now is before times one number, and falls short of that by an eighth of the squared spread of the number.
float spread_of(vec4 before, vec4 now) {
    float largest = sum_of(sqrt(before.rgb * now.rgb));
    return largest > 0.0 ? sqrt(8.0 * max(0.0, 1.0 - before.a / largest)) : NO_SPREAD;
}

// 1 over the root of the number of samples that hold the light.
float rareness_of(vec4 before, vec4 now) {
    return now.a > 0.0 ? min(1.0, now.a / max(sum_of(before.rgb), sum_of(now.rgb))) : 1.0;
}

// Relative standard error of the ratio: the spread over the root of the number of samples that hold the light.
float error_of(vec4 before, vec4 now) {
    float spread = spread_of(before, now);
    return sqrt(spread * spread + LEAST_SPREAD * LEAST_SPREAD) * rareness_of(before, now);
}

vec4 light_ratio(vec4 before, vec4 now) {
    float error = error_of(before, now);
    float coherence = sample_coherence(spread_of(before, now)) * clamp(2.0 - rareness_of(before, now) / LARGEST_RARENESS, 0.0, 1.0);
    float sum_before = sum_of(before.rgb), sum_now = sum_of(now.rgb);
    float least = floor_of_ratio(before.rgb);
    vec3 own = min((now.rgb + least) / (before.rgb + least), LARGEST_RATIO);
    float whole = min((sum_now + least) / (sum_before + least), LARGEST_RATIO);
    float change = (sum_now - sum_before) / max(max(sum_before, sum_now), 1e-6);
    float noise = clamp(COLOUR_NOISE * error * error / max(change * change, 1e-8), 0.0, 1.0);
    // A power, so that light which falls and rises again by the same factor leaves a history as it was.
    float applied = max(coherence, clamp(2.0 - error / LARGEST_ERROR, 0.0, 1.0));
    return vec4(pow(mix(own, vec3(whole), noise), vec3(applied)), coherence);
}
#endif

void main() {
    ivec2 s = ivec2(gl_GlobalInvocationID.xy);
    if (!is_stratum(s)) return;
    vec4 centre = texel_at(gradient_in, s);
    GuideBits packed = GuideBits(texel_at(gradient_guide, s));
    if (guide_depth(packed) == 0.0) {
        imageStore(gradient_out, s, centre);
#if RATIO
        imageStore(before_out, s, LAST ? vec4(1.0, 1.0, 1.0, -1.0) : vec4(0.0));
        imageStore(now_out, s, vec4(0.0));
#endif
        return;
    }
#if RATIO
    vec4 before = texel_at(before_in, s), now = texel_at(now_in, s);
    // A ratio that is not known by the last iteration would say too little of the place.
    float unknown = LAST ? 0.0 : clamp(error_of(before, now) / KNOWN_ERROR - 1.0, 0.0, 1.0);
#endif
    if (push.level >= FIRST_KEPT_LEVEL && centre.x == 0.0 && centre.y > 0.0) {
        imageStore(gradient_out, s, centre);
#if RATIO
        imageStore(before_out, s, LAST ? light_ratio(before, now) : before);
        imageStore(now_out, s, now);
#endif
        return;
    }
    ivec2 p = pixel_of(s, packed);
    EdgeCentre surface = edge_centre(GuideBits(texelFetch(guide, p, 0)));
    float sharpness = LOG2_E / (push.sigma_l * centre.w + LUMINANCE_EPSILON);
    vec3 sum = centre.xyz;
    float variance = centre.w * centre.w, weight_sum = 1.0;
#if RATIO
    float light_sum = 1.0;
    now.a *= now.a;
#endif
    int step_size = 1 << push.level;
    ivec2 last = ivec2(strata_of(frame.render_extent)) - 1;
    [[unroll]] for (int y = -1; y <= 1; ++y)
        [[unroll]] for (int x = -1; x <= 1; ++x) {
            if (x == 0 && y == 0) continue;
            ivec2 t = s + ivec2(x, y) * step_size, tap = clamp(t, ivec2(0), last);
            GuideBits packed_t = GuideBits(texel_at(gradient_guide, tap));
            vec4 value = texel_at(gradient_in, tap);
            vec2 offset = vec2(pixel_of(tap, packed_t) - p);
            float geometry = log2_edge_weight(surface, packed_t, depth_sharpness(surface, offset));
            bool counts = t == tap && guide_depth(packed_t) != 0.0;
            float weight = counts ? exp2(geometry - abs(value.z - centre.z) * sharpness) : 0.0;
            sum += weight * value.xyz;
            variance += weight * weight * value.w * value.w;
            weight_sum += weight;
#if RATIO
            if (unknown > 0.0) {
                float light_weight = weight * unknown;
                vec4 now_t = texel_at(now_in, tap);
                before += light_weight * texel_at(before_in, tap);
                now += light_weight * vec4(now_t.rgb, light_weight * now_t.a * now_t.a);
                light_sum += light_weight;
            }
#endif
        }
    imageStore(gradient_out, s, vec4(sum, sqrt(variance)) / weight_sum);
#if RATIO
    before /= light_sum;
    now = vec4(now.rgb, sqrt(now.a)) / light_sum;
    imageStore(before_out, s, LAST ? light_ratio(before, now) : before);
    imageStore(now_out, s, now);
#endif
}
