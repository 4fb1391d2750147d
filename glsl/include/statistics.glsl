// Counters of values that were replaced because they were not finite. A host may read them back.
#ifndef STATISTICS_GLSL
#define STATISTICS_GLSL

const uint BAD_DEPTH = 0u;
const uint BAD_NORMAL = 1u;
const uint BAD_MOTION = 2u;
const uint BAD_RADIANCE = 3u;
const uint BAD_ALBEDO = 4u;
const uint BAD_EMISSION = 5u;

layout(set = 0, binding = 1, std430) buffer Statistics { uint counts[8]; } statistics;

void count_bad(uint which) { atomicAdd(statistics.counts[which], 1u); }

// By bits: a compiler may assume that isnan() and isinf() never hold.
bool is_finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }
bool is_nan(float x) { return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u; }
bool is_finite(vec2 v) { return is_finite(v.x) && is_finite(v.y); }
bool is_finite(vec4 v) { return is_finite(v.xy) && is_finite(v.zw); }
bool is_finite(vec3 v) { return is_finite(v.xy) && is_finite(v.z); }

#endif
