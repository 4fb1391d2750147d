#ifndef LUMINANCE_GLSL
#define LUMINANCE_GLSL

// Rec. 709.
const vec3 LUMINANCE_PARTS = vec3(0.2126, 0.7152, 0.0722);

float luminance(vec3 c) { return dot(c, LUMINANCE_PARTS); }

// Within what a half-float image can hold; NaN becomes 0.
vec4 half_range(vec4 c) { return min(max(c, vec4(0.0)), vec4(65504.0)); }
vec3 half_range(vec3 c) { return half_range(vec4(c, 0.0)).rgb; }

// Whether a half float cannot hold a light that is finite.
bool is_saturated(vec3 c) { return max(max(c.r, c.g), c.b) > 65504.0; }

// The nearest half float, of two the larger. A device may cut bits off as it stores, which takes light from every average that is fed back;
// what is a half already is stored alike by all. Twin: src/reference/binary16.rs.
vec4 storable(vec4 c) { return uintBitsToFloat((floatBitsToUint(half_range(c)) + 0x1000u) & 0xffffe000u); }
vec3 storable(vec3 c) { return storable(vec4(c, 0.0)).rgb; }

// Of light that may be less than nothing: a sharp look-up undershoots beside a bright pixel, and a clamp in each would brighten their mean.
vec3 with_sign_of(vec3 c, vec3 magnitude) { return uintBitsToFloat(floatBitsToUint(magnitude) | (floatBitsToUint(c) & 0x80000000u)); }
vec3 signed_half_range(vec3 c) { return with_sign_of(c, half_range(abs(c))); }
vec3 signed_storable(vec3 c) { return with_sign_of(c, storable(abs(c))); }

#endif
