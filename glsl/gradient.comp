#version 450
// Temporal gradient of every stratum: how much the luminance of the same samples changed from the previous frame to this one.
// Source: [ASVGF] eq. 2, 3, 13, and 3.4 for mean and variance. Deviations: luminance is divided by that of the albedo, the previous frame's for
// both; of a dense re-shaded image (SOURCE 1) all pixels of a stratum count, each at its place in the previous frame.
// In:  guide, albedo, noisy radiance per signal. SOURCE 0: gradient_samples. SOURCE 1: reshaded_radiance, previous_guide, surface_motion.
//      Both: noisy_luminance of the previous frame, which demodulate.comp left. SOURCE 2: sparse_gradient of the host.
// Out: gradient: δ, Δ, mean, deviation of luminance; gradient_guide. For the ratio of light: light_before and light_now, the mean radiance of
//      the samples over the albedo's luminance; in light_before's alpha the mean of sqrt(before * now), summed over the components, in
//      light_now's the root of the sum of the squares of the larger of both lights, over their number: how few samples hold the light.
// Constants: SOURCE, where the change comes from; STRATUM_SIZE.
// optional: albedo, noisy_1, gradient_samples, reshaded_radiance, previous_guide, surface_motion, sparse_gradient
// optional: previous_luminance, previous_red_blue, light_before, light_now
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

layout(constant_id = 1) const uint SOURCE = 2u;

layout(push_constant) uniform Push {
    uint present;
    float depth_tolerance;
} push;

#include "frame.glsl"
#include "viewport.glsl"
#include "optional.glsl"
#include "finite.glsl"
#include "surface_motion.glsl"
#include "luminance.glsl"
#include "demodulation.glsl"
#include "kept_radiance.glsl"
#include "strata.glsl"
#include "view_position.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const uint ALBEDO = 2u;
const uint NOISY_0 = 3u;
const uint NOISY_1 = 4u;
const uint GRADIENT_SAMPLES = 7u;
const uint RESHADED_RADIANCE = 8u;
const uint PREVIOUS_GUIDE = 9u;
const uint SURFACE_MOTION = 10u;
const uint SPARSE_GRADIENT = 12u;
const uint PREVIOUS_LUMINANCE = 13u;
const uint PREVIOUS_RED_BLUE = 14u;
const uint LIGHT_BEFORE = 15u;
const uint LIGHT_NOW = 16u;

layout(set = 0, binding = 1) uniform utexture2D guide;
layout(set = 0, binding = ALBEDO) uniform texture2D albedo;
layout(set = 0, binding = NOISY_0) uniform texture2D noisy_0;
layout(set = 0, binding = NOISY_1) uniform texture2D noisy_1;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D gradient;
layout(set = 0, binding = 6, rgba16ui) uniform writeonly uimage2D gradient_guide;
layout(set = 0, binding = GRADIENT_SAMPLES) uniform utexture2D gradient_samples;
layout(set = 0, binding = RESHADED_RADIANCE) uniform texture2D reshaded_radiance;
layout(set = 0, binding = PREVIOUS_GUIDE) uniform utexture2D previous_guide;
layout(set = 0, binding = SURFACE_MOTION) uniform utexture2D surface_motion;
layout(set = 0, binding = SPARSE_GRADIENT) uniform texture2D sparse_gradient;
layout(set = 0, binding = PREVIOUS_LUMINANCE) uniform utexture2D previous_luminance;
layout(set = 0, binding = PREVIOUS_RED_BLUE) uniform utexture2D previous_red_blue;
layout(set = 0, binding = LIGHT_BEFORE, rgba16f) uniform writeonly image2D light_before;
layout(set = 0, binding = LIGHT_NOW, rgba16f) uniform writeonly image2D light_now;

const uint FORWARD_PROJECTED = 0u;
const uint RESHADED = 1u;
const uint SPARSE = 2u;

struct Sum {
    float change;     // δ
    float brightest;  // Δ
    float samples;
    float origin;   // luminance that mean and squares are taken about: that of the first surface, since a difference of squares cancels
    float mean;
    float squares;
    float surfaces;
    vec4 before;
    vec4 now;
};

KeptRadiance noisy_at(ivec2 p) {
    KeptRadiance sum = nothing_kept();
    keep(sum, texelFetch(noisy_0, host_pixel(NOISY_0, p), 0).rgb);
    if (is_present(NOISY_1)) keep(sum, texelFetch(noisy_1, host_pixel(NOISY_1, p), 0).rgb);
    return sum;
}

float albedo_at(ivec2 p, bool background) {
    if (background || !is_present(ALBEDO)) return 1.0;
    return luminance(divisor_of(texelFetch(albedo, host_pixel(ALBEDO, guide_pixel(p)), 0).rgb));
}

// Where the light of a pixel of the previous frame is: of candidates, one in every stratum, no other is kept.
ivec2 kept_at(ivec2 previous_pixel) { return SOURCE == FORWARD_PROJECTED ? previous_pixel / int(STRATUM_SIZE) : previous_pixel; }

// Luminance, negative without a sample, and that of the albedo.
vec2 light_of(ivec2 previous_pixel) { return unpack_noisy_luminance(texelFetch(previous_luminance, kept_at(previous_pixel), 0).x); }

bool has_ratio() { return is_present(PREVIOUS_RED_BLUE) && is_present(LIGHT_BEFORE) && is_present(LIGHT_NOW); }

void add_light(inout Sum sum, vec3 before, vec3 now) {
    sum.before += vec4(before, dot(sqrt(before * now), vec3(1.0)));
    float larger = max(dot(before, vec3(1.0)), dot(now, vec3(1.0)));
    sum.now += vec4(now, larger * larger);
}

// `before`: light_of the previous pixel.
void add_change(inout Sum sum, vec3 radiance, vec2 before, ivec2 previous_pixel) {
    if (before.x < 0.0) return;
    float l = min(before.x * frame.exposure_ratio, 65504.0), now = kept_luminance(radiance);
    sum.change += (now - l) / before.y;
    sum.brightest += max(now, l) / before.y;
    sum.samples += 1.0;
    if (has_ratio()) {
        vec2 red_blue = min(unpack_noisy_red_blue(texelFetch(previous_red_blue, kept_at(previous_pixel), 0).x) * frame.exposure_ratio, 65504.0);
        add_light(sum, radiance_of(l, red_blue) / before.y, radiance_of(now, kept_red_blue(radiance)) / before.y);
    }
}

// Pixels between the motion of a surface and that of the camera, and the share of it that rounding explains: what moved further by itself is
// not where paths of the previous frame are traced again.
const float STILL = 0.5;
const float STILL_SHARE = 1.0 / 256.0;

bool stands_still(ivec2 p, float z, vec2 motion) {
    vec2 position;
    if (!previous_pixel_position(world_position(p, z), position)) return false;
    vec2 of_camera = position + 0.5 - (vec2(p) + 0.5) * extent_ratio(frame.render_extent, frame.previous_render_extent);
    return distance(of_camera, motion) <= STILL + STILL_SHARE * length(motion);
}

// The pixel of the previous frame that showed this surface, where that has stood still.
bool previous_pixel_of(ivec2 p, GuideBits packed, out ivec2 j) {
    SurfaceMotion m = unpack_surface_motion(texelFetch(surface_motion, p, 0));
    j = ivec2(floor(previous_position(p, m.motion, frame.render_extent, frame.previous_render_extent)));
    if (!is_inside_previous(j)) return false;
    GuideBits before = GuideBits(texelFetch(previous_guide, j, 0));
    float z = guide_depth(before);
    if (z == 0.0 || guide_id(before) != guide_id(packed)) return false;
    float expected = guide_depth(packed) * (1.0 + m.depth_ratio);
    vec2 slope = abs(guide_gradient(packed));
    bool same = abs(z - expected) <= push.depth_tolerance * expected + slope.x + slope.y;
    return same && stands_still(p, guide_depth(packed), m.motion);
}

void add_reshaded(inout Sum sum, ivec2 p, GuideBits packed) {
    ivec2 j;
    bool known = is_present(RESHADED_RADIANCE) && is_present(PREVIOUS_GUIDE) && is_present(SURFACE_MOTION);
    if (has_flag(FLAG_RESET) || !known || !previous_pixel_of(p, packed, j)) return;
    vec3 radiance = texelFetch(reshaded_radiance, host_pixel(RESHADED_RADIANCE, j), 0).rgb;
    if (is_finite(radiance)) add_change(sum, half_range(exposed(radiance)), light_of(j), j);
}

// Guide of the pixel that stands for the stratum: roughness makes room for its place.
GuideBits guide_of(GuideBits packed, uint place) {
    return GuideBits(uvec4(packed.bits.x & 0xfff0u | place, packed.bits.yzw));
}

vec4 result(Sum sum) {
    float change = sum.samples > 0.0 ? sum.change / sum.samples : 0.0;
    float brightest = sum.samples > 0.0 ? sum.brightest / sum.samples : 0.0;
    float mean = sum.surfaces > 0.0 ? sum.mean / sum.surfaces : 0.0;
    float variance = sum.surfaces > 0.0 ? max(0.0, sum.squares / sum.surfaces - mean * mean) : 0.0;
    return clamp(vec4(change, brightest, sum.origin + mean, sqrt(variance)), -65504.0, 65504.0);
}

void main() {
    ivec2 s = ivec2(gl_GlobalInvocationID.xy);
    if (!is_stratum(s)) return;
    uvec2 extent = stratum_extent(s);
    Sum sum = Sum(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, vec4(0.0), vec4(0.0));
    // The sample's own pixel stands for the stratum; else its middle, else its first surface.
    uint wanted = (extent.x - 1u) / 2u + (extent.y - 1u) / 2u * STRATUM_SIZE;
    GradientSample gradient_sample = GradientSample(ivec2(0), 0u, false);
    if (SOURCE == FORWARD_PROJECTED && is_present(GRADIENT_SAMPLES)) {
        gradient_sample = unpack_gradient_samples(texelFetch(gradient_samples, s, 0));
    }
    bool sampled = gradient_sample.valid && has_flag(FLAG_RESHADED) && !has_flag(FLAG_RESET);
    if (sampled) wanted = gradient_sample.place;
    vec2 before = sampled ? light_of(gradient_sample.previous_pixel) : vec2(0.0);
    GuideBits stands = GuideBits(uvec4(0u));
    for (uint y = 0u; y < extent.y; ++y)
        for (uint x = 0u; x < extent.x; ++x) {
            uint place = x + y * STRATUM_SIZE;
            ivec2 p = pixel_at(s, place);
            GuideBits packed = GuideBits(texelFetch(guide, p, 0));
            bool background = guide_depth(packed) == 0.0;
            KeptRadiance noisy = noisy_at(p);
            bool is_sample = sampled && place == wanted;
            // The light of a sample comes from its own point, not from the middle of the pixel.
            float a = is_sample ? before.y : albedo_at(p, background);
            if (background) continue;
            if (stands.bits == uvec4(0u) || place == wanted) stands = guide_of(packed, place);
            if (SOURCE == RESHADED) add_reshaded(sum, p, packed);
            if (!noisy.known) continue;
            float l = min(luminance(noisy.radiance), 65504.0) / a;
            if (sum.surfaces == 0.0) sum.origin = l;
            sum.mean += l - sum.origin;
            sum.squares += (l - sum.origin) * (l - sum.origin);
            sum.surfaces += 1.0;
            if (is_sample) add_change(sum, noisy.radiance, before, gradient_sample.previous_pixel);
        }
    vec4 value = result(sum);
    if (SOURCE == SPARSE) {
        vec2 host = is_present(SPARSE_GRADIENT) ? texelFetch(sparse_gradient, s, 0).xy : vec2(0.0);
        vec2 host_exposed = exposed(vec3(host, 0.0)).xy;
        value.xy = is_finite(host) ? clamp(host_exposed, vec2(-65504.0, 0.0), vec2(65504.0)) : vec2(0.0);
    }
    imageStore(gradient, s, value);
    imageStore(gradient_guide, s, stands.bits);
    if (!has_ratio()) return;
    float samples = max(sum.samples, 1.0);
    imageStore(light_before, s, min(sum.before / samples, 65504.0));
    imageStore(light_now, s, storable(vec4(sum.now.rgb, sqrt(sum.now.a)) / samples));
}
