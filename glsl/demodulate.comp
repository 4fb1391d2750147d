#version 450
// Divides the noisy radiance by the albedo, so that texture does not reach the filters, and stops what is not finite.
// Source: [SVGF] section 3, demodulation by the albedo.
// In:  noisy radiance per signal and albedo of the host, linear Rec. 709; guide. Specular light has specular_f0 in place of an albedo where the
//      host has none, and specular_hit_distance. Mixed light has both albedos, which add up. With SPECULAR the second signal is specular light.
// Out: irradiance per signal; alpha: 0 (-1 in holes), or the hit distance (scene units; 0: unknown; 65504: beyond the scene). Radiance that
//      is not finite is no sample: a hole, filled from the 3x3 pixels around it (alpha -1; -2: none of them has a sample), unless the input
//      is sub-sampled: then fill_holes or eaw does it.
//      With LUMINANCE noisy_luminance: luminance of the noisy radiance, or of the radiance `compared` (-1: not finite), and of the albedo,
//      for the temporal gradients of the next frame; and noisy_red_blue, for its ratio of light. Both hold the candidate of every stratum
//      where that alone is asked for, else every pixel.
// Constants: SAMPLING: levels of [EAW] that fill the holes of a sub-sampled input; 0 where every pixel has a sample. STRATUM_SIZE: with
// LUMINANCE; 1 without candidates. COAT: the only signal is specular light.
// optional: albedo, specular_albedo, specular_f0, roughness, specular_hit_distance, noisy_1, irradiance_1, compared_0, compared_1, noisy_red_blue, candidates
// variants: LUMINANCE=0 LUMINANCE=1
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(constant_id = 1) const uint SAMPLING = 0u;
layout(constant_id = 2) const bool SPECULAR = false;
layout(constant_id = 3) const bool COAT = false;

layout(push_constant) uniform Push {
    uint present;
    float sigma_n;
    float sigma_z;
} push;

#include "frame.glsl"
#include "viewport.glsl"
#include "optional.glsl"
#include "statistics.glsl"
#include "guide.glsl"
#include "luminance.glsl"
#include "demodulation.glsl"
#include "hole_filling.glsl"
#include "kept_radiance.glsl"
#include "reflection.glsl"
#if LUMINANCE
#include "strata.glsl"
#endif

layout(local_size_x = 8, local_size_y = 8) in;

const uint ALBEDO = 3u;
const uint NOISY_0 = 4u;
const uint NOISY_1 = 6u;
const uint COMPARED_0 = 9u;
const uint COMPARED_1 = 10u;
const uint NOISY_RED_BLUE = 11u;
const uint SPECULAR_F0 = 12u;
const uint SPECULAR_HIT_DISTANCE = 13u;
const uint CANDIDATES = 15u;
const uint SPECULAR_ALBEDO = 16u;
const uint ROUGHNESS = 14u;

layout(set = 0, binding = 2) uniform utexture2D guide;
layout(set = 0, binding = NOISY_0) uniform texture2D noisy_0;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D irradiance_0;
layout(set = 0, binding = NOISY_1) uniform texture2D noisy_1;
layout(set = 0, binding = 7, rgba16f) uniform writeonly image2D irradiance_1;
layout(set = 0, binding = SPECULAR_HIT_DISTANCE) uniform texture2D specular_hit_distance;
#if LUMINANCE
layout(set = 0, binding = 8, r32ui) uniform writeonly uimage2D noisy_luminance;
layout(set = 0, binding = COMPARED_0) uniform texture2D compared_0;
layout(set = 0, binding = COMPARED_1) uniform texture2D compared_1;
layout(set = 0, binding = NOISY_RED_BLUE, r32ui) uniform writeonly uimage2D noisy_red_blue;
layout(set = 0, binding = CANDIDATES) uniform utexture2D candidates;
#endif

#include "divisor.glsl"

// Where a host does not know a distance, as where it has none at all.
const float UNKNOWN_HIT = -1.0;

// How far away is what is seen in a surface, so that a half float holds it.
float hit_distance_at(ivec2 p) {
    if (!is_present(SPECULAR_HIT_DISTANCE) || guide_depth(GuideBits(texelFetch(guide, p, 0))) == 0.0) return 0.0;
    float distance = texelFetch(specular_hit_distance, host_pixel(SPECULAR_HIT_DISTANCE, p), 0).x;
    if (is_nan(distance) || distance < 0.0) {
        if (distance != UNKNOWN_HIT) count_bad(BAD_HIT_DISTANCE);
        return 0.0;
    }
    return distance == 0.0 ? FARTHEST_HIT : clamp(distance, 1.0 / 16384.0, FARTHEST_HIT);
}

void add_hit_distance(inout vec4 irradiance, ivec2 p) {
    if (is_present(SPECULAR_HIT_DISTANCE) && irradiance.a >= 0.0) irradiance.a = hit_distance_at(p);
}

// A pixel without a sample, from those around it.
vec4 filled(ivec2 p, uint binding, texture2D noisy, bool second) {
    EdgeCentre centre = edge_centre(GuideBits(texelFetch(guide, p, 0)));
    Filling sum = no_filling();
    [[dont_unroll]] for (int i = 0; i < 9; ++i) {
        ivec2 offset = ivec2(i % 3 - 1, i / 3 - 1), q = p + offset;
        if (i == 4 || !is_inside(q)) continue;
        GuideBits packed = GuideBits(texelFetch(guide, q, 0));
        vec3 radiance = texelFetch(noisy, host_pixel(binding, q), 0).rgb;
        if (!is_finite(radiance) || !is_of_same_kind(centre, packed)) continue;
        bool bad;
        add_sample(sum, storable(exposed(radiance) / divisor_at(q, packed, second, bad)), packed, vec2(offset), centre);
    }
    return filled_hole(sum);
}

vec4 demodulated(ivec2 p, uint binding, texture2D noisy, vec3 radiance, vec3 divisor, bool second) {
    if (is_finite(radiance)) {
        vec3 irradiance = exposed(radiance) / divisor;
        if (is_saturated(irradiance)) count_bad(SATURATED);
        return vec4(storable(irradiance), 0.0);
    }
    if (SAMPLING > 0u) return vec4(vec3(0.0), HOLE);
    count_bad(BAD_RADIANCE);
    return filled(p, binding, noisy, second);
}

#if LUMINANCE
// Whether the light of a pixel is that of its stratum: each has one, a candidate or the first pixel, so that every texel is written.
bool stands_for(ivec2 s, ivec2 p) {
    if (!is_present(CANDIDATES)) return true;
    uvec2 candidate = texelFetch(candidates, s, 0).xy;
    return p == (candidate.x == NO_PIXEL ? first_pixel(s) : ivec2(candidate));
}
#endif

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    GuideBits packed = GuideBits(texelFetch(guide, p, 0));
    bool bad;
    vec3 divisor = divisor_at(p, packed, false, bad);
    if (bad) count_bad(BAD_ALBEDO);
    vec3 radiance = texelFetch(noisy_0, host_pixel(NOISY_0, p), 0).rgb;
    vec4 irradiance = demodulated(p, NOISY_0, noisy_0, radiance, divisor, false);
    if (!SPECULAR) add_hit_distance(irradiance, p);
    imageStore(irradiance_0, p, irradiance);
    KeptRadiance kept = nothing_kept();
    keep(kept, radiance);
    if (is_present(NOISY_1)) {
        radiance = texelFetch(noisy_1, host_pixel(NOISY_1, p), 0).rgb;
        vec3 second = divisor;
        if (SPECULAR) second = divisor_at(p, packed, true, bad);
        if (SPECULAR && bad) count_bad(BAD_ALBEDO);
        irradiance = demodulated(p, NOISY_1, noisy_1, radiance, second, SPECULAR);
        if (SPECULAR) add_hit_distance(irradiance, p);
        imageStore(irradiance_1, p, irradiance);
        keep(kept, radiance);
    }
#if LUMINANCE
    ivec2 s = p / int(STRATUM_SIZE);
    if (!stands_for(s, p)) return;
    if (is_present(COMPARED_0)) {
        kept = nothing_kept();
        keep(kept, texelFetch(compared_0, host_pixel(COMPARED_0, p), 0).rgb);
        if (is_present(COMPARED_1)) keep(kept, texelFetch(compared_1, host_pixel(COMPARED_1, p), 0).rgb);
    }
    imageStore(noisy_luminance, s, uvec4(pack_halves(vec2(luminance_or_hole(kept), luminance(divisor)))));
    if (is_present(NOISY_RED_BLUE)) imageStore(noisy_red_blue, s, uvec4(pack_halves(kept.radiance.rb)));
#endif
}
