#version 450
// Divides the light of a gradient sample by the albedo of the point that it comes from, which is not that of the pixel's centre: demodulate has
// divided by the latter. Without that a pixel in every stratum has the light of one texel and the albedo of another where textures are fine.
// Source: ours. [ASVGF] 3.1 patches the G-buffer of these pixels instead, so that the picture has the texture of that point.
// In:  gradient_samples; candidates of this frame; guide; albedo, with specular_albedo of mixed light, or specular_f0, by which demodulate
//      divided. candidate_albedo of the previous frame. In place, pixels of samples only: irradiance per signal. Out: candidate_albedo: rgb: divisor
//      at the candidate of every stratum.
// Constants: STRATUM_SIZE. SPECULAR: the second signal is specular light, with a candidate_albedo of its own. COAT: the only one is.
// optional: irradiance_1, albedo, specular_f0, roughness, specular_albedo, previous_candidate_albedo_1, candidate_albedo_1
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(constant_id = 1) const bool SPECULAR = false;
layout(constant_id = 2) const bool COAT = false;

layout(push_constant) uniform Push {
    uint present;
} push;

#include "frame.glsl"
#include "viewport.glsl"
#include "optional.glsl"
#include "guide.glsl"
#include "strata.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint IRRADIANCE_1 = 7u;
const uint ALBEDO = 8u;
const uint SPECULAR_F0 = 9u;
const uint SPECULAR_ALBEDO = 10u;
const uint ROUGHNESS = 13u;

layout(set = 0, binding = 1) uniform utexture2D guide;
layout(set = 0, binding = 2) uniform utexture2D gradient_samples;
layout(set = 0, binding = 3) uniform utexture2D candidates;
layout(set = 0, binding = 4) uniform texture2D previous_candidate_albedo_0;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D candidate_albedo_0;
layout(set = 0, binding = 6, rgba16f) uniform image2D irradiance_0;
layout(set = 0, binding = IRRADIANCE_1, rgba16f) uniform image2D irradiance_1;
layout(set = 0, binding = 11) uniform texture2D previous_candidate_albedo_1;
layout(set = 0, binding = 12, rgba16f) uniform writeonly image2D candidate_albedo_1;

#include "divisor.glsl"

// As candidate_albedo has it: the same divisor gives a factor of 1.
vec3 as_halves(vec3 v) {
    v = min(v, 65504.0);
    return vec3(unpackHalf2x16(packHalf2x16(v.rg)), unpackHalf2x16(packHalf2x16(v.bb)).x);
}

vec3 stored_divisor_at(ivec2 p, bool second) {
    bool bad;
    return as_halves(divisor_at(p, GuideBits(texelFetch(guide, p, 0)), second, bad));
}

void main() {
    ivec2 s = ivec2(gl_GlobalInvocationID.xy);
    if (!is_stratum(s)) return;
    // 65535 is a stratum without a candidate, which no frame asks for.
    ivec2 candidate = min(ivec2(texelFetch(candidates, s, 0).xy), ivec2(frame.render_extent) - 1);
    imageStore(candidate_albedo_0, s, vec4(stored_divisor_at(candidate, false), 0.0));
    if (SPECULAR) imageStore(candidate_albedo_1, s, vec4(stored_divisor_at(candidate, true), 0.0));
    GradientSample taken = unpack_gradient_samples(texelFetch(gradient_samples, s, 0));
    if (!taken.valid || !has_flag(FLAG_RESHADED) || has_flag(FLAG_RESET)) return;
    ivec2 p = pixel_at(s, taken.place);
    ivec2 before = taken.previous_pixel / int(STRATUM_SIZE);
    vec3 factor = stored_divisor_at(p, false) / texelFetch(previous_candidate_albedo_0, before, 0).rgb;
    vec4 value = imageLoad(irradiance_0, p);
    imageStore(irradiance_0, p, vec4(storable(value.rgb * factor), value.a));
    if (!is_present(IRRADIANCE_1)) return;
    if (SPECULAR) factor = stored_divisor_at(p, true) / texelFetch(previous_candidate_albedo_1, before, 0).rgb;
    value = imageLoad(irradiance_1, p);
    imageStore(irradiance_1, p, vec4(storable(value.rgb * factor), value.a));
}
