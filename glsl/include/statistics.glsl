// Counters of values that were replaced because they were not finite, or out of range. A host may read them back.
#ifndef STATISTICS_GLSL
#define STATISTICS_GLSL
#include "finite.glsl"

const uint BAD_DEPTH = 0u;
const uint BAD_NORMAL = 1u;
const uint BAD_MOTION = 2u;
const uint BAD_RADIANCE = 3u;
const uint BAD_ALBEDO = 4u;
const uint BAD_EMISSION = 5u;
const uint BAD_FORWARD_MOTION = 6u;
const uint BAD_SCATTERING_DEPTH = 7u;
const uint BAD_ROUGHNESS = 8u;
const uint BAD_HIT_DISTANCE = 9u;
const uint BAD_VISIBILITY = 10u;
const uint BAD_OCCLUDER_DISTANCE = 11u;

layout(set = 0, binding = 1, std430) buffer Statistics { uint counts[12]; } statistics;

void count_bad(uint which) { atomicAdd(statistics.counts[which], 1u); }

#endif
