#version 450
// Multiplies the albedo back, adds the signals and what was emitted.
// Source: [SVGF] section 3. The divisor is that of demodulate.comp, so the round trip is exact. Light that the host divided itself is multiplied
// by the albedo as it is.
// With UPSAMPLED the irradiance has fewer pixels, and is brought to each rendered one first, as upsample does; so it is never stored.
// In:  filtered irradiance per signal; albedo and emission of the host, and for specular light, the second signal then, an albedo of its own,
//      or specular_f0; guide; where light has fewer pixels also the host's depth, normal and surface_id. Out: denoised_radiance, linear Rec. 709.
//      And where light was accumulated by the pixels of the picture: the light as it was before the filter, and its luminance_history, which says how
//      much of the detail around a pixel noise does not explain. That share is no longer filtered away [ours].
// Constant SPECULAR: the second signal is specular light. Without it both albedos add up, as those of mixed light do.
// variants: FLOAT=0 FLOAT=1 FLOAT=0,UPSAMPLED=1 FLOAT=1,UPSAMPLED=1
// optional: irradiance_history_0, irradiance_history_1, luminance_history_0, luminance_history_1
// optional: albedo, emission, filtered_1, specular_albedo, specular_f0, roughness, depth, normal, surface_id
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(constant_id = 1) const bool SPECULAR = false;

layout(push_constant) uniform Push {
    uint present;
} push;

#define GUIDE_PIXELS
#include "frame.glsl"
#include "viewport.glsl"
#include "optional.glsl"
#include "conventions.glsl"
#include "statistics.glsl"
#include "luminance_history.glsl"
#include "outgoing.glsl"
#include "demodulation.glsl"

layout(local_size_x = 32, local_size_y = 4) in;

const uint ALBEDO = 3u;
const uint EMISSION = 4u;
const uint DENOISED_RADIANCE = 5u;
const uint FILTERED_0 = 6u;
const uint FILTERED_1 = 7u;
const uint SPECULAR_ALBEDO = 8u;
const uint SPECULAR_F0 = 9u;
const uint ROUGHNESS = 11u;
const uint DEPTH = 12u;
const uint NORMAL = 13u;
const uint SURFACE_ID_IMAGE = 14u;
const uint IRRADIANCE_HISTORY_0 = 15u;
const uint IRRADIANCE_HISTORY_1 = 16u;
const uint LUMINANCE_HISTORY_0 = 17u;
const uint LUMINANCE_HISTORY_1 = 18u;

#if UPSAMPLED
// Nobody sets it: its default tells the variant.
layout(constant_id = 2) const bool GATHERS = true;
#endif
layout(set = 0, binding = 2) uniform utexture2D guide;
layout(set = 0, binding = EMISSION) uniform texture2D emission;
layout(set = 0, binding = DENOISED_RADIANCE, OUTGOING_FORMAT) uniform writeonly image2D denoised_radiance;
layout(set = 0, binding = FILTERED_0) uniform texture2D filtered_0;
layout(set = 0, binding = FILTERED_1) uniform texture2D filtered_1;

// Specular light alone is not modulated.
const bool COAT = false;
#include "divisor.glsl"
#include "rendered_guide.glsl"

// Light that comes divided is multiplied by the albedo itself.
vec3 factor_at(ivec2 p, GuideBits packed, bool second) {
    bool bad;
    if (second || !has_convention(DEMODULATED)) return divisor_at(p, packed, second, bad);
    if (!is_present(ALBEDO) || guide_depth(packed) == 0.0) return vec3(1.0);
    vec3 a = albedo_at(p);
    if (!is_finite(a)) count_bad(BAD_ALBEDO);
    return reflectance_of(a);
}

vec3 emission_at(ivec2 p) {
    if (!is_present(EMISSION)) return vec3(0.0);
    vec3 e = texelFetch(emission, host_pixel(EMISSION, p), 0).rgb;
    if (is_finite(e)) return e;
    count_bad(BAD_EMISSION);
    return vec3(0.0);
}

void modulate(ivec2 p, GuideBits packed, vec3 first, vec3 second) {
    if (!SPECULAR) first += second;
    vec3 radiance = first * factor_at(p, packed, false);
    if (SPECULAR) radiance += second * factor_at(p, packed, true);
    radiance = radiance * frame.inverse_filter_exposure + emission_at(p);
    if (is_too_bright(radiance)) count_bad(SATURATED);
    imageStore(denoised_radiance, host_pixel(DENOISED_RADIANCE, p), vec4(outgoing(radiance), 1.0));
}

#if UPSAMPLED
#include "upsampling.glsl"

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!has_light(p)) return;
    Centre centres[CELL];
    gather(p, centres);
    [[unroll]] for (int k = 0; k < CELL; ++k) {
        ivec2 place;
        if (!is_in_cell(k, place)) continue;
        float total = GATHERS ? centres[k].sum_0.a : 1.0;
        modulate(p * ivec2(frame.light_ratio) + place, centres[k].packed, centres[k].sum_0.rgb / total, centres[k].sum_1 / total);
    }
}
#else
layout(set = 0, binding = IRRADIANCE_HISTORY_0) uniform texture2D irradiance_history_0;
layout(set = 0, binding = IRRADIANCE_HISTORY_1) uniform texture2D irradiance_history_1;
layout(set = 0, binding = LUMINANCE_HISTORY_0) uniform utexture2D luminance_history_0;
layout(set = 0, binding = LUMINANCE_HISTORY_1) uniform utexture2D luminance_history_1;

// Pixels from one window of 5x5 to the next.
const int WINDOWS = 4;

// The light of a pixel with the detail that noise does not explain: of five windows, since one is too few to tell noise from it.
vec3 restored(vec3 filtered, texture2D irradiance_history, utexture2D luminance_history, ivec2 p) {
    float sum = detail_of(texelFetch(luminance_history, p, 0).x);
    if (sum == UNTOLD_DETAIL) return filtered;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        ivec2 beside = nearest_inside(p + WINDOWS * (2 * ivec2(i & 1, i >> 1) - 1));
        sum += detail_of(texelFetch(luminance_history, beside, 0).x);
    }
    return mix(filtered, texelFetch(irradiance_history, p, 0).rgb, max(0.2 * sum, 0.0));
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    GuideBits packed = rendered_guide_at(p);
    vec3 first = texelFetch(filtered_0, host_pixel(FILTERED_0, p), 0).rgb, second = vec3(0.0);
    if (is_present(FILTERED_1)) second = texelFetch(filtered_1, host_pixel(FILTERED_1, p), 0).rgb;
    if (is_wired(IRRADIANCE_HISTORY_0)) first = restored(first, irradiance_history_0, luminance_history_0, p);
    if (is_wired(IRRADIANCE_HISTORY_1)) second = restored(second, irradiance_history_1, luminance_history_1, p);
    modulate(p, packed, first, second);
}
#endif
