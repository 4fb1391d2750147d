#version 450
// Divides the noisy radiance by the albedo, so that texture does not reach the filters, and stops what is not finite.
// Source: [SVGF] section 3, demodulation by the albedo.
// In:  noisy radiance per signal and albedo of the host, linear Rec. 709; guide. Specular light has specular_f0 in place of an albedo where the
//      host has none, and specular_hit_distance. Out: filter_ping per signal: irradiance; alpha: 0 (-1 in holes), or the hit distance
//      (scene units; 0: unknown; 65504: beyond the scene).
//      With LUMINANCE noisy_luminance: luminance of the noisy radiance, or of the radiance `compared` (-1: not finite), and of the albedo,
//      for the temporal gradients of the next frame; and noisy_red_blue, for its ratio of light.
// Constants: PAINTING: levels of [EAW] that paint in the holes of a sub-sampled input; 0 where it has none.
// optional: albedo, specular_f0, specular_hit_distance, noisy_1, irradiance_1, compared_0, compared_1, noisy_red_blue
// variants: LUMINANCE=0 LUMINANCE=1
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(constant_id = 1) const uint PAINTING = 0u;

layout(push_constant) uniform Push {
    uint present;
} push;

#include "frame.glsl"
#include "optional.glsl"
#include "statistics.glsl"
#include "guide.glsl"
#include "luminance.glsl"
#include "demodulation.glsl"
#include "kept_radiance.glsl"
#include "reflection.glsl"
#include "specular_albedo.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint ALBEDO = 3u;
const uint NOISY_1 = 6u;
const uint COMPARED_0 = 9u;
const uint COMPARED_1 = 10u;
const uint NOISY_RED_BLUE = 11u;
const uint SPECULAR_F0 = 12u;
const uint SPECULAR_HIT_DISTANCE = 13u;

layout(set = 0, binding = 2) uniform utexture2D guide;
layout(set = 0, binding = ALBEDO) uniform texture2D albedo;
layout(set = 0, binding = 4) uniform texture2D noisy_0;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D irradiance_0;
layout(set = 0, binding = NOISY_1) uniform texture2D noisy_1;
layout(set = 0, binding = 7, rgba16f) uniform writeonly image2D irradiance_1;
layout(set = 0, binding = SPECULAR_F0) uniform texture2D specular_f0;
layout(set = 0, binding = SPECULAR_HIT_DISTANCE) uniform texture2D specular_hit_distance;
#if LUMINANCE
layout(set = 0, binding = 8, r32ui) uniform writeonly uimage2D noisy_luminance;
layout(set = 0, binding = COMPARED_0) uniform texture2D compared_0;
layout(set = 0, binding = COMPARED_1) uniform texture2D compared_1;
layout(set = 0, binding = NOISY_RED_BLUE, r32ui) uniform writeonly uimage2D noisy_red_blue;
#endif

vec3 divisor_at(ivec2 p) {
    GuideBits packed = GuideBits(texelFetch(guide, p, 0));
    bool from_f0 = !is_present(ALBEDO) && is_present(SPECULAR_F0);
    if ((!is_present(ALBEDO) && !from_f0) || guide_depth(packed) == 0.0) return vec3(1.0);
    vec3 a = from_f0 ? texelFetch(specular_f0, p, 0).rgb : texelFetch(albedo, p, 0).rgb;
    if (!is_finite(a)) count_bad(BAD_ALBEDO);
    return divisor_of(from_f0 ? specular_albedo_from(a, p, packed) : a);
}

// How far away is what is seen in a surface, so that a half float holds it.
float hit_distance_at(ivec2 p) {
    if (!is_present(SPECULAR_HIT_DISTANCE) || guide_depth(GuideBits(texelFetch(guide, p, 0))) == 0.0) return 0.0;
    float distance = texelFetch(specular_hit_distance, p, 0).x;
    if (is_nan(distance) || distance < 0.0) {
        count_bad(BAD_HIT_DISTANCE);
        return 0.0;
    }
    return distance == 0.0 ? FARTHEST_HIT : clamp(distance, 1.0 / 16384.0, FARTHEST_HIT);
}

// Alpha of a pixel without a sample, where the input is sub-sampled [EAW 3.2]: what is not finite is one.
const float HOLE = -1.0;

vec4 demodulated(vec3 radiance, vec3 divisor) {
    if (!is_finite(radiance)) {
        if (PAINTING > 0u) return vec4(vec3(0.0), HOLE);
        count_bad(BAD_RADIANCE);
        return vec4(0.0);
    }
    return vec4(storable(radiance / divisor), 0.0);
}

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (!is_inside(p)) return;
    vec3 divisor = divisor_at(p);
    vec3 radiance = texelFetch(noisy_0, p, 0).rgb;
    vec4 irradiance = demodulated(radiance, divisor);
    if (is_present(SPECULAR_HIT_DISTANCE) && irradiance.a >= 0.0) irradiance.a = hit_distance_at(p);
    imageStore(irradiance_0, p, irradiance);
    KeptRadiance kept = nothing_kept();
    keep(kept, radiance);
    if (is_present(NOISY_1)) {
        radiance = texelFetch(noisy_1, p, 0).rgb;
        imageStore(irradiance_1, p, demodulated(radiance, divisor));
        keep(kept, radiance);
    }
#if LUMINANCE
    if (is_present(COMPARED_0)) {
        kept = nothing_kept();
        keep(kept, texelFetch(compared_0, p, 0).rgb);
        if (is_present(COMPARED_1)) keep(kept, texelFetch(compared_1, p, 0).rgb);
    }
    imageStore(noisy_luminance, p, uvec4(pack_halves(vec2(luminance_or_hole(kept), luminance(divisor)))));
    if (is_present(NOISY_RED_BLUE)) imageStore(noisy_red_blue, p, uvec4(pack_halves(kept.radiance.rb)));
#endif
}
