// Counters of values that were replaced because they were not finite, or out of range, of surfaces that kept or lost their history, and of
// noise that repeats. A host may read them back. Twin: src/contract/statistics.rs.
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
// The first of five: one for each reason of luminance_history.glsl from REASON_NONE, history was kept, to REASON_NORMAL.
const uint HISTORY_KEPT = 12u;

// Light that a half float cannot hold, where it comes into the filter or goes out of it.
const uint SATURATED = 17u;

const uint BAD_HIT_ID = 18u;
const uint BAD_OCCLUDER_ID = 19u;
const uint BAD_OCCLUDER_MOTION = 20u;
const uint BAD_SPECULAR_MOTION = 21u;
const uint BAD_MATERIAL_CLASS = 22u;

// A surface whose noise comes again from frame to frame.
const uint REPEATED_SAMPLE = 23u;

layout(set = 0, binding = 1, std430) buffer Statistics { uint counts[24]; } statistics;

void count_bad(uint which) { atomicAdd(statistics.counts[which], 1u); }

// One add for each reason, since compilers merge those whose place is the same for all.
void count_history(uint reason) {
    for (uint i = 0u; i < 5u; ++i)
        if (reason == i) atomicAdd(statistics.counts[HISTORY_KEPT + i], 1u);
}

#endif
