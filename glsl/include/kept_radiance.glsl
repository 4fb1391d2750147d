// The noisy radiance that one frame keeps, so that the next one can tell how the light changed. Twin: src/reference/kept_radiance.rs.
// noisy_luminance: luminance of the radiance of all signals, and of the albedo; noisy_red_blue: its red and blue, of which green follows.
#ifndef KEPT_RADIANCE_GLSL
#define KEPT_RADIANCE_GLSL
#include "finite.glsl"
#include "frame.glsl"
#include "luminance.glsl"

// Radiance of all signals of a pixel, as the filter counts it. One that is not finite says nothing of how bright the light is.
struct KeptRadiance {
    vec3 radiance;
    bool known;
};

KeptRadiance nothing_kept() { return KeptRadiance(vec3(0.0), true); }

void keep(inout KeptRadiance kept, vec3 radiance) {
    bool finite = is_finite(radiance);
    kept.radiance += finite ? half_range(exposed(radiance)) : vec3(0.0);
    kept.known = kept.known && finite;
}

// In an order of its own and never fused: one stage keeps it, another compares with it, and of equal light the difference is exactly 0.
float luminance_to_compare(vec3 c) {
    precise float l = 0.2126 * c.r;
    l = l + 0.7152 * c.g;
    l = l + 0.0722 * c.b;
    return l;
}

// What noisy_luminance holds of a pixel: negative where its light is not known.
float luminance_or_hole(KeptRadiance kept) { return kept.known ? luminance_to_compare(kept.radiance) : -1.0; }

// The nearest number that a half holds, of two the larger; below 2^-14 these are 2^-24 apart. A device rounds either way where it packs
// others, and need not round at all what it packs and unpacks in one shader.
float nearest_half(float x) {
    precise float steps = x * 16777216.0 + 0.5;
    float rounded = uintBitsToFloat((floatBitsToUint(min(x, 65504.0)) + 0x1000u) & 0xffffe000u);
    return x < 6.103515625e-5 ? floor(steps) / 16777216.0 : rounded;
}

uint pack_halves(vec2 v) { return packHalf2x16(vec2(nearest_half(v.x), nearest_half(v.y))); }

vec2 unpack_noisy_luminance(uint packed) { return unpackHalf2x16(packed); }  // luminance of the radiance, and of the albedo
vec2 unpack_noisy_red_blue(uint packed) { return unpackHalf2x16(packed); }

// As a texel of either image has it: what did not change differs by 0.
float kept_luminance(vec3 radiance) { return nearest_half(luminance_to_compare(radiance)); }
vec2 kept_red_blue(vec3 radiance) { return vec2(nearest_half(radiance.r), nearest_half(radiance.b)); }

vec3 radiance_of(float luminance, vec2 red_blue) {
    return vec3(red_blue.x, max(0.0, (luminance - 0.2126 * red_blue.x - 0.0722 * red_blue.y) / 0.7152), red_blue.y);
}

#endif
