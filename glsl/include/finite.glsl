#ifndef FINITE_GLSL
#define FINITE_GLSL

// By bits: a compiler may assume that isnan() and isinf() never hold.
bool is_finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }
bool is_nan(float x) { return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u; }
bool is_finite(vec2 v) { return is_finite(v.x) && is_finite(v.y); }
bool is_finite(vec4 v) { return is_finite(v.xy) && is_finite(v.zw); }
bool is_finite(vec3 v) { return is_finite(v.xy) && is_finite(v.z); }

#endif
