// How far a history is true again once it is scaled by the ratio of light. Twin: src/reference/light_ratio.rs.
#ifndef LIGHT_RATIO_GLSL
#define LIGHT_RATIO_GLSL

const float LARGEST_RATIO = 64.0;
// Share of the brightest component, below which a component has no ratio of its own.
const float RATIO_FLOOR = 1e-3;

// Light that is added to both sides of a ratio.
float floor_of_ratio(vec3 before) { return RATIO_FLOOR * max(before.r, max(before.g, before.b)) + 1e-6; }

// Relative spreads of a ratio: below the first of both numbers it is none, above the second there is no ratio. Samples of one place may
// differ, as long as their mean is known.
const vec2 SAMPLE_SPREADS = vec2(0.2, 0.5);
const vec2 STRATUM_SPREADS = vec2(0.1, 0.3);

// 1, true, to 0.
float coherence_of(float spread, vec2 spreads) { return clamp((spreads.y - spread) / (spreads.y - spreads.x), 0.0, 1.0); }

// Among the samples of a place.
float sample_coherence(float spread) { return coherence_of(spread, SAMPLE_SPREADS); }

// Between strata.
float stratum_coherence(float spread) { return coherence_of(spread, STRATUM_SPREADS); }

#endif
